"""exp, and the hyperbolic functions made of it."""

from __future__ import annotations

import math

from zeroset.arith.elementary.horner import polynomial, with_linear_term
from zeroset.arith.format import Format
from zeroset.arith.scalar import Scalar, absolute, fma, gt, lt, maximum, minimum, pow2, rint, select

__all__ = ["cosh", "exp", "sinh", "tanh"]

_LOG2_E = 1.4426950408889634
# ln 2 in two parts; the first is short, so that its product with any exponent is exact.
_LN2 = {
    "f32": (0.693145751953125, 1.428606765330187e-06),
    "f64": (0.6931471805598903, 5.497923018708371e-14),
}


def exp(fmt: Format, x: Scalar) -> Scalar:
    """e**x, 2**k e**r with |r| <= ln(2)/2; stops at ``big``, and below ``tiny``."""
    return _exp(fmt, x, math.log2(fmt.big))


def _exp(fmt: Format, x: Scalar, highest: float) -> Scalar:
    """``exp`` that stops at 2**highest."""
    top, bottom = highest * math.log(2.0), math.log2(fmt.quantum) * math.log(2.0) + 1.0
    x = minimum(maximum(x, fmt.up(bottom)), fmt.up(top))
    k = rint(x * _LOG2_E)
    high, low = _LN2[fmt.name]
    r = fma(k, -low, fma(k, -high, x))
    return (fma(r * r, polynomial("EXP", fmt, r), r) + 1.0) * pow2(k)


def _twice_big(fmt: Format, x: Scalar) -> Scalar:
    return _exp(fmt, x, math.log2(fmt.big) + 1.0)


def sinh(fmt: Format, x: Scalar) -> Scalar:
    """(e**x - e**-x)/2, for |x| <= 1 its odd polynomial."""
    size = minimum(absolute(x), fmt.big)
    small = minimum(size, 1.0)
    grown = _twice_big(fmt, maximum(size, 1.0))
    value = select(gt(size, 1.0), 0.5 * grown - 0.5 / grown, with_linear_term("SINH", fmt, small, small * small))
    return select(lt(x, 0.0), -value, value)


def cosh(fmt: Format, x: Scalar) -> Scalar:
    """(e**x + e**-x)/2."""
    grown = _twice_big(fmt, absolute(x))
    return 0.5 * grown + 0.5 / grown


def tanh(fmt: Format, x: Scalar) -> Scalar:
    """1 - 2/(e**2x + 1), for |x| <= 5/8 its odd polynomial."""
    size = minimum(absolute(x), 30.0)
    small = minimum(size, 0.625)
    value = select(
        gt(size, 0.625), 1.0 - 2.0 / (exp(fmt, size + size) + 1.0), with_linear_term("TANH", fmt, small, small * small)
    )
    return select(lt(x, 0.0), -value, value)
