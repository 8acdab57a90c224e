"""The pass from G-buffer to picture: one colour a pixel, packed to bytes, put in rows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from zeroset.kernel import F32, U32, Kernel, KernelBuilder, if_, load, store
from zeroset.render.layout import pixel_coordinates, pixel_place
from zeroset.render.view import pixel_ray
from zeroset.scene.camera import Rays
from zeroset.scene.light import Color, Light, Material
from zeroset.shade.reflectance import blinn_phong, normalised
from zeroset.shade.tone import encode, pack
from zeroset.solve.problem import MISS

LIGHT = ("x", "y", "z", "r", "g", "b")


def shade_kernel(lights: int) -> Kernel:
    """Blinn-Phong over the background; ``lights`` shapes the kernel, everything else is uniforms."""
    with KernelBuilder("shade") as builder:
        lane = builder.index()
        normal = [load(builder.buffer(name, F32), lane) for name in ("nx", "ny", "nz")]
        hit = load(builder.buffer("status", U32), lane).ne(MISS)

        def lit() -> tuple[object, ...]:
            ray = pixel_ray(builder, *pixel_coordinates(builder, lane))
            toward_eye = [-d for d in normalised(ray.direction)]
            sources = [[builder.uniform(f"light{i}_{name}", F32) for name in LIGHT] for i in range(lights)]
            color = blinn_phong(lambda name: builder.uniform(name, F32), normal, toward_eye, sources)
            return tuple(encode(c) for c in color)

        def behind() -> tuple[object, ...]:
            # Already encoded by the caller: the background is one colour for the whole frame.
            return tuple(builder.uniform(f"background_{c}", F32) for c in "rgb")

        color = pack(if_(hit, lit, behind))
        rgba = builder.buffer("rgba", U32, writable=True)
        column, row = pixel_place(builder, lane)
        width = builder.uniform("width", U32)
        inside = (column < width) & (row < builder.uniform("height", U32))
        if_(inside, lambda: store(rgba, row * width + column, color))
    return builder.kernel


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
