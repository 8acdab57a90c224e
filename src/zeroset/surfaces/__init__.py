"""Surfaces as data: the named surfaces of the papers, corrected, with bounds and a camera each.

The equations come from Singh & Narayanan, "Real-Time Ray Tracing of Implicit Surfaces on the GPU"
(IEEE TVCG 16(2), 2010, doi:10.1109/TVCG.2009.41; SN10), Appendix A, and Knoll et al., "Fast Ray
Tracing of Arbitrary Implicit Surfaces with Interval and Affine Arithmetic" (Computer Graphics Forum
28(1), 2009, doi:10.1111/j.1467-8659.2008.01189.x; K09), Table A1. Both print some of them wrong:
each entry's `note` says what was put right, and why. Nothing is read until a name is asked for.

Example:
    >>> from zeroset.surfaces import chmutov, entry
    >>> entry("ding-dong").formula
    'x^2 + y^2 = (1 - z) z^2'
    >>> chmutov(40).degree
    40
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.surfaces.chebyshev import LEAST_ORDER, MOST_ORDER, chmutov_of_order
from zeroset.surfaces.entry import BallBounds, BoxBounds, GalleryEntry, SolidEntry, SolidPart, Source, View
from zeroset.surfaces.load import family, index, solid_names, solids

if TYPE_CHECKING:
    from typing import NoReturn

__all__ = [
    "BallBounds",
    "BoxBounds",
    "GalleryEntry",
    "SolidEntry",
    "SolidPart",
    "Source",
    "View",
    "chmutov",
    "entry",
    "names",
    "solid_names",
    "solids",
]

_CHMUTOV = "chmutov-"


def names() -> tuple[str, ...]:
    """The names of all surfaces, by family and rising degree.

    Chmutov surfaces of other orders than those listed exist too, see `chmutov`.
    """
    return tuple(index())


def entry(name: str) -> GalleryEntry:
    """The surface of that name.

    Args:
        name: One of `names()`, or "chmutov-<n>" with n from 2 to 512.

    Raises:
        UnknownSurfaceError: There is none; the error names the nearest ones.
    """
    listed = index().get(name)
    if listed is not None:
        return family(listed)[name]
    order = name.removeprefix(_CHMUTOV)
    if order != name and order.isascii() and order.isdecimal() and len(order) <= 9 and order == str(int(order)):
        return chmutov(int(order))
    if name in solid_names():
        _no_surface(name)
    _unknown(name)


def chmutov(order: int) -> GalleryEntry:
    """The Chmutov surface of any order: T_n(x) + T_n(y) + T_n(z) = 0, or = -1 for odd n.

    Args:
        order: The degree n, from 2 to 512.

    Raises:
        UnknownSurfaceError: The order is outside that range, or no integer.
    """
    from zeroset.errors import UnknownSurfaceError

    if not isinstance(order, int) or isinstance(order, bool) or not LEAST_ORDER <= order <= MOST_ORDER:
        raise UnknownSurfaceError(
            f"there is no Chmutov surface of order {str(order)[:40]} here",
            hint=f"the order is a whole number from {LEAST_ORDER} to {MOST_ORDER}",
        )
    name = f"{_CHMUTOV}{order}"
    listed = index().get(name)
    return family(listed)[name] if listed is not None else chmutov_of_order(order)


def _no_surface(name: str) -> NoReturn:
    from zeroset.errors import UnknownSurfaceError

    raise UnknownSurfaceError(
        f"{name} is a solid, not a surface", hint=f"zs.gallery.solids[{name!r}] in Python, zeroset render {name}"
    )


def _unknown(name: str) -> NoReturn:
    from zeroset.errors import UnknownSurfaceError, did_you_mean

    raise UnknownSurfaceError(
        f'the gallery has no surface "{name[:80]}"',
        hints=(*did_you_mean(name, (*names(), *solid_names())), "zeroset gallery lists all names"),
    )
