"""Rays to try a surface with: from everywhere, at every length, and where things go wrong.

Through the entry's own camera and two others, from inside, far away, parallel, along axes and diagonals and planes of
symmetry (where singular points lie), and grazing the surface. Seeded by the surface's name: the same in every run.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from zeroset import Ball, Surface
from zeroset.scene.camera import fit_camera

from .judge import Judge, Kind

Array = npt.NDArray[np.float64]
Ray = tuple[Array, Array]


def seeded(surface: Surface) -> np.random.Generator:
    """A generator of its own for each surface."""
    word = (surface.name or surface.formula).encode()
    return np.random.default_rng(int.from_bytes(hashlib.sha256(word).digest()[:8], "big"))


def rays(judge: Judge, count: int) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    """Origins and directions of about so many rays."""
    surface = judge.surface
    rng = seeded(surface)
    some = max(1, count // 16)
    bounds = surface.fitted
    center = np.asarray(bounds.center)
    reach = bounds.reach if isinstance(bounds, Ball) else 0.5 * min(np.subtract(bounds.max, bounds.min))
    made = [
        *_from_cameras(surface, rng, some),
        *_from_inside(rng, center, reach, 2 * some),
        *_far(rng, center, reach, some),
        *_parallel(rng, center, reach, some),
        *_symmetric(rng, center, reach, 4 * some),
    ]
    made += list(_grazing(judge, rng, made, 2 * some))
    origins = np.array([o for o, _ in made], np.float32)
    directions = np.array([d for _, d in made])
    # Directions need not be unit vectors.
    scale = np.where(rng.random(len(made)) < 0.3, 10.0 ** rng.uniform(-2, 2, len(made)), 1.0)
    return origins, (directions * scale[:, None]).astype(np.float32)


def _unit(v: Array) -> Array:
    return np.asarray(v / np.linalg.norm(v))


def _within(rng: np.random.Generator, center: Array, reach: float, share: float = 0.8) -> Array:
    return np.asarray(center + share * reach * rng.uniform(-0.57, 0.57, 3))


def _from_cameras(surface: Surface, rng: np.random.Generator, some: int) -> Iterator[Ray]:
    bounds = surface.fitted
    own = surface.camera or fit_camera(bounds)
    for camera, share in ((own, 4 * some), (own.orbit(100, 20), some), (own.orbit(215, -50), some)):
        eye = np.asarray(camera.eye)
        for _ in range(share):
            yield eye, _unit(_within(rng, np.asarray(bounds.center), bounds.reach) - eye)


def _from_inside(rng: np.random.Generator, center: Array, reach: float, count: int) -> Iterator[Ray]:
    for _ in range(count):
        yield _within(rng, center, reach), _unit(rng.normal(size=3))


def _far(rng: np.random.Generator, center: Array, reach: float, count: int) -> Iterator[Ray]:
    for k in range(count):
        eye = center + (30.0 if k % 2 else 1000.0) * reach * _unit(rng.normal(size=3))
        yield eye, _unit(_within(rng, center, reach) - eye)


def _parallel(rng: np.random.Generator, center: Array, reach: float, count: int) -> Iterator[Ray]:
    way = _unit(np.array([0.3, -0.5, 0.8]))
    for _ in range(count):
        yield _within(rng, center, reach) - 3.0 * reach * way, way


def _symmetric(rng: np.random.Generator, center: Array, reach: float, count: int) -> Iterator[Ray]:
    """Along axes, face diagonals and space diagonals, through the origin, or within a plane of coordinates."""
    axes = ((1, 0, 0), (0, 1, 0), (0, 0, -1), (1, 1, 0), (0, 1, -1), (1, 1, 1), (1, -1, 1))
    ways = [np.array(way, float) for way in axes]
    for k in range(count):
        way = ways[k % len(ways)]
        through = np.zeros(3) if k < len(ways) else np.round(_within(rng, center, reach) * 4) / 4
        if k % 3 == 2 and k >= len(ways):
            way = rng.normal(size=3)
            way[k % 2], through[k % 2] = 0.0, 0.0
        size = float(np.max(np.abs(way)))
        yield through - 4.0 * np.ceil(reach) * way / size, way / size


def _grazing(judge: Judge, rng: np.random.Generator, tried: list[Ray], count: int) -> Iterator[Ray]:
    """Nearly tangent at points that other rays have found, a little to either side."""
    for origin, direction in tried:
        if count <= 0:
            return
        root = judge.first_root(origin.tolist(), direction.tolist()).root
        if root is None or root.kind is not Kind.CROSS:
            continue
        point = origin + root.a * direction
        normal = _gradient(judge, point)
        if normal is None:
            continue
        count -= 1
        along = _unit(np.cross(normal, rng.normal(size=3)))
        reach = judge.surface.fitted.reach
        aside = rng.choice([0.0, 1e-5, -1e-5, 1e-3, -1e-3]) * reach * normal
        yield point + aside - reach * along, along


def _gradient(judge: Judge, point: Array) -> Array | None:
    """Unit normal, where there is one."""
    found = np.array(judge.gradient(point.tolist()))
    size = np.linalg.norm(found)
    return np.asarray(found / size) if np.isfinite(size) and size > 0 else None
