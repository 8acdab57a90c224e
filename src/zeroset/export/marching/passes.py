"""The kernels that say where triangles are: sample f, mark cells, list what they hold, join vertices.

Only ``sample`` is traced for each formula. The others know signs and numbers alone: they are the same for all surfaces.

Most lanes are points of blocks: such a lane's number is the block's place on the slab's list (the slot), then three
bits each for z, y and x.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

from zeroset.export.marching.lattice import BITS, MISSING, SIDE
from zeroset.export.marching.solid import Solid
from zeroset.export.marching.tetrahedra import CODES
from zeroset.kernel import F32, U32, Kernel, KernelBuilder, Type, Value, constant, for_, if_, load, store
from zeroset.solve.field import Field

GHOST = 2e30
"""Value of a ghost point: outside."""
UNDEFINED = 3e30
"""Value of a point where f is not defined, or where the lattice has ended."""
CASE = 7
"""Where in a mark the cell's case begins; below it are bits for those of the point's seven edges that cross f = 0."""


class Place(NamedTuple):
    """A lane's point.

    Attributes:
        slot: the block's place on the slab's list.
        block: the block's coordinates.
        local: the point's coordinates in the block, 0 to 7.
    """

    slot: Value
    block: tuple[Value, ...]
    local: tuple[Value, ...]

    @property
    def indices(self) -> tuple[Value, ...]:
        """The point's place in the lattice."""
        return tuple(b * SIDE + i for b, i in zip(self.block, self.local, strict=True))


def coordinates(code: Value) -> tuple[Value, ...]:
    """A block's coordinates from its code."""
    mask = (1 << BITS) - 1
    return code & mask, (code >> BITS) & mask, code >> (2 * BITS)


def place_of(builder: KernelBuilder, lane: Value) -> Place:
    """The point that a lane's number stands for."""
    slot = lane >> 9
    code = load(builder.buffer("blocks", U32), slot)
    return Place(slot, coordinates(code), (lane & 7, (lane >> 3) & 7, (lane >> 6) & 7))


def last_of(builder: KernelBuilder) -> tuple[Value, ...]:
    """Index of the lattice's last point along each axis."""
    return tuple(builder.uniform(f"last_{axis}", U32) for axis in "xyz")


def position(builder: KernelBuilder, indices: Sequence[Value]) -> tuple[Value, ...]:
    """The coordinates of a point of the lattice, f32."""
    grid = builder.buffer("grid", F32)
    x, y, z = indices
    return (
        load(grid, x),
        load(grid, y + builder.uniform("begin_y", U32)),
        load(grid, z + builder.uniform("begin_z", U32)),
    )


def any_of(conditions: Sequence[Value]) -> Value:
    """Whether one of three holds."""
    a, b, c = conditions
    return a | b | c


def is_ghost(builder: KernelBuilder, indices: Sequence[Value]) -> Value:
    """Whether a point is one of the ghost layers."""
    ghosts = builder.uniform("ghosts", U32)
    return any_of([(i < ghosts) | (i + ghosts > n) for i, n in zip(indices, last_of(builder), strict=True)])


def sample_kernel(field: Field, kind: str, capped: bool, type_: Type) -> Kernel:
    """The function that is meshed at every point of the slab's blocks."""
    with KernelBuilder("mesh sample") as builder:
        lane = builder.index()
        indices = place_of(builder, lane).indices
        values = builder.buffer("values", type_, writable=True)
        beyond = any_of([i > n for i, n in zip(indices, last_of(builder), strict=True)])
        solid = Solid(field, builder, kind, capped, type_)

        def evaluate() -> Value:
            point = [v.convert(type_) for v in position(builder, indices)]
            value, defined = solid.value(point)
            return is_ghost(builder, indices).select(GHOST, defined.select(value, UNDEFINED))

        def nothing() -> float:
            return UNDEFINED

        store(values, lane, if_(~beyond, evaluate, nothing)[0])
    return builder.kernel


def mark_kernel(type_: Type) -> Kernel:
    """Which edges of each point cross the surface, and the case of the cell that begins there."""
    with KernelBuilder("mesh mark") as builder:
        lane = builder.index()
        values = builder.buffer("values", type_)
        marks = builder.buffer("marks", U32, writable=True)
        x, y, z = lane & 7, (lane >> 3) & 7, (lane >> 6) & 7
        owned = (x < SIDE) & (y < SIDE) & (z < SIDE)

        def mark() -> Value:
            corners = [load(values, lane + ((c & 1) + (c & 2) * 4 + (c & 4) * 16)) for c in range(8)]
            inside = [v <= 0.0 for v in corners]
            known = [v < 0.5 * (GHOST + UNDEFINED) for v in corners]
            edges = case = lane & 0
            whole = known[0]
            for c in range(1, 8):
                crossing = (inside[0] ^ inside[c]) & known[0] & known[c]
                edges = edges | (crossing.convert(U32) << (c - 1))
                whole = whole & known[c]
            for c in range(8):
                case = case | (inside[c].convert(U32) << c)
            return edges | (whole.select(case, 0) << CASE)

        store(marks, lane, if_(owned, mark, lambda: 0)[0])
    return builder.kernel


def list_kernel() -> Kernel:
    """One cell a lane: put its vertices and its triangles on their lists, each at its own number."""
    with KernelBuilder("mesh list") as builder:
        lane = builder.index()
        cell = load(builder.buffer("cells", U32), lane)
        mark = load(builder.buffer("marks", U32), cell)
        keys = builder.buffer("keys", U32, writable=True)
        number = load(builder.buffer("starts", U32), cell) - builder.uniform("base", U32)
        for along in range(1, 8):
            bit = (mark >> (along - 1)) & 1
            if_(bit.ne(0), partial(store, keys, number, (cell << 3) | along))
            number = number + bit
        count = load(builder.buffer("table", U32), (mark >> CASE) + 256 * CODES)
        first = load(builder.buffer("firsts", U32), lane)
        whose, which = (builder.buffer(name, U32, writable=True) for name in ("whose", "which"))

        def triangle(i: Value) -> None:
            store(whose, first + i, cell)
            store(which, first + i, i)

        for_(count, triangle)
    return builder.kernel


def join_kernel() -> Kernel:
    """One triangle a lane: the numbers of its three vertices."""
    with KernelBuilder("mesh join") as builder:
        lane = builder.index()
        cell = load(builder.buffer("whose", U32), lane)
        case = load(builder.buffer("marks", U32), cell) >> CASE
        entry = case * CODES + load(builder.buffer("which", U32), lane) * 3
        place = place_of(builder, cell)
        corners = builder.buffer("corners", U32, writable=True)
        for i in range(3):
            code = load(builder.buffer("table", U32), entry + i)
            store(corners, lane * 3 + i, _number(builder, place, code))
    return builder.kernel


def _number(builder: KernelBuilder, place: Place, code: Value) -> Value:
    """The number of the vertex on an edge of a cell."""
    point = [i + ((code >> axis) & 1) for axis, i in enumerate(place.local)]
    # The last points of a block are the first ones of the next.
    block = [b + i.eq(SIDE).convert(U32) for b, i in zip(place.block, point, strict=True)]
    x, y, z = (i.eq(SIDE).select(0, i) for i in point)
    across, along = builder.uniform("blocks_x", U32), builder.uniform("blocks_y", U32)
    slot = load(builder.buffer("slots", U32), (block[2] * along + block[1]) * across + block[0])
    lane = (slot << 9) | (z << 6) | (y << 3) | x

    def numbered() -> Value:
        before = (constant(1, U32) << ((code >> 3) - 1)) - 1
        mask = load(builder.buffer("marks", U32), lane) & before
        return load(builder.buffer("starts", U32), lane) + _ones(mask)

    return if_(slot.ne(MISSING), numbered, lambda: MISSING)[0]


def _ones(bits: Value) -> Value:
    """How many of seven bits are set."""
    pairs = bits - ((bits >> 1) & 0x55)
    fours = (pairs & 0x33) + ((pairs >> 2) & 0x33)
    return (fours + (fours >> 4)) & 0xF
