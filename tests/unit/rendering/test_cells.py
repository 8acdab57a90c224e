"""The cells that beams are traced through: together they cover the frame, and each holds its own pixels."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from zeroset.kernel import F32, U32, KernelBuilder, interp, store
from zeroset.rendering.buffers import IN_BLOCKS, IN_PARTS, IN_PIXELS, IN_QUARTERS, IN_TILES, THIN, THIN_PIXEL
from zeroset.rendering.cells import HALF, WIDTHS, Cells
from zeroset.rendering.layout import Layout, pixel_coordinates

LAYOUT = Layout(37, 21)
QUARTER = np.array([0, 1, 4, 5])
PIXELS = {
    IN_TILES: np.arange(64),
    IN_BLOCKS: np.arange(16),
    IN_QUARTERS: QUARTER,
    IN_PIXELS: np.arange(1),
    IN_PARTS: np.arange(1),
}
"""A cell's pixels, from its first lane on."""


def looked_at(level: int) -> dict[str, Any]:
    """First lane, middle in frame coordinates and width in pixels of all cells of a level, the lists being full."""
    lists = {
        IN_QUARTERS: (THIN["block"].lanes, np.arange(0, LAYOUT.lanes, 16)),
        IN_PIXELS: (THIN["quarter"].lanes, (np.arange(0, LAYOUT.lanes, 16)[:, None] + [0, 2, 8, 10]).ravel()),
        IN_PARTS: (THIN_PIXEL, np.arange(LAYOUT.lanes)),
    }
    counts = {IN_TILES: LAYOUT.tiles, IN_BLOCKS: LAYOUT.lanes // 16, IN_QUARTERS: LAYOUT.lanes // 4}
    count = counts.get(level, LAYOUT.lanes * (16 if level == IN_PARTS else 1))
    with KernelBuilder("cells") as builder:
        cells = Cells(builder)
        u, v = pixel_coordinates(builder, cells.lane)
        across, down = cells.middle()
        pixel, index = builder.uniform("pixel", F32), builder.index()
        middle = across.fma(pixel, u), (-down).fma(pixel, v)
        for name, value in (("u", middle[0]), ("v", middle[1]), ("width", cells.width)):
            store(builder.buffer(name, F32, writable=True), index, value)
        store(builder.buffer("lane", U32, writable=True), index, cells.lane)
    buffers: dict[str, Any] = {b.name: np.zeros(count, b.type.dtype) for b in builder.kernel.buffers}
    buffers |= {name: lanes.astype(np.uint32) for name, lanes in lists.values()}
    interp.run(builder.kernel, count, LAYOUT.uniforms() | {"level": level}, buffers)
    return buffers


def middles() -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """Frame coordinates of all pixels, in the buffers' order."""
    with KernelBuilder("pixels") as builder:
        lane = builder.index()
        for name, value in zip("uv", pixel_coordinates(builder, lane), strict=True):
            store(builder.buffer(name, F32, writable=True), lane, value)
    found = {name: np.zeros(LAYOUT.lanes, np.float32) for name in "uv"}
    interp.run(builder.kernel, LAYOUT.lanes, LAYOUT.uniforms(), found)
    return found["u"], found["v"]


@pytest.mark.parametrize("level", sorted(PIXELS))
def test_cells_hold_their_pixels_and_leave_none_out(level: int) -> None:
    found, (u, v), side = looked_at(level), middles(), LAYOUT.uniforms()["pixel"]
    assert set(found["width"]) == {np.float32(WIDTHS[level])}
    lanes = found["lane"][:, None] + PIXELS[level]
    assert sorted(set(lanes.ravel())) == list(range(LAYOUT.lanes))
    # Of parts it is they that lie in their pixel.
    reach = side * (0.5 * WIDTHS[level] if level < IN_PARTS else 0.5) * (HALF / 0.5)
    assert np.all(np.abs(u[lanes] - found["u"][:, None]) <= reach)
    assert np.all(np.abs(v[lanes] - found["v"][:, None]) <= reach)


def test_a_pixels_parts_are_in_rows_of_four() -> None:
    found, (u, v) = looked_at(IN_PARTS), middles()
    side = LAYOUT.uniforms()["pixel"]
    across = (found["u"] - u[found["lane"]])[:16].reshape(4, 4) / side
    down = (v[found["lane"]] - found["v"])[:16].reshape(4, 4) / side
    assert np.allclose(across, np.array([[-0.375, -0.125, 0.125, 0.375]] * 4), atol=1e-4)
    assert np.allclose(down, across.T, atol=1e-4)
