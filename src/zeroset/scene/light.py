"""Lights, materials and background: how a surface is lit in the first frame (Blinn-Phong, two-sided).

Colours are linear-light RGB, 1 for full; the picture is encoded to sRGB at the very end. Front is the side that the
gradient points to (growing f), back the other.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from zeroset.errors import ParameterError
from zeroset.scene.bounds import Vector, number, vector

if TYPE_CHECKING:
    from zeroset.scene.coloring import Coloring

Color = tuple[float, float, float]

BRIGHTEST = 1e6
"""Largest component of a colour: a light may be far brighter than white."""

SHORTEST = 1e-15
"""A light's direction with no component above this has no direction at all."""


def color(values: Iterable[float], what: str) -> Color:
    """Three numbers from 0 to ``BRIGHTEST``, or a ``ParameterError`` naming ``what``."""
    made = vector(values, what, ParameterError)
    if not all(0 <= v <= BRIGHTEST for v in made):
        raise ParameterError(f"{what} must be three numbers, 0 for none and 1 for full, not {made!r}")
    return made


DIRECTION = (-0.45, 0.7, 0.75)
"""Towards the light that is meant where nobody says where it is."""


@dataclass(frozen=True, slots=True)
class Light:
    """A light, far away or at a place.

    Attributes:
        direction: from the surface towards a light far away.
        color: its colour and strength.
        headlight: whether it moves with the camera: direction and position are then right, up and back from it.
        position: where the light is; None for one far away.
    """

    direction: Vector = DIRECTION
    color: Color = (1.0, 1.0, 1.0)
    headlight: bool = True
    position: Vector | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", vector(self.direction, "a light's direction", ParameterError))
        if self.position is not None:
            object.__setattr__(self, "position", vector(self.position, "a light's position", ParameterError))
            if self.direction != DIRECTION:
                raise ParameterError(
                    "a light has either a direction or a position, not both",
                    hint="a light at a place shines from there; one far away has a direction",
                )
        object.__setattr__(self, "color", color(self.color, "a light's colour"))
        if self.headlight not in (True, False):
            raise ParameterError(f"a light's headlight must be True or False, not {self.headlight!r}")
        object.__setattr__(self, "headlight", bool(self.headlight))
        if max(map(abs, self.direction)) < SHORTEST:
            raise ParameterError("a light's direction must not be zero")


@dataclass(frozen=True, slots=True)
class Material:
    """How a surface reflects: Blinn-Phong with one colour for each side.

    Attributes:
        front: colour of the side that the gradient points to.
        back: colour of the other side.
        ambient: share of the colour that is seen without any light.
        diffuse: share that follows Lambert's cosine.
        specular: strength of the highlight, which has the light's colour.
        shininess: exponent of the highlight; larger is smaller and sharper.
        opacity: 1 for solid; below, what lies behind is seen through it.
        reflectance: share of the light that is mirrored.
        ior: index of refraction of the inside, where f < 0, against the outside; 1 bends nothing. It does nothing where
            no light goes through: with an opacity of 1.
        coloring: colours both sides by a quantity instead; text for one in its usual colours. All surfaces of a picture
            that are coloured so have the same one.
        last_solid: whether it is seen through only where another surface lies behind, so that the last one along a ray
            is solid, and nothing of the surroundings is seen through the surface (K09 section 6.2).
    """

    front: Color = (0.95, 0.52, 0.12)
    back: Color = (0.16, 0.38, 0.72)
    ambient: float = 0.12
    diffuse: float = 0.80
    specular: float = 0.35
    shininess: float = 40.0
    opacity: float = 1.0
    reflectance: float = 0.0
    ior: float = 1.0
    coloring: Coloring | None = None
    last_solid: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "front", color(self.front, "a material's front colour"))
        object.__setattr__(self, "back", color(self.back, "a material's back colour"))
        for name in ("ambient", "diffuse", "specular", "shininess", "opacity", "reflectance", "ior"):
            object.__setattr__(self, name, number(getattr(self, name), f"a material's {name}", ParameterError))
        for name in ("ambient", "diffuse", "specular"):
            if not 0 <= getattr(self, name) <= BRIGHTEST:
                raise ParameterError(f"a material's {name} must not be negative, or above {BRIGHTEST:g}")
        if not 0 < self.shininess <= 10000:
            raise ParameterError("a material's shininess must be above 0 and at most 10000")
        for name in ("opacity", "reflectance"):
            if not 0 <= getattr(self, name) <= 1:
                raise ParameterError(f"a material's {name} must be from 0 to 1, not {getattr(self, name)!r}")
        if self.last_solid not in (True, False):
            raise ParameterError(f"a material's last_solid must be True or False, not {self.last_solid!r}")
        object.__setattr__(self, "last_solid", bool(self.last_solid))
        if self.coloring is not None:
            # Imported where there is one: most pictures are coloured by nothing.
            from zeroset.scene.coloring import as_coloring

            object.__setattr__(self, "coloring", as_coloring(self.coloring))
        if not 0.1 <= self.ior <= 10:
            raise ParameterError(f"a material's index of refraction must be from 0.1 to 10, not {self.ior!r}")


DEFAULT_LIGHTS = (Light(), Light(direction=(0.8, 0.1, 0.55), color=(0.22, 0.24, 0.30)))
DEFAULT_BACKGROUND: Color = (1.0, 1.0, 1.0)
