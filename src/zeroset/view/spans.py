"""Ranges of sliders, in round numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Span:
    """The range of a slider."""

    low: float
    high: float


UNIT = Span(-1.0, 1.0)


def usual_span(value: float) -> Span:
    """A sensible range around a value: to twice its size on either side of zero, in round numbers.

    Example:
        >>> usual_span(5.0), usual_span(0.0)
        (Span(low=-10.0, high=10.0), Span(low=-1.0, high=1.0))
    """
    if value == 0.0:
        return UNIT
    twice = 2.0 * abs(value)
    unit = 10.0 ** math.floor(math.log10(twice))
    reach = next(step * unit for step in (1.0, 2.0, 5.0, 10.0) if step * unit >= twice * (1 - 1e-12))
    return Span(-reach, reach)


def around(low: float, high: float) -> Span:
    """The range between round numbers that holds two others; around one alone where they are the same.

    Example:
        >>> around(-3.2, 12.9), around(4.0, 4.0)
        (Span(low=-4.0, high=14.0), Span(low=-10.0, high=10.0))
    """
    if not high - low > 1e-9 * max(abs(low), abs(high)):
        return usual_span(high)
    step = nice_step(high - low)
    return Span(multiple(math.floor(low / step), step), multiple(math.ceil(high / step), step))


def multiple(count: int, step: float) -> float:
    """So many round steps as the number that reads best.

    Example:
        >>> 3 * 0.1, multiple(3, 0.1)
        (0.30000000000000004, 0.3)
    """
    return float(f"{count * step:.12g}")


def nice_step(length: float) -> float:
    """A round number, 1, 2 or 5 times a power of ten, that goes into a length some ten times at most.

    Example:
        >>> nice_step(3.0), nice_step(40.0)
        (0.5, 5.0)
    """
    unit = 10.0 ** math.floor(math.log10(length / 8.0))
    return next(step * unit for step in (1.0, 2.0, 5.0, 10.0) if step * unit >= length / 8.0 * 0.75)
