"""Infinitely thin parts are drawn: a ray through them is never a MISS, a ray beside them is one.

Whiskers (double lines that no sheet passes through), tips, isolated nodes and surfaces that are double everywhere: f
keeps its sign there, so only a method that proves what it leaves out can see them. All rays go exactly through the
thin part in float32, as the judge confirms.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import pytest

import zeroset as zs

from .held import held, proving_methods
from .judge import Judge, Kind, Verdict

Point = tuple[float, float, float]


@dataclass(frozen=True)
class Thin:
    """A thin part and rays to try it with.

    Attributes:
        formula: the surface, or a gallery name.
        points: on the thin part, exact in float32.
        ways: directions through them that meet nothing else before.
        beside: a shift that leaves the thin part, and the surface, certainly alone.
        reach: how far before the point the rays start.
    """

    formula: str
    points: tuple[Point, ...]
    ways: tuple[Point, ...]
    beside: Point
    reach: float = 4.0


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)

THIN = {
    "steiner, x axis": Thin("steiner", ((1.125, 0, 0), (-1.0625, 0, 0)), (Y, Z, (0, 1, -0.25)), (0, 0.125, 0.125)),
    "steiner, z axis": Thin("steiner", ((0, 0, 1.125), (0, 0, -1.0625)), (X, Y, (1, -1, 0)), (0.125, 0.125, 0)),
    "cross cap's line": Thin("cross-cap", ((0, 0, -0.5), (0, 0, -0.25)), (X, Y, (1, 0.5, 0)), (0, 0, 0), 0.25),
    "miter's line": Thin("miter", ((0, 0, 1.03125), (0, 0, -1.015625)), (X, Y, (1, 0.5, 0)), (0, 0.125, 0.25)),
    "kiss, between its lips": Thin("kiss", ((0, 0, 0),), (X, Y, (1, 0.5, 0)), (0.03125, 0.0625, 0)),
    "teardrop's tip": Thin("teardrop", ((0, 0, 0),), (Y, Z, (0, 1, -0.5)), (0, 0.0625, 0.0625)),
    "piriform's tip": Thin("piriform", ((0, 0, 0),), (Y, Z, (0, 1, 0.5)), (-0.03125, 0, 0)),
    "ding-dong's node": Thin("ding-dong", ((0, 0, 0),), (X, Y, (1, 0.5, 0)), (0, 0, 0)),
    "double sphere": Thin("(x^2 + y^2 + z^2 - 1)^2", ((0, 0, 0.5), (0.25, 0, 0)), (X, Y, (1, 1, 1)), (2, 2, 0)),
    "double plane": Thin("(x - y)^2", ((0, 0, 0.5), (0.3125, 0.3125, 0)), (X, Y, (1, 0.5, 3)), (0, 0, 0)),
    "double plane at 1/3": Thin("(x - 1/3)^2", ((0, 0, 0.5),), (X, (1, 0.5, 1)), (0, 0, 0)),
    "double saddle of sines": Thin("(sin(x) - y)^2", ((0, 0, 0.5),), (X, (1, -0.5, 1)), (0, 0, 0)),
    "isolated point": Thin("x^2 + y^2 + z^2 = 0", ((0, 0, 0),), (X, Z, (1, -0.5, 2)), (0.0625, 0.0625, 0.0625)),
    "isolated line": Thin("x^2 + y^2 = 0", ((0, 0, 0), (0, 0, 0.75)), (X, Y, (1, -0.5, 2)), (0.0625, 0.0625, 0)),
    "plane by its distance": Thin("|x|", ((0, 0, 0), (0, 0.5, 0)), (X, (1, -0.5, 2)), (0, 0, 0)),
    "line where planes meet": Thin("max(|x|, |y|)", ((0, 0, 0), (0, 0, 0.5)), (X, (1, -0.5, 2)), (0.0625, 0.0625, 0)),
    "root's edge": Thin("sqrt(x^2 + y^2)", ((0, 0, 0), (0, 0, 0.5)), (X, (1, -0.5, 2)), (0.0625, 0.0625, 0)),
}


@lru_cache
def surface_of(thin: Thin) -> zs.Surface:
    return zs.gallery[thin.formula] if thin.formula in zs.gallery else zs.surface(thin.formula, bounds=1.5)


def rays_at(thin: Thin, shift: Point) -> tuple[np.ndarray, np.ndarray]:
    """Origins and directions, exact in float32."""
    pairs = [
        (np.add(point, shift) - thin.reach * sign * np.array(way), sign * np.array(way))
        for point in thin.points
        for way in thin.ways
        for sign in (1.0, -1.0)
    ]
    origins, directions = (np.array(column, np.float64) for column in zip(*pairs, strict=True))
    assert np.array_equal(origins, origins.astype(np.float32))
    return origins.astype(np.float32), directions.astype(np.float32)


@lru_cache
def judged(thin: Thin, shift: Point) -> tuple[np.ndarray, np.ndarray, list[Verdict]]:
    """Origins, directions and verdicts, once for all methods."""
    origins, directions = rays_at(thin, shift)
    judge = Judge(surface_of(thin))
    pairs = zip(origins.tolist(), directions.tolist(), strict=True)
    return origins, directions, [judge.first_root(o, d) for o, d in pairs]


def cases() -> Iterator[tuple[str, str]]:
    for name, thin in THIN.items():
        for method in proving_methods(surface_of(thin)):
            yield name, method


@pytest.mark.parametrize(("name", "method"), list(cases()))
def test_a_ray_through_a_thin_part_is_no_miss(name: str, method: str) -> None:
    surface = surface_of(THIN[name])
    origins, directions, verdicts = judged(THIN[name], (0.0, 0.0, 0.0))
    found = [verdict.root.kind if verdict.root else None for verdict in verdicts]
    exact = surface.field.degree is not None
    assert not exact or Kind.CROSS not in found
    assert not exact or None not in found
    hits = zs.cast(surface, origins, directions, method=proving_methods(surface)[method], device="cpu")
    assert hits.certified
    assert (hits.status != zs.MISS).all()
    assert not held(verdicts, hits, origins, directions).broken


@pytest.mark.parametrize(("name", "method"), [case for case in cases() if any(THIN[case[0]].beside)])
def test_a_ray_beside_it_is_a_miss(name: str, method: str) -> None:
    surface = surface_of(THIN[name])
    origins, directions, verdicts = judged(THIN[name], THIN[name].beside)
    clear = [not verdict.events for verdict in verdicts]
    assert any(clear)
    hits = zs.cast(surface, origins[clear], directions[clear], method=proving_methods(surface)[method], device="cpu")
    assert (hits.status == zs.MISS).all()


def test_rays_that_only_f64_shows_to_miss_leave_no_gaps() -> None:
    """Close to Steiner's pinch point f32 leaves rays open that f64 sees pass the double line by."""
    steiner = zs.gallery["knoll-steiner"]
    close = zs.Camera(eye=(-0.00711, 0.005529, -0.495654), target=(0, 0, -0.5), fov=30)
    image = zs.render(steiner, 340, camera=close, method="affine", tolerance=steiner.fitted.extent * 2.0**-18)
    line = image.aov("status")[170:, 160:180] != zs.MISS
    assert line.any(axis=1).all()
    # It is one stroke in every row, not two with a gap between them.
    assert np.all(np.abs(np.diff(line.astype(int), axis=1)).sum(axis=1) <= 2)
