"""The numbers of the shading pass: material, lights and background as uniforms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from zeroset.scene.camera import Rays
from zeroset.scene.light import Color, Light, Material

LIGHT = ("x", "y", "z", "r", "g", "b")


def srgb(linear: float) -> float:
    """The sRGB encoding of one linear channel in [0, 1]."""
    x = min(max(linear, 0.0), 1.0)
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


def shading_uniforms(material: Material, lights: Sequence[Light], background: Color, rays: Rays) -> dict[str, float]:
    """Numbers of the shading pass by uniform name; headlights are turned into world directions here."""
    named = {
        f"{side}_{c}": v for side in ("front", "back") for c, v in zip("rgb", getattr(material, side), strict=True)
    }
    named |= {f"background_{c}": srgb(v) for c, v in zip("rgb", background, strict=True)}
    named |= {name: getattr(material, name) for name in ("ambient", "diffuse", "specular", "shininess")}
    for i, light in enumerate(lights):
        named |= {f"light{i}_{k}": v for k, v in zip(LIGHT, (*_world(light, rays), *light.color), strict=True)}
    return named


def _world(light: Light, rays: Rays) -> tuple[float, ...]:
    direction = np.asarray(light.direction, np.float64)
    if light.headlight:
        across = np.asarray(rays.right) + np.asarray(rays.right_origin)
        upwards = np.asarray(rays.up) + np.asarray(rays.up_origin)
        frame = [across / np.linalg.norm(across), upwards / np.linalg.norm(upwards), -np.asarray(rays.forward)]
        direction = direction @ np.stack(frame)
    return tuple(float(v) for v in direction / np.linalg.norm(direction))
