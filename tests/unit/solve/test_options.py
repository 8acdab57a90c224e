"""Names and options of methods, and what is said of wrong ones."""

from __future__ import annotations

import dataclasses
from typing import Any

import pytest

import zeroset as zs
from zeroset.errors import MethodError
from zeroset.methods import METHODS, Affine, Analytic, Auto, MarchingPoints, Mitchell, MitchellExact
from zeroset.solve import resolve_method
from zeroset.solve.sampling import formula_steps


def test_every_method_of_the_design_is_there() -> None:
    assert set(METHODS) == {
        *("auto", "analytic", "interval", "affine", "mitchell", "mitchell-exact"),
        *("marching-points", "adaptive-marching-points"),
    }
    certified = {name for name, method in METHODS.items() if method.certified}
    assert set(METHODS) - certified == {"marching-points", "adaptive-marching-points"}
    for method in METHODS.values():
        assert method.summary
        assert method.__doc__


def test_a_method_is_named_or_given() -> None:
    assert resolve_method("affine") == Affine()
    assert resolve_method(Affine(axis="k")) == Affine(axis="k")
    assert resolve_method(Affine) == Affine()  # type: ignore[arg-type]
    with pytest.raises(MethodError, match="did you mean 'mitchell'"):
        resolve_method("mitchel")
    with pytest.raises(MethodError, match="the methods are"):
        resolve_method(None)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        ("affine", {"axis": "z"}, "axis must be"),
        ("auto", {"offset": float("nan")}, "offset must be a finite number"),
        ("auto", {"offset": "much"}, "offset must be a finite number"),
        ("affine", {"offset": 1e40}, "offset must be a finite number, up to 1e.30"),
        ("interval", {"delta": -1.0}, "delta must be 0 or more"),
        ("marching-points", {"test": "gut"}, "test must be"),
        ("marching-points", {"steps": -1}, "steps"),
        ("marching-points", {"steps": 2.5}, "steps"),
        ("marching-points", {"steps": 1e6}, "steps"),
        ("marching-points", {"steps": "many"}, "steps must be a finite number"),
        ("adaptive-marching-points", {"silhouettes": "yes"}, "silhouettes must be True or False"),
        ("adaptive-marching-points", {"tau1": float("inf")}, "tau1 must be a finite number"),
        ("adaptive-marching-points", {"epsilon": -1.0}, "epsilon must not be negative"),
    ],
)
def test_bad_options_are_refused(name: str, options: dict[str, Any], said: str) -> None:
    with pytest.raises(MethodError, match=said):
        METHODS[name](**options)


@pytest.mark.parametrize(
    ("method", "formula"),
    [
        (Analytic(), "x^5 + y"),
        (Analytic(), "sin(x) + y"),
        (MitchellExact(), "x^6 + y"),
        (MitchellExact(), "1/x + y"),
    ],
)
def test_methods_for_polynomials_refuse_what_is_none(method: Any, formula: str) -> None:
    with pytest.raises(MethodError, match="needs a polynomial of degree 1 to"):
        zs.cast(formula, [0, 0, 5], [0, 0, -1], method=method)
    with pytest.raises(MethodError, match="auto"):
        zs.render(formula, size=8, method=method)


def test_numbers_do_not_shape_the_kernel_and_choices_do() -> None:
    assert MarchingPoints(steps=7).structure() == MarchingPoints(steps=9).structure()
    assert MarchingPoints(steps=7).uniforms() != MarchingPoints(steps=9).uniforms()
    assert MarchingPoints(test="taylor").structure() != MarchingPoints().structure()
    assert Auto(offset=1.0).structure() == Auto(offset=2.0).structure()
    assert Auto(offset=1.0).structure() != Auto().structure()
    assert len({method().structure() for method in METHODS.values()}) == len(METHODS)


def test_methods_are_values() -> None:
    assert Mitchell() == Mitchell()
    assert len({Affine(), Affine(), Affine(axis="k")}) == 2
    with pytest.raises(dataclasses.FrozenInstanceError):
        Auto().offset = 1.0  # type: ignore[misc]


@pytest.mark.parametrize(("formula", "steps"), [("x + y", 100), ("x^6 + y", 100), ("x^7 + y", 113), ("sin(x)", 100)])
def test_the_step_formula_of_the_paper(formula: str, steps: int) -> None:
    assert formula_steps(zs.surface(formula).field) == steps


def test_steps_by_hand_are_what_is_spent() -> None:
    miss = zs.surface("x^2 + y^2 + z^2 + 1", bounds=1.0)
    for steps in (1, 10, 250):
        hits = zs.cast(miss, [0, 0, 5], [0, 0, -1], method=MarchingPoints(steps=steps))
        assert abs(int(hits.steps[0]) - steps) <= 2
