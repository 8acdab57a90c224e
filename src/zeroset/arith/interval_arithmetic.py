"""Arithmetic, choices and comparisons of intervals, each bound rounded outward once.

A result that may overflow is clamped before it is rounded outward, so no bound is ever infinite and no operation ever
meets infinity times 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING

from zeroset.arith import scalar as s
from zeroset.arith.flags import Flags
from zeroset.arith.number import Number
from zeroset.arith.rounding import ROUNDED, clamp, lower, lower_nonnegative, upper, upper_nonnegative
from zeroset.arith.scalar import Mask, Scalar, and_, ge, gt, is_literal, le, lt, maximum, minimum, not_, or_, select

if TYPE_CHECKING:
    from zeroset.arith.interval_bounds import B, Bounds

__all__ = [
    "absolute", "add", "divide", "floor", "larger", "literal_reciprocal", "mod", "mul", "neg", "powi", "sign",
    "smaller", "sqr", "sub",
]  # fmt: skip

_HIGH = 16
"""Whole powers from which on coordinates that are not large have powers that are."""
_NARROW = 1e-4
"""Relative width up to which a constant interval is treated as its middle with an error."""


def add(a: B, b: B) -> B:
    """a + b."""
    if a.is_point(0.0) or b.is_point(0.0):
        return b if a.is_point(0.0) else a
    fmt, flags = a.fmt, a.flags.meet(b.flags)
    hi = upper(fmt, a.hi + b.hi)
    if a.nonnegative and b.nonnegative:
        return a.make(lower_nonnegative(fmt, a.lo + b.lo), hi, flags, nonnegative=True)
    return _endless_sum(a.make(lower(fmt, a.lo + b.lo), hi, flags), a, b)


def sub(a: B, b: B) -> B:
    """a - b."""
    if a.is_point(0.0) or b.is_point(0.0):
        return neg(b) if a.is_point(0.0) else a
    difference = a.make(lower(a.fmt, a.lo - b.hi), upper(a.fmt, a.hi - b.lo), a.flags.meet(b.flags))
    return _endless_sum(difference, a, neg(b))


def _endless_sum(total: B, a: Bounds, b: Bounds) -> B:
    """A sum of what is large: it has no end where one of the two has none, whatever the other one is."""
    if not (a.flags.large and b.flags.large):
        return total
    (below, above), (under, over) = a.endless(), b.endless()
    return total.endless_as(or_(below, under), or_(above, over))


def neg(a: B) -> B:
    """-a, exactly."""
    return a.make(s.neg(a.hi), s.neg(a.lo))


def mul(a: B, b: B) -> B:
    """a * b: two products where signs are known while tracing, else four; one a bound for a constant factor."""
    if is_literal(b.lo, b.hi):
        return _times_constant(a, b)
    return _times_constant(b, a) if is_literal(a.lo, a.hi) else _product(a, b)


def _product(a: B, b: B) -> B:
    product = _plain_product(a, b)
    down: Mask = False
    up: Mask = False
    for large, other in ((a, b), (b, a)):
        if large.flags.large:
            (below, above), rises = large.endless(), gt(other.hi, 0.0)
            falls = False if other.nonnegative else lt(other.lo, 0.0)
            up = or_(up, and_(above, rises), and_(below, falls))
            down = or_(down, and_(above, falls), and_(below, rises))
    return product if up is False and down is False else product.endless_as(down, up)


def _plain_product(a: B, b: B) -> B:
    if a.nonnegative and not b.nonnegative:
        a, b = b, a
    lows, highs = [a.lo * b.lo], [a.hi * b.hi]
    if b.nonnegative and not a.nonnegative:
        lows.append(a.lo * b.hi)
        highs.append(a.hi * b.lo)
    elif not b.nonnegative:
        lows = highs = [a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi]
    return _clamped(a, lows, highs, ROUNDED, a.flags.meet(b.flags), a.nonnegative and b.nonnegative)


def _clamped(a: B, lows: list[Scalar], highs: list[Scalar], k: float, flags: Flags, nonnegative: bool) -> B:
    fmt = a.fmt
    lo, hi = clamp(fmt, _fold(minimum, lows)), clamp(fmt, _fold(maximum, highs))
    if nonnegative:
        return a.make(lower_nonnegative(fmt, lo, k), upper_nonnegative(fmt, hi, k), flags, nonnegative=True)
    return a.make(lower(fmt, lo, k), upper(fmt, hi, k), flags)


def _fold(function: Callable[[Scalar, Scalar], Scalar], values: list[Scalar]) -> Scalar:
    result = values[0]
    for value in values[1:]:
        result = function(result, value)
    return result


def _times_constant(a: B, constant: B) -> B:
    if constant.flags.large:
        # It may be beyond what the format holds: then its literal bounds are not its value.
        return _product(a, constant)
    lo, hi, fmt = constant.lo, constant.hi, a.fmt
    flags = a.flags.meet(constant.flags)
    nonnegative = a.nonnegative and lo >= 0
    if lo == hi and (lo == 0 or _is_short_power_of_two(lo)):
        return _scaled_exactly(a, lo, flags, nonnegative)
    middle = fmt.round(0.5 * lo + 0.5 * hi)
    width = max(hi - middle, middle - lo)
    if width > _NARROW * abs(middle):
        return _product(a, constant)
    # The constant's own width is a relative error of the product.
    k = ROUNDED if width == 0 else ROUNDED + 0.01 + 1.01 * width / abs(middle) / fmt.eps
    products = a.lo * middle, a.hi * middle
    low, high = products if lo >= 0 else products[::-1]
    return _endless_share(_clamped(a, [low], [high], k, flags, nonnegative), a, middle)


def _endless_share(product: B, a: Bounds, factor: float) -> B:
    """A multiple of what may be large: a part of what has no end has none."""
    if not a.flags.large or factor == 0:
        return product
    below, above = a.endless()
    if factor < 0:
        below, above = above, below
    return product.endless_as(False if product.nonnegative else below, above)


def _is_short_power_of_two(value: float) -> bool:
    """Whether multiplying by ``value`` is exact but for underflow, and harmless to repeat."""
    return abs(math.frexp(value)[0]) == 0.5 and abs(value) <= 256.0


def _scaled_exactly(a: B, factor: float, flags: Flags, nonnegative: bool) -> B:
    lo, hi = s.mul(a.lo, factor), s.mul(a.hi, factor)
    if factor < 0:
        lo, hi = hi, lo
    if 0 < abs(factor) < 1:
        lo, hi = lo - a.fmt.tiny, hi + a.fmt.tiny
        lo = maximum(lo, 0.0) if nonnegative else lo
    return _endless_share(a.make(lo, hi, flags, nonnegative), a, factor)


def divide(a: B, b: B) -> B:
    """a / b: the whole line, or half of it, where b may be 0."""
    fmt = a.fmt
    if is_literal(b.lo, b.hi) and not b.flags.large and (b.lo > fmt.tiny or b.hi < -fmt.tiny):
        return mul(a, a.make(*literal_reciprocal(b), b.flags))
    inverse, pole = _reciprocal(b)
    if a.is_point(1.0):
        return inverse
    # Where the inverse has no end there may be a pole, which is seen to below: its product need not look for that.
    quotient = mul(a, inverse.make(inverse.lo, inverse.hi, b.flags, inverse.nonnegative))
    # A numerator that reaches 0 leaves bounds of order tiny; any other, times big, is far beyond that.
    lo = select(and_(pole, lt(quotient.lo, -2 * fmt.tiny)), -fmt.big, quotient.lo)
    hi = select(and_(pole, gt(quotient.hi, 2 * fmt.tiny)), fmt.big, quotient.hi)
    return a.make(lo, hi, inverse.flags.meet(quotient.flags), quotient.nonnegative)


def literal_reciprocal(constant: Bounds) -> tuple[float, float]:
    """Bounds of 1/constant for a literal interval without 0."""
    low, high = 1 / Fraction(constant.hi), 1 / Fraction(constant.lo)
    return -constant.fmt.ceiling(-low), constant.fmt.ceiling(high)


def _reciprocal(b: B) -> tuple[B, Mask]:
    """1/b, and where a pole may lie in it: within tiny of 0, for 1/tiny is as good as infinite."""
    fmt = b.fmt
    above, below = gt(b.lo, fmt.tiny), False if b.nonnegative else lt(b.hi, -fmt.tiny)
    low, high = s.div(1.0, b.hi), s.div(1.0, b.lo)
    reaches_up = gt(b.hi, fmt.tiny)
    defined = or_(above, below)
    flags = b.flags.within(defined).growing()
    if b.nonnegative:
        lo = select(reaches_up, lower_nonnegative(fmt, low), 0.0)
        hi = select(above, upper_nonnegative(fmt, high), fmt.big)
        return b.make(lo, hi, flags, nonnegative=True), not_(defined)
    bounded_below = or_(below, and_(ge(b.lo, 0.0), reaches_up))
    bounded_above = or_(above, and_(le(b.hi, 0.0), lt(b.lo, -fmt.tiny)))
    lo = select(bounded_below, lower(fmt, low), -fmt.big)
    hi = select(bounded_above, upper(fmt, high), fmt.big)
    return b.make(lo, hi, flags), not_(defined)


def magnitudes(a: Bounds) -> tuple[Scalar, Scalar]:
    """Bounds of |a|."""
    if a.nonnegative:
        return a.lo, a.hi
    return maximum(maximum(a.lo, s.neg(a.hi)), 0.0), maximum(s.neg(a.lo), a.hi)


def absolute(a: B) -> B:
    """|a|, exactly."""
    return a.make(*magnitudes(a), nonnegative=True)


def sqr(a: B) -> B:
    """a**2."""
    return powi(a, 2)


def powi(a: B, n: int) -> B:
    """a**n between the powers of the ends, or of the least and the largest |a| for even n."""
    if n <= 1:
        return Number.powi(a, n)
    low, high = magnitudes(a) if n % 2 == 0 else (a.lo, a.hi)
    # x**n takes fewer than n roundings of weight one, and k of them cost a bit more than k*eps.
    k = ROUNDED if n == 2 else 1.01 * n + ROUNDED
    nonnegative = n % 2 == 0 or a.nonnegative
    flags = a.flags.growing() if n >= _HIGH else a.flags
    return _clamped(a, [_power(low, n)], [_power(high, n)], k, flags, nonnegative)


def _power(x: Scalar, n: int) -> Scalar:
    if n == 1:
        return x
    half = _power(x, n // 2)
    return half * half * x if n % 2 else half * half


def sign(a: B) -> B:
    """-1, 0 or 1; a jump is possible unless both ends have the same sign."""
    low, high = s.sign(a.lo), s.sign(a.hi)
    return a.make(low, high, a.flags.within(ge(low, high)), a.nonnegative)


def floor(a: B) -> B:
    """The floor; a jump is possible unless both ends have the same."""
    low, high = s.floor(a.lo), s.floor(a.hi)
    return a.make(low, high, a.flags.within(ge(low, high)), a.nonnegative)


def mod(a: B, b: B) -> B:
    """a - b floor(a/b), which lies between 0 and b."""
    return mod_and_steps(a, b)[0]


def mod_and_steps(a: B, b: B) -> tuple[B, Mask]:
    """a mod b, and where the quotient is bounded, so that its floor means something."""
    quotient = divide(a, b)
    bounded = and_(gt(quotient.lo, -0.5 * a.fmt.big), lt(quotient.hi, 0.5 * a.fmt.big))
    plain = sub(a, mul(b, floor(quotient)))
    least, most = minimum(b.lo, 0.0), maximum(b.hi, 0.0)
    like = a.lo if is_literal(b.lo) else b.lo
    lo = select(bounded, maximum(plain.lo, least), least, like)
    hi = select(bounded, maximum(lo, minimum(plain.hi, most)), most, like)
    return a.make(lo, hi, plain.flags.within(bounded), b.nonnegative), bounded


def larger(a: B, b: B) -> B:
    """The larger of two, exactly."""
    flags = a.flags.meet(b.flags)
    return a.make(maximum(a.lo, b.lo), maximum(a.hi, b.hi), flags, a.nonnegative or b.nonnegative)


def smaller(a: B, b: B) -> B:
    """The smaller of two, exactly."""
    flags = a.flags.meet(b.flags)
    return a.make(minimum(a.lo, b.lo), minimum(a.hi, b.hi), flags, a.nonnegative and b.nonnegative)
