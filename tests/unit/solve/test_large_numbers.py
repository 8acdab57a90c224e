"""Formulas whose parts pass the largest number of f32 are answered as certainly as all others."""

from __future__ import annotations

import numpy as np
import pytest
from tests.gpus import no_gpu

import zeroset as zs
from zeroset.solve.status import HIT, MISS

PROVING = ["auto", "interval", "affine", "mitchell", "mitchell-exact", "analytic"]
CASES = [
    # formula, half the bounds' side, the coordinate x of the first root along x from the left
    ("x*1e34 = 1e34/2", 3.0, 0.5),
    ("x*cosh(90) = cosh(90)/2", 3.0, 0.5),
    ("(x^2 + y^2 + z^2)*1e30 = 1e36", 1500.0, -1000.0),
    ("x^4 + y^4 + z^4 = 1e36", 2e9, -1e9),
    ("(x^3 + y^3 + z^3)*1e-36 + 1", 2e12, -1e12),
    ("x/1e40*1e40 = 1e280*(x/1e280) + x - 1", 3.0, 1.0),
    ("1e250*x^3 = 1e250/8", 3.0, 0.5),
    ("x*exp(75) = 50exp(75)", 300.0, 50.0),
    ("x/sqrt(2e-66) - y/sqrt(2e-66) = 50/sqrt(2e-66)", 300.0, 50.0),
]


@pytest.mark.parametrize("method", PROVING)
@pytest.mark.parametrize(("formula", "half", "root"), CASES)
def test_the_root_is_where_it_is(formula: str, half: float, root: float, method: str) -> None:
    surface = zs.surface(formula, bounds=zs.Box((-half,) * 3, (half,) * 3))
    begin = -2.0 * half
    found = zs.cast(surface, [begin, 0.0, 0.0], [1.0, 0.0, 0.0], method=method, device="cpu")
    assert found.status[0] == HIT
    assert begin + found.t[0] == pytest.approx(root, abs=1e-3 * half)


@pytest.mark.skipif(bool(no_gpu()), reason=no_gpu() or "there is one")
@pytest.mark.parametrize(("formula", "half", "root"), CASES[:4])
def test_a_gpu_says_nothing_else(formula: str, half: float, root: float) -> None:
    surface = zs.surface(formula, bounds=zs.Box((-half,) * 3, (half,) * 3))
    found = zs.cast(surface, [-2.0 * half, 0.0, 0.0], [1.0, 0.0, 0.0], device="gpu")
    # Without f64 it may not know.
    assert found.status[0] != MISS
    if found.status[0] == HIT:
        assert found.t[0] - 2.0 * half == pytest.approx(root, abs=1e-3 * half)


def test_high_powers_of_far_coordinates() -> None:
    surface = zs.surface("x^30 + y^30 + z^30 = 50^30", bounds=100.0)
    found = zs.cast(surface, [-150.0, 0.0, 0.0], [1.0, 0.0, 0.0], device="cpu")
    assert (found.status[0], found.t[0]) == (HIT, pytest.approx(100.0, abs=0.1))


def test_a_parameter_may_carry_it_there() -> None:
    surface = zs.surface("(x + 2)*a*a*a = a^3", {"a": 1.0}, bounds=3.0)
    for a in (1.0, 1e9, 1e11, 1e25):
        found = zs.cast(surface.with_params(a=a), [-5.0, 0.1, 0.1], [1.0, 0.0, 0.0], device="cpu")
        assert (found.status[0], found.t[0]) == (HIT, pytest.approx(4.0, abs=0.01))


def test_normals_of_steep_functions() -> None:
    for scale in ("1e-60", "1e-31", "1e31", "1e60"):
        surface = zs.surface(f"(3x + 4z - 1)*{scale}", bounds=3.0)
        found = zs.cast(surface, [-5.0, 0.0, 0.0], [1.0, 0.0, 0.0], device="cpu")
        if found.status[0] == HIT:
            np.testing.assert_allclose(found.normal[0], [0.6, 0.0, 0.8], atol=1e-5)
        assert found.status[0] != MISS


def test_nothing_is_watched_without_need() -> None:
    assert not [name for name, surface in zs.gallery.items() if surface.drawn_in(surface.fitted).large]


def test_a_wall_of_a_solid_beside_large_numbers() -> None:
    box = zs.surface("max(|x|, |y|, |z|)*1e35 = 1e35")
    solid = (box - zs.surface("x^2 + y^2 + z^2 = 1/4")).with_bounds(2.0)
    found = zs.cast(solid, [[-5.0, 0.1, 0.2], [-5.0, 1.5, 0.0]], [1.0, 0.0, 0.0], device="cpu")
    assert found.status.tolist() == [HIT, MISS]
    assert found.t[0] == pytest.approx(4.0, abs=0.01)


def test_bounds_that_are_fitted_tell_as_well() -> None:
    for formula, large in (("(x^2 + y^2 + z^2 - 1)*1e35", True), ("x^16 + y^16 + z^16 = 1", False)):
        surface = zs.surface(formula)
        assert zs.render(surface, 32, device="cpu").hits > 300
        found = zs.cast(zs.surface(formula), [-5.0, 0.0, 0.0], [1.0, 0.0, 0.0], device="cpu")
        assert (found.status[0], found.t[0]) == (HIT, pytest.approx(4.0, abs=1e-3))
        assert surface.drawn_in(surface.fitted).large == large


def test_light_is_the_same_on_large_numbers() -> None:
    plain = zs.surface("x + (y^2 + z^2)/2 - sqrt(x^2 + 1)/4", bounds=2.0)
    large = zs.surface("(x + (y^2 + z^2)/2 - sqrt(x^2 + 1)/4)*1e34", bounds=2.0)
    lamp = zs.Light(position=(-1.0, -3.0, 2.0), headlight=False)
    camera = zs.Camera(eye=(5.0, -3.0, 2.0))
    mirror = zs.Material(reflectance=0.4)
    for options in ({}, {"antialias": 4}, {"material": mirror, "depth": 2}):
        one, two = (
            np.asarray(zs.render(s, 64, camera, lights=[lamp], shadows=True, device="cpu", **options)).astype(int)
            for s in (plain, large)
        )
        assert np.count_nonzero(abs(one - two).max(axis=-1) > 2) <= 8
        assert len(np.unique(one.reshape(-1, 3), axis=0)) > 20
