from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Callable
from itertools import count

import pytest

from zeroset.errors import DeviceError
from zeroset.runtime.pool import Pool, thread_count

THREADS = pytest.mark.parametrize("threads", [1, 2, 5])


def numbers(limit: int, seen: list[int]) -> Callable[[], bool]:
    """A job that takes the numbers below ``limit``, each once."""
    following = count()

    def job() -> bool:
        number = next(following)
        if number < limit:
            seen.append(number)
        return number < limit

    return job


@THREADS
def test_a_job_is_done_once_and_whole(threads: int) -> None:
    pool = Pool(threads)
    for _ in range(20):
        seen: list[int] = []
        pool.run(numbers(100, seen))
        assert sorted(seen) == list(range(100))
    pool.close()


def test_every_thread_takes_part() -> None:
    pool, gate, names = Pool(3), threading.Barrier(3), set()

    def job() -> bool:
        names.add(threading.get_ident())
        gate.wait(60)
        return False

    pool.run(job)
    assert len(names) == 3
    assert threading.get_ident() in names
    pool.close()


def test_one_thread_is_the_callers() -> None:
    names = set()
    Pool(5).run(lambda: bool(names.add(threading.get_ident())), threads=1)
    assert names == {threading.get_ident()}


@THREADS
def test_errors_come_back_and_the_pool_goes_on(threads: int) -> None:
    pool = Pool(threads)
    following = count()

    def job() -> bool:
        if next(following) == 50:
            raise ValueError("fifty")
        return True

    with pytest.raises(ValueError, match="fifty"):
        pool.run(job)
    seen: list[int] = []
    pool.run(numbers(10, seen))
    assert len(seen) == 10
    pool.close()


def test_an_error_of_another_thread() -> None:
    pool, here, gate = Pool(2), threading.get_ident(), threading.Barrier(2)

    def job() -> bool:
        gate.wait(60)
        if threading.get_ident() != here:
            raise ValueError("elsewhere")
        return False

    with pytest.raises(ValueError, match="elsewhere"):
        pool.run(job)
    pool.close()


def test_an_interrupt_ends_the_work_of_all() -> None:
    """The other thread would never end by itself."""
    pool, here, gate = Pool(2), threading.get_ident(), threading.Event()

    def job() -> bool:
        if threading.get_ident() == here:
            gate.wait(60)
            raise KeyboardInterrupt
        gate.set()
        return True

    with pytest.raises(KeyboardInterrupt):
        pool.run(job)
    pool.close()


def test_an_interrupt_at_any_moment_ends_the_job() -> None:
    """Between asking a thread and waiting for it are many steps, and Ctrl-C may come after each of them."""
    if not hasattr(os, "fork"):
        pytest.skip("this system does not fork")
    program = """
import os, random, select, signal, time
from itertools import count
from zeroset.runtime.pool import Pool

def run(told):
    signal.signal(signal.SIGINT, signal.default_int_handler)
    pool = Pool(2)
    os.write(told, b"r")
    try:
        while True:
            numbers = count()
            pool.run(lambda: next(numbers) < 40)
    except KeyboardInterrupt:
        os.write(told, b"k")
        os._exit(0)

random.seed(1)
for _ in range(100):
    here, there = os.pipe()
    child = os.fork()
    if child == 0:
        run(there)
    assert os.read(here, 1) == b"r"
    time.sleep(random.uniform(0.002, 0.02))
    os.kill(child, signal.SIGINT)
    ended = select.select([here], [], [], 10)[0]
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    assert ended, "an interrupted job has not come back"
    os.close(here)
    os.close(there)
"""
    subprocess.run([sys.executable, "-W", "ignore", "-c", program], check=True, timeout=120)


def test_threads_of_a_forked_process() -> None:
    if not hasattr(os, "fork"):
        pytest.skip("this system does not fork")
    program = """
import os, warnings
warnings.simplefilter("ignore")
from itertools import count
from zeroset.runtime.pool import Pool
pool, first, second = Pool(3), count(), count()
pool.run(lambda: next(first) < 50)
child = os.fork()
pool.run(lambda: next(second) < 50)
if child == 0:
    os._exit(7)
assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
"""
    subprocess.run([sys.executable, "-c", program], check=True, timeout=60)


@THREADS
def test_the_environment_sets_the_number(threads: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ZEROSET_THREADS", str(threads))
    assert thread_count() == threads


@pytest.mark.parametrize("asked", ["0", "-1", "many", "1.5", "99999"])
def test_numbers_that_cannot_be(asked: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ZEROSET_THREADS", asked)
    with pytest.raises(DeviceError, match="ZEROSET_THREADS"):
        thread_count()


def test_the_default_is_what_the_process_may_use(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ZEROSET_THREADS", raising=False)
    monkeypatch.setattr(os, "sched_getaffinity", lambda process: {3, 5, 8}, raising=False)
    assert thread_count() == 3
    monkeypatch.delattr(os, "sched_getaffinity")
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert thread_count() == 1
