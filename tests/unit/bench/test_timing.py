"""The clock: turns are taken as promised; what they took is nobody's business here."""

from __future__ import annotations

from zeroset.bench.timing import FEWEST, MOST, take_turns


def test_actions_take_turns() -> None:
    calls: list[str] = []
    times = take_turns((lambda: calls.append("a"), lambda: calls.append("b")), seconds=0.0)
    assert calls == ["a", "b"] * (2 + FEWEST)
    assert [t.count for t in times] == [FEWEST, FEWEST]
    assert all(0.0 <= t.best <= t.median for t in times)


def test_fast_actions_come_to_an_end() -> None:
    (times,) = take_turns((lambda: None,), seconds=3600.0)
    assert times.count == MOST
