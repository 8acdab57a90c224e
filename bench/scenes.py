"""The surfaces that programs are compared on: one view, one light and one region for all of them.

Surfaces come from zeroset's gallery with its cameras. surf clips by balls alone, so each is shown inside a ball around
the origin. What POV-Ray's isosurface needs to know besides, a function in its own language and a bound of its gradient
where rays pass, is written by hand, as somebody who cares for speed would write it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import zeroset as zs

ONE_LIGHT = (zs.Light(),)


@dataclass(frozen=True)
class Case:
    """A surface to be drawn by everybody.

    Attributes:
        name: in zeroset's gallery.
        isosurface: makes the body of POV-Ray's function, declarations before it aside.
        declarations: what that function uses.
        max_gradient: the least power of 2 from which on POV-Ray's picture does not change any more.
        radius: of the ball that bounds it; None takes the gallery's.
        container: what POV-Ray's isosurface is looked for in, where a tighter region than the ball holds all of it.
    """

    name: str
    isosurface: Callable[[zs.Surface], str]
    max_gradient: float
    declarations: str = ""
    radius: float | None = None
    container: str = ""

    @cached_property
    def surface(self) -> zs.Surface:
        """The surface inside its ball."""
        found = zs.gallery[self.name]
        return found if self.radius is None else found.with_bounds(self.radius)

    @property
    def camera(self) -> zs.Camera:
        """The surface's own camera, which must be one that every program has."""
        camera = self.surface.camera
        if camera is None or camera.fov is None or any(camera.target):
            raise ValueError(f"{self.name} must be seen in perspective, from a camera that looks at the origin")
        return camera

    @property
    def scene(self) -> zs.Scene:
        """The surface in one light."""
        return replace(zs.Scene(self.surface), lights=ONE_LIGHT)

    @property
    def bounding_radius(self) -> float:
        """Radius of the ball around the origin that everybody clips to."""
        bounds = self.surface.fitted
        if not isinstance(bounds, zs.Ball) or any(bounds.center):
            raise ValueError(f"{self.name} must be shown in a ball around the origin")
        return bounds.radius


def _fixed(text: str) -> Callable[[zs.Surface], str]:
    return lambda surface: text


def _blobs(surface: zs.Surface) -> str:
    columns = (surface.arrays[name] for name in ("r", "cx", "cy", "cz"))
    epsilon = surface.params["epsilon"]
    terms = []
    for r, *center in zip(*columns, strict=True):
        squares = "+".join(
            f"({axis}-({c!r}))*({axis}-({c!r}))" for axis, c in zip("xyz", map(float, center), strict=True)
        )
        terms.append(f"{float(r * r)!r}/({squares}+{epsilon!r})")
    return "1-(" + "+".join(terms) + ")"


_PHI = "#declare P = (1 + sqrt(5))/2;\n#declare P2 = P*P;\n#declare P4 = P2*P2;\n#declare SQ = function(a) { a*a };\n"
_T14 = (
    "#declare T = function(q) { -1 + q*(98 + q*(-1568 + q*(9408 + q*(-26880 + q*(39424 + q*(-28672 + q*8192)))))) };\n"
)

_CUBE = "box { -1.006, 1.006 }"

CASES = (
    Case(
        "barth-sextic",
        _fixed("4*(P2*x*x - y*y)*(P2*y*y - z*z)*(P2*z*z - x*x) - (1 + 2*P)*SQ(x*x + y*y + z*z - 1)"),
        max_gradient=128,
        declarations=_PHI,
    ),
    Case(
        "barth-decic",
        _fixed(
            "8*(x*x - P4*y*y)*(y*y - P4*z*z)*(z*z - P4*x*x)"
            "*(SQ(x*x) + SQ(y*y) + SQ(z*z) - 2*x*x*y*y - 2*x*x*z*z - 2*y*y*z*z)"
            " + (3 + 5*P)*SQ(x*x + y*y + z*z - 1)*SQ(x*x + y*y + z*z - 2 + P)"
        ),
        max_gradient=8192,
        declarations=_PHI,
    ),
    Case(
        "chmutov-14",
        _fixed("T(x*x) + T(y*y) + T(z*z)"),
        max_gradient=512,
        declarations=_T14,
        radius=1.75,
        container=_CUBE,
    ),
    Case("blinn-blobby-30", _blobs, max_gradient=32),
    Case(
        "clebsch",
        _fixed(
            "81*(x*x*x + y*y*y + z*z*z) - 189*(x*x*(y + z) + y*y*(x + z) + z*z*(x + y)) + 54*x*y*z"
            " + 126*(x*y + y*z + x*z) - 9*(x*x + y*y + z*z) - 9*(x + y + z) + 1"
        ),
        max_gradient=256,
    ),
    Case(
        "kummer",
        _fixed("x*x*x*x + y*y*y*y + z*z*z*z - x*x - y*y - z*z - x*x*y*y - y*y*z*z - z*z*x*x + 1"),
        max_gradient=32,
    ),
)
