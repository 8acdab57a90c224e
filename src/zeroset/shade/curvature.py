"""The curvatures of an implicit surface, from the first and second derivatives of f.

R. Goldman, Curvature formulas for implicit curves and surfaces, Computer Aided Geometric Design 22 (2005).
The Gaussian curvature does not depend on the sign of f. The mean curvature does: here it is half the divergence of
grad f/|grad f|, positive where the surface bends away from growing f, which is the negative of Goldman's.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zeroset.arith.scalar import sqrt

Scalar = Any
"""A float, an array or a kernel Value."""


def gaussian(g: Sequence[Scalar], h: Sequence[Scalar]) -> Scalar:
    """The product of the principal curvatures: g adj(H) g / |g|^4.

    Args:
        g: the gradient, not 0.
        h: second derivatives xx, xy, xz, yy, yz, zz.

    Example:
        >>> gaussian((4.0, 0.0, 0.0), (2.0, 0.0, 0.0, 2.0, 0.0, 2.0))
        0.25
    """
    x, y, z = g
    xx, xy, xz, yy, yz, zz = h
    across = x * x * (yy * zz - yz * yz) + y * y * (xx * zz - xz * xz) + z * z * (xx * yy - xy * xy)
    mixed = x * y * (xz * yz - xy * zz) + y * z * (xy * xz - yz * xx) + x * z * (xy * yz - xz * yy)
    square = x * x + y * y + z * z
    return (across + mixed * 2.0) / (square * square)


def mean(g: Sequence[Scalar], h: Sequence[Scalar]) -> Scalar:
    """Half the sum of the principal curvatures: (|g|^2 tr H - g H g) / (2 |g|^3); arguments as of ``gaussian``.

    Example:
        >>> mean((4.0, 0.0, 0.0), (2.0, 0.0, 0.0, 2.0, 0.0, 2.0))
        0.5
    """
    x, y, z = g
    xx, xy, xz, yy, yz, zz = h
    # Without |g|^2 tr H and g H g themselves, which have terms in common that would be lost to rounding.
    bend = x * x * (yy + zz) + y * y * (xx + zz) + z * z * (xx + yy)
    twist = x * y * xy + y * z * yz + x * z * xz
    square = x * x + y * y + z * z
    return (bend - twist * 2.0) / (square * sqrt(square) * 2.0)
