"""How a value runs through an animation: from here to there, there and back, round and round.

Motions are *open* (the last frame shows the end) or *closed* (the frame after the last would be the first again, so
that the movie repeats without a jump). Which one is the motion's own affair, so several may run side by side.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from zeroset.errors import ParameterError, did_you_mean
from zeroset.scene.parameters import scalar

_NUMBER = re.compile(
    r"(?P<sign>[-+]?)(?P<factor>(\d+\.?\d*|\.\d+)(e[-+]?\d+)?)?\s*\*?\s*(?P<pi>pi)?(\s*/\s*(?P<by>\d+\.?\d*))?",
    re.IGNORECASE | re.ASCII,
)


@dataclass(frozen=True, slots=True)
class Moment:
    """One frame of an animation.

    Attributes:
        index: its number, from 0.
        count: how many frames there are.
    """

    index: int
    count: int

    def share(self, closed: bool) -> float:
        """How far the animation is: to 1 with the last frame, or to 1 with the frame after it if it is closed."""
        return self.index / (self.count if closed else max(1, self.count - 1))


class Path(Protocol):
    """What gives a value for each frame."""

    def at(self, moment: Moment) -> float | npt.NDArray[np.float64]:
        """The value in a frame."""


def _ping_pong(share: float) -> float:
    return 1.0 - abs(1.0 - 2.0 * (share % 1.0))


SHAPES: dict[str, Callable[[float], float]] = {
    "linear": lambda share: share,
    "loop": lambda share: share % 1.0,
    "ping-pong": _ping_pong,
    "sine": lambda share: 0.5 - 0.5 * math.cos(2.0 * math.pi * share),
}
"""Ways from the first value (0) to the second (1), by name; all but ``linear`` are closed."""


@dataclass(frozen=True, slots=True)
class Motion:
    """A number on its way between two others.

    Attributes:
        first: where it begins.
        second: where it goes.
        shape: ``linear`` (and stays), ``loop`` (and begins again), ``ping-pong`` or ``sine`` (and comes back).
        times: how often, in the whole animation.

    Example:
        >>> [Motion(1.0, 5.0).at(Moment(i, 3)) for i in range(3)]
        [1.0, 3.0, 5.0]
        >>> [Motion(1.0, 5.0, "ping-pong").at(Moment(i, 4)) for i in range(4)]
        [1.0, 3.0, 5.0, 3.0]
    """

    first: float
    second: float
    shape: str = "linear"
    times: int = 1

    def at(self, moment: Moment) -> float:
        """The value in a frame."""
        # A closed motion is the same one period later, and whole turns are left out exactly.
        share = moment.index * self.times % moment.count / moment.count if self.closed else moment.share(False)
        part = SHAPES[self.shape](share)
        return self.first * (1.0 - part) + self.second * part

    @property
    def closed(self) -> bool:
        """Whether it ends where it begins."""
        return self.shape != "linear"


@dataclass(frozen=True, slots=True)
class Swing:
    """A row of numbers, each swinging about a place of its own: the path of an array parameter.

    Attributes:
        around: the places.
        by: how far each goes to either side.
        turns: how often, a whole number each, so that the motion is closed.
        phase: where in its turn each begins, from 0 to 1.

    Example:
        >>> Swing((0.0, 5.0), (1.0, 2.0), (1, 1), (0.0, 0.25)).at(Moment(1, 4)).tolist()
        [1.0, 5.0]
    """

    around: Sequence[float]
    by: Sequence[float]
    turns: Sequence[int]
    phase: Sequence[float]

    def at(self, moment: Moment) -> npt.NDArray[np.float64]:
        """The values in a frame."""
        angle = 2.0 * np.pi * (np.asarray(self.turns) * moment.share(True) + np.asarray(self.phase))
        # Rounded, so that what is zero by its angle is zero: frames of one moment are then equal bit by bit.
        values: npt.NDArray[np.float64] = np.round(np.asarray(self.around) + np.asarray(self.by) * np.sin(angle), 12)
        return values


def read_number(text: str) -> float:
    """A number as people write it for angles and times; raises ``ValueError``.

    Example:
        >>> read_number("-2pi/3") == -2 * math.pi / 3
        True
        >>> read_number("1.5")
        1.5
    """
    found = _NUMBER.fullmatch(text.strip())
    if not found or not (found["factor"] or found["pi"]):
        raise ValueError(text)
    by = float(found["by"] or 1.0)
    if by == 0.0:
        raise ValueError(text)
    value = float(found["factor"] or 1.0) * (math.pi if found["pi"] else 1.0) / by
    return -value if found["sign"] == "-" else value


def read_motion(name: str, text: str) -> Motion:
    """A motion from ``1:5``, ``0:2pi:loop`` or ``1:5:sine:3``.

    Raises:
        ParameterError: the text is no motion.

    Example:
        >>> read_motion("a", "1:5:sine")
        Motion(first=1.0, second=5.0, shape='sine', times=1)
    """
    first, *rest = text.split(":")
    try:
        ends = read_number(first), read_number(rest[0])
        shape = rest[1].strip() if len(rest) > 1 else "linear"
        times = int(rest[2]) if len(rest) > 2 else 1
        if len(rest) > 3:
            raise ValueError
    except (ValueError, IndexError):
        raise ParameterError(
            f"cannot read how {name} moves: {text!r}",
            hint=f"write {name}=1:5, or {name}=1:5:sine, or {name}=0:2pi:loop:3 for three times",
        ) from None
    return checked(name, Motion(*ends, shape, times))


def checked(name: str, motion: Motion) -> Motion:
    """The motion, if it is one."""
    ends = scalar(name, motion.first), scalar(name, motion.second)
    if motion.shape not in SHAPES:
        raise ParameterError(
            f"{name} cannot move as {motion.shape!r}",
            hints=(*did_you_mean(str(motion.shape), SHAPES), f"there are {', '.join(SHAPES)}"),
        )
    if isinstance(motion.times, bool) or not isinstance(motion.times, int) or not 1 <= motion.times <= 1_000_000:
        raise ParameterError(f"{name} must move a whole number of times, at least once, not {motion.times!r}")
    if motion.times > 1 and not motion.closed:
        raise ParameterError(
            f"{name} cannot move more than once from one value to another and stay there",
            hint="say how it begins again: loop, ping-pong or sine",
        )
    if ends[0] == ends[1]:
        raise ParameterError(f"{name} does not move: it goes from {ends[0]:g} to {ends[1]:g}")
    return Motion(*ends, motion.shape, motion.times)


def as_path(name: str, value: Any) -> Path:
    """A path from what users write: a Motion, text, ``(1, 5)``, ``(1, 5, "sine")`` or ``(1, 5, "sine", 3)``."""
    if isinstance(value, str):
        return read_motion(name, value)
    if isinstance(value, Motion):
        return checked(name, value)
    if isinstance(value, Swing):
        return value
    if isinstance(value, (tuple, list)) and 2 <= len(value) <= 4:
        return checked(name, Motion(*value))
    raise ParameterError(
        f"cannot read how {name} moves: {value!r}", hint=f"try vary={{'{name}': (1, 5)}} or {{'{name}': '1:5:sine'}}"
    )
