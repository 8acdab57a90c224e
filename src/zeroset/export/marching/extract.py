"""The passes in order: which blocks may hold something, then slab by slab signs, vertices and triangles.

A slab is a run of layers of blocks, together with the layer behind it, whose first points own the edges at the slab's
end. That layer comes first in the next slab and is numbered alike there, so slabs fit together without being compared,
and memory is bounded by the slab.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.export.marching.lattice import LANES, MISSING, SIDE, Integers, Lattice, pack, unpack
from zeroset.export.marching.passes import CASE
from zeroset.export.marching.programs import Programs
from zeroset.export.marching.tetrahedra import CODES, table
from zeroset.kernel import F32, U32

Told = Callable[[float], None]
"""Told the share that is done, from 0 to 1."""
SLAB, WATCHED_SLAB = 1 << 12, 1 << 10
"""Blocks that a slab may have before it ends with its layer; fewer where somebody watches the progress."""
COARSEST = 4
"""Blocks along the longest side of the lattice in the first round of exclusion."""
ONES = np.array([bin(mask).count("1") for mask in range(128)], np.uint32)


@dataclass(frozen=True, slots=True)
class Pieces:
    """Vertices and triangles as the kernels left them.

    Attributes:
        vertices: (N, 6) float32: position, normal.
        kinds: (N,) what each vertex is a root of.
        at: (N,) the lattice point that it lies at, or ``MISSING``.
        corners: (M, 3) vertices of the triangles; ``MISSING`` for one that no slab has.
    """

    vertices: npt.NDArray[np.float32]
    kinds: Integers
    at: Integers
    corners: Integers


def extract(programs: Programs, lattice: Lattice, told: Told | None = None, exclude: bool = True) -> Pieces:
    """Run all passes.

    Args:
        programs: of the surface.
        lattice: where to sample it.
        told: called after each slab.
        exclude: leave out blocks that certainly hold nothing; the pieces are the same without.
    """
    programs.compile()
    uniforms = programs.uniforms(lattice)
    grid = programs.put(lattice.coordinates, F32)
    codes = active_blocks(programs, lattice, grid) if exclude else lattice.code(np.arange(np.prod(lattice.blocks)))
    parts: list[Pieces] = []
    base = 0
    for own, behind in slabs(codes, SLAB if told is None else WATCHED_SLAB):
        part = _Slab(programs, lattice, uniforms, grid, np.concatenate([own, behind])).pieces(len(own), base)
        base += len(part.vertices)
        parts.append(part)
        if told is not None:
            told((int(unpack(own[-1:])[2][0]) + 1) / lattice.blocks[2])
    return _joined(parts)


def _joined(parts: list[Pieces]) -> Pieces:
    if len(parts) == 1:
        return parts[0]
    none = np.zeros(0, np.uint32)
    parts = [Pieces(np.zeros((0, 6), np.float32), none, none, none.reshape(0, 3)), *parts]
    return Pieces(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.kinds for part in parts]),
        np.concatenate([part.at for part in parts]),
        np.concatenate([part.corners for part in parts]),
    )


def active_blocks(programs: Programs, lattice: Lattice, grid: Any) -> Integers:
    """Codes of the blocks that may hold something, z slowest; found from coarse to fine."""
    level = max(0, (max(lattice.blocks) - 1).bit_length() - COARSEST.bit_length() + 1)
    codes = _all_blocks(lattice, level)
    while True:
        codes = codes[_kept(programs, lattice, grid, codes, SIDE << level)]
        if not level or not len(codes):
            return codes[np.argsort(lattice.row(codes))]
        level -= 1
        codes = _halves(lattice, codes, level)


def _counts(lattice: Lattice, level: int) -> list[int]:
    """Blocks along each axis where each has 2^level of the finest along its side."""
    return [(n - 1 >> level) + 1 for n in lattice.blocks]


def _all_blocks(lattice: Lattice, level: int) -> Integers:
    x, y, z = np.meshgrid(*(np.arange(n) for n in _counts(lattice, level)), indexing="ij")
    return pack(x.ravel(), y.ravel(), z.ravel())


def _halves(lattice: Lattice, codes: Integers, level: int) -> Integers:
    """The eight halves of each block, those left out that begin beyond the lattice."""
    x, y, z = (2 * axis for axis in unpack(codes))
    parts = [(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)) for c in range(8)]
    wide, deep, high = _counts(lattice, level)
    return np.concatenate([pack(*part)[(part[0] < wide) & (part[1] < deep) & (part[2] < high)] for part in parts])


def _kept(programs: Programs, lattice: Lattice, grid: Any, codes: Integers, size: int) -> npt.NDArray[np.bool_]:
    device = programs.device
    kept = device.allocate(U32, len(codes))
    buffers = {"grid": grid, "blocks": programs.put(codes), "kept": kept, **programs.arrays()}
    programs.run("exclude", len(codes), {**programs.uniforms(lattice), "size": size}, buffers)
    flags: npt.NDArray[np.bool_] = device.read(kept) != 0
    return flags


def slabs(codes: Integers, most: int) -> Iterator[tuple[Integers, Integers]]:
    """Runs of whole layers of blocks, and after each the blocks of the layer behind it."""
    z = unpack(codes)[2]
    layers, starts = np.unique(z, return_index=True)
    begin = 0
    for i in range(len(starts)):
        end = int(starts[i + 1]) if i + 1 < len(starts) else len(codes)
        # The next layer joins the slab while there is room.
        following = int(starts[i + 2]) if i + 2 < len(starts) else len(codes)
        if end < len(codes) and following - begin <= most:
            continue
        behind = codes[end:following] if i + 1 < len(starts) and layers[i + 1] == layers[i] + 1 else codes[:0]
        yield codes[begin:end], behind
        begin = end


class _Slab:
    """The passes over some blocks."""

    def __init__(
        self, programs: Programs, lattice: Lattice, uniforms: dict[str, float], grid: Any, codes: Integers
    ) -> None:
        self._programs = programs
        self._uniforms = dict(uniforms)
        self._lanes = len(codes) * LANES
        slots = np.full(int(np.prod(lattice.blocks)), MISSING, np.uint32)
        slots[lattice.row(codes)] = np.arange(len(codes))
        device = programs.device
        self._buffers: dict[str, Any] = {
            "grid": grid,
            "blocks": programs.put(codes),
            "slots": programs.put(slots),
            "values": device.allocate(programs.type, self._lanes),
            "marks": device.allocate(U32, self._lanes),
            **programs.arrays(),
        }

    def pieces(self, own: int, base: int) -> Pieces:
        """The vertices and triangles of the first ``own`` blocks; vertices are numbered from ``base``."""
        self._run("sample", self._lanes)
        self._run("mark", self._lanes)
        marks = self._programs.device.read(self._buffers["marks"])
        # A cell with corners on both sides is marked, though the crossing edges may all begin at other points.
        cells = np.flatnonzero(marks)
        crossing = ONES[marks[cells] & (1 << CASE) - 1]
        starts = np.zeros(self._lanes, np.uint32)
        starts[cells] = base + np.cumsum(crossing) - crossing
        ours = int(np.searchsorted(cells, own * LANES))
        self._buffers["starts"] = self._programs.put(starts)
        return self._listed(cells[:ours], marks, int(crossing[:ours].sum()), base)

    def _listed(self, cells: npt.NDArray[np.int64], marks: Integers, vertices: int, base: int) -> Pieces:
        """What is in some cells; ``vertices`` of them."""
        counts = table()[256 * CODES :][marks[cells] >> CASE]
        triangles = int(counts.sum())
        put, device = self._programs.put, self._programs.device
        lists = {name: device.allocate(U32, triangles) for name in ("whose", "which")}
        lists |= {"keys": device.allocate(U32, vertices), "table": put(table())}
        numbers = {"cells": put(cells), "firsts": put(np.cumsum(counts) - counts)}
        self._uniforms["base"] = base
        self._run("list", len(cells), **lists, **numbers)
        made = {"vertices": device.allocate(F32, 6 * vertices), "corners": device.allocate(U32, 3 * triangles)}
        made |= {name: device.allocate(U32, vertices) for name in ("kinds", "at")}
        self._run("root", vertices, **lists, **made)
        self._run("join", triangles, **lists, **made)
        read = {name: device.read(buffer) for name, buffer in made.items()}
        shaped = read["vertices"].reshape(-1, 6), read["kinds"], read["at"], read["corners"].reshape(-1, 3)
        return Pieces(*shaped)

    def _run(self, name: str, count: int, **extra: Any) -> None:
        self._programs.run(name, count, self._uniforms, {**self._buffers, **extra})
