"""The sampling methods fail where SN10 figure 6 says they do, and succeed where it says they do.

Steiner, cross cap, miter and kiss have places where f touches 0 or crosses it twice within a step: the sign test misses
them, shifting the surface by 0.01 fattens them until it does not, the Taylor test finds them as they are, and so
does Mitchell's method. The judge confirms that each ray meets such a place first, and nothing beside it.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

import zeroset as zs
from zeroset.methods import AdaptiveMarchingPoints, MarchingPoints, Method, Mitchell

from .judge import Judge

RAYS = 120
NEAR = 0.05
"""A multiple root is found where something is found this close to it, in world units."""

SHIFT = {"steiner": 0.01, "cross-cap": -0.01, "miter": 0.01, "kiss": 0.01}
"""By the sign that f has around the thin part: it must reach the shifted value somewhere."""


def thin_points(name: str, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Points on the thin part, exact in float32, and the direction that it runs in."""
    along = {"steiner": (1.03, 1.2), "cross-cap": (-0.8, -0.3), "miter": (1.01, 1.04), "kiss": (0.01, 0.035)}
    places = np.round(rng.uniform(*along[name], RAYS) * 2**12) / 2**12
    axis = np.zeros(3)
    axis[0 if name == "steiner" else 2] = 1.0
    return places[:, None] * axis, axis


@lru_cache
def multiple_roots(name: str) -> tuple[zs.Surface, np.ndarray, np.ndarray, np.ndarray]:
    """Surface, origins and unit directions of rays whose first root is multiple or nearly so, and its t."""
    surface, rng = zs.gallery[name], np.random.default_rng(6)
    points, axis = thin_points(name, rng)
    # Oblique to the axis, or the equal steps through symmetric bounds would have a sample exactly on it.
    slant = rng.uniform(0.1, 0.3, (RAYS, 1)) * axis
    ways = np.round((np.cross(rng.normal(size=(RAYS, 3)), axis) + slant) * 2**10) / 2**10
    reach = 0.25 if name == "cross-cap" else 4.0
    origins = points - reach * ways
    assert np.array_equal(origins, origins.astype(np.float32))
    judge, chosen, found = Judge(surface), [], []
    for i, (origin, way) in enumerate(zip(origins.tolist(), ways.tolist(), strict=True)):
        root = judge.first_root(origin, way).root
        if root is not None and abs(root.a - reach) * np.linalg.norm(way) < NEAR:
            chosen.append(i)
            found.append(root.a)
    assert len(chosen) >= RAYS // 2
    return surface, origins[chosen], ways[chosen], np.array(found)


def share_found(name: str, method: Method) -> float:
    """How many of the multiple roots a method finds."""
    surface, origins, ways, t = multiple_roots(name)
    hits = zs.cast(surface, origins, ways, method=method, device="cpu")
    away = np.abs(hits.t - t) * np.linalg.norm(ways, axis=1)
    # Shifted surfaces are fatter: they count as found where their own surface is met on the way there.
    near = NEAR if method.offset == 0.0 else 0.5
    return float(np.mean((hits.status != zs.MISS) & (away < near)))


@pytest.mark.parametrize("name", list(SHIFT))
def test_the_sign_test_misses_multiple_roots(name: str) -> None:
    assert share_found(name, AdaptiveMarchingPoints(test="sign")) < 0.5
    assert share_found(name, MarchingPoints(test="sign")) < 0.5


@pytest.mark.parametrize("name", list(SHIFT))
def test_the_sign_test_finds_them_on_the_shifted_surface(name: str) -> None:
    assert share_found(name, AdaptiveMarchingPoints(test="sign", offset=SHIFT[name])) > 0.95


@pytest.mark.parametrize("name", list(SHIFT))
def test_the_taylor_test_finds_them(name: str) -> None:
    assert share_found(name, AdaptiveMarchingPoints(test="taylor")) > 0.95


@pytest.mark.parametrize("name", list(SHIFT))
def test_mitchells_method_finds_them(name: str) -> None:
    assert share_found(name, Mitchell()) == 1.0
