"""Beams: of tiles, which say where rays start, and of ever smaller cells, which find what lies between the rays.

That is thin parts, down to lines and points without any thickness, such as Steiner's axes (SN10 figure 6, K09 figure
6). The kernel runs once before the rays, on tiles, and four times after them, each time on what the time before could
not rule out (``cells``): on blocks of 4x4 pixels of which a ray missed, on the quarters of those blocks, on their
pixels, and on 4x4 parts of those pixels, whose enclosures are sharp. A pixel with a part left is drawn, as UNRESOLVED;
where the device has f64, ``parts`` looks at the parts once more before.

It is one kernel because most of it is f over a beam, whose code takes long to compile.
"""

from __future__ import annotations

from typing import NamedTuple

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.arith import AffineSystem
from zeroset.kernel import F32, U32, Buffer, Kernel, KernelBuilder, Value, atomic, constant, if_, lift, store
from zeroset.rendering.buffers import (
    COUNTERS,
    EMPTY_TILE,
    IN_BLOCKS,
    IN_PARTS,
    IN_PIXELS,
    IN_QUARTERS,
    IN_TILES,
    PARTS,
    THIN,
    THIN_PIXEL,
    THIN_REACH,
    Ends,
)
from zeroset.rendering.cells import HALF, Cells, place_of
from zeroset.rendering.gbuffer import write
from zeroset.rendering.layout import pixel_coordinates
from zeroset.rendering.primary import camera_ray
from zeroset.rendering.view import frame_patch
from zeroset.solve.beam import Beam, trace_beam
from zeroset.solve.field import Ray
from zeroset.solve.problem import Answer
from zeroset.solve.shape import Shape
from zeroset.solve.status import UNRESOLVED
from zeroset.solve.subject import Subject


def beam_kernel(shape: Shape, offset: bool, ends: Ends = (), again: bool = False) -> Kernel:
    """One run; the uniform ``level`` says on what.

    Args:
        shape: what is searched.
        offset: whether f is compared with a uniform.
        ends: whether what lies around a find is kept, for rays that go on.
        again: whether parts that are left are to be looked at again; else they are drawn.
    """
    with KernelBuilder("beams") as builder:
        cells = Cells(builder)
        subject = Subject(shape, builder, offset=offset)
        pixel = builder.uniform("pixel", F32)
        u, v = pixel_coordinates(builder, cells.lane)
        across, down = cells.middle()
        half = pixel * cells.width * HALF
        patch = frame_patch(builder, subject, across.fma(pixel, u), (-down).fma(pixel, v), half)
        start, step = cells.start()
        aiming, far = cells.level.eq(IN_TILES), cells.far(start)
        unsure = cells.level < IN_PIXELS
        beam = trace_beam(patch, start, far, step, cells.finest(), aiming, unsure, cells.ordinary(far))
        keep = _Keeping(builder, subject, cells, beam)

        def found() -> None:
            if_(cells.level.eq(IN_BLOCKS), lambda: keep.cell("block"))
            if_(cells.level.eq(IN_QUARTERS), lambda: keep.cell("quarter"))
            if_(cells.level.eq(IN_PIXELS), lambda: keep.pixel(again))
            if_(cells.level.eq(IN_PARTS), keep.part if again else (lambda: keep.draw(ends)))

        if_(aiming, keep.tile)
        if_(beam.found & ~aiming, found)
    return builder.kernel


class _Keeping(NamedTuple):
    """Puts what may hold something thin on the next list, or draws it."""

    builder: KernelBuilder
    subject: Subject
    cells: Cells
    beam: Beam

    def _append(self, counter: int, name: str, what: Value) -> Value:
        slot = atomic("add", self.builder.buffer(COUNTERS, U32, writable=True), counter, 1)
        store(self.builder.buffer(name, U32, writable=True), slot, what)
        return slot

    def tile(self) -> None:
        """Where a tile's rays start, and with what step."""
        tile, (start, step) = self.builder.index(), self.cells.tiles
        store(start, tile, self.beam.found.select(self.beam.start, EMPTY_TILE))
        store(step, tile, self.beam.step)

    def cell(self, kind: str) -> None:
        """A block, or a quarter of one, by its first pixel."""
        slot = self._append(THIN[kind].counter, THIN[kind].lanes, self.cells.lane)
        store(self.builder.buffer(THIN[kind].reach, F32, writable=True), slot, self.beam.t)

    def pixel(self, again: bool) -> None:
        slot = self._append(3, THIN_PIXEL, self.cells.lane)
        store(self.builder.buffer(THIN_REACH, F32, writable=True), slot, self.beam.t)
        if again:
            store(self._parts(), slot, 0)

    def part(self) -> None:
        """Each pixel is listed once, by the first of its parts that comes here."""
        place = self.cells.place
        before = atomic("add", self._parts(), place, constant(1, U32) << self.cells.part)

        def first() -> None:
            self._append(4, "thin_left", place)

        if_(before.eq(0), first)

    def _parts(self) -> Buffer:
        return self.builder.buffer("thin_parts", PARTS["thin_parts"], writable=True)

    def draw(self, ends: Ends) -> None:
        """Several parts of a pixel may come here: they all write the same, which is the pixel's."""
        lane, place = self.cells.lane, self.cells.place
        where, ray = place_of(self.builder, place), camera_ray(self.builder, lane)
        write(self.builder, self.subject, lane, ray, thin_answer(self.subject, where, ray), ends)


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
