"""The newest wish wins, errors are answers, and the thread ends."""

from __future__ import annotations

import threading

from zeroset.errors import ZerosetError
from zeroset.view.worker import Failed, GivenUp, Newest, Superseded, told


def test_what_was_asked_in_between_is_forgotten() -> None:
    gate, begun = threading.Event(), threading.Event()

    def work(job: int, superseded: Superseded) -> int:
        begun.set()
        assert gate.wait(10)
        return job

    worker = Newest("test", work)
    worker.ask(1)
    assert begun.wait(10)
    for job in (2, 3, 4):
        worker.ask(job)
    gate.set()
    assert worker.wait(10)
    assert worker.answers() == [1, 4]
    assert worker.answers() == []
    assert worker.close()


def test_jobs_about_different_things_wait_for_each_other() -> None:
    gate, begun = threading.Event(), threading.Event()
    seen: list[bool] = []

    def work(job: tuple[str, int], superseded: Superseded) -> tuple[str, int]:
        begun.set()
        assert gate.wait(10)
        seen.append(superseded())
        return job

    worker = Newest("test", work, about=lambda job: job[0])
    worker.ask(("a", 1))
    assert begun.wait(10)
    for job in (("b", 1), ("b", 2), ("c", 1), ("b", 3)):
        worker.ask(job)
    gate.set()
    assert worker.wait(10)
    assert worker.answers() == [("a", 1), ("c", 1), ("b", 3)]
    assert not any(seen)
    assert worker.close()


def test_a_job_may_give_up_when_a_newer_one_waits() -> None:
    begun = threading.Event()

    def work(job: str, superseded: Superseded) -> str:
        begun.set()
        while job == "long":
            if superseded():
                raise GivenUp
        return job

    worker = Newest("test", work)
    worker.ask("long")
    assert begun.wait(10)
    worker.ask("short")
    assert worker.wait(10)
    assert worker.answers() == ["short"]
    assert worker.close()


def test_errors_of_any_kind_are_answers_and_the_thread_goes_on() -> None:
    woken: list[int] = []

    def work(job: Exception | int, superseded: Superseded) -> int:
        if isinstance(job, Exception):
            raise job
        return job

    worker = Newest("test", work, lambda: woken.append(1))
    for job in (ZerosetError("no", hint="yes"), RecursionError("deep"), MemoryError(), 5):
        worker.ask(job)
        assert worker.wait(10)
    answers = worker.answers()
    assert worker.close()
    assert [a.text for a in answers if isinstance(a, Failed)] == [
        "no\n  hint: yes",
        "this should not have happened: RecursionError: deep",
        "there is not enough memory for this",
    ]
    assert answers[-1] == 5
    assert len(woken) == 4


def test_closing_ends_a_job_that_looks_up() -> None:
    begun = threading.Event()

    def work(job: int, superseded: Superseded) -> int:
        begun.set()
        while not superseded():
            pass
        raise GivenUp

    worker = Newest("test", work)
    worker.ask(1)
    assert begun.wait(10)
    assert worker.busy
    assert worker.close(10)


def test_what_users_are_told() -> None:
    assert told(ZerosetError("m")) == "m"
    assert "ValueError" in told(ValueError("x"))
