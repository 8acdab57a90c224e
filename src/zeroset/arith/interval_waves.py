"""sin, cos and tan of intervals: extrema and poles are found by counting turns.

An extremum or a pole lies in [lo, hi] if an integer lies between x/period - phase at both ends; the ends are moved
outward by more than the rounding of that, so none is missed. Beyond ``trigonometric_limit`` the honest answer is
everything.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from zeroset.arith import elementary
from zeroset.arith.rounding import lower, upper
from zeroset.arith.scalar import (
    Mask,
    Scalar,
    absolute,
    floor,
    fma,
    gt,
    maximum,
    minimum,
    not_,
    or_,
    select,
)  # fmt: skip

if TYPE_CHECKING:
    from zeroset.arith.interval_bounds import B, Bounds

__all__ = ["cos", "sin", "tan"]


def sin(x: B) -> B:
    """The sine: maxima at a quarter turn, minima at three quarters."""
    return _wave(x, "sin", 0.25, 0.75)


def cos(x: B) -> B:
    """The cosine: maxima at full turns, minima at half turns."""
    return _wave(x, "cos", 0.0, 0.5)


def _size(x: Bounds) -> Scalar:
    return maximum(absolute(x.lo), absolute(x.hi))


def _holds_turn(x: Bounds, size: Scalar, period: float, phase: float) -> Mask:
    """Whether x/period - phase is an integer somewhere in the interval, or may be.

    The quotient rounds twice (the constant and the product), the difference once, each by at most eps times
    |x|/period + 1.
    """
    eps, turns = x.fmt.eps, 1.0 / period
    slack = fma(size, 4 * turns * eps, 4 * eps)
    first, last = fma(x.lo, turns, -phase) - slack, fma(x.hi, turns, -phase) + slack
    return gt(floor(last), floor(first))


def _wave(x: B, name: str, top: float, bottom: float) -> B:
    fmt, size = x.fmt, _size(x)
    bound = elementary.error_bound(name, fmt)
    function, k, slack = getattr(elementary, name), bound.relative + 1.1, bound.slope * size
    first, last = function(fmt, x.lo), function(fmt, x.hi)
    low = maximum(lower(fmt, minimum(first, last), k, slack), -1.0)
    high = minimum(upper(fmt, maximum(first, last), k, slack), 1.0)
    beyond = gt(size, elementary.trigonometric_limit(fmt))
    down = or_(beyond, _holds_turn(x, size, 2 * math.pi, bottom))
    up = or_(beyond, _holds_turn(x, size, 2 * math.pi, top))
    return x.make(select(down, -1.0, low, like=x.lo), select(up, 1.0, high, like=x.lo))


def tan(x: B) -> B:
    """The tangent: increasing between poles, everything across one."""
    fmt, size = x.fmt, _size(x)
    bound = elementary.error_bound("tan", fmt)
    pole = or_(gt(size, elementary.trigonometric_limit(fmt)), _holds_turn(x, size, math.pi, 0.5))
    low, high = elementary.tan(fmt, x.lo), elementary.tan(fmt, x.hi)
    k, slope = bound.relative + 1.1, bound.slope * size
    low, high = lower(fmt, low, k, slope * fma(low, low, 1.0)), upper(fmt, high, k, slope * fma(high, high, 1.0))
    flags = x.flags.within(not_(pole)).growing()
    return x.make(select(pole, -fmt.big, low, like=x.lo), select(pole, fmt.big, high, like=x.lo), flags)
