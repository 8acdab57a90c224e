"""Elementary functions of intervals: end points for the monotone ones, domains respected.

Each scalar function of ``elementary`` states its error bound; the bounds here are moved outward by that. Where an
interval sticks out of a domain, the part inside counts, and the flags say so. The periodic ones are in
``interval_waves``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.arith import elementary
from zeroset.arith import scalar as s
from zeroset.arith.flags import Flags
from zeroset.arith.interval_waves import cos, sin, tan
from zeroset.arith.rounding import lower, lower_nonnegative, upper, upper_nonnegative
from zeroset.arith.scalar import Scalar, and_, ge, gt, is_literal, le, lt, maximum, minimum, or_, select

if TYPE_CHECKING:
    from zeroset.arith.interval_bounds import B, Bounds

__all__ = [
    "acos", "asin", "atan", "atan2", "cbrt", "cos", "cosh", "exp", "log", "power", "rational_power", "sin", "sinh",
    "sqrt", "tan", "tanh",
]  # fmt: skip

_PI_ABOVE = {"f32": 3.1415929794311523, "f64": 3.1415926535897936}


def ends(x: B, name: str, lo: Scalar, hi: Scalar, flags: Flags | None = None, nonnegative: bool = False) -> B:
    """The interval between f(lo) and f(hi), moved outward by the stated error of f."""
    fmt = x.fmt
    function, bound = getattr(elementary, name), elementary.error_bound(name, fmt)
    k, slack = bound.relative + 1.1, bound.absolute
    low, high = function(fmt, lo), function(fmt, hi)
    if nonnegative:
        return x.make(
            lower_nonnegative(fmt, low, k, slack), upper_nonnegative(fmt, high, k, slack), flags, nonnegative=True
        )
    return x.make(lower(fmt, low, k, slack), upper(fmt, high, k, slack), flags)


def within(x: B, lo: float, hi: float) -> B:
    """An interval cut to bounds that its function is known to keep."""
    return x.make(minimum(maximum(x.lo, lo), hi), maximum(minimum(x.hi, hi), lo), nonnegative=x.nonnegative or lo >= 0)


def sqrt(x: B) -> B:
    """The square root of the part that is not negative."""
    fmt = x.fmt
    lo, hi = (x.lo, x.hi) if x.nonnegative else (maximum(x.lo, 0.0), maximum(x.hi, 0.0))
    flags = x.flags if x.nonnegative else x.flags.within(ge(x.lo, 0.0), lt(x.hi, 0.0))
    root = x.make(lower_nonnegative(fmt, s.sqrt(lo)), upper_nonnegative(fmt, s.sqrt(hi)), flags, nonnegative=True)
    return root.endless_as(False, x.endless()[1])


def exp(x: B) -> B:
    """e**x; reaches ``big`` where it would pass it."""
    return ends(x, "exp", x.lo, x.hi, x.flags.growing(), nonnegative=True)


def log(x: B) -> B:
    """The logarithm of the positive part; -big from below where that comes within ``tiny`` of 0."""
    fmt = x.fmt
    plain = ends(x, "log", x.lo, x.hi)
    lo = select(gt(x.lo, fmt.tiny), plain.lo, -fmt.big)
    logarithm = x.make(lo, plain.hi, x.flags.within(gt(x.lo, 0.0), le(x.hi, 0.0)).growing())
    return logarithm.endless_as(False, x.endless()[1])


def _inside_one(x: Bounds) -> Flags:
    return x.flags.within(and_(ge(x.lo, -1.0), le(x.hi, 1.0)), or_(gt(x.lo, 1.0), lt(x.hi, -1.0)))


def asin(x: B) -> B:
    """The arc sine of the part in [-1, 1]."""
    return ends(x, "asin", x.lo, x.hi, _inside_one(x), x.nonnegative)


def acos(x: B) -> B:
    """The arc cosine of the part in [-1, 1]."""
    return ends(x, "acos", x.hi, x.lo, _inside_one(x), nonnegative=True)


def atan(x: B) -> B:
    """The arc tangent."""
    return ends(x, "atan", x.lo, x.hi, nonnegative=x.nonnegative)


def sinh(x: B) -> B:
    """The hyperbolic sine."""
    return ends(x, "sinh", x.lo, x.hi, x.flags.growing(), nonnegative=x.nonnegative)


def cosh(x: B) -> B:
    """The hyperbolic cosine: least where |x| is."""
    size = x.abs()
    plain = ends(size, "cosh", size.lo, size.hi, size.flags.growing(), nonnegative=True)
    return plain.make(maximum(plain.lo, 1.0), plain.hi, nonnegative=True)


def tanh(x: B) -> B:
    """The hyperbolic tangent."""
    return within(ends(x, "tanh", x.lo, x.hi, nonnegative=x.nonnegative), 0.0 if x.nonnegative else -1.0, 1.0)


def cbrt(x: B) -> B:
    """The cube root."""
    return ends(x, "cbrt", x.lo, x.hi, nonnegative=x.nonnegative).endless_as(*x.endless())


def power(x: B, y: B) -> B:
    """x**y = exp(y log x) on x > 0, with 0**y = 0 for y > 0."""
    positive = x.make(maximum(x.lo, 0.0), maximum(x.hi, 0.0), nonnegative=True)
    plain = exp(y.mul(log(positive)))
    reached = le(x.lo, 0.0)
    defined = or_(gt(x.lo, 0.0), and_(ge(x.lo, 0.0), gt(y.lo, 0.0)))
    empty = or_(lt(x.hi, 0.0), and_(le(x.hi, 0.0), le(y.hi, 0.0)))
    flags = x.flags.meet(y.flags).within(defined, empty).growing()
    return plain.make(select(reached, 0.0, plain.lo, like=plain.hi), plain.hi, flags, nonnegative=True)


def rational_power(x: B, exponent: tuple[int, int]) -> B:
    """x**(p/q) of the part that is not negative: by roots where q divides 12, else by logarithm."""
    p, q = exponent
    if p < 0:
        return x.literal(1.0).div(rational_power(x, (-p, q)))
    flags = x.flags if x.nonnegative else x.flags.within(ge(x.lo, 0.0), lt(x.hi, 0.0))
    part = x.make(maximum(x.lo, 0.0), maximum(x.hi, 0.0), flags, nonnegative=True)
    if elementary.by_roots(exponent):
        while q % 2 == 0:
            part, q = sqrt(part), q // 2
        return (cbrt(part) if q == 3 else part).powi(p)
    ratio = x.literal(float(p)).div(x.literal(float(q)))
    plain = exp(log(part).mul(ratio))
    lo = select(le(x.lo, 0.0), 0.0, plain.lo, like=plain.hi)
    return plain.make(lo, plain.hi, flags, nonnegative=True)


def atan2(y: B, x: B) -> B:
    """The angle of the points of a box: between two of its corners unless it meets the negative x axis."""
    fmt = y.fmt
    across = and_(le(y.lo, 0.0), ge(y.hi, 0.0))
    cut = or_(and_(lt(y.lo, 0.0), across, le(x.lo, 0.0)), and_(across, le(x.lo, 0.0), ge(x.hi, 0.0)))
    first = select(ge(y.lo, 0.0), x.hi, x.lo, like=y.lo)
    last = select(le(y.hi, 0.0), x.hi, x.lo, like=y.hi)
    k = elementary.error_bound("atan2", fmt).relative + 1.1
    low = lower(fmt, elementary.atan2(fmt, select(ge(first, 0.0), y.lo, y.hi, like=first), first), k)
    high = upper(fmt, elementary.atan2(fmt, select(ge(last, 0.0), y.hi, y.lo, like=last), last), k)
    pi = _PI_ABOVE[fmt.name]
    like = x.lo if is_literal(y.lo) else y.lo
    flags = y.flags.meet(x.flags).within(s.not_(cut))
    return y.make(select(cut, -pi, low, like), select(cut, pi, high, like), flags)
