"""Two clocks for a GPU: its own, around each pass, and the wall's, with many frames under way at once."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import TYPE_CHECKING

from zeroset.bench.timing import FEWEST, MOST, Times
from zeroset.kernel import U32

if TYPE_CHECKING:
    from zeroset.runtime.gpu.device import GpuDevice

Action = Callable[[], object]
ROUNDS = 3
"""How often frames are sent off without waiting; each round ends with a wait for its last frame."""


@dataclass(frozen=True, slots=True)
class Passes:
    """What the GPU's clock says of one frame.

    Attributes:
        each: name and milliseconds of each pass, in order.
        busy: the sum of them.
        span: from the first one's beginning to the last one's end.
    """

    each: tuple[tuple[str, float], ...]
    busy: float
    span: float


def timed_passes(device: GpuDevice, action: Action) -> Passes | None:
    """What an action's passes take on the GPU itself; None where the GPU has no clock."""
    clock = device.stream.clock
    if clock is None:
        return None
    device.submit()
    clock.start()
    try:
        action()
        device.submit()
    finally:
        found = clock.stop()
    each = tuple((label, end - begin) for label, begin, end in found)
    begin, end = min(b for _, b, _ in found), max(e for _, _, e in found)
    return Passes(each, sum(spent for _, spent in each), end - begin)


def gpu_turns(device: GpuDevice, actions: Sequence[Action], seconds: float) -> tuple[tuple[Passes, ...], ...]:
    """Time several actions by turns on the GPU's clock, after one round that does not count.

    Gives what each action took, once for each round; nothing where the GPU has no clock.
    """
    taken: list[list[Passes]] = [[] for _ in actions]
    rounds, end = -1, time.perf_counter() + seconds
    while rounds < FEWEST or (rounds < MOST and time.perf_counter() < end):
        for times, action in zip(taken, actions, strict=True):
            passes = timed_passes(device, action)
            if passes is None:
                return tuple(() for _ in actions)
            if rounds >= 0:
                times.append(passes)
        rounds += 1
    return tuple(map(tuple, taken))


def spans(passes: Sequence[Passes]) -> Times | None:
    """The spans of an action's repetitions; None where there is none."""
    return _times([p.span for p in passes]) if passes else None


def in_flight(device: GpuDevice, draw: Action, seconds: float) -> tuple[Times, Times]:
    """Wall milliseconds a frame where frames are sent off one after the other and only the last is waited for.

    Args:
        device: where the frames are drawn.
        draw: asks for one frame and does not wait for it.
        seconds: for all rounds together, about.

    Returns:
        Milliseconds a frame, and how many of them the host took to ask for it; one figure for each round.
    """
    # Reading a buffer, however small, waits for all that was asked for before.
    last = device.allocate(U32, 1)
    whole, asking = [], []
    count = FEWEST
    for round_ in range(-1, ROUNDS):
        begin = time.perf_counter()
        for _ in range(count):
            draw()
        asked = time.perf_counter()
        device.read(last)
        done = time.perf_counter()
        spent = (done - begin) * 1e3 / count
        if round_ < 0:
            count = min(max(FEWEST, int(seconds * 1e3 / ROUNDS / spent)), MOST)
        else:
            whole.append(spent)
            asking.append((asked - begin) * 1e3 / count)
    return _times(whole), _times(asking)


def _times(values: Sequence[float]) -> Times:
    return Times(median(values), min(values), len(values))
