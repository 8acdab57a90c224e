"""All hits along rays, held to the real roots of the polynomials along them."""

from __future__ import annotations

import flint
import numpy as np
import pytest
from tests.gpus import needs_gpu
from tests.narrow import narrow

import zeroset as zs
from zeroset.errors import ParameterError

TANGLE = zs.surface("x^4 - 5x^2 + y^4 - 5y^2 + z^4 - 5z^2 + 11.8", bounds=3.5)


def rays(count: int, distance: float, spread: float) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(7)
    origins = random.normal(size=(count, 3))
    origins *= distance / np.linalg.norm(origins, axis=1, keepdims=True)
    directions = random.uniform(-spread, spread, (count, 3)) - origins
    return origins.astype(np.float32), directions.astype(np.float32)


def tangle_roots(origin: np.ndarray, direction: np.ndarray) -> list[float]:
    """Every real root along a ray, certified by Arb."""
    total = flint.fmpq_poly([flint.fmpq(118, 10)])
    for o, d in zip(origin, direction, strict=True):
        line = flint.fmpq_poly([flint.fmpq(*float(v).as_integer_ratio()) for v in (o, d)])
        total += line**4 - 5 * line**2
    roots = total.numer().complex_roots()
    return sorted(float(root.real.mid()) for root, _ in roots if root.imag.contains(0))


@pytest.mark.parametrize("device", ["cpu", pytest.param("gpu", marks=needs_gpu)])
def test_every_root_in_order(device: str) -> None:
    origins, directions = rays(400, 8.0, 2.0)
    hits = zs.cast(TANGLE, origins, directions, max_hits=6, device=device)
    assert hits.t.shape == hits.status.shape == hits.steps.shape == (400, 6)
    assert hits.normal.shape == (400, 6, 3)
    numbers = set()
    for i in range(400):
        truth = tangle_roots(origins[i], directions[i])
        found = hits.t[i][hits.status[i] == zs.HIT]
        assert len(found) == len(truth)
        assert found == pytest.approx(truth, abs=1e-3)
        numbers.add(len(found))
    assert numbers == {0, 2, 4}


@pytest.mark.parametrize("method", ["affine", "interval", "mitchell", "analytic", "mitchell-exact", "marching-points"])
def test_every_method_goes_on(method: str) -> None:
    origins, directions = rays(60, 8.0, 1.0)
    reference = zs.cast(TANGLE, origins, directions, max_hits=4)
    hits = zs.cast(TANGLE, origins, directions, max_hits=4, method=method)
    assert np.array_equal(hits.status, reference.status)
    assert np.allclose(hits.t, reference.t, atol=2e-3, equal_nan=True)


def test_the_first_layer_is_the_first_hit() -> None:
    origins, directions = rays(200, 8.0, 3.0)
    one, many = (zs.cast(TANGLE, origins, directions, max_hits=n) for n in (None, 1))
    assert np.array_equal(one.status, many.status[:, 0])
    assert np.allclose(one.t, many.t[:, 0], equal_nan=True, atol=1e-4)
    assert np.allclose(one.normal, many.normal[:, 0], atol=1e-2)


def test_normals_of_layers_point_towards_growing_f() -> None:
    hits = zs.cast(zs.surface("x^2 + y^2 + z^2 = 1", bounds=2), [0, 0, 5], [0, 0, -1], max_hits=2)
    assert hits.normal[0] == pytest.approx(np.array([[0, 0, 1], [0, 0, -1]]), abs=1e-3)


def test_a_double_root_is_one_place() -> None:
    sheet = zs.surface("z^2 (z - 1)", bounds=3)
    hits = zs.cast(sheet, [0.1, 0.2, 2.5], [0.01, 0.02, -1], max_hits=4)
    assert hits.status[0].tolist() == [zs.HIT, zs.UNRESOLVED, zs.MISS, zs.MISS]
    assert hits.t[0, :2] == pytest.approx([1.5, 2.5], abs=0.01)


def test_two_roots_that_f32_cannot_tell_apart_are_two() -> None:
    # Between them f is -0.02 at most, which is rounding in f32 there: all of it is as unresolved as a double root.
    eye, toward = (0.0, 6.853, 4.236), np.array([0.08346312, -0.78151715, -0.6182757], np.float32)
    hits = zs.cast(zs.gallery["barth-decic"], eye, toward, max_hits=4)
    assert hits.status[0].tolist() == [zs.HIT, zs.HIT, zs.MISS, zs.MISS]
    assert hits.t[0, :2] == pytest.approx([9.50214, 9.50674], abs=1e-3)


def test_without_f64_what_touches_a_hit_stays_unresolved() -> None:
    # f32 proves the first root, and cannot tell the second one from what is left of it.
    eye, toward = (0.0, 6.853, 4.236), np.array([-0.002367281587794423, -0.8596280813217163, -0.5109148025512695])
    roots = zs.cast(zs.gallery["barth-decic"], eye, toward, max_hits=5).t[0]
    assert roots[:4] == pytest.approx([7.454326, 7.456016, 8.630331, 8.698753], abs=1e-3)
    hits = zs.cast(zs.gallery["barth-decic"], eye, toward, max_hits=5, device=narrow())
    assert hits.status[0].tolist() == [zs.HIT, zs.UNRESOLVED, zs.HIT, zs.HIT, zs.MISS]
    assert hits.t[0, :4] == pytest.approx(roots[:4], abs=2e-3)


@pytest.mark.parametrize("formula", ["T(5, y) + T(6, z)", "T(7, y) + x", "T(7, x) + T(5, y) + T(6, z)"])
def test_no_root_is_found_twice(formula: str) -> None:
    # Along an axis f has much the same slope everywhere, and one long look may prove a root that lies just before it.
    surface = zs.surface(formula, bounds=1.2)
    origins = np.random.default_rng(1).uniform(-0.7, 0.7, (2000, 3))
    origins[:, 1] = -1.32
    hits = zs.cast(surface, origins, [0, 1, 0], max_hits=8)
    both = (hits.status[:, 1:] == zs.HIT) & (hits.status[:, :-1] == zs.HIT)
    assert np.count_nonzero(both) > 1000
    assert np.diff(hits.t, axis=1)[both].min() > surface.fitted.extent * 2.0**-15
    # From one root to the next f crosses zero the other way.
    assert np.all((hits.normal[:, 1:, 1] * hits.normal[:, :-1, 1])[both] < 0)


@pytest.mark.parametrize("method", ["auto", "affine", "interval"])
def test_a_ray_that_starts_on_the_surface_goes_on(method: str) -> None:
    sheets = zs.cast(zs.surface("x (x - 1)", bounds=2), [0, 0.3, 0.2], [1, 0, 0], max_hits=4, method=method)
    assert sheets.status[0].tolist() == [zs.UNRESOLVED, zs.HIT, zs.MISS, zs.MISS]
    assert sheets.t[0, :2] == pytest.approx([0, 1], abs=1e-3)
    ball = zs.surface("x^2 + y^2 + z^2 = 1", bounds=2)
    away, through = zs.cast(ball, [0, -1, 0], [[0, -1, 0], [0, 1, 0]], max_hits=4, method=method).status
    assert np.count_nonzero(away != zs.MISS) <= 1
    assert np.count_nonzero(through != zs.MISS) == 2


@pytest.mark.parametrize("distance", [1e2, 1e4, 1e6, 1e8])
def test_far_away_a_hit_is_as_close_as_t_can_say(distance: float) -> None:
    ball = zs.surface("x^2 + y^2 + z^2 = 1", bounds=2)
    hits = zs.cast(ball, [0, -distance, 0], [0, 1, 0], max_hits=3)
    apart = np.spacing(np.float32(distance))
    true = np.array([distance - 1, distance + 1])
    found = hits.t[0, hits.status[0] == zs.HIT].astype(float)
    assert len(found) == (2 if apart < 1 else 1)
    assert np.abs(found - true[: len(found)]).max() <= max(apart, 1e-3)
    rough = zs.cast(ball, [0, -distance, 0], [0, 1, 0], device=narrow())
    assert rough.status[0] == (zs.HIT if distance < 1e3 else zs.UNRESOLVED)


def test_parts_outside_the_stretch_are_not_counted() -> None:
    ball = zs.surface("x^2 + y^2 + z^2 = 1", bounds=2)
    inside = zs.cast(ball, [0, 0, 5], [0, 0, -1], t_min=4.5, max_hits=2)
    assert inside.t[0, 0] == pytest.approx(6, abs=1e-3)
    assert inside.status[0].tolist() == [zs.HIT, zs.MISS]
    before = zs.cast(ball, [0, 0, 5], [0, 0, -1], t_max=4.5, max_hits=2)
    assert before.status[0].tolist() == [zs.HIT, zs.MISS]


@pytest.mark.parametrize("wrong", [0, -1, 2000, 1.5, "two"])
def test_numbers_of_hits_that_cannot_be(wrong: object) -> None:
    with pytest.raises(ParameterError, match="max_hits"):
        zs.cast(TANGLE, [0, 0, 5], [0, 0, -1], max_hits=wrong)  # type: ignore[arg-type]
