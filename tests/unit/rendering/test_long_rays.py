"""Rays that go on for very long, or come from very far: what lies near is told as closely as on short ones."""

from __future__ import annotations

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.runtime import get_device

DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]
METHODS = ["auto", "affine", "interval", "mitchell", "mitchell-exact", "analytic"]


def doubles(device: str) -> bool:
    from zeroset.kernel.types import F64

    return get_device(device).supports(F64)


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("far", [1e2, 1e5, 1e6])
@pytest.mark.parametrize("method", METHODS)
def test_near_roots_in_long_bounds_are_found_to_the_tolerance(method: str, far: float, device: str) -> None:
    bounds = zs.Box((-1, -1, -far), (1, 1, far))
    surface = zs.surface("(z - 0.2) (z - 0.21)", bounds=bounds)
    hits = zs.cast(surface, [0.1, 0.2, -1], [0, 0, 1], method=method, device=device, tolerance=1e-5, max_hits=3)
    assert hits.status.tolist() == [[zs.HIT, zs.HIT, zs.MISS]]
    assert np.abs(hits.t[0, :2] - [1.2, 1.21]).max() <= 4e-5


@pytest.mark.parametrize("device", DEVICES)
def test_roots_far_along_a_ray_are_found_too(device: str) -> None:
    surface = zs.surface("(z - 2) (z - 3000) (z - 7e7)", bounds=1e8)
    hits = zs.cast(surface, [0, 0, 0], [0, 0, 1], device=device, tolerance=1e-3, max_hits=4)
    assert (hits.status[0] != zs.MISS).tolist() == [True, True, True, False]
    true = np.array([2, 3000, 7e7])
    assert np.all(np.abs(hits.t[0, :3] - true) < np.maximum(4e-3, 1e-6 * true))


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("first", ["ball", "beside", "ground"])
def test_no_thing_costs_another_one_its_roots(first: str, device: str) -> None:
    """Of a box that a ray along its axis misses, and of a very large ground, stretches of t are very long."""
    things = {
        "ball": zs.surface("x^2 + y^2 + z^2 = 1", bounds=2.0),
        "beside": zs.surface("x + 5", bounds=zs.Box((-1, 3, -1), (1, 4, 1))),
        "ground": zs.surface("z + 9e6", bounds=1e9),
    }
    scene = [things.pop(first), *things.values()]
    hits = zs.cast(scene, [-5, 0.1, 0.2], [1, 0, 0], device=device, max_hits=4, tolerance=1e-4)
    assert hits.status.tolist() == [[zs.HIT, zs.HIT, zs.MISS, zs.MISS]]
    assert np.abs(hits.t[0, :2] - [5 - np.sqrt(0.95), 5 + np.sqrt(0.95)]).max() < 4e-4


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("bounds", [zs.Ball(1.0), zs.Box((-1, -1, -1), (1, 1, 1))], ids=["ball", "box"])
@pytest.mark.parametrize("away", [1e2, 1e4, 1e5, 1e6])
def test_hits_lie_inside_the_bounds_however_far_away_a_ray_begins(away: float, bounds: zs.Box, device: str) -> None:
    random = np.random.default_rng(3)
    target = np.concatenate([random.uniform(-2, 2, (400, 2)), np.zeros((400, 1))], axis=1)
    direction = random.normal(size=(400, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    direction[np.abs(direction[:, 2]) < 0.3] = [0, 0, 1]
    origin, direction = (v.astype(np.float32) for v in (target - away * direction, direction))
    hits = zs.cast(zs.surface("z", bounds=bounds), origin, direction, device=device)
    o, d = origin.astype(float), direction.astype(float)
    point = o - d * (o[:, 2] / d[:, 2])[:, None]
    size = np.linalg.norm(point, axis=1) if isinstance(bounds, zs.Ball) else np.abs(point).max(axis=1)
    hit = hits.status == zs.HIT
    # What is rounded of t, and the tolerance: no more.
    assert not np.any(hit & (size > 1 + 1e-3 + away * 2.0**-22))
    assert np.all(hits.status[size < 1 - 1e-3] != zs.MISS)
    if doubles(device):
        assert np.all(hit[size < 1 - 1e-3])


def test_a_first_root_outside_the_bounds_is_none() -> None:
    surface = zs.surface("(z - 1.5) (z - 0.5)", bounds=1.0)
    hits = zs.cast(surface, [0, 0, 1e6], [0, 0, -1], device="cpu")
    assert (hits.status.tolist(), hits.t.tolist()) == ([zs.HIT], [999999.5])
