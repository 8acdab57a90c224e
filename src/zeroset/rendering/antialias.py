"""Antialiasing where it matters: pixels at silhouettes, creases and borders get many rays, the others keep their one.

A pixel is at an edge where a neighbour shows something else: nothing, another side of a crease, another part, or a
sheet that does not go on from this one's tangent plane (SN10 sections 3.4 and 7.1). Such pixels are put on a list and
drawn anew from many rays (``paths``), which go on as all others do: whatever a scene can show, its edges can. Pixels
that are drawn because something thinner than a pixel lies in them keep their colour.
"""

from __future__ import annotations

from zeroset.kernel import F32, U32, Kernel, KernelBuilder, Value, atomic, constant, if_, load, store
from zeroset.rendering.buffers import COUNTERS, EDGES, NORMAL, PART
from zeroset.rendering.layout import frame_coordinates, lane_at, pixel_place, tile_of
from zeroset.rendering.primary import EMPTY_TILE
from zeroset.rendering.view import pixel_ray
from zeroset.shade.reflectance import dot
from zeroset.solve.status import MISS, UNRESOLVED

CREASE = 0.92
"""Cosine between the normals of neighbours below which there is a crease."""
STEP = 0.75
"""Pixels' widths by which a neighbour's point may lie off the tangent plane."""


class _Point:
    """What a pixel shows."""

    def __init__(self, builder: KernelBuilder, column: Value, row: Value, parts: bool) -> None:
        lane = lane_at(builder, column, row)
        u, v = frame_coordinates(builder, column.convert(F32) + 0.5, row.convert(F32) + 0.5)
        ray = pixel_ray(builder, u, v)
        t = load(builder.buffer("t", F32), lane)
        self.hit = load(builder.buffer("status", U32), lane).ne(MISS)
        self.place = [t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True)]
        self.normal = [load(builder.buffer(name, F32), lane) for name in NORMAL]
        self.part = load(builder.buffer(PART, U32), lane) if parts else None

    def differs(self, other: _Point, pixel: Value) -> Value:
        """Whether there is an edge between two pixels."""
        across = [a - b for a, b in zip(other.place, self.place, strict=True)]
        off = abs(dot(across, self.normal)).maximum(abs(dot(across, other.normal)))
        crease = dot(self.normal, other.normal) < CREASE
        if self.part is not None and other.part is not None:
            crease = crease | self.part.ne(other.part)
        return (self.hit ^ other.hit) | (self.hit & other.hit & (crease | (off > pixel * STEP)))


def edge_kernel(beams: bool, parts: bool = False) -> Kernel:
    """List the pixels at edges among a run of pixels.

    ``beams``: whether tiles have beams; ``parts``: where one part meets another there is an edge too.

    Uniforms beside the camera's: ``first``, the first lane; ``everywhere``, 1 for all pixels; ``world_pixel``, a
    pixel's width in the scene.
    """
    with KernelBuilder("edges") as builder:
        lane = builder.index() + builder.uniform("first", U32)
        column, row = pixel_place(builder, lane)
        width, height = builder.uniform("width", U32), builder.uniform("height", U32)
        inside = (column < width) & (row < height)
        thin = load(builder.buffer("status", U32), lane).eq(UNRESOLVED)
        everywhere = builder.uniform("everywhere", U32).ne(0)
        # A tile that its beam has shown to be empty is smooth as it is.
        start = load(builder.buffer("tile_start", F32), tile_of(lane)) if beams else constant(0.0, F32)

        def look() -> None:
            edge = everywhere | _at_edge(builder, column, row, width, height, parts)
            if_(edge, lambda: _list(builder, lane))

        if_(inside & ~thin & (start < EMPTY_TILE), look)
    return builder.kernel


def _list(builder: KernelBuilder, lane: Value) -> None:
    slot = atomic("add", builder.buffer(COUNTERS, U32, writable=True), 0, 1)
    store(builder.buffer(EDGES, U32, writable=True), slot, lane)


def _at_edge(builder: KernelBuilder, column: Value, row: Value, width: Value, height: Value, parts: bool) -> Value:
    pixel = builder.uniform("world_pixel", F32)
    last_column, last_row = width - 1, height - 1
    here = _Point(builder, column.minimum(last_column), row.minimum(last_row), parts)
    edge: Value | None = None
    for right, down in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        # A pixel at the frame's border is its own neighbour.
        beside = (column + 1).minimum(last_column) if right > 0 else column.maximum(1) - 1 if right < 0 else column
        below = (row + 1).minimum(last_row) if down > 0 else row.maximum(1) - 1 if down < 0 else row
        other = here.differs(_Point(builder, beside.minimum(last_column), below.minimum(last_row), parts), pixel)
        edge = other if edge is None else edge | other
    assert edge is not None
    return edge
