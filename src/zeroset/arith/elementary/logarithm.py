"""log, cbrt and real powers: functions that take a number's exponent apart."""

from __future__ import annotations

from zeroset.arith.elementary.bounds import by_roots
from zeroset.arith.elementary.exponential import exp
from zeroset.arith.elementary.horner import polynomial
from zeroset.arith.format import Format
from zeroset.arith.scalar import Scalar, absolute, eq, floor, fma, frexp, gt, lt, maximum, pow2, select, sqrt

__all__ = ["cbrt", "log", "pow", "powr"]

_SQRT2 = 1.4142135623730951
_LN2 = {
    "f32": (0.693145751953125, 1.428606765330187e-06),
    "f64": (0.6931471805598903, 5.497923018708371e-14),
}
_CUBE_ROOTS = (1.2599210498948732, 1.5874010519681996)


def log(fmt: Format, x: Scalar) -> Scalar:
    """The natural logarithm: e log 2 + 2 atanh(s), s = (m-1)/(m+1), m in [1/sqrt 2, sqrt 2].

    Arguments below the smallest normal number count as that number.
    """
    mantissa, exponent = frexp(maximum(x, fmt.quantum))
    large = gt(mantissa, _SQRT2)
    mantissa = select(large, 0.5 * mantissa, mantissa)
    exponent = select(large, exponent + 1.0, exponent)
    f = mantissa - 1.0
    s = f / (f + 2.0)
    square = s * s
    high, low = _LN2[fmt.name]
    small = fma(s * square, polynomial("LOG", fmt, square), exponent * low)
    return fma(exponent, high, (s + s) + small)


def cbrt(fmt: Format, x: Scalar) -> Scalar:
    """The cube root: one step of Halley's iteration from a polynomial; 0 for subnormals."""
    size = absolute(x)
    m, exponent = frexp(maximum(size, fmt.quantum))
    third = floor((exponent + 0.5) * (1.0 / 3.0))
    rest = fma(third, -3.0, exponent)
    y = polynomial("CBRT", fmt, m)
    cube = y * y * y
    y = y * ((m + m + cube) / (cube + cube + m))
    factor = select(gt(rest, 1.5), _CUBE_ROOTS[1] * y, select(gt(rest, 0.5), _CUBE_ROOTS[0] * y, y))
    value = select(lt(size, fmt.quantum), 0.0, factor * pow2(third))
    return select(lt(x, 0.0), -value, value)


def pow(fmt: Format, x: Scalar, y: Scalar) -> Scalar:
    """x**y for x > 0, else 0."""
    return select(gt(x, 0.0), exp(fmt, y * log(fmt, x)), 0.0)


def powr(fmt: Format, x: Scalar, exponent: tuple[int, int]) -> Scalar:
    """x**(p/q) for x >= 0: by roots where q divides 12, else by logarithm; 0 for x < 0."""
    p, q = exponent
    size = maximum(x, 0.0)
    if not by_roots(exponent):
        return pow(fmt, x, fmt.round(p / q))
    while q % 2 == 0:
        size, q = sqrt(size), q // 2
    if q == 3:
        size = cbrt(fmt, size)
    power = _integer_power(size, abs(p))
    if p > 0:
        return power
    return select(eq(power, 0.0), fmt.big, 1.0 / select(eq(power, 0.0), 1.0, power))


def _integer_power(x: Scalar, n: int) -> Scalar:
    if n == 1:
        return x
    half = _integer_power(x, n // 2)
    return half * half * x if n % 2 else half * half
