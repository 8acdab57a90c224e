"""Where a surface is drawn: a ball or a box. Hits lie inside the bounds only.

Bounds do two things inside kernels: clip a ray to the stretch of t inside them, and say where a whole region (a box of
any number system) lies outside them, which is how beams skip the corners of a frame.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from zeroset.errors import BoundsError, ZerosetError

Vector = tuple[float, float, float]

LARGEST = 1e15
"""Coordinates and radii stay below this, so that their squares and products are floats in every kernel."""
SMALLEST = 1e-15
"""The least radius and the least side, for the same reason."""


def vector(value: Iterable[float], what: str, error: type[ZerosetError] = BoundsError) -> Vector:
    """Three finite floats below ``LARGEST``, or an error naming ``what``."""
    try:
        x, y, z = (float(v) for v in value)
    except (TypeError, ValueError, OverflowError):
        raise error(f"{what} must be three numbers, not {value!r}") from None
    if not all(abs(v) < LARGEST for v in (x, y, z)):
        raise error(f"{what} must be finite, and below {LARGEST:g} in every coordinate, not {value!r}")
    return x, y, z


def number(value: float, what: str, error: type[ZerosetError] = BoundsError) -> float:
    """A finite float, or an error naming ``what``."""
    try:
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        raise error(f"{what} must be a number, not {value!r}") from None
    if not math.isfinite(result):
        raise error(f"{what} must be finite, not {value!r}")
    return result


@dataclass(frozen=True, slots=True)
class Ball:
    """The ball |p - center| <= radius.

    Example:
        >>> Ball(2.0).radius
        2.0
    """

    radius: float
    center: Vector = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "center", vector(self.center, "the centre of the bounds"))
        object.__setattr__(self, "radius", number(self.radius, "the radius of the bounds"))
        if not SMALLEST <= self.radius < LARGEST:
            raise BoundsError(
                f"the radius of the bounds must be at least {SMALLEST:g} and below {LARGEST:g}, not {self.radius!r}",
                hint="try bounds=3.0",
            )

    @property
    def extent(self) -> float:
        """The diameter."""
        return 2.0 * self.radius

    @property
    def farthest(self) -> Vector:
        """The largest size of each coordinate inside."""
        x, y, z = (abs(c) + self.radius for c in self.center)
        return x, y, z

    @property
    def reach(self) -> float:
        """Radius of the smallest ball around ``center`` that holds the bounds."""
        return self.radius


@dataclass(frozen=True, slots=True)
class Box:
    """The axis-parallel box between two corners.

    Example:
        >>> Box((-1, -1, -1), (1, 1, 2)).center
        (0.0, 0.0, 0.5)
    """

    min: Vector
    max: Vector

    def __post_init__(self) -> None:
        object.__setattr__(self, "min", vector(self.min, "the lower corner of the bounds"))
        object.__setattr__(self, "max", vector(self.max, "the upper corner of the bounds"))
        if not all(b - a >= SMALLEST for a, b in zip(self.min, self.max, strict=True)):
            raise BoundsError(f"the bounds are empty: {self.min} is not below {self.max} in every coordinate")

    @property
    def center(self) -> Vector:
        """The middle of the box."""
        x, y, z = (0.5 * (a + b) for a, b in zip(self.min, self.max, strict=True))
        return x, y, z

    @property
    def extent(self) -> float:
        """The diagonal."""
        return math.dist(self.min, self.max)

    @property
    def farthest(self) -> Vector:
        """The largest size of each coordinate inside."""
        x, y, z = (max(abs(a), abs(b)) for a, b in zip(self.min, self.max, strict=True))
        return x, y, z

    @property
    def reach(self) -> float:
        """Radius of the smallest ball around ``center`` that holds the bounds."""
        return 0.5 * self.extent


Bounds = Ball | Box


def parse_bounds(value: Any) -> Bounds | None:
    """Bounds from what users write: a number, a Ball or Box, a mapping with their fields, corners, or None."""
    if value is None or isinstance(value, (Ball, Box)):
        return value
    if isinstance(value, Mapping):
        keys = set(value)
        if keys == {"min", "max"}:
            return Box(value["min"], value["max"])
        if keys <= {"center", "radius"} and "radius" in keys:
            return Ball(value["radius"], value.get("center", (0.0, 0.0, 0.0)))
        given = ", ".join(sorted(map(str, keys))) or "nothing"
        raise BoundsError(f"bounds have either min and max, or center and radius, not {given}")
    if (isinstance(value, Sequence) and not isinstance(value, str)) or (isinstance(value, np.ndarray) and value.ndim):
        if len(value) == 6 and all(isinstance(v, (int, float)) for v in value):
            return Box(tuple(value[:3]), tuple(value[3:]))
        if len(value) != 2:
            raise BoundsError(
                f"bounds as a sequence are two corners, not {len(value)} items",
                hints=("try bounds=((-1, -1, -1), (1, 1, 1))", "a ball around the origin is one number: bounds=3.0"),
            )
        if all(isinstance(corner, (int, float)) for corner in value):
            raise BoundsError(
                f"bounds as a sequence are two corners of three numbers each, not {value[0]!r} and {value[1]!r}",
                hints=("try bounds=((-1, -1, -1), (1, 1, 1))", "a ball around the origin is one number: bounds=3.0"),
            )
        return Box(value[0], value[1])
    try:
        radius = float(value)
    except (TypeError, ValueError, OverflowError):
        raise BoundsError(f"bounds must be a number, a Ball or a Box, not {value!r}", hint="try bounds=3.0") from None
    return Ball(radius)


NAMES = ("bx0", "by0", "bz0", "bx1", "by1", "bz1")
"""Uniforms that hold the bounds' numbers in kernels."""


def bounds_kind(bounds: Bounds | None) -> str:
    """What of the bounds shapes a kernel; bounds that are still to be fitted will be a ball."""
    return "box" if isinstance(bounds, Box) else "ball"


def bounds_uniforms(bounds: Bounds, prefix: str = "") -> dict[str, float]:
    """The bounds' numbers by uniform name: centre and radius of a ball, the corners of a box."""
    values = (*bounds.center, bounds.radius, 0.0, 0.0) if isinstance(bounds, Ball) else (*bounds.min, *bounds.max)
    return {prefix + name: value for name, value in zip(NAMES, values, strict=True)}
