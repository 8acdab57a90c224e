"""The lattice that f is sampled on: points in rows along the axes, in blocks of 7 cells a side.

A block of 7x7x7 cells has 8x8x8 points, so that a point's place in its block is nine bits of a lane's number and no
kernel divides. A block owns the edges that begin at its first 7x7x7 points; the last layer of points belongs to the
blocks behind it, and is evaluated twice to the same bits.

A box that is to be closed gets a ghost layer around it: points outside the solid, at the very places of the box's
faces. The cells between have no thickness, and the triangles in them are the box's own faces where f <= 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.scene.bounds import Ball, Bounds

SIDE = 7
"""Cells along a block."""
LANES = 512
"""Points of a block, and lanes that work on it."""
BITS = 10
"""Bits of a block's coordinate in its code."""
MISSING = 2**32 - 1
"""What stands for a block that is not on a list, for a vertex that none of a slab's blocks owns, and for no point."""
MARGIN = 0.2
"""Cells between a ball and the outermost points: those must lie outside, or a cap could end at the lattice's end."""

Integers = npt.NDArray[np.uint32]


@dataclass(frozen=True, eq=False)
class Lattice:
    """Points along three axes.

    Attributes:
        axes: coordinates of the points along x, y and z, float32, as kernels read them.
        ghosts: ghost layers at each end, 0 or 1.
        cell: the longest edge of a cell along an axis.
    """

    axes: tuple[npt.NDArray[np.float32], ...]
    ghosts: int
    cell: float

    @cached_property
    def last(self) -> tuple[int, int, int]:
        """Index of the last point along each axis."""
        x, y, z = (len(axis) - 1 for axis in self.axes)
        return x, y, z

    @cached_property
    def blocks(self) -> tuple[int, int, int]:
        """Blocks along each axis, enough to own every point."""
        x, y, z = (last // SIDE + 1 for last in self.last)
        return x, y, z

    @cached_property
    def coordinates(self) -> npt.NDArray[np.float32]:
        """All coordinates in one row: x, then y, then z."""
        return np.concatenate(self.axes)

    def uniforms(self) -> dict[str, float]:
        """What kernels need to know of the lattice."""
        last = dict(zip(("last_x", "last_y", "last_z"), self.last, strict=True))
        begins = {"begin_y": len(self.axes[0]), "begin_z": len(self.axes[0]) + len(self.axes[1])}
        blocks = {"blocks_x": self.blocks[0], "blocks_y": self.blocks[1], "blocks_z": self.blocks[2]}
        return {**last, **begins, **blocks, "ghosts": self.ghosts}

    def row(self, codes: Integers) -> npt.NDArray[np.int64]:
        """Places of blocks in the table of all blocks, z slowest."""
        x, y, z = unpack(codes)
        across, along, _ = self.blocks
        return (z * along + y) * across + x

    def code(self, row: npt.NDArray[Any]) -> Integers:
        """The inverse of ``row``."""
        across, along, _ = self.blocks
        return pack(row % across, row // across % along, row // (across * along))


def pack(x: npt.NDArray[Any], y: npt.NDArray[Any], z: npt.NDArray[Any]) -> Integers:
    """Codes of blocks from their coordinates."""
    codes: Integers = (x | y << BITS | z << 2 * BITS).astype(np.uint32)
    return codes


def unpack(codes: Integers) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Coordinates of blocks from their codes."""
    wide = codes.astype(np.int64)
    mask = (1 << BITS) - 1
    return wide & mask, wide >> BITS & mask, wide >> 2 * BITS


def make_lattice(bounds: Bounds, resolution: int, closed: bool) -> Lattice:
    """The lattice of some bounds with so many cells along their longest side; the cells are nearly cubes.

    Args:
        bounds: a ball lies inside its lattice with a little room around it, a box is its lattice.
        resolution: cells along the longest side.
        closed: whether a box gets a ghost layer.
    """
    if isinstance(bounds, Ball):
        half = bounds.radius * resolution / (resolution - 2.0 * MARGIN)
        ends = [(c - half, c + half) for c in bounds.center]
    else:
        ends = list(zip(bounds.min, bounds.max, strict=True))
    longest = max(high - low for low, high in ends)
    counts = [max(1, round(resolution * (high - low) / longest)) for low, high in ends]
    rows = [np.linspace(*end, count + 1).astype(np.float32) for end, count in zip(ends, counts, strict=True)]
    cell = max((high - low) / count for (low, high), count in zip(ends, counts, strict=True))
    ghosts = int(closed and not isinstance(bounds, Ball))
    return Lattice(tuple(np.pad(row, ghosts, mode="edge") for row in rows), ghosts, cell)
