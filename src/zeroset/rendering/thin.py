"""Thin parts: what of the surface lies between the rays because it is thinner than a pixel.

Down to lines and points without any thickness, such as Steiner's axes (SN10 figure 6, K09 figure 6). The same kernel
runs three times, each time on what the time before could not rule out: on blocks of 4x4 pixels of which a ray missed,
on the pixels of those blocks, and on 4x4 parts of those pixels, whose enclosures are sharp. A pixel with a part left is
drawn, as UNRESOLVED.
"""

from __future__ import annotations

from dataclasses import dataclass

from zeroset.kernel import F32, U32, Kernel, KernelBuilder, Value, atomic, constant, if_, load, store
from zeroset.rendering.buffers import BLOCK, COUNTERS, FIELDS, THIN, Ends
from zeroset.rendering.gbuffer import write
from zeroset.rendering.layout import TILE, pixel_coordinates, tile_of
from zeroset.rendering.primary import EMPTY_TILE, camera_ray, t_range
from zeroset.rendering.view import frame_patch
from zeroset.solve.beam import Thin, find_thin
from zeroset.solve.problem import Answer
from zeroset.solve.shape import Shape
from zeroset.solve.status import MISS, UNRESOLVED
from zeroset.solve.subject import Subject

BLOCKS, PIXELS, PARTS = 0, 1, 2
"""Values of the uniform ``level``."""
WIDTHS = 4.0, 1.0, 0.25
"""Side of what a lane looks at, in pixels."""
FINENESS = 1.0, 0.125, 0.125
"""The shortest step along a beam as a part of its width."""


@dataclass(frozen=True, slots=True)
class _Level:
    """The level of this run, and values that depend on it."""

    level: Value

    def pick(self, values: tuple[Value, Value, Value]) -> Value:
        return self.level.eq(BLOCKS).select(values[0], self.level.eq(PIXELS).select(values[1], values[2]))

    def number(self, values: tuple[float, float, float]) -> Value:
        a, b, c = (constant(v, F32) for v in values)
        return self.pick((a, b, c))


def thin_kernel(shape: Shape, offset: bool, ends: Ends = ()) -> Kernel:
    """One run; the uniform ``level`` says on what."""
    with KernelBuilder("thin") as builder:
        index = builder.index()
        at = _Level(builder.uniform("level", U32))
        buffers = {name: builder.buffer(name, type_, writable=True) for name, type_ in THIN.items()}
        t = builder.buffer("t", FIELDS["t"], writable=True)
        place, part = index >> 4, index & (BLOCK - 1)
        listed_block = load(buffers["thin_block"], at.level.eq(PIXELS).select(place, constant(0, U32)))
        listed_pixel = load(buffers["thin_pixel"], at.level.eq(PARTS).select(place, constant(0, U32)))
        lane = at.pick((index << 4, (listed_block << 4) + part, listed_pixel))

        subject = Subject(shape, builder, offset=offset)
        pixel, width = builder.uniform("pixel", F32), at.number(WIDTHS)
        u, v = pixel_coordinates(builder, lane)
        # From the middle of a lane's (first) pixel to the middle of its block, or of its part of the pixel.
        across = at.pick((constant(1.5, F32), constant(0.0, F32), (part & 3).convert(F32).fma(0.25, -0.375)))
        down = at.pick((constant(1.5, F32), constant(0.0, F32), (part >> 2).convert(F32).fma(0.25, -0.375)))
        patch = frame_patch(builder, subject, across.fma(pixel, u), (-down).fma(pixel, v), pixel * width * 0.5)

        tile = tile_of(lane)
        start, step = (load(builder.buffer(name, F32), tile) for name in ("tile_start", "tile_step"))
        finest = builder.uniform("finest", F32) * (width * at.number(FINENESS)) * (1.0 / TILE)
        # A block's pixels are clear as far as the block was, and a pixel's parts as far as the pixel was.
        reach = load(buffers["block_reach"], lane >> 4) - builder.uniform("finest", F32) * (WIDTHS[BLOCKS] / TILE)
        before = load(t, lane) - builder.uniform("finest", F32) * (2.0 / TILE)
        start = at.pick((start, start.maximum(reach), start.maximum(before)))
        missed = load(builder.buffer("status", U32, writable=True), lane).eq(MISS)
        marked = load(buffers["block_missed"], lane >> 4).ne(0)
        wanted = at.pick((marked, marked & missed, marked))
        thin = find_thin(patch, wanted.select(start, EMPTY_TILE), t_range(builder)[1], step, finest)
        _record(builder, at, subject, lane, thin, ends)
    return builder.kernel


def _record(builder: KernelBuilder, at: _Level, subject: Subject, lane: Value, thin: Thin, ends: Ends) -> None:
    """Put what may hold something thin on the next list, or draw it."""
    counters = builder.buffer(COUNTERS, U32, writable=True)
    t = builder.buffer("t", FIELDS["t"], writable=True)

    def block() -> None:
        store(builder.buffer("thin_block", U32, writable=True), atomic("add", counters, 1, 1), lane >> 4)
        store(builder.buffer("block_reach", F32, writable=True), lane >> 4, thin.t)

    def pixel() -> None:
        store(builder.buffer("thin_pixel", U32, writable=True), atomic("add", counters, 2, 1), lane)
        # Where a ray misses nobody reads t; here it tells the parts where to look, and where to draw.
        store(t, lane, thin.t)

    def draw() -> None:
        # Several parts of a pixel may come here: they all write the same, which is the pixel's.
        where = load(t, lane)
        # Of which part it is nobody has told: the nearest one's.
        mark = None if subject.shape.plain else constant(0xFFFFFFFF, U32)
        answer = Answer(where, constant(UNRESOLVED, U32), constant(1, U32), where, constant(0.0, F32), where, mark)
        write(builder, subject, lane, camera_ray(builder, lane), answer, ends)

    def found() -> None:
        if_(at.level.eq(BLOCKS), block)
        if_(at.level.eq(PIXELS), pixel)
        if_(at.level.eq(PARTS), draw)

    if_(thin.found, found)
