"""Antialiasing where it matters: pixels at silhouettes, creases and borders get many rays, the others keep their one.

A pixel is at an edge where a neighbour shows something else: nothing, another side of a crease, another part, or a
sheet that does not go on from this one's tangent plane (SN10 sections 3.4 and 7.1). Such pixels are put on a list and
drawn anew from many rays (``paths``), which go on as all others do: whatever a scene can show, its edges can. Pixels
that are drawn because something thinner than a pixel lies in them keep their colour.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import NamedTuple

from zeroset.kernel import F32, U32, Buffer, Kernel, KernelBuilder, Value, atomic, constant, if_, load, store
from zeroset.rendering.buffers import COUNTERS, EDGES, EMPTY_TILE, NORMAL, PART
from zeroset.rendering.layout import Beside, pixel_coordinates, pixel_place, tile_of
from zeroset.rendering.view import pixel_ray, vector
from zeroset.shade.reflectance import dot
from zeroset.solve.status import MISS, UNRESOLVED

CREASE = 0.92
"""Cosine between the normals of neighbours below which there is a crease."""
STEP = 0.75
"""Pixels' widths by which a neighbour's point may lie off the tangent plane."""
STEPS = ("right_origin", "right"), ("up_origin", "up")
"""What a ray's origin and direction change by in the frame: along a row, and from row to row."""


class _Point:
    """What a pixel shows: the buffers' values for it, in their order."""

    def __init__(self, values: Sequence[Value]) -> None:
        status, self.t, *rest = values
        self.hit = status.ne(MISS)
        self.normal = rest[:3]
        self.part = rest[3] if len(rest) > 3 else None


class _Look(NamedTuple):
    """What a kernel's lane looks at: its pixel, and what lies around."""

    builder: KernelBuilder
    lane: Value
    column: Value
    row: Value
    buffers: Sequence[Buffer]

    def at_edge(self) -> Value:
        """Whether there is an edge between the pixel and any of its neighbours."""
        here = _Point([load(buffer, self.lane) for buffer in self.buffers])
        ray = pixel_ray(self.builder, *pixel_coordinates(self.builder, self.lane))
        edges = [self._edge(here, ray.direction, rows, onward) for rows in (False, True) for onward in (True, False)]
        return reduce(lambda a, b: a | b, edges)

    def _edge(self, here: _Point, direction: Sequence[Value], rows: bool, onward: bool) -> Value:
        place = Beside.of(self.builder, self.lane, self.row if rows else self.column, rows, onward)
        other = _Point(place.load(self.buffers))
        # From one pixel to the next, rays differ by the same vectors all over the frame.
        step = self.builder.uniform("pixel", F32) * (1.0 if rows ^ onward else -1.0)
        moved, turned = ([v * step for v in vector(self.builder, name)] for name in STEPS[rows])
        far = other.t - here.t
        across = [other.t.fma(turn, far.fma(d, move)) for turn, d, move in zip(turned, direction, moved, strict=True)]
        off = abs(dot(across, here.normal)).maximum(abs(dot(across, other.normal)))
        crease = dot(here.normal, other.normal) < CREASE
        if here.part is not None and other.part is not None:
            crease = crease | here.part.ne(other.part)
        apart = crease | (off > self.builder.uniform("world_pixel", F32) * STEP)
        return place.exists & ((here.hit ^ other.hit) | (here.hit & other.hit & apart))


def edge_kernel(beams: bool, parts: bool = False) -> Kernel:
    """List the pixels at edges among a run of pixels.

    ``beams``: whether tiles have beams; ``parts``: where one part meets another there is an edge too.

    Uniforms beside the camera's: ``first``, the first lane; ``everywhere``, 1 for all pixels; ``world_pixel``, a
    pixel's width in the scene.
    """
    with KernelBuilder("edges") as builder:
        lane = builder.index() + builder.uniform("first", U32)
        column, row = pixel_place(builder, lane)
        inside = (column < builder.uniform("width", U32)) & (row < builder.uniform("height", U32))
        list_edge(builder, lane, (column, row), inside, beams, parts)
    return builder.kernel


def list_edge(
    builder: KernelBuilder, lane: Value, place: tuple[Value, Value], inside: Value, beams: bool, parts: bool
) -> None:
    """Put a pixel on the list if it is at an edge; see ``edge_kernel``.

    Args:
        builder: of the kernel.
        lane: the pixel's.
        place: its column and row.
        inside: whether it is in the frame.
        beams: whether tiles have beams.
        parts: whether there are several parts.
    """
    thin = load(builder.buffer("status", U32), lane).eq(UNRESOLVED)
    everywhere = builder.uniform("everywhere", U32).ne(0)
    # A tile that its beam has shown to be empty is smooth as it is.
    start = load(builder.buffer("tile_start", F32), tile_of(lane)) if beams else constant(0.0, F32)

    def look() -> None:
        names = {"status": U32, "t": F32, **dict.fromkeys(NORMAL, F32), **({PART: U32} if parts else {})}
        buffers = [builder.buffer(name, type_) for name, type_ in names.items()]
        edge = everywhere | _Look(builder, lane, *place, buffers).at_edge()
        if_(edge, lambda: _list(builder, lane))

    if_(inside & ~thin & (start < EMPTY_TILE), look)


def _list(builder: KernelBuilder, lane: Value) -> None:
    slot = atomic("add", builder.buffer(COUNTERS, U32, writable=True), 0, 1)
    store(builder.buffer(EDGES, U32, writable=True), slot, lane)
