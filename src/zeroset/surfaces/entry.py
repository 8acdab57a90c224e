"""What the gallery knows of one surface: plain values, no parsed formula and no kernel.

Entries stay plain so that listing the gallery, or showing where an equation comes from, costs no
parsing of formulas. The package root turns an entry into a surface when someone asks for one.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["BallBounds", "BoxBounds", "GalleryEntry", "SolidEntry", "SolidPart", "Source", "Vector", "View"]

Vector = tuple[float, float, float]
"""Three coordinates x, y, z."""


_NO_PARAMS: Mapping[str, float] = MappingProxyType({})
_NO_ARRAYS: Mapping[str, tuple[float, ...]] = MappingProxyType({})


class BallBounds(NamedTuple):
    """The part of the surface inside a ball is shown."""

    center: Vector
    radius: float


class BoxBounds(NamedTuple):
    """The part of the surface inside an axis-parallel box is shown, from `min` to `max`."""

    min: Vector
    max: Vector


class View(NamedTuple):
    """A perspective camera at `eye` looking at `target`; `fov` is the vertical opening in degrees."""

    eye: Vector
    target: Vector
    up: Vector
    fov: float


class Source(NamedTuple):
    """Where an equation is printed.

    Attributes:
        paper: "SN10" (Singh & Narayanan 2010) or "K09" (Knoll et al. 2009).
        where: The place in the paper: "Appendix A, cubic 1", "Table A1".
        figures: Numbers of the paper's figures that show the surface: ("4", "12").
    """

    paper: str
    where: str
    figures: tuple[str, ...] = ()


class GalleryEntry(NamedTuple):
    """One surface of the gallery.

    Attributes:
        name: Its key: lower-case words joined by hyphens.
        title: Its name for people.
        formula: Text of the formula language, on one line.
        params: Values of the formula's parameters. `w` (time) is a variable and never here.
        arrays: Values of its array parameters (sphere centres and radii), all of one length.
        bounds: The region in which the surface is shown.
        camera: The view that shows it as its figure does, or as it is usually shown.
        degree: Of the polynomial; 0 for a formula that is none.
        source: The papers it is printed in.
        note: What was corrected in the printed equation, and why; empty where it is as printed.
    """

    name: str
    title: str
    formula: str
    bounds: BallBounds | BoxBounds
    camera: View
    degree: int
    source: tuple[Source, ...]
    params: Mapping[str, float] = _NO_PARAMS
    arrays: Mapping[str, tuple[float, ...]] = _NO_ARRAYS
    note: str = ""


class SolidPart(NamedTuple):
    """One surface of a solid, which stands for f <= 0.

    Attributes:
        formula: Text of the formula language, on one line.
        front: Linear RGB of its outside.
        back: Linear RGB of its inside.
        params: Values of the formula's parameters.
    """

    formula: str
    front: Vector
    back: Vector
    params: Mapping[str, float] = _NO_PARAMS


class SolidEntry(NamedTuple):
    """One solid of the gallery.

    Attributes:
        name: Its key: lower-case words joined by hyphens.
        title: Its name for people.
        solid: How it is made of its parts: "(a & b) - c".
        parts: Its surfaces by the names they have there.
        bounds: The region in which it is shown.
        camera: The view that shows it.
        source: The papers it is printed in.
        note: What was corrected or chosen, and why.
    """

    name: str
    title: str
    solid: str
    parts: Mapping[str, SolidPart]
    bounds: BallBounds | BoxBounds
    camera: View
    source: tuple[Source, ...]
    note: str = ""
