from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from zeroset.arith import F32 as FORMAT
from zeroset.arith import IntervalSystem
from zeroset.kernel import BOOL, F32, KernelBuilder, interp, load, store
from zeroset.scene.bounds import Ball, Bounds, Box, bounds_kind, bounds_uniforms
from zeroset.scene.clip import clip, outside

BOUNDS = [Ball(1.5, (0.5, -0.25, 0.0)), Box((-1.0, -0.5, 0.0), (0.5, 1.0, 2.0))]


def inside(bounds: Bounds, points: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    if isinstance(bounds, Ball):
        return np.linalg.norm(points - bounds.center, axis=-1) <= bounds.radius
    return np.all((points >= bounds.min) & (points <= bounds.max), axis=-1)


@pytest.mark.parametrize("bounds", BOUNDS)
def test_the_stretch_is_what_of_the_line_is_inside(bounds: Bounds) -> None:
    random = np.random.default_rng(7)
    count = 500
    origins = random.normal(size=(count, 3)).astype(np.float32) * 2
    directions = random.normal(size=(count, 3)).astype(np.float32)
    directions[:30, 0] = 0
    directions[30:40, 1:] = 0
    with KernelBuilder("clip") as builder:
        lane = builder.index()
        origin, direction = ([load(builder.buffer(f"{n}{i}", F32), lane) for i in range(3)] for n in "od")
        for name, value in zip("ab", clip(builder, bounds_kind(bounds), origin, direction), strict=True):
            store(builder.buffer(name, F32, writable=True), lane, value)
    buffers = {f"{n}{i}": values[:, i].copy() for n, values in (("o", origins), ("d", directions)) for i in range(3)}
    buffers |= {name: np.zeros(count, np.float32) for name in "ab"}
    interp.run(builder.kernel, count, bounds_uniforms(bounds), buffers)

    first, last = (buffers[name].astype(float)[:, None] for name in "ab")
    missed = (last <= first)[:, 0]
    assert 50 < missed.sum() < 450
    o, d = origins.astype(float), directions.astype(float)
    for share, expected in ((0.001, True), (0.5, True), (0.999, True), (-0.01, False), (1.01, False)):
        points = o + d * (first + share * (last - first))
        assert np.all(inside(bounds, points[~missed]) == expected), share
    steps = np.linspace(-20, 20, 2001)
    for i in np.flatnonzero(missed):
        assert not inside(bounds, o[i] + d[i] * steps[:, None]).any()


@pytest.mark.parametrize("bounds", BOUNDS)
def test_a_region_is_outside_only_where_all_of_it_is(bounds: Bounds) -> None:
    random = np.random.default_rng(8)
    count = 300
    low = (random.normal(size=(count, 3)) * 2).astype(np.float32)
    high = low + random.uniform(0, 1, size=(count, 3)).astype(np.float32)
    system = IntervalSystem(FORMAT)
    with KernelBuilder("outside") as builder:
        lane = builder.index()
        ends = [[load(builder.buffer(f"{n}{i}", F32), lane) for n in "lh"] for i in range(3)]
        verdict = outside(builder, bounds_kind(bounds), system, [system.bounds(a, b) for a, b in ends])
        assert verdict.type == BOOL
        store(builder.buffer("out", F32, writable=True), lane, verdict.select(1.0, 0.0))
    buffers = {f"{n}{i}": values[:, i].copy() for n, values in (("l", low), ("h", high)) for i in range(3)}
    buffers["out"] = np.zeros(count, np.float32)
    interp.run(builder.kernel, count, bounds_uniforms(bounds), buffers)

    out = buffers["out"] > 0
    if isinstance(bounds, Ball):
        nearest = np.clip(bounds.center, low, high)
        truth = ~inside(bounds, nearest)
    else:
        truth = np.any((low > bounds.max) | (high < bounds.min), axis=1)
    assert not np.any(out & ~truth)
    # Enclosures give some away, and not much.
    assert out.sum() > 0.9 * truth.sum() > 0
