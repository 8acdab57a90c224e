"""Rays and surfaces whose first roots are known in closed form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import zeroset as zs

Array = np.ndarray[Any, Any]
Roots = Callable[[Array, Array], Array]


@dataclass(frozen=True)
class Known:
    """A surface and all its roots along rays: (N, 3) origins and directions to (N, k) values of t, nan for none."""

    surface: zs.Surface
    roots: Roots

    def settled(self, origins: Array, directions: Array) -> Array:
        """Rays whose answer does not hang on a root within rounding of the bounds."""
        inner, outer = (self.first(origins, directions, grown) for grown in (1 - 1e-5, 1 + 1e-5))
        return (inner == outer) | (np.isnan(inner) & np.isnan(outer))

    def first(self, origins: Array, directions: Array, grown: float = 1.0) -> Array:
        """The first root ahead and inside the bounds, which may be scaled; nan where there is none."""
        o, d = origins.astype(np.float32).astype(float), directions.astype(np.float32).astype(float)
        o, d = (
            np.broadcast_to(o, np.broadcast_shapes(o.shape, d.shape)),
            np.broadcast_to(d, np.broadcast_shapes(o.shape, d.shape)),
        )
        t = np.sort(self.roots(o, d), axis=1)
        points = o[:, None] + t[..., None] * d[:, None]
        bounds = self.surface.fitted
        if isinstance(bounds, zs.Ball):
            inside = np.linalg.norm(points - bounds.center, axis=-1) <= bounds.radius * grown
        else:
            inside = np.all(
                (points >= np.multiply(bounds.min, grown)) & (points <= np.multiply(bounds.max, grown)), axis=-1
            )
        t = np.where(inside & (t >= 0), t, np.inf)
        first = t.min(axis=1)
        return np.where(np.isinf(first), np.nan, first)


def _quadratic(a: Array, b: Array, c: Array) -> Array:
    """Roots of a t^2 + 2 b t + c."""
    d = b * b - a * c
    root = np.sqrt(np.where(d >= 0, d, np.nan))
    return np.stack([(-b - root) / a, (-b + root) / a], axis=1)


def _sphere(radius: float, center: tuple[float, ...] = (0.0, 0.0, 0.0)) -> Roots:
    def roots(o: Array, d: Array) -> Array:
        p = o - center
        return _quadratic((d * d).sum(1), (p * d).sum(1), (p * p).sum(1) - radius**2)

    return roots


def _levels(values: Array) -> Roots:
    """The planes z = value."""
    return lambda o, d: (values[None] - o[:, 2:]) / d[:, 2:]


def _remembered(roots: Roots) -> Roots:
    """Finds them once for the same rays: every method gets those, and each test asks three times."""
    found: dict[tuple[bytes, bytes], Array] = {}

    def again(o: Array, d: Array) -> Array:
        key = o.tobytes(), d.tobytes()
        if key not in found:
            found[key] = roots(o, d)
        return found[key]

    return again


def _torus(big: float, small: float) -> Roots:
    def roots(o: Array, d: Array) -> Array:
        found = np.full((len(o), 4), np.nan)
        for i, (p, q) in enumerate(zip(o, d, strict=True)):
            x, y, z = (np.polynomial.Polynomial([a, b]) for a, b in zip(p, q, strict=True))
            f = (x**2 + y**2 + z**2 + big**2 - small**2) ** 2 - 4 * big**2 * (x**2 + y**2)
            real = np.array([r.real for r in f.roots() if abs(r.imag) < 1e-9])
            found[i, : len(real)] = real
        return found

    return roots


_wave = np.concatenate([(np.arcsin(0.3) + 2 * np.pi * k * np.ones(1)) / 4 for k in range(-4, 5)])
_wave = np.concatenate([_wave, np.pi / 4 - _wave])

KNOWN = {
    "plane": Known(zs.surface("z = 0.25", bounds=2.0), _levels(np.array([0.25]))),
    "sphere": Known(zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 1.1}, bounds=2.0), _sphere(1.1)),
    "torus": Known(
        zs.surface("(x^2 + y^2 + z^2 + 0.75)^2 = 4(x^2 + y^2)", bounds=zs.Box((-2, -2, -1), (2, 2, 1))),
        _remembered(_torus(1.0, 0.5)),
    ),
    "wave": Known(zs.surface("sin(4z) = 0.3", bounds=2.0), _levels(_wave)),
    "slab": Known(zs.surface("|z| = 0.5", bounds=zs.Box((-1, -1, -1), (1, 1, 1))), _levels(np.array([-0.5, 0.5]))),
    "exponential": Known(zs.surface("exp(z) = 2 + x - x", bounds=2.0), _levels(np.array([np.log(2.0)]))),
}


def rays(count: int, distance: float = 5.0, spread: float = 1.0, seed: int = 5) -> tuple[Array, Array]:
    """Rays from a ball's surface to about its middle, with directions of many lengths, in float32."""
    random = np.random.default_rng(seed)
    origins = random.normal(size=(count, 3))
    origins *= distance / np.linalg.norm(origins, axis=1, keepdims=True)
    targets = random.uniform(-spread, spread, size=(count, 3))
    directions = (targets - origins) * random.uniform(0.05, 3.0, size=(count, 1))
    return origins.astype(np.float32), directions.astype(np.float32)


@pytest.fixture(scope="session")
def known() -> dict[str, Known]:
    return KNOWN


@pytest.fixture(scope="session")
def some_rays() -> Callable[..., tuple[Array, Array]]:
    return rays
