"""The clock: actions repeated in steady state, and what is kept of their times."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

FEWEST, MOST = 3, 200
"""Repetitions of one action: never fewer, however slow it is, and never more, however fast."""


@dataclass(frozen=True, slots=True)
class Times:
    """What repeating an action took.

    Attributes:
        median: milliseconds.
        best: milliseconds.
        count: repetitions.
    """

    median: float
    best: float
    count: int


def take_turns(actions: Sequence[Callable[[], object]], seconds: float) -> tuple[Times, ...]:
    """Time several actions by turns for about so many seconds in all, after two rounds that do not count.

    By turns, so that what else the machine does disturbs all of them alike. Two rounds, for a program measures its
    first run to decide how many threads its next ones are worth.
    """
    taken: list[list[float]] = [[] for _ in actions]
    for _ in range(2):
        _round(actions)
    end = time.perf_counter() + seconds
    while len(taken[0]) < FEWEST or (len(taken[0]) < MOST and time.perf_counter() < end):
        for times, spent in zip(taken, _round(actions), strict=True):
            times.append(spent)
    return tuple(Times(statistics.median(times), min(times), len(times)) for times in taken)


def _round(actions: Sequence[Callable[[], object]]) -> list[float]:
    spent = []
    for action in actions:
        begin = time.perf_counter()
        action()
        spent.append((time.perf_counter() - begin) * 1e3)
    return spent
