"""The pass from G-buffer to picture: one colour a pixel, packed to bytes, put in rows."""

from __future__ import annotations

from zeroset.kernel import F32, U32, Kernel, KernelBuilder, if_, load, store
from zeroset.rendering.layout import pixel_coordinates, pixel_place
from zeroset.rendering.shading import LIGHT
from zeroset.rendering.view import pixel_ray
from zeroset.shade.reflectance import blinn_phong, normalised
from zeroset.shade.tone import encode, pack
from zeroset.solve.status import MISS


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
