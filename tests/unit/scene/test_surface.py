from __future__ import annotations

import copy
import math
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy

import zeroset as zs
from zeroset.errors import (
    ArrayShapeError,
    BoundsError,
    FormulaError,
    FormulaLimitError,
    ParameterError,
    UnknownNameError,
    UnknownSurfaceError,
)

BLOBS = "sum(i, exp(-r[i]*((x - c[i])^2 + y^2 + z^2))) = 0.5"


def test_all_that_a_surface_can_be_made_of() -> None:
    x, y = sympy.symbols("x y")
    text = zs.surface("x^2 + sin(y)")
    assert zs.surface(x**2 + sympy.sin(y)) == text
    assert zs.surface(sympy.Eq(x**2, -sympy.sin(y))) == text
    assert zs.surface(lambda x, y, z: x**2 + np.sin(y)) == text
    assert zs.surface(text.field.expr) == text
    assert zs.surface(text) == text


def test_a_function_has_its_parameters_from_its_defaults() -> None:
    surface = zs.surface(lambda x, y, z, a=2.0: x**2 + a * y)
    assert dict(surface.params) == {"a": 2.0}
    assert zs.surface(lambda x, y, z, a=2.0: x**2 + a * y, {"a": 3.0}).params["a"] == 3.0


def test_parameters_change_and_the_field_does_not() -> None:
    surface = zs.surface("x^2 + a*y + w", {"a": 1})
    changed = surface.with_params(a=2, w=0.5)
    assert dict(surface.params) == {"a": 1.0, "w": 0.0}
    assert dict(changed.params) == {"a": 2.0, "w": 0.5}
    assert changed.field is surface.field
    assert changed != surface
    assert len({surface, changed, surface.with_params(a=1)}) == 2


def test_array_parameters() -> None:
    surface = zs.surface(BLOBS, {"c": [0, 1], "r": (1, 1)})
    assert surface.with_params(c=[1, 2]) != surface
    assert surface.arrays["c"].tolist() == [0.0, 1.0]
    assert surface == zs.surface(BLOBS, {"c": np.array([0.0, 1.0]), "r": [1.0, 1.0]})
    with pytest.raises(ValueError, match="read-only"):
        surface.arrays["c"][0] = 5.0
    with pytest.raises(ArrayShapeError, match="equally long"):
        surface.with_params(c=[1, 2, 3])


def test_a_surface_cannot_be_changed_in_place_but_copied() -> None:
    surface = zs.surface("x^2 + a*y", {"a": 1.0}, bounds=2.0)
    with pytest.raises(TypeError):
        surface.params["a"] = 2.0  # type: ignore[index]
    assert copy.copy(surface) == surface


@pytest.mark.parametrize(
    ("source", "params", "error", "said"),
    [
        ("x^2 + a", {}, UnknownNameError, "unknown name a"),
        ("x^2", {"a": 1}, ParameterError, "no parameter 'a'"),
        ("x^2 + ab", {"ab": 1, "abc": 1}, ParameterError, "did you mean ab"),
        ("x^2 + a", {"a": math.nan}, ParameterError, "finite"),
        ("x^2 + a", {"a": "one"}, ParameterError, "number"),
        ("x^2 + a", {"a": None}, ParameterError, "number"),
        ("x^2 + a", {"a": 1e31}, ParameterError, r"below 1e\+30"),
        ("x^2", {"x": 1}, ParameterError, "variable"),
        ("x^2", [("a", 1)], ParameterError, "mapping"),
        (BLOBS, {"c": [1.0], "r": [[1.0]]}, ArrayShapeError, "one row"),
        (BLOBS, {"c": [], "r": []}, ArrayShapeError, "one row"),
        (BLOBS, {"c": [1.0], "r": [math.inf]}, ArrayShapeError, "finite"),
        (BLOBS, {"c": [1.0], "r": ["a"]}, ArrayShapeError, "numbers"),
        (BLOBS, {"c": [1.0], "r": 1.0}, UnknownNameError, "not an array"),
        (None, {}, FormulaError, "NoneType"),
        (3.0, {}, FormulaError, "float"),
        (sympy.Symbol("x") * 0 + 1, {}, FormulaError, "none of the variables"),
        (sympy.Function("f")(sympy.Symbol("x")), {}, FormulaError, r"SymPy's f has no meaning"),
        (sympy.Function("f"), {}, FormulaError, "has no meaning"),
        (lambda x, y: x, {}, FormulaError, "2 arguments"),
        (lambda x, y, z: (x, y), {}, FormulaError, "tuple"),
        (lambda x, y, z: x if x > 0 else y, {}, FormulaError, "np.where"),
        ("x^(10^9)", {}, FormulaLimitError, "exponent"),
        ("(" * 100_000 + "x" + ")" * 100_000, {}, FormulaLimitError, "at most"),
        ("+".join(["x"] * 1_000_000), {}, FormulaLimitError, "at most"),
        ("3", {}, FormulaError, "none of the variables"),
    ],
)
def test_mistakes_are_named(source: Any, params: Any, error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        zs.surface(source, params)


def test_unknown_parameters_of_a_surface_are_named() -> None:
    with pytest.raises(ParameterError, match="it has alpha"):
        zs.surface("x + alpha", {"alpha": 1.0}).with_params(alhpa=2)


def test_bounds_are_checked_at_once() -> None:
    with pytest.raises(BoundsError, match="radius"):
        zs.surface("x", bounds=-1)
    with pytest.raises(BoundsError, match="empty"):
        zs.surface("x").with_bounds(zs.Box((0, 0, 0), (1, 1, 0)))


def test_a_long_formula_has_a_short_repr() -> None:
    surface = zs.surface(" + ".join(f"sin({i}x)" for i in range(200)))
    assert len(repr(surface)) < 100
    assert repr(zs.surface("x^2 - y")) == "<zeroset.Surface 'x^2 - y'>"


def test_the_gallery_is_a_mapping_of_surfaces() -> None:
    assert len(zs.gallery) == len(list(zs.gallery)) > 50
    assert zs.gallery["cayley"].name == "cayley"
    assert "chmutov-15" in zs.gallery
    assert "cayle" not in zs.gallery
    assert 5 not in zs.gallery
    with pytest.raises(UnknownSurfaceError, match="did you mean cayley"):
        zs.gallery["cayle"]
    with pytest.raises(UnknownSurfaceError, match="no 5"):
        zs.gallery[5]  # type: ignore[index]


def test_expressions_survive_pickling() -> None:
    expr = zs.surface("x^2 + sin(y)").field.expr
    assert pickle.loads(pickle.dumps(expr)) is expr


def test_an_argument_that_a_function_makes_no_use_of_is_no_parameter() -> None:
    ball = zs.surface(lambda x, y, z, r=1.0, spare=3.0: x**2 + y**2 + z**2 - r)
    assert dict(ball.params) == {"r": 1.0}
    with pytest.raises(zs.errors.ParameterError, match="no parameter 'spare'"):
        zs.surface(lambda x, y, z, spare=3.0: x, params={"spare": 2.0})


@pytest.mark.parametrize("again", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy], ids=["pickle", "deepcopy"])
def test_surfaces_solids_and_scenes_can_be_sent_and_copied(again: Callable[[Any], Any]) -> None:
    blobs = zs.gallery["blinn-blobby"]
    turned = zs.surface("x cos(a) + y sin(a) - z^2", params={"a": 0.5}, bounds=2).with_material(
        zs.Material(opacity=0.5)
    )
    for thing in (blobs, turned, turned & zs.surface("x^2 + y^2 - 1"), zs.Scene(turned, shadows=True)):
        assert again(thing) == thing
    sent = again(turned)
    with pytest.raises(TypeError):
        sent.params["a"] = 1.0


def test_names_that_simplifying_takes_away_may_have_values() -> None:
    """A formula that a program has put together: c r with c = 0."""
    made = zs.surface("0*r + z + 0*sum(i, c[i] x)", {"r": 1, "c": [1, 2]})
    assert (dict(made.params), dict(made.arrays)) == ({}, {})
    with pytest.raises(ParameterError, match="no parameter 'a'"):
        zs.surface("max(x, y)", {"a": 1})
