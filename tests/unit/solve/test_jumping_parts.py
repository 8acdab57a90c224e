"""Solids of which one part jumps right where another one has its skin: what does not matter there does no harm."""

from __future__ import annotations

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs

JUMPING = ["z - sign(x)/4", "z - floor(4x)/4", "z - mod(x, 1)/2", "z - 0.1/x", "z - if(x < 0, 1, y)"]
DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]


def rays() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rays through points of the plane x = 0 where |y| > 0.8, from x > 0; and how far these are."""
    random = np.random.default_rng(7)
    points = np.stack([np.zeros(200), random.uniform(0.85, 1.1, 200), random.uniform(-0.6, 0.6, 200)], axis=1)
    points[::2, 1] *= -1
    direction = np.stack([-np.ones(200), *random.uniform(-0.02, 0.02, (2, 200))], axis=1)
    return points - 3 * direction, direction, np.full(200, 3.0)


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("formula", JUMPING)
def test_a_part_that_cannot_matter_hides_nothing(formula: str, device: str) -> None:
    half, slab, jumping = (zs.surface(f) for f in ("x", "|y| - 0.8", formula))
    origin, direction, t = rays()
    for solid in (half | (slab & jumping), half & (~slab | jumping)):
        hits = zs.cast(solid.with_bounds(1.3), origin, direction, device=device)
        assert (hits.status == zs.HIT).all()
        assert np.abs(hits.t - t).max() < 1e-3


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("formula", JUMPING)
def test_pictures_have_no_holes(formula: str, device: str) -> None:
    half, slab, jumping = (zs.surface(f) for f in ("x", "|y| - 0.8", formula))
    camera = zs.Camera(eye=(6, 0, 0), fov=30)
    image, whole = (
        zs.render(shown.with_bounds(1.3), 160, camera, device=device) for shown in (half | (slab & jumping), half)
    )
    rays = camera.rays(160, 160)
    across = (np.arange(160) + 0.5) / 80 - 1
    aside = np.abs(6 * across * rays.right[1] / rays.forward[0]) > 0.85
    seen = (whole.aov("status") == zs.HIT) & aside
    assert seen.sum() > 500
    # Nearer to the eye rays pass through the slab, where the jumping part has walls of its own.
    there = np.abs(image.aov("t")[seen] - 6) < 0.01
    assert there.sum() > 0.5 * seen.sum()
    assert (image.aov("status")[seen][there] == zs.HIT).all()
    assert not (image.aov("status")[seen] == zs.MISS).any()


@pytest.mark.parametrize("formula", JUMPING[:3])
def test_what_jumps_but_has_a_value_everywhere_is_inside_where_it_is_below_0(formula: str) -> None:
    """Below z = -1/4 the jumping part is inside all around x = 0: its complement is outside, and half is alone."""
    half, jumping = zs.surface("x"), zs.surface(formula)
    origin, direction, t = rays()
    low = origin[:, 2] + 3 * direction[:, 2] < -0.3
    hits = zs.cast((half | ~jumping).with_bounds(1.3), origin[low], direction[low], device="cpu")
    before = origin[low][:, 2] + 2.5 * direction[low][:, 2] < -0.3
    assert before.sum() > 20
    assert (hits.status[before] == zs.HIT).all()
    assert np.abs(hits.t[before] - t[low][before]).max() < 1e-3
