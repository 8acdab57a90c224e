"""Division, roots, exponentials and powers of affine forms, each an ``Expansion`` given to ``linearise``.

With p the point of expansion and x = p + d, the remainder f(x) - f(p) - f'(p) d is w d**2; each function here says
what w is. By Taylor w is the mean of f''/2 between p and x, the end p counting twice: where f'' is convex, w <=
f''(p)/3 + f''(x)/6.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.arith import elementary
from zeroset.arith import scalar as s
from zeroset.arith.affine_circular import acos, asin, atan, atan2, cos, sin, tan
from zeroset.arith.interval import Interval
from zeroset.arith.interval_arithmetic import literal_reciprocal
from zeroset.arith.linearise import Expansion, linearise, narrower, picked, point, span
from zeroset.arith.rounding import lower_nonnegative, upper_nonnegative
from zeroset.arith.scalar import (
    Mask,
    Scalar,
    absolute,
    and_,
    fma,
    gt,
    is_literal,
    lt,
    maximum,
    minimum,
    not_,
    or_,
    select,
)  # fmt: skip

if TYPE_CHECKING:
    from zeroset.arith.affine_form import F, Form

__all__ = [
    "acos", "asin", "atan", "atan2", "cbrt", "cos", "cosh", "divide", "exp", "log", "narrower", "power",
    "rational_power", "sin", "sinh", "sqrt", "tan", "tanh",
]  # fmt: skip


def _reciprocal(a: F) -> tuple[F, Mask]:
    """1/a, and where ``a`` certainly keeps away from 0; w = 1/x and h = 1/p, exactly."""
    fmt, p, x = a.fmt, point(a), a.interval()
    enclosure = x.literal(1.0).div(x)
    regular = or_(gt(x.lo, fmt.tiny), lt(x.hi, -fmt.tiny))
    value = s.div(1.0, p)
    low, high = minimum(enclosure.lo, 0.0), maximum(enclosure.hi, 0.0)
    return linearise(
        a, enclosure, Expansion(value, -(value * value), low, high, 1.0, 3.0, valid=regular, unit=value)
    ), regular


def divide(a: F, b: F) -> F:
    """a / b; the whole line where ``b`` may be 0."""
    divisor = b.interval()
    known = b.is_constant and is_literal(divisor.lo, divisor.hi) and not b.flags.large
    if known and (divisor.lo > b.fmt.tiny or divisor.hi < -b.fmt.tiny):
        return a.mul(a.system.constant(*literal_reciprocal(divisor)))
    inverse, regular = _reciprocal(b)
    # Where the inverse is endless there may be a pole, which ``regular`` sees: its product need not look for that.
    plain = inverse.make(inverse.centre, inverse.terms, inverse.error, inverse.budget, b.flags, inverse.bounds)
    quotient = a.mul(plain)
    line = a.system.from_interval(Interval(a.system.intervals, -a.fmt.big, a.fmt.big))
    chosen = picked(regular, quotient, line, like=b.centre)
    bounds = a.interval().div(b.interval()) if a.system.intersect else None
    return chosen.make(
        chosen.centre, chosen.terms, chosen.error, chosen.budget, quotient.flags.meet(inverse.flags), bounds
    )


def sqrt(a: F) -> F:
    """The square root: w = -2 q/(sqrt(x) + q)**2 and h = 1/(2 q) with q = sqrt(p), which holds down to x = 0."""
    p, x = point(a), a.interval()
    enclosure = x.sqrt()
    value = s.sqrt(maximum(p, 0.0))
    slope = s.div(1.0, value + value)
    total = enclosure.lo + value
    low = -s.div(value + value, total * total)
    valid = and_(gt(p, a.fmt.tiny), not_(x.endless()[1]))
    return linearise(a, enclosure, Expansion(value, slope, low, 0.0, 1.0, 3.0, valid=valid, unit=slope))


def cbrt(a: F) -> F:
    """The cube root: w = -3 q**2 (2 q + y)/(y**2 + y q + q**2)**2, h = 1/(3 q**2) for y = cbrt(x), q = cbrt(p) of a
    sign.

    Its size falls as |y| grows.
    """
    fmt, p, x = a.fmt, point(a), a.interval()
    enclosure = x.cbrt()
    value = elementary.cbrt(fmt, p)
    error = elementary.error_bound("cbrt", fmt)
    q, y = absolute(value), maximum(maximum(enclosure.lo, s.neg(enclosure.hi)), 0.0)
    slope = s.div(1.0 / 3.0, q * q)
    base = fma(y, y, fma(y, q, q * q))
    size = s.div(q + q + y, base) * s.div(3.0 * (q * q), base)
    above, below = gt(x.lo, fmt.tiny), lt(x.hi, -fmt.tiny)
    bounded = not_(or_(*x.endless()))
    expansion = Expansion(
        value,
        slope,
        select(above, -size, 0.0),
        select(above, 0.0, size),
        value_error=error.relative,
        slope_error=2 * error.relative + 4,
        absolute=error.absolute,
        valid=and_(or_(above, below), bounded),
        unit=slope,
    )
    return linearise(a, enclosure, expansion)


def exp(a: F) -> F:
    """The exponential: f'' is convex, and w is never negative."""
    fmt, p, r = a.fmt, point(a), span(a)
    error = elementary.error_bound("exp", fmt)
    # minimum keeps its second operand for a NaN: a form that overflowed grows without bound.
    value, growth = elementary.exp(fmt, p), elementary.exp(fmt, minimum(r, fmt.big))
    if a.system.intersect:
        enclosure = a.interval().exp()
    else:
        # e**p e**-r to e**p e**r; growth stops at big, and then so must the bound.
        k = 2 * error.relative + 3.0
        high = select(lt(growth, 0.5 * fmt.big), minimum(value * growth, fmt.big), fmt.big)
        # Where growth has stopped their quotient is no bound; a value that has is less than the true one.
        enclosure = Interval(
            a.system.intervals,
            lower_nonnegative(fmt, select(lt(growth, 0.5 * fmt.big), value / growth, 0.0), k, fmt.tiny),
            upper_nonnegative(fmt, high, k, fmt.tiny),
            a.flags.growing(),
            nonnegative=True,
        )
    # Where exp stops at big or loses relative accuracy near tiny the slope is not the value.
    valid = and_(lt(enclosure.hi, fmt.big), gt(enclosure.lo, 2 * fmt.tiny))
    high = value * fma(growth, 1.0 / 6.0, 1.0 / 3.0)
    return linearise(
        a, enclosure, Expansion(value, value, 0.0, high, error.relative, error.relative, error.absolute, valid)
    )


def log(a: F) -> F:
    """The logarithm: -f'' = 1/x**2 is convex; with h = 1/least x, -w <= (least x/p)**2/3 + 1/6."""
    fmt, p, x = a.fmt, point(a), a.interval()
    enclosure = x.log()
    error = elementary.error_bound("log", fmt)
    slope, nearest = s.div(1.0, p), s.mul(x.lo, s.div(1.0, p))
    low = -fma(nearest * nearest, 1.0 / 3.0, 1.0 / 6.0)
    valid, unit = and_(gt(x.lo, fmt.tiny), not_(x.endless()[1])), s.div(1.0, x.lo)
    expansion = Expansion(elementary.log(fmt, p), slope, low, 0.0, error.relative, 2.0, valid=valid, unit=unit)
    return linearise(a, enclosure, expansion)


def sinh(a: F) -> F:
    """The hyperbolic sine: f'' = f."""
    return _hyperbolic(a, "sinh", "cosh")


def cosh(a: F) -> F:
    """The hyperbolic cosine: f'' = f."""
    return _hyperbolic(a, "cosh", "sinh")


def _hyperbolic(a: F, name: str, derivative: str) -> F:
    fmt, p, x = a.fmt, point(a), a.interval()
    enclosure: Interval = getattr(x, name)()
    value, slope = getattr(elementary, name)(fmt, p), getattr(elementary, derivative)(fmt, p)
    error = elementary.error_bound(name, fmt)
    low = 0.0 if enclosure.nonnegative else 0.5 * minimum(enclosure.lo, 0.0)
    valid = and_(lt(enclosure.hi, fmt.big), gt(enclosure.lo, -fmt.big))
    accuracy = elementary.error_bound(derivative, fmt).relative
    absolute_error = error.absolute + fmt.tiny * a.reach()
    high = 0.5 * maximum(enclosure.hi, 0.0)
    return linearise(a, enclosure, Expansion(value, slope, low, high, error.relative, accuracy, absolute_error, valid))


def tanh(a: F) -> F:
    """The hyperbolic tangent: f''/2 = -t (1 - t**2), largest where |t| = 1/sqrt 3."""
    fmt, p, x = a.fmt, point(a), a.interval()
    enclosure = x.tanh()
    value = elementary.tanh(fmt, p)
    error = elementary.error_bound("tanh", fmt).relative
    slope = (1.0 - value) * (1.0 + value)
    least = maximum(maximum(enclosure.lo, s.neg(enclosure.hi)), 0.0)
    width = minimum((1.0 - least) * (1.0 + least) + 8 * fmt.eps, 1.0)
    high = minimum(-minimum(enclosure.lo, 0.0) * width, 0.385)
    low = maximum(-maximum(enclosure.hi, 0.0) * width, -0.385)
    # Next to 1 the slope's error is that of t, absolute.
    spread = (2 * error + 4) * fmt.eps * a.reach()
    return linearise(a, enclosure, Expansion(value, slope, low, high, error, 4.0, spread))


def power(a: F, b: F) -> F:
    """a**b = exp(b log a)."""
    enclosure = a.interval().pow(b.interval())
    return narrower(exp(b.mul(log(a))), enclosure)


def rational_power(a: F, exponent: tuple[int, int]) -> F:
    """a**(p/q); w is c x**(p/q) for h = 1/x and c = (p/q)(p/q-1)/2, at the end where that is most."""
    p, q = exponent
    if p < 0:
        return a.literal(1.0).div(rational_power(a, (-p, q)))
    x = a.interval()
    enclosure = x.powr(exponent)
    if not elementary.by_roots(exponent):
        ratio = a.literal(float(p)).div(a.literal(float(q)))
        return narrower(exp(log(a).mul(ratio)), enclosure)
    return linearise(a, enclosure, _power_expansion(a, x, exponent))


def _power_expansion(a: Form, x: Interval, exponent: tuple[int, int]) -> Expansion:
    fmt, at = a.fmt, point(a)
    ratio = exponent[0] / exponent[1]
    value = elementary.powr(fmt, at, exponent)
    slope = s.div(value * fmt.round(ratio), at)
    edge: Scalar = x.lo if ratio < 2 else x.hi
    bend = elementary.powr(fmt, edge, exponent) * fmt.round(0.5 * ratio * (ratio - 1))
    low, high = (bend, 0.0) if ratio < 1 else (0.0, bend)
    error = elementary.power_error(exponent)
    grown = fmt.up(1.0 + error * fmt.eps)
    valid = and_(gt(x.lo, fmt.tiny), not_(x.endless()[1]))
    low, high, unit = s.mul(low, grown), s.mul(high, grown), s.div(1.0, edge)
    return Expansion(value, slope, low, high, error, error + 4, valid=valid, unit=unit)
