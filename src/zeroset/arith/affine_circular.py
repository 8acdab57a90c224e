"""Circular functions of affine forms and their inverses; see ``affine_functions`` for p, d and w."""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.arith import elementary
from zeroset.arith import scalar as s
from zeroset.arith.interval import Interval
from zeroset.arith.linearise import Expansion, linearise, narrower, picked, point, span
from zeroset.arith.scalar import (
    Scalar,
    absolute,
    and_,
    fma,
    gt,
    is_literal,
    is_zero,
    le,
    lt,
    maximum,
    minimum,
    or_,
)  # fmt: skip

if TYPE_CHECKING:
    from zeroset.arith.affine_form import F

_HALF_PI = (1.5707963267948966, 1.5707963267948968)

__all__ = ["acos", "asin", "atan", "atan2", "cos", "sin", "tan"]


def sin(a: F) -> F:
    """The sine."""
    sine, cosine = elementary.sincos(a.fmt, point(a))
    return _wave(a, "sin", sine, cosine)


def cos(a: F) -> F:
    """The cosine."""
    sine, cosine = elementary.sincos(a.fmt, point(a))
    return _wave(a, "cos", cosine, -sine)


def _wave(a: F, name: str, value: Scalar, slope: Scalar) -> F:
    """f(p + d) = f(p) cos d + f'(p) sin d, so w is between 0 and -f(p)/2, within |f'(p) d|/6.

    That needs no values at the ends of the range; the fallback is [-1, 1], unless an interval goes along or is all
    there is: what depends on parameters alone has no terms.
    """
    fmt, p, r = a.fmt, point(a), span(a)
    error = elementary.error_bound(name, fmt)
    size = absolute(p) + r
    enclosure: Interval
    if a.system.intersect or all(is_zero(u) for u in a.terms):
        enclosure = getattr(a.interval(), name)()
    else:
        enclosure = Interval(a.system.intervals, -1.0, 1.0, a.flags)
    # The reduction's error is absolute: in the value, times d in the slope, times d**2 in w.
    spread = (error.slope * size) * (1.0 + r) * (1.0 + r)
    valid = le(size, elementary.trigonometric_limit(fmt))
    cubic = (absolute(slope) * r) * (1.0 / 6.0)
    low, high = fma(maximum(value, 0.0), -0.5, -cubic), fma(minimum(value, 0.0), -0.5, cubic)
    return linearise(a, enclosure, Expansion(value, slope, low, high, error.relative, error.relative, spread, valid))


def tan(a: F) -> F:
    """The tangent: f''/2 = t (1 + t**2) grows with t."""
    fmt, p, x = a.fmt, point(a), a.interval()
    enclosure = x.tan()
    value = elementary.tan(fmt, p)
    slope = fma(value, value, 1.0)
    error = elementary.error_bound("tan", fmt)
    low, high = minimum(enclosure.lo, 0.0), maximum(enclosure.hi, 0.0)
    low, high = low * fma(low, low, 1.0), high * fma(high, high, 1.0)
    spread = (error.slope * slope * absolute(p)) * fma(2.0 * absolute(value), a.reach(), 1.0)
    accuracy = 2 * error.relative + 4
    valid = and_(lt(enclosure.hi, fmt.big), gt(enclosure.lo, -fmt.big))
    return linearise(a, enclosure, Expansion(value, slope, low, high, error.relative, accuracy, spread, valid))


def asin(a: F) -> F:
    """The arc sine: f''/2 = x/2 (1 - x**2)**(-3/2) grows with x."""
    return _arc(a, "asin", 1.0)


def acos(a: F) -> F:
    """The arc cosine: pi/2 - asin(x)."""
    return _arc(a, "acos", -1.0)


def _arc(a: F, name: str, sign: float) -> F:
    fmt, p, x = a.fmt, point(a), a.interval()
    enclosure: Interval = getattr(x, name)()
    slope = s.div(sign, s.sqrt(_leg(p)))
    ends = minimum(x.lo, 0.0), maximum(x.hi, 0.0)
    low, high = (s.div(0.5 * e, _leg(e) * s.sqrt(_leg(e))) for e in ends)
    if sign < 0:
        low, high = -high, -low
    error = elementary.error_bound(name, fmt).relative
    valid = and_(gt(x.lo, -1.0), lt(x.hi, 1.0))
    value = getattr(elementary, name)(fmt, p)
    return linearise(a, enclosure, Expansion(value, slope, low, high, error, 5.0, valid=valid))


def _leg(x: Scalar) -> Scalar:
    """1 - x**2, accurate next to 1; 0 beyond."""
    return maximum((1.0 - x) * (1.0 + x), 0.0)


def atan(a: F) -> F:
    """The arc tangent: f''/2 = -x/(1 + x**2)**2, at most 3 sqrt(3)/16 in size."""
    fmt, p, x = a.fmt, point(a), a.interval()
    enclosure = x.atan()
    slope = 1.0 / fma(p, p, 1.0)
    least = maximum(maximum(x.lo, s.neg(x.hi)), 0.0)
    flat = 1.0 / fma(least, least, 1.0)
    square = flat * flat
    high = minimum(-minimum(x.lo, 0.0) * square, 0.325)
    low = maximum(-maximum(x.hi, 0.0) * square, -0.325)
    error = elementary.error_bound("atan", fmt).relative
    valid = lt(maximum(absolute(x.lo), absolute(x.hi)), 2.0**50)
    return linearise(a, enclosure, Expansion(elementary.atan(fmt, p), slope, low, high, error, 4.0, valid=valid))


def atan2(y: F, x: F) -> F:
    """The angle: atan(y/x) right of the origin, atan(-x/y) a quarter turn on above and below it.

    Left of the origin, across or on the axis, the interval is all there is.
    """
    over, beside = y.interval(), x.interval()
    enclosure = over.atan2(beside)
    right, above, below = gt(beside.lo, 0.0), gt(over.lo, 0.0), lt(over.hi, 0.0)
    top, bottom = picked(right, y, x.neg()), picked(right, x, y)
    turn, none = y.system.constant(*_HALF_PI), y.literal(0.0)
    like = beside.lo if is_literal(over.lo) else over.lo
    offset = picked(right, none, picked(above, turn, turn.neg(), like), like)
    return narrower(atan(top.div(bottom)).add(offset), enclosure, or_(right, above, below))
