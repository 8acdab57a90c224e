"""Solids with parts that have no value in places: there these are outside, and what else there is keeps its skin."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import zeroset as zs

Array = np.ndarray[Any, Any]
Inside = Callable[[Array, Array, Array], Array]
BALL, CUBE = "x^2 + y^2 + z^2 - 1", "max(|x|, |y|, |z|) - 0.9"
REACH = 1.3


def ball(x: Array, y: Array, z: Array) -> Array:
    return x**2 + y**2 + z**2 <= 1


def cube(x: Array, y: Array, z: Array) -> Array:
    return np.maximum(np.maximum(np.abs(x), np.abs(y)), np.abs(z)) <= 0.9


SOLIDS: dict[str, tuple[zs.Solid, Inside]] = {}


def solid(name: str, made: zs.Solid, inside: Inside) -> None:
    SOLIDS[name] = made.with_bounds(REACH), inside


def part(text: str) -> zs.Surface:
    return zs.surface(text, bounds=REACH)


# A comparison with what is no number is false, as being inside is.
solid(
    "ball or root", part(BALL) | part("sqrt(x - 1/2) - 0.4"), lambda x, y, z: ball(x, y, z) | (np.sqrt(x - 0.5) <= 0.4)
)
solid("ball or log", part(BALL) | part("log(x) + 0.4"), lambda x, y, z: ball(x, y, z) | (np.log(x) <= -0.4))
solid(
    "cube and dome",
    part(CUBE) & part("z - sqrt(1 - x^2 - y^2)"),
    lambda x, y, z: cube(x, y, z) & (z <= np.sqrt(1 - x**2 - y**2)),
)
solid(
    "cube less dome",
    part(CUBE) - part("z - sqrt(1 - x^2 - y^2)"),
    lambda x, y, z: cube(x, y, z) & ~(z <= np.sqrt(1 - x**2 - y**2)),
)
solid("cube and power", part(CUBE) & part("z - x^1.5"), lambda x, y, z: cube(x, y, z) & (z <= x**1.5))
solid("cube and arc", part(CUBE) & part("asin(3/2 x) - z"), lambda x, y, z: cube(x, y, z) & (np.arcsin(1.5 * x) <= z))
solid("not a root", part(BALL) & ~part("sqrt(x) - 1/2"), lambda x, y, z: ball(x, y, z) & ~(np.sqrt(x) <= 0.5))


@pytest.mark.parametrize("method", ["auto", "affine", "interval"])
@pytest.mark.parametrize("name", SOLIDS)
def test_the_first_skin_along_rays(name: str, method: str) -> None:
    made, inside = SOLIDS[name]
    random = np.random.default_rng(3)
    aim = random.uniform(-0.8, 0.8, (400, 3))
    way = random.normal(size=(400, 3))
    way = (way / np.linalg.norm(way, axis=1, keepdims=True)).astype(np.float32).astype(float)
    origin = (aim - 4 * way).astype(np.float32).astype(float)
    hits = zs.cast(made, origin, way, method=method)
    # Where the ray enters the bounds, and every 2000th of the way through them.
    along = np.einsum("ij,ij->i", origin, way)
    half = np.sqrt(np.maximum(along**2 - np.einsum("ij,ij->i", origin, origin) + REACH**2, 0))
    t = (-along - half)[:, None] + 2 * half[:, None] * (np.arange(2000) + 0.5) / 2000
    with np.errstate(invalid="ignore", divide="ignore"):
        within = inside(*(origin[:, None, i] + t * way[:, None, i] for i in range(3)))
    changes = within[:, 1:] != within[:, :-1]
    first = np.where(changes.any(axis=1), t[np.arange(400), changes.argmax(axis=1)], np.inf)
    step = (t[:, 1] - t[:, 0]).max()
    seen = np.where(hits.status == zs.MISS, np.inf, hits.t)
    # What is thinner than the samples lie apart may come before the first change that these see, none after it.
    assert np.all(seen <= first + 2 * step)
    early = (seen < first - 2 * step) & np.isfinite(seen)
    assert early.mean() < 0.02
    assert np.isfinite(first).mean() > 0.3


@pytest.mark.parametrize("name", SOLIDS)
def test_pictures_have_no_holes_at_tiles(name: str) -> None:
    made, _ = SOLIDS[name]
    camera = zs.Camera(eye=(3.0, -4.0, 2.5), fov=35)
    with_beams = zs.render(made, 96, camera, device="cpu").aov("status")
    eye, across, upwards, forward, right, up = map(np.array, camera.rays(96, 96))
    middles = (np.arange(96) + 0.5) * 2 / 96 - 1
    u, v = np.meshgrid(middles, -middles)
    origins = eye + u[..., None] * across + v[..., None] * upwards
    ways = forward + u[..., None] * right + v[..., None] * up
    cast = zs.cast(made, origins.reshape(-1, 3), ways.reshape(-1, 3)).status.reshape(96, 96)
    assert np.count_nonzero((with_beams == zs.MISS) & (cast == zs.HIT)) == 0
