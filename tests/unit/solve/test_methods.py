"""Every method on surfaces whose roots are known."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import zeroset as zs
from zeroset.methods import METHODS, Method

Array = np.ndarray[Any, Any]
GENERAL = (
    zs.methods.Auto(),
    zs.methods.Interval(),
    zs.methods.Interval(axis="k"),
    zs.methods.Affine(),
    zs.methods.Affine(axis="k"),
    zs.methods.Mitchell(),
)
CLOSED = (zs.methods.Analytic(), zs.methods.MitchellExact())
SAMPLING = (
    zs.methods.MarchingPoints(),
    zs.methods.MarchingPoints(test="taylor"),
    zs.methods.AdaptiveMarchingPoints(),
    zs.methods.AdaptiveMarchingPoints(test="taylor", silhouettes=False),
)
CERTIFIED = [
    *(("torus", method) for method in (*GENERAL, *CLOSED)),
    *(("plane", method) for method in (GENERAL[2], *CLOSED)),
    *(("sphere", method) for method in (GENERAL[0], *CLOSED)),
    *(("wave", method) for method in GENERAL),
    *(("slab", method) for method in (GENERAL[0], GENERAL[4])),
    *(("exponential", method) for method in (GENERAL[0], GENERAL[5])),
]


def label(value: Any) -> str:
    return value.structure() if isinstance(value, Method) else str(value)


def tolerance_of(surface: zs.Surface, directions: Array) -> Array:
    """The default tolerance in units of t, and never below t's own resolution in float32."""
    lengths = np.linalg.norm(directions.astype(float), axis=1)
    return np.maximum(surface.fitted.extent * 2.0**-14, 10.0 * 2.0**-20) / lengths


@pytest.mark.parametrize(("name", "method"), CERTIFIED, ids=label)
def test_certified_methods_miss_nothing_and_invent_nothing(
    name: str, method: Method, known: Any, some_rays: Callable[..., tuple[Array, Array]]
) -> None:
    case = known[name]
    origins, directions = some_rays(300)
    hits = zs.cast(case.surface, origins, directions, method=method)
    truth = case.first(origins, directions)
    assert hits.certified
    settled = case.settled(origins, directions)
    assert settled.sum() > 290
    hit, miss = (settled & (hits.status == status) for status in (zs.HIT, zs.MISS))
    assert not np.any(hit & np.isnan(truth))
    assert not np.any(miss & ~np.isnan(truth))
    error = np.abs(hits.t - truth)
    assert np.all(error[hit] <= 4 * tolerance_of(case.surface, directions)[hit])
    assert np.count_nonzero(hits.status == zs.UNRESOLVED) <= 9
    assert np.count_nonzero(hit) > 60
    found = hits.status != zs.MISS
    assert np.array_equal(np.isnan(hits.t), ~found)
    assert np.all(hits.steps[found] >= 1)
    assert np.allclose(np.linalg.norm(hits.normal[found], axis=1), 1, atol=1e-5)
    assert np.all(hits.normal[~found] == 0)


@pytest.mark.parametrize("name", ["sphere", "wave"])
@pytest.mark.parametrize("method", SAMPLING, ids=label)
def test_sampling_methods_find_what_is_wider_than_their_steps(
    name: str, method: Method, known: Any, some_rays: Callable[..., tuple[Array, Array]]
) -> None:
    case = known[name]
    origins, directions = some_rays(300, spread=0.7)
    hits = zs.cast(case.surface, origins, directions, method=method)
    truth = case.first(origins, directions)
    assert not hits.certified
    assert set(np.unique(hits.status)) <= {zs.MISS, zs.HIT}
    lengths = np.linalg.norm(directions, axis=1)
    # A hundred steps through the bounds, halved ten times; near silhouettes a sample or two may decide otherwise.
    good = np.abs(hits.t - truth) * lengths <= 4.0 / 100 / 1024 * 8 + 1e-4
    assert np.mean(good | (np.isnan(truth) & (hits.status == zs.MISS))) > 0.98


@pytest.mark.parametrize("method", ["auto", "analytic", "marching-points"])
def test_normals_are_unit_gradients(method: str, known: Any, some_rays: Callable[..., tuple[Array, Array]]) -> None:
    origins, directions = some_rays(100, spread=0.6)
    hits = zs.cast(known["sphere"].surface, origins, directions, method=method)
    found = hits.status > 0
    points = origins + hits.t[:, None] * directions
    assert found.sum() > 80
    assert np.allclose(np.linalg.norm(hits.normal[found], axis=1), 1, atol=1e-5)
    assert np.allclose(hits.normal[found], points[found] / 1.1, atol=2e-3)
    assert np.all(hits.normal[~found] == 0)


def test_a_finer_tolerance_costs_steps_and_brings_precision(known: Any, some_rays: Any) -> None:
    case = known["torus"]
    origins, directions = some_rays(200)
    truth = case.first(origins, directions)
    lengths = np.linalg.norm(directions, axis=1)
    spent, errors = [], []
    sure = ~np.isnan(truth)
    for tolerance in (0.1, 1e-3, 1e-5):
        hits = zs.cast(case.surface, origins, directions, method="affine", tolerance=tolerance)
        sure &= hits.status == zs.HIT
        spent.append(int(hits.steps[sure].sum()))
        errors.append(float(np.max((np.abs(hits.t - truth) * lengths)[sure])))
        assert errors[-1] <= 4 * max(tolerance, 10 * 2.0**-20)
    assert sure.sum() > 50
    assert spent[0] < spent[1] < spent[2]
    assert errors[0] > errors[1] > errors[2]


@pytest.mark.parametrize("method", ["auto", "analytic", "marching-points"])
def test_rays_begin_and_end_where_they_are_told_to(method: str, known: Any) -> None:
    sphere = known["sphere"].surface
    origin, direction = [0.3, 0.2, -4.0], [[0.0, 0.0, 2.0]]
    near, far = (4.0 - s * float(np.sqrt(1.1**2 - 0.13)) for s in (1, -1))
    near, far = near / 2, far / 2

    def t(low: float, high: float) -> float:
        return float(zs.cast(sphere, origin, direction, low, high, method=method).t[0])

    assert t(0, np.inf) == pytest.approx(near, abs=1e-3)
    assert t(near + 0.1, np.inf) == pytest.approx(far, abs=1e-3)
    assert np.isnan(t(far + 0.1, np.inf))
    assert np.isnan(t(0, near - 0.1))
    assert np.isnan(t(near + 0.1, far - 0.1))
    assert np.isnan(t(5, 1))
    assert t(-np.inf, np.inf) == pytest.approx(near, abs=1e-3)
    # From behind, looking away: only a negative start finds it.
    behind = zs.cast(sphere, [0.3, 0.2, 4.0], direction, -10.0, method=method)
    assert float(behind.t[0]) == pytest.approx(near - 4.0, abs=1e-3)
    assert zs.cast(sphere, [0.3, 0.2, 4.0], direction, method=method).status[0] == zs.MISS


@pytest.mark.parametrize("method", ["auto", "marching-points"])
def test_hits_lie_inside_the_bounds_only(method: str) -> None:
    plane = zs.surface("z", bounds=zs.Box((-1, -1, -1), (1, 2, 1)))
    xs = np.linspace(-3, 3, 61) + 0.003
    origins = np.stack([xs, 0.5 * xs, np.full(61, 4.0)], axis=1)
    hits = zs.cast(plane, origins, [0.0, 0.0, -1.0], method=method)
    assert np.array_equal(hits.status > 0, (np.abs(xs) < 1) & (0.5 * xs > -1) & (0.5 * xs < 2))


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1e3, 1e6])
@pytest.mark.parametrize("method", ["auto", "analytic"])
def test_huge_and_tiny_surfaces(scale: float, method: str, known: Any, some_rays: Any) -> None:
    case = known["sphere"]
    sphere = zs.surface(case.surface.field.expr, {"r": 1.1 * scale}, bounds=2.0 * scale)
    origins, directions = some_rays(150)
    scaled = (origins.astype(float) * scale).astype(np.float32)
    hits = zs.cast(sphere, scaled, directions, method=method)
    truth = case.first(scaled.astype(float) / scale, directions) * scale
    sure = hits.status != zs.UNRESOLVED
    assert sure.sum() > 145
    assert np.array_equal(np.isnan(hits.t[sure]), np.isnan(truth[sure]))
    found = sure & ~np.isnan(truth)
    assert np.allclose(hits.t[found] / scale, truth[found] / scale, rtol=1e-3)


def meets_unit_ball(origin: Any, direction: Any) -> bool:
    """Exactly: far away, the discriminant in f64 is nothing but rounding."""
    o, d = ([Fraction(float(v)) for v in vector] for vector in (origin, direction))
    a, b, c = sum(v * v for v in d), sum(v * w for v, w in zip(o, d, strict=True)), sum(v * v for v in o) - 1
    return b * b >= a * c and b < 0


def test_far_away_eyes(some_rays: Any) -> None:
    ball = zs.surface("x^2 + y^2 + z^2 - 1", bounds=1.5)
    for distance in (1e2, 1e4, 1e6, 1e8):
        origins, directions = (v.astype(np.float32) for v in some_rays(100, distance=distance, spread=0.5))
        hits = zs.cast(ball, origins, directions)
        truth = np.array([meets_unit_ball(o, d) for o, d in zip(origins, directions, strict=True)])
        assert not np.any((hits.status == zs.HIT) & ~truth)
        assert not np.any((hits.status == zs.MISS) & truth)


def test_the_offset_draws_another_level(known: Any) -> None:
    sphere = zs.surface("x^2 + y^2 + z^2 - 1", bounds=3.0)
    for name in ("auto", "analytic", "marching-points"):
        hits = zs.cast(sphere, [0, 0, 5], [[0, 0, -1.0]], method=METHODS[name](offset=1.25))
        assert hits.t[0] == pytest.approx(5 - 1.5, abs=2e-3), name


def test_double_roots_are_drawn_and_not_claimed() -> None:
    touching = zs.surface("z^2", bounds=2.0)
    for method in (GENERAL[0], GENERAL[5], *CLOSED):
        hits = zs.cast(touching, [[0.1, 0.2, 4.0]], [[0.01, 0.02, -1.0]], method=method)
        assert hits.status[0] == zs.UNRESOLVED, method
        assert hits.t[0] == pytest.approx(4, abs=0.02), method


def test_no_rays_are_no_hits(known: Any) -> None:
    hits = zs.cast(known["sphere"].surface, np.zeros((0, 3)), np.zeros((0, 3)))
    assert len(hits) == 0
    assert hits.normal.shape == (0, 3)
