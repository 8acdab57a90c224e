"""A GPU's clocks: what is timed, how often, and that nothing is left running."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from zeroset.bench.flight import ROUNDS, Passes, gpu_turns, in_flight, spans, timed_passes
from zeroset.bench.timing import FEWEST, MOST


class _Clock:
    """A clock that has every action make two passes, one millisecond apart."""

    running = False

    def start(self) -> None:
        assert not self.running
        self.running = True

    def stop(self) -> list[tuple[str, float, float]]:
        self.running = False
        return [("beams", 10.0, 12.0), ("primary", 13.0, 17.0)]


def _device(clock: _Clock | None, calls: list[str]) -> Any:
    def note(what: str) -> Callable[..., None]:
        return lambda *_: calls.append(what)

    stream = SimpleNamespace(clock=clock)
    return SimpleNamespace(stream=stream, submit=note("submit"), allocate=lambda *_: None, read=note("read"))


def test_passes_are_added_up_and_spanned() -> None:
    calls: list[str] = []
    passes = timed_passes(_device(_Clock(), calls), lambda: calls.append("draw"))
    assert passes == Passes((("beams", 2.0), ("primary", 4.0)), busy=6.0, span=7.0)
    # What was asked for before must not be timed, and what is timed must have been handed over.
    assert calls == ["submit", "draw", "submit"]


def test_a_gpu_without_a_clock_tells_nothing() -> None:
    calls: list[str] = []
    device = _device(None, calls)
    assert timed_passes(device, lambda: calls.append("draw")) is None
    assert gpu_turns(device, (lambda: None, lambda: None), 0.0) == ((), ())
    assert spans(()) is None
    assert calls == []


def test_a_clock_is_stopped_when_an_action_fails() -> None:
    clock = _Clock()

    def fail() -> None:
        raise ArithmeticError

    try:
        timed_passes(_device(clock, []), fail)
    except ArithmeticError:
        assert not clock.running
    else:
        raise AssertionError


def test_actions_take_turns_after_a_round_that_does_not_count() -> None:
    calls: list[str] = []
    frames, limits = gpu_turns(_device(_Clock(), []), (lambda: calls.append("a"), lambda: calls.append("b")), 0.0)
    assert calls == ["a", "b"] * (1 + FEWEST)
    assert len(frames) == len(limits) == FEWEST
    times = spans(frames)
    assert times is not None
    assert (times.median, times.best, times.count) == (7.0, 7.0, FEWEST)


def test_only_the_last_frame_of_a_round_is_waited_for() -> None:
    calls: list[str] = []
    wall, host = in_flight(_device(None, calls), lambda: calls.append("draw"), 0.0)
    assert calls == (["draw"] * FEWEST + ["read"]) * (1 + ROUNDS)
    assert wall.count == host.count == ROUNDS
    assert 0 <= host.best <= wall.best
    calls.clear()
    in_flight(_device(None, calls), lambda: calls.append("draw"), 3600.0)
    assert calls.count("draw") == FEWEST + ROUNDS * MOST
