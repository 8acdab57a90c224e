"""The stated error bounds of the elementary functions, held against ball arithmetic and, densely, against float64."""

import flint
import numpy as np
import pytest

from zeroset.arith import F32, F64, elementary
from zeroset.arith.elementary import error_bound, trigonometric_limit
from zeroset.arith.elementary.tables import TABLES

from .fit import fits, fitted
from .scalars import Flushed, Fused, plain
from .truth import BINARY, UNARY, awkward, true_values

NAMES = ["exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "cbrt"]
REFERENCE = {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan}
SPANS = {
    "exp": [(-90, 79), (-1, 1)],
    "log": [(0.5, 2), (1e-3, 1e3)],
    "sin": [(-8192, 8192), (-7, 7)],
    "cos": [(-8192, 8192), (-7, 7)],
    "tan": [(-8192, 8192), (-7, 7)],
    "asin": [(-1, 1), (0.499, 0.501)],
    "acos": [(-1, 1), (0.499, 0.501), (0.999, 1)],
    "atan": [(-5, 5), (-1000, 1000)],
    "sinh": [(-79, 79), (-2, 2)],
    "cosh": [(-79, 79), (-2, 2)],
    "tanh": [(-12, 12), (-1, 1)],
    "cbrt": [(-10, 10), (-1e6, 1e6)],
}


def in_domain(name, x, fmt):
    if name == "log":
        return x[x >= fmt.quantum]
    if name in ("asin", "acos"):
        return x[abs(x) <= 1]
    if name in ("sin", "cos", "tan"):
        return x[abs(x) <= trigonometric_limit(fmt)]
    return x


def dense(name):
    generator = np.random.default_rng(3)
    parts = [generator.uniform(*span, 40_000) for span in SPANS[name]]
    sizes = 2.0 ** generator.uniform(-100, 100, 40_000) * generator.choice([-1, 1], 40_000)
    return in_domain(name, np.concatenate([*parts, sizes, awkward("float32")]).astype(np.float32), F32)


def allowed(name, fmt, x, value):
    bound = error_bound(name, fmt)
    slope = bound.slope * abs(x) * (1 + value**2 if name == "tan" else 1)
    return bound.relative * fmt.eps * abs(value) + bound.absolute + slope + 2 * fmt.quantum


@pytest.mark.parametrize("kind", [np.asarray, Fused, Flushed], ids=["plain", "fused", "flushed"])
@pytest.mark.parametrize("name", NAMES)
def test_f32_densely(name, kind):
    x = dense(name)
    with np.errstate(all="ignore"):
        value = plain(getattr(elementary, name)(F32, kind(x))).astype(np.float64)
        wide = x.astype(np.float64)
        true = REFERENCE.get(name, getattr(np, name, None))(wide)
        error = abs(value - true)
    assert np.isfinite(value).all()
    known = abs(true) <= F32.big
    # The reference itself is good to a few roundings of float64.
    assert (error <= allowed(name, F32, wide, value) + 4 * F64.eps * abs(true))[known].all()
    assert (abs(value) >= F32.big * (1 - 1e-5))[~known].all()


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
@pytest.mark.parametrize("name", NAMES)
def test_against_ball_arithmetic(name, fmt):
    generator = np.random.default_rng(5)
    parts = [generator.uniform(*span, 300) for span in SPANS[name]]
    x = in_domain(name, np.concatenate([*parts, awkward(fmt.dtype)]).astype(fmt.dtype), fmt)
    with np.errstate(all="ignore"):
        values = getattr(elementary, name)(fmt, x).astype(np.float64)
    truths = true_values(UNARY[name], x.astype(np.float64))
    checked = 0
    for point, value, true in zip(x.tolist(), values.tolist(), truths, strict=True):
        if true is not None and abs(true) <= fmt.big:
            assert abs(flint.arb(value) - true) <= allowed(name, fmt, point, value), point
            checked += 1
    assert checked > 200


@pytest.mark.parametrize("name", NAMES)
def test_python_floats_follow_the_same_bounds(name):
    for fmt in (F32, F64):
        for point in in_domain(name, awkward("float32"), F32).astype(float).tolist()[::5]:
            value = getattr(elementary, name)(fmt, point)
            true = true_values(UNARY[name], np.array([point]))[0]
            assert isinstance(value, float)
            if true is not None and abs(true) <= fmt.big:
                assert abs(flint.arb(value) - true) <= allowed(name, fmt, point, value)


@pytest.mark.parametrize("name", NAMES)
def test_bounds_are_not_vacuous(name):
    assert error_bound(name, F32).relative <= 8
    x = dense(name)
    with np.errstate(all="ignore"):
        value = getattr(elementary, name)(F32, x).astype(np.float64)
        true = REFERENCE.get(name, getattr(np, name, None))(x.astype(np.float64))
        error = abs(value - true) / (F32.eps * abs(true))
    usual = (abs(true) > 1e-3) & (abs(true) < 1e3)
    assert error[usual].max() > error_bound(name, F32).relative / 5


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
def test_atan2_in_all_quadrants(fmt):
    values = awkward(fmt.dtype)
    values = values[(abs(values) > fmt.tiny) | (values == 0)]
    y, x = (part.ravel() for part in np.meshgrid(values[::3], values[::4]))
    with np.errstate(all="ignore"):
        angles = elementary.atan2(fmt, y, x).astype(np.float64)
    truths = true_values(BINARY["atan2"], y.astype(np.float64), x.astype(np.float64))
    limit = error_bound("atan2", fmt).relative * fmt.eps
    for angle, true in zip(angles.tolist(), truths, strict=True):
        if true is not None:
            assert abs(flint.arb(angle) - true) <= limit * abs(angle) + fmt.tiny


@pytest.mark.parametrize("exponent", [(1, 2), (3, 2), (5, 4), (2, 3), (7, 6), (1, 12)])
def test_powers_by_roots_keep_their_bound(exponent):
    x = 2.0 ** np.random.default_rng(1).uniform(-20, 20, 20_000).astype(np.float32)
    value = elementary.powr(F32, x, exponent).astype(np.float64)
    true = x.astype(np.float64) ** (exponent[0] / exponent[1])
    assert (abs(value - true) <= elementary.power_error(exponent) * F32.eps * abs(value)).all()


def test_powers_outside_their_domain_are_finite():
    x = np.float32([-1.0, 0.0, -0.0, 2.0])
    assert elementary.pow(F32, x, np.float32(2.0)).tolist()[:3] == [0.0, 0.0, 0.0]
    assert elementary.powr(F32, x, (-1, 2)).tolist()[1] == F32.big
    assert elementary.powr(F32, x, (3, 5)).tolist()[0] == 0.0


@pytest.mark.parametrize("name", NAMES)
def test_no_finite_argument_gives_nan_or_infinity(name):
    x = np.concatenate([awkward("float32"), np.float32([3e38, -3e38, 1e38, -1e38])])
    with np.errstate(all="ignore"):
        assert np.isfinite(getattr(elementary, name)(F32, x)).all()


@pytest.mark.parametrize("dtype", ["float32", "float64"])
@pytest.mark.parametrize("name", sorted(fits()))
def test_tables_are_those_that_the_fit_makes(name, dtype):
    assert TABLES[name][dtype] == fitted(name, dtype)
