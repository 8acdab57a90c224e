"""Thin parts: what of the surface lies between the rays because it is thinner than a pixel.

Down to lines and points without any thickness, such as Steiner's axes (SN10 figure 6, K09 figure 6). The same kernel
runs three times, each time on what the time before could not rule out: on blocks of 4x4 pixels of which a ray missed,
on the pixels of those blocks, and on 4x4 parts of those pixels, whose enclosures are sharp. A pixel with a part left is
drawn, as UNRESOLVED; where the device has f64, ``parts`` looks at the parts once more before.
"""

from __future__ import annotations

from typing import NamedTuple

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.arith import AffineSystem
from zeroset.kernel import F32, U32, Buffer, Kernel, KernelBuilder, Value, atomic, constant, if_, lift, load, store
from zeroset.rendering.buffers import BLOCK, COUNTERS, FIELDS, PARTS, THIN, THIN_PIXEL, Ends
from zeroset.rendering.gbuffer import write
from zeroset.rendering.layout import TILE, pixel_coordinates, tile_of
from zeroset.rendering.primary import EMPTY_TILE, camera_ray, t_range
from zeroset.rendering.view import frame_patch
from zeroset.solve.beam import Thin, find_thin
from zeroset.solve.field import Ray
from zeroset.solve.problem import Answer
from zeroset.solve.shape import Shape
from zeroset.solve.status import MISS, UNRESOLVED
from zeroset.solve.subject import Subject

IN_BLOCKS, IN_PIXELS, IN_PARTS = 0, 1, 2
"""Values of the uniform ``level``."""
WIDTHS = 4.0, 1.0, 0.25
"""Side of what a lane looks at, in pixels."""
FINENESS = 1.0, 0.125, 0.125
"""The shortest step along a beam as a part of its width."""
HALF = 0.505
"""Half a side, and a hundredth for how coordinates are rounded: between two neighbours nothing gets lost."""


class _Level(NamedTuple):
    """The level of this run, and values that depend on it."""

    level: Value

    def pick(self, values: tuple[Value, Value, Value]) -> Value:
        return self.level.eq(IN_BLOCKS).select(values[0], self.level.eq(IN_PIXELS).select(values[1], values[2]))

    def number(self, values: tuple[float, float, float]) -> Value:
        a, b, c = (constant(v, F32) for v in values)
        return self.pick((a, b, c))


def part_offset(part: Value) -> tuple[Value, Value]:
    """How far, in pixels, the middle of a part is from its pixel's, to the right and down."""
    return (part & 3).convert(F32).fma(0.25, -0.375), (part >> 2).convert(F32).fma(0.25, -0.375)


def place_of(builder: KernelBuilder, lane: Value) -> Value:
    """The t of a pixel that is on the list: where it was found to hold something, seen as a whole.

    From there it is lit, too: a little in front of what is thin its normals are smooth.
    """
    return load(builder.buffer("t", FIELDS["t"], writable=True), lane)


def reached(builder: KernelBuilder, lane: Value) -> Value:
    """Up to where a pixel that is on the list was clear."""
    return place_of(builder, lane) - builder.uniform("finest", F32) * (2.0 / TILE)


def shortest(builder: KernelBuilder, width: Value | float) -> Value:
    """The beams' finest step for a patch of this width, in pixels."""
    return builder.uniform("finest", F32) * width * (1.0 / TILE)


def thin_kernel(shape: Shape, offset: bool, ends: Ends = (), again: bool = False) -> Kernel:
    """One run; the uniform ``level`` says on what.

    Args:
        shape: what is searched.
        offset: whether f is compared with a uniform.
        ends: whether what lies around a find is kept, for rays that go on.
        again: whether parts that are left are to be looked at again; else they are drawn.
    """
    with KernelBuilder("thin") as builder:
        index = builder.index()
        at = _Level(builder.uniform("level", U32))
        buffers = {name: builder.buffer(name, type_, writable=True) for name, type_ in THIN.items()}
        place, part = index >> 4, index & (BLOCK - 1)
        listed_block = load(buffers["thin_block"], at.level.eq(IN_PIXELS).select(place, constant(0, U32)))
        pixels = builder.buffer(THIN_PIXEL, U32, writable=True)
        listed_pixel = load(pixels, at.level.eq(IN_PARTS).select(place, constant(0, U32)))
        lane = at.pick((index << 4, (listed_block << 4) + part, listed_pixel))

        subject = Subject(shape, builder, offset=offset)
        pixel, width = builder.uniform("pixel", F32), at.number(WIDTHS)
        u, v = pixel_coordinates(builder, lane)
        # From the middle of a lane's (first) pixel to the middle of its block, or of its part of the pixel.
        right, below = part_offset(part)
        across = at.pick((constant(1.5, F32), constant(0.0, F32), right))
        down = at.pick((constant(1.5, F32), constant(0.0, F32), below))
        patch = frame_patch(builder, subject, across.fma(pixel, u), (-down).fma(pixel, v), pixel * width * HALF)

        tile = tile_of(lane)
        start, step = (load(builder.buffer(name, F32), tile) for name in ("tile_start", "tile_step"))
        finest = shortest(builder, width * at.number(FINENESS))
        # A block's pixels are clear as far as the block was, and a pixel's parts as far as the pixel was.
        reach = load(buffers["block_reach"], lane >> 4) - builder.uniform("finest", F32) * (WIDTHS[0] / TILE)
        start = at.pick((start, start.maximum(reach), start.maximum(reached(builder, lane))))
        missed = load(builder.buffer("status", U32, writable=True), lane).eq(MISS)
        marked = load(buffers["block_missed"], lane >> 4).ne(0)
        wanted = at.pick((marked, marked & missed, marked))
        thin = find_thin(patch, wanted.select(start, EMPTY_TILE), t_range(builder)[1], step, finest)
        keep = _Keeping(builder, subject, lane, thin)

        def found() -> None:
            if_(at.level.eq(IN_BLOCKS), keep.block)
            if_(at.level.eq(IN_PIXELS), lambda: keep.pixel(again))
            if_(at.level.eq(IN_PARTS), (lambda: keep.part(place, part)) if again else (lambda: keep.draw(ends)))

        if_(thin.found, found)
    return builder.kernel


class _Keeping(NamedTuple):
    """Puts what may hold something thin on the next list, or draws it."""

    builder: KernelBuilder
    subject: Subject
    lane: Value
    thin: Thin

    def _append(self, counter: int, name: str, what: Value) -> Value:
        slot = atomic("add", self.builder.buffer(COUNTERS, U32, writable=True), counter, 1)
        store(self.builder.buffer(name, U32, writable=True), slot, what)
        return slot

    def block(self) -> None:
        self._append(1, "thin_block", self.lane >> 4)
        store(self.builder.buffer("block_reach", F32, writable=True), self.lane >> 4, self.thin.t)

    def pixel(self, again: bool) -> None:
        slot = self._append(2, THIN_PIXEL, self.lane)
        # Where a ray misses nobody reads t; here it tells the parts where to look, and where to draw.
        store(self.builder.buffer("t", FIELDS["t"], writable=True), self.lane, self.thin.t)
        if again:
            store(self._parts(), slot, 0)

    def part(self, place: Value, part: Value) -> None:
        """Each pixel is listed once, by the first of its parts that comes here."""
        before = atomic("add", self._parts(), place, constant(1, U32) << part)

        def first() -> None:
            self._append(3, "thin_left", place)

        if_(before.eq(0), first)

    def _parts(self) -> Buffer:
        return self.builder.buffer("thin_parts", PARTS["thin_parts"], writable=True)

    def draw(self, ends: Ends) -> None:
        """Several parts of a pixel may come here: they all write the same, which is the pixel's."""
        where, ray = place_of(self.builder, self.lane), camera_ray(self.builder, self.lane)
        write(self.builder, self.subject, self.lane, ray, thin_answer(self.subject, where, ray), ends)


def thin_answer(subject: Subject, where: Value, missed: Ray) -> Answer:
    """A thin part at some t, as what a pixel shows; ``missed``: the pixel's own ray, which passes it by."""
    # Of which part of the shape it is nobody has told: the nearest one's.
    mark = None if subject.shape.plain else constant(0xFFFFFFFF, U32)
    return Answer(where, constant(UNRESOLVED, U32), constant(1, U32), where, _side(subject, where, missed), where, mark)


def _side(subject: Subject, where: Value, missed: Ray) -> Value:
    """The sign that f shows the eye: all along a ray that misses it is the same, so that of one point is enough."""
    zero, one = constant(0.0, subject.type), constant(1.0, subject.type)
    if not subject.shape.plain:
        return zero
    system = AffineSystem(FORMAT32 if subject.type == F32 else FORMAT64)
    bounds = subject.bodies[0].first.along(system, missed, system.exact(where)).interval()
    low, high = (lift(end, subject.type) for end in (bounds.lo, bounds.hi))
    return (low > 0.0).select(one, (high < 0.0).select(-one, zero))
