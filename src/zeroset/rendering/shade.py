"""The pass from G-buffer to picture: one colour a pixel, packed to bytes, put in rows."""

from __future__ import annotations

from collections.abc import Callable

from zeroset.kernel import F32, U32, Kernel, KernelBuilder, Value, if_, load, store
from zeroset.rendering.buffers import COLORS, LIT, NORMAL, PART, VALUE
from zeroset.rendering.layout import pixel_coordinates, pixel_place
from zeroset.rendering.materials import material_at
from zeroset.rendering.shading import LIGHT, Lighting
from zeroset.rendering.view import pixel_ray
from zeroset.shade.albedo import Albedo, two_sided
from zeroset.shade.colormap import mapped
from zeroset.shade.reflectance import blinn_phong, normalised
from zeroset.shade.tone import encode, pack
from zeroset.solve.field import Ray
from zeroset.solve.status import MISS


def shade_kernel(lighting: Lighting, parts: int = 1, beams: bool = False) -> Kernel:
    """Blinn-Phong over the background; lists the pixels at edges as well, where these are to be smooth.

    Both read the same of a pixel, which comes out of memory once.

    Args:
        lighting: shapes the kernel.
        parts: how many there are.
        beams: whether tiles have beams.

    Where edges are listed, there are the uniforms of ``antialias.edge_kernel``.
    """
    smooth = lighting.optics is not None and lighting.optics.smooth
    with KernelBuilder("shade") as builder:
        lane = builder.index()
        if smooth:
            lane = lane + builder.uniform("first", U32)
        hit = load(builder.buffer("status", U32), lane).ne(MISS)

        def lit() -> tuple[object, ...]:
            normal = [load(builder.buffer(name, F32), lane) for name in NORMAL]
            ray = pixel_ray(builder, *pixel_coordinates(builder, lane))
            toward_eye = [-d for d in normalised(ray.direction)]
            sources = _sources(builder, lighting, ray, lane)
            part = load(builder.buffer(PART, U32), lane) if parts > 1 else None
            material, albedo = material_at(builder, part), None
            if lighting.colored:
                albedo = by_value(builder, load(builder.buffer(VALUE, F32), lane), None if part is None else material)
            color = blinn_phong(material, normal, toward_eye, sources, albedo)
            return tuple(encode(c) for c in color)

        color = pack(if_(hit, lit, lambda: background(builder)))
        rgba = builder.buffer("rgba", U32, writable=True)
        column, row = pixel_place(builder, lane)
        width = builder.uniform("width", U32)
        inside = (column < width) & (row < builder.uniform("height", U32))
        if_(inside, lambda: store(rgba, row * width + column, color))
        if smooth:
            from zeroset.rendering.antialias import list_edge

            list_edge(builder, lane, (column, row), inside, beams, parts > 1)
    return builder.kernel


def background(builder: KernelBuilder) -> tuple[Value, ...]:
    """The background, encoded by the caller: it is one colour for the whole frame."""
    return tuple(builder.uniform(f"background_{c}", F32) for c in "rgb")


def by_value(builder: KernelBuilder, value: Value, material: Callable[[str], Value] | None) -> Albedo:
    """The albedo of a point that is coloured by a value: through the frame's colour map.

    ``material``: gives the numbers of the point's part, which may keep its own colours; None where there is one part.
    """
    own = None if material is None else two_sided(material)
    return mapped(builder.buffer(COLORS, F32), lambda name: builder.uniform(name, F32), value, own)


def _sources(builder: KernelBuilder, lighting: Lighting, ray: Ray, lane: Value) -> list[list[Value]]:
    """For each light the unit direction towards it and its colour, black where something is in its path."""
    sources = [[builder.uniform(f"light{i}_{name}", F32) for name in LIGHT] for i in range(len(lighting.kinds))]
    if "p" in lighting.kinds:
        t = load(builder.buffer("t", F32), lane)
        point = [t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True)]
        for i, kind in enumerate(lighting.kinds):
            if kind == "p":
                sources[i][:3] = normalised([p - x for p, x in zip(sources[i][:3], point, strict=True)])
    if lighting.shadows:
        lit = load(builder.buffer(LIT, U32), lane)
        for i, source in enumerate(sources):
            reached = ((lit >> i) & 1).ne(0)
            source[3:] = [reached.select(c, 0.0) for c in source[3:]]
    return sources
