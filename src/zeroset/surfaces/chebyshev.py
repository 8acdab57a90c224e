"""Chmutov surfaces of any order: sums of Chebyshev polynomials T_n.

The ones that the paper shows are entries of chmutov.toml, and are checked against this rule; all
other orders are made here on demand. The two parities differ. For even n the sum is taken to be 0:
the critical values of T_n are +1 and -1, three of which never add up to 0, so the surface is
smooth, and since T_n >= -1 it is compact, with T_n(x) <= 2 on it. For odd n the sum is taken to be
-1: the surface has a node wherever critical values 1, -1, -1 meet; it is unbounded and is shown
inside the cube [-1, 1]^3, which holds all its nodes.
"""

from __future__ import annotations

import math

from zeroset.surfaces.entry import BoxBounds, GalleryEntry, Source, Vector, View

__all__ = ["LEAST_ORDER", "MOST_ORDER", "chmutov_of_order"]

LEAST_ORDER = 2
MOST_ORDER = 512
"""The formula language evaluates T(n, x) up to this order."""

_EVEN_EYE = (3.475, -4.739, 2.401)
_ODD_EYE = (4.86, 3.89, 2.92)


def chmutov_of_order(order: int) -> GalleryEntry:
    """The Chmutov surface of an order from `LEAST_ORDER` to `MOST_ORDER`.

    SN10, Appendix A and figure 11, where orders 6 to 30 are shown.
    """
    even = order % 2 == 0
    half = _half_width(order)
    return GalleryEntry(
        name=f"chmutov-{order}",
        title=f"Chmutov surface of order {order}",
        formula=f"T({order}, x) + T({order}, y) + T({order}, z)" + (" = 0" if even else " + 1 = 0"),
        bounds=BoxBounds((-half, -half, -half), (half, half, half)),
        camera=View(_scaled(_EVEN_EYE, half) if even else _ODD_EYE, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 30.0),
        degree=order,
        source=(Source("SN10", "Appendix A"),),
    )


def _scaled(vector: Vector, factor: float) -> Vector:
    x, y, z = (round(factor * each, 3) for each in vector)
    return x, y, z


def _half_width(order: int) -> float:
    """Half the edge of a cube, in thousandths, that holds the surface with a little to spare.

    On the surface T_n(x) <= 2, which is cosh(n arcosh x) <= 2 for x > 1.
    """
    if order % 2:
        return 1.0
    return (math.ceil(1000 * math.cosh(math.acosh(2) / order)) + 1) / 1000
