"""sin, cos and tan: reduction by multiples of pi/2 in three parts (Cody & Waite), then polynomials on [-pi/4, pi/4].

The first two parts are so short that their products with k are exact, and so are the two subtractions; the third
product and subtraction round, which is the slope of the error bound. Beyond ``trigonometric_limit`` the argument is
clamped.
"""

from __future__ import annotations

from zeroset.arith.elementary.bounds import trigonometric_limit
from zeroset.arith.elementary.horner import polynomial, with_linear_term
from zeroset.arith.format import Format
from zeroset.arith.scalar import Mask, Scalar, absolute, and_, eq, floor, fma, gt, lt, maximum, minimum, rint, select

__all__ = ["cos", "sin", "sincos", "tan"]

_TWO_OVER_PI = 0.6366197723675814
_HALF_PI = {
    "f32": (1.5703125, 0.0004837512969970703, 7.549790126404332e-08),
    "f64": (1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21),
}


def _reduced(fmt: Format, x: Scalar) -> tuple[Scalar, Scalar, Scalar]:
    """sin r, cos r and k mod 4, where x = k pi/2 + r."""
    limit = trigonometric_limit(fmt)
    x = minimum(maximum(x, -limit), limit)
    k = rint(x * _TWO_OVER_PI)
    first, second, third = _HALF_PI[fmt.name]
    r = fma(k, -third, fma(k, -second, fma(k, -first, x)))
    square = r * r
    sine = with_linear_term("SIN", fmt, r, square)
    cosine = fma(square * square, polynomial("COS", fmt, square), fma(square, -0.5, 1.0))
    return sine, cosine, fma(floor(k * 0.25), -4.0, k)


def _odd(quarter: Scalar) -> Mask:
    return eq(absolute(quarter - 2.0), 1.0)


def sincos(fmt: Format, x: Scalar) -> tuple[Scalar, Scalar]:
    """The sine and the cosine."""
    sine, cosine, quarter = _reduced(fmt, x)
    odd = _odd(quarter)
    high, wide = select(odd, cosine, sine), select(odd, sine, cosine)
    inner = lt(absolute(quarter - 1.5), 1.0)
    return select(gt(quarter, 1.5), -high, high), select(inner, -wide, wide)


def sin(fmt: Format, x: Scalar) -> Scalar:
    """The sine."""
    return sincos(fmt, x)[0]


def cos(fmt: Format, x: Scalar) -> Scalar:
    """The cosine."""
    return sincos(fmt, x)[1]


def tan(fmt: Format, x: Scalar) -> Scalar:
    """The tangent; at most ``big`` in size."""
    sine, cosine, quarter = _reduced(fmt, x)
    odd = _odd(quarter)
    top, bottom = select(odd, -cosine, sine), select(odd, sine, cosine)
    flat = and_(odd, lt(absolute(bottom), fmt.tiny))
    return select(flat, fmt.big, top / select(flat, 1.0, bottom))
