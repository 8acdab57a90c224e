from __future__ import annotations

import numpy as np
import pytest

from zeroset.kernel import F32, U32, KernelBuilder, interp, store
from zeroset.rendering.layout import TILE, Layout, pixel_coordinates, pixel_place, tile_coordinates, tile_of

SIZES = [(1, 1), (7, 5), (8, 8), (9, 8), (513, 31), (64, 48)]


def places(layout: Layout) -> dict[str, np.ndarray]:  # type: ignore[type-arg]
    """Column, row, u and v of every lane, and u and v of the middle of its tile, as the kernels see them."""
    with KernelBuilder("layout") as builder:
        lane = builder.index()
        column, row = pixel_place(builder, lane)
        for name, whole in (("column", column), ("row", row)):
            store(builder.buffer(name, U32, writable=True), lane, whole)
        middles = tile_coordinates(builder, tile_of(lane))
        values = (*pixel_coordinates(builder, lane), *middles)
        for name, value in zip(("u", "v", "tile_u", "tile_v"), values, strict=True):
            store(builder.buffer(name, F32, writable=True), lane, value)
    buffers = {name: np.zeros(layout.lanes, np.uint32) for name in ("column", "row")}
    buffers |= {name: np.zeros(layout.lanes, np.float32) for name in ("u", "v", "tile_u", "tile_v")}
    interp.run(builder.kernel, layout.lanes, layout.uniforms(), buffers)
    return buffers


@pytest.mark.parametrize("size", SIZES)
def test_every_pixel_is_one_lane(size: tuple[int, int]) -> None:
    layout = Layout(*size)
    found = places(layout)
    inside = (found["column"] < layout.width) & (found["row"] < layout.height)
    seen = found["row"][inside].astype(int) * layout.width + found["column"][inside]
    assert np.array_equal(np.sort(seen), np.arange(layout.width * layout.height))
    assert layout.lanes < (layout.width + TILE) * (layout.height + TILE)


@pytest.mark.parametrize("size", SIZES)
def test_rows_come_back_from_the_buffers_order(size: tuple[int, int]) -> None:
    layout = Layout(*size)
    found = places(layout)
    rows, columns = layout.unscramble(found["row"]), layout.unscramble(found["column"])
    assert rows.shape == (layout.height, layout.width)
    assert np.array_equal(rows, np.arange(layout.height)[:, None].repeat(layout.width, 1))
    assert np.array_equal(columns, np.arange(layout.width)[None].repeat(layout.height, 0))


@pytest.mark.parametrize("size", SIZES)
def test_frame_coordinates_run_from_edge_to_edge(size: tuple[int, int]) -> None:
    width, height = size
    layout = Layout(width, height)
    found = places(layout)
    u, v = layout.unscramble(found["u"]), layout.unscramble(found["v"])
    longer = max(width, height)
    assert np.allclose(u[0], (2 * (np.arange(width) + 0.5) - width) / longer, atol=1e-6)
    assert np.allclose(v[:, 0], -(2 * (np.arange(height) + 0.5) - height) / longer, atol=1e-6)


@pytest.mark.parametrize("size", SIZES)
def test_a_tile_holds_its_pixels(size: tuple[int, int]) -> None:
    layout = Layout(*size)
    found = places(layout)
    half = layout.uniforms()["pixel"] * 0.5 * TILE
    assert np.all(np.abs(found["u"] - found["tile_u"]) <= half)
    assert np.all(np.abs(found["v"] - found["tile_v"]) <= half)
