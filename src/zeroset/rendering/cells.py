"""What a beam is traced through: a tile of 8x8 pixels, a block of 4x4, a quarter of it, a pixel, or a part of a pixel.

A tile's beam says where its rays start. The other levels look for thin parts: a run at one level puts what it cannot
rule out on a list, and the next one has four lanes for each entry, sixteen for a pixel. An enclosure's error shrinks
with the square of its width, so that each level is sharper than the one before, and a list's entry says up to where it
was clear, so that none looks twice at what lies before.
"""

from __future__ import annotations

from zeroset.kernel import BOOL, F32, U32, Buffer, KernelBuilder, Type, Value, constant, for_, if_, load
from zeroset.rendering.buffers import (
    BLOCK,
    EMPTY_TILE,
    IN_BLOCKS,
    IN_PARTS,
    IN_PIXELS,
    IN_QUARTERS,
    IN_TILES,
    OPEN,
    THIN,
    THIN_PIXEL,
    THIN_REACH,
)
from zeroset.rendering.front import free_up_to
from zeroset.rendering.layout import TILE, lane_of, pixel_place, tile_of
from zeroset.rendering.primary import t_range
from zeroset.solve.beam import Ordinary
from zeroset.solve.status import MISS

WIDTHS = 8.0, 4.0, 2.0, 1.0, 0.25
"""Side of what a lane looks at, in pixels."""
FINENESS = 1.0, 1.0, 0.5, 0.125, 0.125
"""The shortest step along a beam as a part of its width."""
STEADINESS = 0.0, 2.0**-6, 2.0**-6, 2.0**-6, 0.4
"""The share of one derivative across a patch that the other one keeps beside an ordinary silhouette, for f's gradient
turns little there. In a neck thinner than a pixel it turns by half a turn, and that must not be passed over."""
HALF = 0.505
"""Half a side, and a hundredth for how coordinates are rounded: between two neighbours nothing gets lost."""


def part_offset(part: Value) -> tuple[Value, Value]:
    """How far, in pixels, the middle of a part is from its pixel's, to the right and down."""
    return (part & 3).convert(F32).fma(0.25, -0.375), (part >> 2).convert(F32).fma(0.25, -0.375)


def place_of(builder: KernelBuilder, place: Value) -> Value:
    """The t of a pixel on the list: where it was found to hold something, seen as a whole.

    From there it is lit, too: a little in front of what is thin its normals are smooth.
    """
    return load(builder.buffer(THIN_REACH, F32, writable=True), place)


def reached(builder: KernelBuilder, place: Value) -> Value:
    """Up to where a pixel on the list was clear."""
    return place_of(builder, place) - builder.uniform("finest", F32) * (2.0 / TILE)


def _met(builder: KernelBuilder) -> tuple[Buffer, Buffer]:
    """Whether pixels' rays have met something, and where."""
    return builder.buffer("status", U32, writable=True), builder.buffer("t", F32, writable=True)


def shortest(builder: KernelBuilder, width: Value | float) -> Value:
    """The beams' finest step for a patch of this width, in pixels."""
    return builder.uniform("finest", F32) * width * (1.0 / TILE)


class Cells:
    """One run's lanes.

    Args:
        builder: of the kernel.

    Attributes:
        level: which run it is.
        place: the lane's entry on the list of the run before.
        part: which of sixteen parts of a pixel it is.
        lane: its pixel, or the first of its pixels.
        width: side of what it looks at, in pixels.
        tiles: the buffers of where the rays of tiles start, and with what step.
    """

    def __init__(self, builder: KernelBuilder) -> None:
        self._builder = builder
        self.level = builder.uniform("level", U32)
        self.tiles = [builder.buffer(name, F32, writable=True) for name in ("tile_start", "tile_step")]
        index = builder.index()
        self.place = self.level.eq(IN_PARTS).select(index >> 4, index >> 2)
        self.part = index & (BLOCK - 1)
        block, quarter = (self._listed(THIN[kind].lanes, level) for kind, level in _PARENTS)
        right, below = index & 1, (index >> 1) & 1
        # A block's lanes are its rows, one after the other.
        self.lane = self._pick(
            index << 6,
            index << 4,
            block + (below << 3) + (right << 1),
            quarter + (below << 2) + right,
            self._listed(THIN_PIXEL, IN_PARTS),
        )
        self.width = self._number(WIDTHS)

    def middle(self) -> tuple[Value, Value]:
        """How far, in pixels, the middle of what a lane looks at is from its pixel's, to the right and down."""
        right, below = part_offset(self.part)
        whole = [constant(0.5 * width - 0.5, F32) for width in WIDTHS[:IN_PARTS]]
        return self._pick(*whole, right), self._pick(*whole, below)

    def start(self) -> tuple[Value, Value]:
        """Where on its beam a lane starts, and with what step: as its tile's beam has left it, or the level before."""
        near, far = t_range(self._builder)
        start, step = (load(tile, tile_of(self.lane)) for tile in self.tiles)
        block, quarter = (
            self._listed(THIN[kind].reach, level, F32) - shortest(self._builder, WIDTHS[level - 1])
            for kind, level in _PARENTS
        )
        reach = self._pick(near, start, block, quarter, reached(self._builder, self.place))
        whole, blocks = self.level.eq(IN_TILES), self.level.eq(IN_BLOCKS)
        marked = load(self._builder.buffer(OPEN, U32, writable=True), self.lane >> 4).ne(0)
        begin = (blocks & ~marked).select(EMPTY_TILE, start.maximum(reach))
        return whole.select(near, begin), whole.select((far - near) * 0.25, step)

    def far(self, start: Value) -> Value:
        """Where a lane's beam ends: in front of what rays have met in each quarter of what it looks at.

        Where one has missed there is nothing to end at.
        """
        end, quarters = t_range(self._builder)[1], self.level.eq(IN_BLOCKS).select(constant(4, U32), 1)
        pixels = (self.level <= IN_QUARTERS).select(constant(4, U32), 1)

        def quarter(i: Value, farthest: Value, nearest: Value) -> tuple[Value, ...]:
            corner = self.lane + ((i & 1) << 1) + ((i >> 1) << 3)

            def pixel(i: Value, last: Value) -> Value:
                return last.maximum(free_up_to(self._builder, corner + (i & 1) + ((i >> 1) << 2), end))

            (last,) = for_(pixels, pixel, constant(-EMPTY_TILE, F32))
            return farthest.maximum(last), nearest.minimum(last)

        def rays() -> tuple[Value, ...]:
            return for_(quarters, quarter, constant(-EMPTY_TILE, F32), end)

        farthest, nearest = if_(start < EMPTY_TILE, rays, lambda: (end, end))
        return (self.level.eq(IN_TILES) | (farthest >= end)).select(end, nearest)

    def finest(self) -> Value:
        """The shortest step along a lane's beam."""
        return shortest(self._builder, self.width * self._number(FINENESS))

    def ordinary(self, far: Value) -> Ordinary:
        """What f's derivatives across a lane's patch, up to ``far``, are like beside an ordinary silhouette."""
        closely = self.level >= IN_PIXELS
        across, down = if_(closely, lambda: self._hits_beside(far), lambda: (False, False))
        return Ordinary(self._number(STEADINESS), across, down, self.level.eq(IN_PARTS), closely)

    def _hits_beside(self, far: Value) -> tuple[Value, ...]:
        """Whether a ray left or right of a lane's pixel meets something nearer than that does; or above or below."""
        builder = self._builder
        status, t = _met(builder)
        column, row = pixel_place(builder, self.lane)
        last = [builder.uniform(name, U32) - 1 for name in ("width", "height")]
        # A sheet that ends in this pixel may be met a little behind ``far``; what the pixel's ray met lies farther yet.
        before = far + builder.uniform("finest", F32)

        def one(i: Value, across: Value, down: Value) -> tuple[Value, ...]:
            # Numbers wrap around at 0: the first pixel's other neighbour is taken twice.
            step, sideways = (i & 1) * 2 - 1, i < 2
            x = sideways.select(column + step, column).minimum(last[0])
            y = sideways.select(row, row + step).minimum(last[1])
            beside = lane_of(builder, x, y)
            hit = load(status, beside).ne(MISS) & (load(t, beside) < before)
            return across | (hit & sideways), down | (hit & ~sideways)

        no = constant(False, BOOL)
        return for_(4, one, no, no)

    def _listed(self, name: str, level: int, type_: Type = U32) -> Value:
        """An entry of a list that a level reads; the first one at all others."""
        return load(self._builder.buffer(name, type_, writable=True), self.level.eq(level).select(self.place, 0))

    def _pick(self, *values: Value) -> Value:
        """The value of this run's level."""
        picked = values[-1]
        for level in range(len(values) - 1):
            picked = self.level.eq(level).select(values[level], picked)
        return picked

    def _number(self, values: tuple[float, ...]) -> Value:
        return self._pick(*(constant(v, F32) for v in values))


_PARENTS = ("block", IN_QUARTERS), ("quarter", IN_PIXELS)
"""What the entries are of which a level looks at the quarters."""
