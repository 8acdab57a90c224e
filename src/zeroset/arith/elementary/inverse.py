"""atan, atan2, asin and acos."""

from __future__ import annotations

from zeroset.arith.elementary.horner import with_linear_term
from zeroset.arith.format import Format
from zeroset.arith.scalar import Mask, Scalar, absolute, gt, lt, maximum, minimum, select, sqrt

__all__ = ["acos", "asin", "atan", "atan2"]

_TAN_PI_8 = 0.41421356237309503
_TAN_3PI_8 = 2.414213562373095
# pi/2 as a number of the format and the rest.
_HALF_PI = {
    "f32": (1.5707963705062866, -4.371138828673793e-08),
    "f64": (1.5707963267948966, 6.123233995736766e-17),
}


def atan(fmt: Format, x: Scalar) -> Scalar:
    """The arc tangent, from pi/2, pi/4 or 0 on by a polynomial for at most pi/8."""
    size = absolute(x)
    steep, middle = gt(size, _TAN_3PI_8), gt(size, _TAN_PI_8)
    top = select(steep, -1.0, select(middle, size - 1.0, size))
    bottom = select(steep, size, select(middle, size + 1.0, 1.0))
    z = top / bottom
    high, low = _HALF_PI[fmt.name]
    offset = select(steep, high, select(middle, 0.5 * high, 0.0, like=x), like=x)
    rest = select(steep, low, select(middle, 0.5 * low, 0.0, like=x), like=x)
    value = offset + (with_linear_term("ATAN", fmt, z, z * z) + rest)
    return select(lt(x, 0.0), -value, value)


def atan2(fmt: Format, y: Scalar, x: Scalar) -> Scalar:
    """The angle of the point (x, y), in [-pi, pi]; 0 at the origin."""
    across, up = absolute(x), absolute(y)
    swapped = gt(up, across)
    ratio = select(swapped, across, up) / maximum(select(swapped, up, across), fmt.quantum)
    high, low = _HALF_PI[fmt.name]
    angle = atan(fmt, ratio)
    angle = select(swapped, high - (angle - low), angle)
    angle = select(lt(x, 0.0), 2 * high - (angle - 2 * low), angle)
    return select(lt(y, 0.0), -angle, angle)


def _half_angle(fmt: Format, x: Scalar) -> tuple[Scalar, Mask]:
    """asin of |x| where |x| <= 1/2; elsewhere asin(sqrt((1-|x|)/2)), which is half of acos|x|; and where the latter."""
    size = minimum(absolute(x), 1.0)
    outer = gt(size, 0.5)
    square = select(outer, 0.5 - 0.5 * size, size * size)
    root = select(outer, sqrt(square), size)
    return with_linear_term("ASIN", fmt, root, square), outer


def asin(fmt: Format, x: Scalar) -> Scalar:
    """The arc sine of x clamped to [-1, 1]."""
    part, outer = _half_angle(fmt, x)
    high, low = _HALF_PI[fmt.name]
    value = select(outer, high - (part + part - low), part)
    return select(lt(x, 0.0), -value, value)


def acos(fmt: Format, x: Scalar) -> Scalar:
    """The arc cosine of x clamped to [-1, 1]."""
    part, outer = _half_angle(fmt, x)
    high, low = _HALF_PI[fmt.name]
    negative = lt(x, 0.0)
    far = select(negative, 2 * high - (part + part - 2 * low), part + part)
    near = high - (select(negative, -part, part) - low)
    return select(outer, far, near)
