"""How a frame's pixels lie in its buffers: tiles of 8x8 pixels, each four blocks of 4x4.

A packet of 16 lanes is one block, which keeps neighbouring rays together; 64 lanes in a row are one tile, which shares
its beam. Buffers keep that order through all passes, so that every load and store is contiguous; only what leaves the
frame is put into rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from zeroset.kernel import F32, Buffer, KernelBuilder, Value, constant, if_, load

TILE = 8


class Layout(NamedTuple):
    """The tiling of one frame size."""

    width: int
    height: int

    @property
    def columns(self) -> int:
        """Tiles across."""
        return -(-self.width // TILE)

    @property
    def rows(self) -> int:
        """Tiles down."""
        return -(-self.height // TILE)

    @property
    def tiles(self) -> int:
        """Tiles in all."""
        return self.columns * self.rows

    @property
    def lanes(self) -> int:
        """Pixels in all, those of the last row and column of tiles that stick out of the frame included."""
        return self.tiles * TILE * TILE

    def uniforms(self) -> dict[str, float]:
        """What the kernels need to know: tiles across, and the map from pixels to frame coordinates."""
        scale = 2.0 / max(self.width, self.height)
        middle = {"middle_x": 0.5 * self.width, "middle_y": 0.5 * self.height}
        return {"columns": self.columns, "width": self.width, "height": self.height, "pixel": scale} | middle

    def unscramble(self, buffer: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        """A buffer in rows: (height, width)."""
        blocks = buffer.reshape(self.rows, self.columns, 2, 2, 4, 4).transpose(0, 2, 4, 1, 3, 5)
        return np.ascontiguousarray(blocks.reshape(self.rows * TILE, self.columns * TILE)[: self.height, : self.width])


def tile_of(lane: Value) -> Value:
    """The tile that a lane's pixel is in."""
    return lane >> 6


def _tile_corner(builder: KernelBuilder, tile: Value) -> tuple[Value, Value]:
    """Column and row of a tile, found without an integer division: exact below 2^23 tiles in all."""
    columns = builder.uniform("columns", tile.type)
    across = columns.convert(F32)
    row = ((tile.convert(F32) + 0.5) / across).floor().convert(tile.type)
    return tile - row * columns, row


def frame_coordinates(builder: KernelBuilder, column: Value, row: Value) -> tuple[Value, Value]:
    """u and v of a place given in pixels, v upwards."""
    # From the middle, where both are exactly 0: the ray there is the camera's axis, on every device.
    pixel, x, y = (builder.uniform(name, F32).convert(column.type) for name in ("pixel", "middle_x", "middle_y"))
    return (column - x) * pixel, (y - row) * pixel


def pixel_place(builder: KernelBuilder, lane: Value) -> tuple[Value, Value]:
    """Column and row of a lane's pixel; those of the last tiles may lie outside the frame."""
    tile_column, tile_row = _tile_corner(builder, tile_of(lane))
    column = (tile_column << 3) + ((lane >> 4) & 1) * 4 + (lane & 3)
    return column, (tile_row << 3) + ((lane >> 5) & 1) * 4 + ((lane >> 2) & 3)


def lane_of(builder: KernelBuilder, column: Value, row: Value) -> Value:
    """The lane of a pixel, which is in the frame."""
    tile = (row >> 3) * builder.uniform("columns", row.type) + (column >> 3)
    block = (((row >> 2) & 1) << 1) + ((column >> 2) & 1)
    return (tile << 6) + (block << 4) + ((row & 3) << 2) + (column & 3)


class Beside(NamedTuple):
    """The pixel on one side of a lane's own, as far as the frame reaches.

    It lies in the same block, in the tile's other block or in the next tile: each time so many lanes on that all lanes
    of a packet load from places in a row, which costs far less than a load from anywhere.

    Attributes:
        exists: whether it is in the frame.
        block: whether it is in the same block.
        tile: whether, outside the block, it is in the same tile.
        lanes: its lane in these two cases and in that of the next tile.
    """

    exists: Value
    block: Value
    tile: Value
    lanes: tuple[Value, Value, Value]

    @classmethod
    def of(cls, builder: KernelBuilder, lane: Value, along: Value, rows: bool, onward: bool) -> Beside:
        """The pixel beside another.

        Args:
            builder: of the kernel.
            lane: the other.
            along: its row where ``rows``, else its column.
            rows: whether the pixel is in another row; else it is in another column.
            onward: whether in the next one; else in the one before.
        """
        step, block = (4, 32) if rows else (1, 16)
        tile = builder.uniform("columns", lane.type) * 64 if rows else constant(64, lane.type)
        steps = constant(step, lane.type), constant(block - 3 * step, lane.type), tile - (block + 3 * step)
        last = builder.uniform("height" if rows else "width", lane.type) - 1
        if onward:
            lanes = lane + steps[0], lane + steps[1], lane + steps[2]
            return cls(along < last, (along & 3).ne(3), (along & 4).eq(0), lanes)
        lanes = lane - steps[0], lane - steps[1], lane - steps[2]
        return cls(along.ne(0), (along & 3).ne(0), (along & 4).ne(0), lanes)

    def load(self, buffers: Sequence[Buffer]) -> tuple[Value, ...]:
        """What buffers hold for it; zeros, or any pixel's, where it does not exist."""

        def at(lane: Value) -> tuple[Value, ...]:
            return tuple(load(buffer, lane) for buffer in buffers)

        def nothing() -> tuple[Value, ...]:
            return tuple(constant(0, buffer.type) for buffer in buffers)

        def far() -> tuple[Value, ...]:
            return if_(self.exists, lambda: at(self.lanes[2]), nothing)

        return if_(self.block, lambda: at(self.lanes[0]), lambda: if_(self.tile, lambda: at(self.lanes[1]), far))


def pixel_coordinates(builder: KernelBuilder, lane: Value) -> tuple[Value, Value]:
    """u and v of the middle of a lane's pixel."""
    column, row = pixel_place(builder, lane)
    return frame_coordinates(builder, column.convert(F32) + 0.5, row.convert(F32) + 0.5)
