from __future__ import annotations

from functools import partial

import numpy as np
import pytest

from zeroset.kernel import F32, U32, KernelBuilder, if_, interp, store
from zeroset.rendering.layout import TILE, Beside, Layout, lane_of, pixel_coordinates, pixel_place

SIZES = [(1, 1), (7, 5), (8, 8), (9, 8), (513, 31), (64, 48)]


def places(layout: Layout) -> dict[str, np.ndarray]:  # type: ignore[type-arg]
    """Column, row, u and v of every lane, as the kernels see them."""
    with KernelBuilder("layout") as builder:
        lane = builder.index()
        column, row = pixel_place(builder, lane)
        for name, whole in (("column", column), ("row", row)):
            store(builder.buffer(name, U32, writable=True), lane, whole)
        for name, value in zip("uv", pixel_coordinates(builder, lane), strict=True):
            store(builder.buffer(name, F32, writable=True), lane, value)
    buffers = {name: np.zeros(layout.lanes, np.uint32) for name in ("column", "row")}
    buffers |= {name: np.zeros(layout.lanes, np.float32) for name in "uv"}
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
def test_a_pixels_lane_is_the_one_with_its_place(size: tuple[int, int]) -> None:
    layout = Layout(*size)
    with KernelBuilder("lanes") as builder:
        lane = builder.index()
        store(builder.buffer("lane", U32, writable=True), lane, lane_of(builder, *pixel_place(builder, lane)))
    lanes = np.zeros(layout.lanes, np.uint32)
    interp.run(builder.kernel, layout.lanes, layout.uniforms(), {"lane": lanes})
    assert np.array_equal(lanes, np.arange(layout.lanes))


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


def beside(layout: Layout) -> dict[tuple[bool, bool], tuple[np.ndarray, np.ndarray]]:  # type: ignore[type-arg]
    """For each side of every lane's pixel whether there is another one, and the number of that one."""
    sides = [(rows, onward) for rows in (False, True) for onward in (False, True)]
    with KernelBuilder("beside") as builder:
        lane = builder.index()
        column, row = pixel_place(builder, lane)
        number = builder.buffer("number", U32)
        for i, (rows, onward) in enumerate(sides):
            there = Beside.of(builder, lane, row if rows else column, rows, onward)
            inside = (column < builder.uniform("width", U32)) & (row < builder.uniform("height", U32))
            store(builder.buffer(f"exists{i}", U32, writable=True), lane, (there.exists & inside).select(1, 0))
            (found,) = if_(inside, partial(there.load, [number]), lambda: (0,))
            store(builder.buffer(f"found{i}", U32, writable=True), lane, found)
    given = places(layout)
    buffers = {"number": (given["row"] << 16) + given["column"]}
    buffers |= {f"{name}{i}": np.zeros(layout.lanes, np.uint32) for name in ("exists", "found") for i in range(4)}
    interp.run(builder.kernel, layout.lanes, layout.uniforms(), buffers)
    return {side: (buffers[f"exists{i}"], buffers[f"found{i}"]) for i, side in enumerate(sides)}


@pytest.mark.parametrize("size", SIZES)
def test_neighbours_are_beside_each_other(size: tuple[int, int]) -> None:
    layout = Layout(*size)
    place = places(layout)
    column, row = place["column"].astype(int), place["row"].astype(int)
    inside = (column < layout.width) & (row < layout.height)
    for (rows, onward), (exists, found) in beside(layout).items():
        step = 1 if onward else -1
        c, r = (column, row + step) if rows else (column + step, row)
        wanted = inside & (c >= 0) & (c < layout.width) & (r >= 0) & (r < layout.height)
        assert np.array_equal(exists != 0, wanted)
        assert np.array_equal(found[wanted], (r * 65536 + c)[wanted])
