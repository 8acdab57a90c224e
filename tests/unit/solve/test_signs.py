"""The sign of an excluded interval is that of what has excluded it, to the last bit."""

from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs


@pytest.mark.parametrize("method", ["auto", "affine", "interval"])
def test_rays_from_beside_a_surface_know_on_which_side_they_are(method: str) -> None:
    """f is so small there that its range reaches 0 by rounding where the test for 0 does not."""
    wall, floor = zs.surface("x + y - 0.5"), zs.surface("z")
    rng = np.random.default_rng(7)
    count = 20_000
    origins = rng.uniform(-1, 1, (count, 3))
    origins[:, 1] = 0.5 - origins[:, 0] + 10 ** rng.uniform(-8, -5, count)
    directions = rng.normal(size=(count, 3))
    origins, directions = (v.astype(np.float32).astype(np.float64) for v in (origins, directions))
    t = -origins[:, 2] / directions[:, 2]
    point = origins + t[:, None] * directions
    outside = point[:, 0] + point[:, 1] - 0.5
    clear = (t > 1e-3) & (np.linalg.norm(point, axis=1) < 1.99) & (outside > 1e-3)
    both = zs.cast((wall & floor).with_bounds(2.0), origins, directions, method=method)
    either = zs.cast((wall | floor).with_bounds(2.0), origins, directions, method=method)
    assert clear.sum() > 1000
    # Above the wall there is no floor in the one, and a floor in the other.
    at_floor = np.abs(both.t - t) < 1e-3
    assert not (clear & at_floor & (both.status == zs.HIT)).any()
    assert not (clear & (either.status == zs.MISS)).any()


@pytest.mark.parametrize("formula", ["exp(exp(x))", "exp(exp(x^3))", "10^(10^x)", "exp(exp(exp(x)))"])
@pytest.mark.parametrize("method", ["auto", "affine", "interval", "mitchell"])
def test_what_overflows_has_no_root(formula: str, method: str) -> None:
    rng = np.random.default_rng(3)
    origins = rng.uniform(-30, 30, (300, 3))
    directions = rng.normal(size=(300, 3))
    directions[::3] = (1.0, 0.0, 0.0)
    hits = zs.cast(zs.surface(formula, bounds=50), origins, directions, method=method)
    assert not (hits.status == zs.HIT).any()
