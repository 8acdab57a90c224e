"""Parts of a formula that depend on parameters alone are numbers: functions of them are as well known as they are."""

from __future__ import annotations

import math

import numpy as np
import pytest

import zeroset as zs
from zeroset.arith import F32, F64, AffineSystem
from zeroset.expr import FUNCTIONS, OPS
from zeroset.runtime.cpu import CpuDevice

ONE_ARGUMENT = sorted(name for name in FUNCTIONS if hasattr(AffineSystem(F64).constant(1.0, 1.0), name))
EXPECTED = {"sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "cbrt"}


@pytest.mark.parametrize("method", ["auto", "affine", "interval", "mitchell"])
@pytest.mark.parametrize("name", sorted(EXPECTED))
def test_a_plane_at_a_function_of_a_parameter(name: str, method: str) -> None:
    at = 0.61
    surface = zs.surface(f"z = {name}(a)", params={"a": at}, bounds=3.0)
    function = np.cbrt if name == "cbrt" else getattr(math, name)
    hits = zs.cast(surface, [0.1, 0.2, -5.0], [0.0, 0.0, 1.0], method=method)
    assert hits.status.tolist() == [zs.HIT]
    assert hits.t[0] == pytest.approx(5 + function(at), abs=1e-3)


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
@pytest.mark.parametrize("symbols", [1, 3])
@pytest.mark.parametrize("name", sorted(EXPECTED))
def test_forms_without_terms_stay_narrow(name: str, symbols: int, fmt: object) -> None:
    system = AffineSystem(F32 if fmt is F32 else F64, symbols=symbols)
    range_ = getattr(system.enclose(0.61, 0.0), name)().interval()
    assert 0 <= float(range_.hi) - float(range_.lo) < 400 * system.fmt.eps


def test_turning_by_a_parameter_turns_the_picture() -> None:
    formula = "(x cos(a) - z sin(a))^2/2 + y^2 + 2 (x sin(a) + z cos(a))^2 = 1"
    turned = zs.render(zs.surface(formula, params={"a": 0.7}, bounds=2.0), 128, device="cpu")
    c, s = math.cos(0.7), math.sin(0.7)
    same = zs.surface(f"({c!r} x - {s!r} z)^2/2 + y^2 + 2 ({s!r} x + {c!r} z)^2 = 1", bounds=2.0)
    plain = zs.render(same, 128, device="cpu")
    assert turned.unresolved == 0
    assert plain.hits > 1000
    assert np.count_nonzero(turned.aov("status") != plain.aov("status")) <= 2


def test_what_overflows_while_bounds_are_fitted_is_no_error() -> None:
    """A pole at the very value of a parameter: f is defined nowhere."""
    surface = zs.surface("T(9, 1/(b - 1.11)) + x", params={"b": 1.11})
    assert zs.render(surface, 16, device="cpu").hits == 0


BORDERS = [
    ("x^2 + y^2 + z^2 - floor(a)", {"a": 1.0}, 1.0),
    ("x^2 + y^2 + z^2 - ceil(a)", {"a": 1.0}, 1.0),
    ("x^2 + y^2 + (z - 0.6 mod(w, 1))^2 = 0.5", {"w": 0.0}, 0.5),
    ("x^2 + y^2 + z^2 - 1 - sqrt(a)", {"a": 0.0}, 1.0),
    ("x^2 + y^2 + z^2 - 1 - a^1.5", {"a": 0.0}, 1.0),
    ("x^2 + y^2 + z^2 - asin(a)", {"a": 1.0}, math.pi / 2),
    ("x^2 + y^2 + z^2 - 1 - sign(a)", {"a": 0.0}, 1.0),
    ("x^2 + y^2 + z^2 - if(a < 1, 0.5, 1)", {"a": 1.0}, 1.0),
    ("x^2 + y^2 + z^2 - if(a <= 1, 0.5, 1)", {"a": 1.0}, 0.5),
    ("x^2 + y^2 + z^2 - sum(i, sqrt(r[i]))", {"r": [0.0, 1.0]}, 1.0),
    ("x^2 + y^2 + z^2 - floor(2a)", {"a": 0.5}, 1.0),
    ("x^2 + y^2 + z^2 - ceil(a b)", {"a": 0.25, "b": 4.0}, 1.0),
    ("x^2 + y^2 + z^2 - 1 - sqrt(a - b)", {"a": 0.1, "b": 0.1}, 1.0),
    ("x^2 + y^2 + z^2 - 1 - acosh(a)", {"a": 1.0}, 1.0),
    ("x^2 + y^2 + z^2 - 1 - 0.1 cos(1000000 a)", {"a": 12.7}, 1 + 0.1 * math.cos(12_700_000)),
    ("x^2 + y^2 + z^2 - if(a^2 + b < 1, 0.5, 1)", {"a": 0.75, "b": 0.4375}, 1.0),
]


@pytest.mark.parametrize("method", ["auto", "affine", "interval", "mitchell"])
@pytest.mark.parametrize(("formula", "params", "square"), BORDERS, ids=[border[0] for border in BORDERS])
def test_a_parameter_at_the_end_of_a_domain_is_just_there(
    formula: str, params: dict[str, float | list[float]], square: float, method: str
) -> None:
    """Sliders begin at 0 and 1: a value that is stored exactly is not taken for values on both sides."""
    surface = zs.surface(formula, params=params, bounds=1.6)
    hits = zs.cast(surface, [-5.0, 0.1, 0.2], [1.0, 0.0, 0.0], method=method)
    assert hits.status.tolist() == [zs.HIT]
    assert hits.t[0] == pytest.approx(5 - math.sqrt(square - 0.05), abs=1e-3)


def test_sliders_move_what_parameters_decide_without_compiling(monkeypatch: pytest.MonkeyPatch) -> None:
    surface = zs.surface("x^2 + y^2 + (z - sin(2a))^2 = floor(b)/4 + 0.1", params={"a": 0.1, "b": 1.0}, bounds=3.0)
    zs.cast(surface, [0, 0, -5], [0, 0, 1], device="cpu")
    monkeypatch.setattr(CpuDevice, "_write", None)
    for a, b in [(0.1, 1.0), (-0.5, 1.5), (0.3, 4.0), (1e6, 0.2)]:
        hits = zs.cast(surface.with_params(a=a, b=b), [0, 0, -5], [0, 0, 1], device="cpu")
        assert hits.t[0] == pytest.approx(5 + math.sin(2 * a) - math.sqrt(math.floor(b) / 4 + 0.1), abs=1e-3)


def test_what_f32_cannot_hold_is_found_in_f64() -> None:
    """A part that is larger than any number of kernels in f32 is left to kernels, which know what to make of it."""
    surface = zs.surface("x^20 + y^20 + z^20 = a^20", params={"a": 100.0}, bounds=200.0)
    assert surface.settled.field is surface.field
    hits = zs.cast(surface, [1.0, 2.0, -500.0], [0, 0, 1], device="cpu")
    assert hits.status.tolist() == [zs.HIT]
    assert hits.t[0] == pytest.approx(400, abs=1e-2)


@pytest.mark.parametrize("at", [-1e17, -1e8, -1e5, -3.0, -1e-3, 0.0, 2.0, 1e20])
def test_asinh_is_as_good_below_0_as_above(at: float) -> None:
    hits = zs.cast(zs.surface("x + asinh(a)/50", params={"a": at}, bounds=2.0), [-5, 0.1, 0.1], [1, 0, 0])
    assert hits.status.tolist() == [zs.HIT]
    assert hits.t[0] - 5 == pytest.approx(-math.asinh(at) / 50, abs=1e-4)


def test_every_function_is_there() -> None:
    assert set(OPS) >= EXPECTED
    assert set(ONE_ARGUMENT) >= EXPECTED
