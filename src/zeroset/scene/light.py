"""Lights, materials and background: how a surface is lit in the first frame (Blinn-Phong, two-sided).

Colours are linear-light RGB in [0, 1]; the picture is encoded to sRGB at the very end. Front is the side that the
gradient points to (growing f), back the other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from zeroset.errors import SceneFileError
from zeroset.scene.bounds import Vector

Color = tuple[float, float, float]


def _check(values: tuple[float, ...], what: str) -> None:
    if len(values) != 3 or not all(math.isfinite(v) for v in values):
        raise SceneFileError(f"{what} must be three finite numbers, not {values!r}")


@dataclass(frozen=True, slots=True)
class Light:
    """A light far away.

    Attributes:
        direction: from the surface towards the light; with ``headlight`` in camera coordinates (right, up, back).
        color: its colour and strength.
        headlight: whether it moves with the camera.
    """

    direction: Vector = (-0.45, 0.7, 0.75)
    color: Color = (1.0, 1.0, 1.0)
    headlight: bool = True

    def __post_init__(self) -> None:
        _check(self.direction, "a light's direction")
        _check(self.color, "a light's colour")
        if not any(self.direction):
            raise SceneFileError("a light's direction must not be zero")


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
    """

    front: Color = (0.95, 0.52, 0.12)
    back: Color = (0.16, 0.38, 0.72)
    ambient: float = 0.12
    diffuse: float = 0.80
    specular: float = 0.35
    shininess: float = 40.0

    def __post_init__(self) -> None:
        _check(self.front, "a material's front colour")
        _check(self.back, "a material's back colour")
        for name in ("ambient", "diffuse", "specular"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) >= 0):
                raise SceneFileError(f"a material's {name} must not be negative")
        if not (math.isfinite(self.shininess) and 0 < self.shininess <= 10000):
            raise SceneFileError("a material's shininess must be between 0 and 10000")


DEFAULT_LIGHTS = (Light(), Light(direction=(0.8, 0.1, 0.55), color=(0.22, 0.24, 0.30)))
DEFAULT_BACKGROUND: Color = (1.0, 1.0, 1.0)
