"""Where something on the way to f passes the largest number of the format, nothing is claimed of it."""

from __future__ import annotations

import numpy as np
import pytest
from tests.gpus import no_gpu

import zeroset as zs

DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.skipif(bool(no_gpu()), reason=no_gpu() or "there is one"))]
METHODS = ["auto", "affine", "interval", "mitchell"]
# A formula, its parameters, and where a ray along x from -5, at y = z = 0.1, meets it first.
CASES = [
    ("log(cosh(100 x))/100 = 1.5", {}, -1.5069314718),
    ("x - log(exp(100 + y) + exp(100))/100", {}, 1.0074313),
    ("x - log(cosh(a))/100", {"a": 100.0}, 0.9930685),
    ("x + hypot(1e20, y)/1e20", {}, -1.0),
    ("(|x|^a + |y|^a)^(1/a) = 1.9", {"a": 200.0}, -1.9),
    ("log(1 + exp(a x))/a = 1.5", {"a": 60.0}, 1.5),
    ("x - exp(70) * exp(-70) * 0.7", {}, 0.7),
    ("x - exp(100 + y - y) / exp(100) * 0.7", {}, 0.7),
    ("x - (exp(90) - exp(89)) / exp(90)", {}, 1 - np.exp(-1.0)),
    ("x - sqrt(exp(120 x)) * 1e-20 + 1", {}, -1.0),
]


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(("formula", "params", "root"), CASES, ids=[case[0] for case in CASES])
def test_no_root_is_lost_and_none_invented(
    formula: str, params: dict[str, float], root: float, method: str, device: str
) -> None:
    surface = zs.surface(formula, params=params, bounds=2.0)
    hits = zs.cast(surface, [-5.0, 0.1, 0.1], [1.0, 0.0, 0.0], method=method, device=device)
    status, x = hits.status[0], hits.t[0] - 5
    assert status != zs.MISS
    if status == zs.HIT:
        assert x == pytest.approx(root, abs=2e-3)
    else:
        assert x <= root + 2e-3


@pytest.mark.parametrize(("formula", "params", "root"), CASES, ids=[case[0] for case in CASES])
def test_doubles_find_what_floats_leave_open(formula: str, params: dict[str, float], root: float) -> None:
    hits = zs.cast(zs.surface(formula, params=params, bounds=2.0), [-5.0, 0.1, 0.1], [1.0, 0.0, 0.0], device="cpu")
    assert hits.status.tolist() == [zs.HIT]
    assert hits.t[0] - 5 == pytest.approx(root, abs=1e-3)


@pytest.mark.parametrize(
    ("formula", "like"),
    [
        ("log(exp(60 (x^2 + y^2)) + exp(60 z^2))/60 = 1.5", "max(x^2 + y^2, z^2) = 1.5"),
        ("log(cosh(100 x) + cosh(100 y) + cosh(100 z))/100 = 1", "max(|x|, |y|, |z|) = 1"),
    ],
)
def test_soft_shapes_have_their_pictures(formula: str, like: str) -> None:
    soft, sharp = (zs.render(zs.surface(f, bounds=2.0), 96, device="cpu").aov("status") for f in (formula, like))
    assert np.count_nonzero(sharp) > 2000
    assert np.count_nonzero((soft != 0) != (sharp != 0)) < 0.05 * np.count_nonzero(sharp)


def test_where_nothing_is_claimed_of_large_values_signs_are_still_known() -> None:
    for formula in ("exp(exp(x + 6)) + y^2", "1/(1 + exp(100 x)) + 1", "cosh(90 x) + exp(95 y)"):
        assert zs.render(zs.surface(formula, bounds=2.0), 64, device="cpu").hits == 0


def test_where_floats_overflow_nothing_is_taken_for_thin() -> None:
    surface = zs.surface("log(exp(20 (x^2 + y^2)) + exp(20 z^2))/20 = 1", bounds=2.2)
    with_thin, without = (zs.render(surface, 128, thin=thin, device="cpu").aov("status") for thin in (True, False))
    assert np.count_nonzero(without == zs.HIT) > 3000
    assert np.array_equal(with_thin, without)
