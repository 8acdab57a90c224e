"""Solids and isovalues as plain surfaces f = 0."""

from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.expr import parse, text
from zeroset.expr.renaming import renamed
from zeroset.scene.plain import merged, plain_surfaces
from zeroset.scene.solid import Solid

BALL = zs.surface("x^2 + y^2 + z^2 = r^2", params={"r": 1.0}, bounds=2.0)
ROD = zs.surface("x^2 + y^2 = r", params={"r": 0.25}, bounds=2.0)


@pytest.mark.parametrize(
    ("solid", "formula"),
    [
        (BALL & ROD, "max(x^2 + y^2 + z^2 - r^2, x^2 + y^2 - r_2)"),
        (BALL | ROD, "min(x^2 + y^2 + z^2 - r^2, x^2 + y^2 - r_2)"),
        (~BALL, "-(x^2 + y^2 + z^2 - r^2)"),
    ],
)
def test_a_solid_is_one_formula(solid: Solid, formula: str) -> None:
    one = merged(solid)
    assert one.field.digest == parse(formula, params=("r", "r_2")).digest
    assert one.params["r"] == 1.0
    assert one.bounds == solid.fitted


def test_it_has_the_solids_skin() -> None:
    """The first root along any ray is where the solid's is."""
    solid = ((BALL - ROD) | zs.surface("(x - 1)^2 + y^2 + z^2 = r", params={"r": 0.25})).with_bounds(2.0)
    draw = np.random.default_rng(5)
    eyes = draw.normal(size=(400, 3))
    eyes *= 4.0 / np.linalg.norm(eyes, axis=1, keepdims=True)
    towards = draw.uniform(-0.8, 0.8, (400, 3)) - eyes
    whole, one = (zs.cast(thing, eyes, towards, device="cpu") for thing in (solid, merged(solid)))
    certain = (whole.status != 2) & (one.status != 2)
    assert certain.sum() > 380
    assert np.array_equal(whole.status[certain], one.status[certain])
    hit = certain & (whole.status == 1)
    assert hit.sum() > 200
    assert np.abs(whole.t - one.t)[hit].max() < 1e-3


def test_parameters_of_one_name_and_value_are_one() -> None:
    other = zs.surface("(x - r)^2 + y^2 + z^2 = r^2", params={"r": 1.0})
    assert dict(merged(BALL | other).params) == {"r": 1.0}
    third = ROD.with_params(r=0.5)
    assert dict(merged((BALL - ROD) - third).params) == {"r": 1.0, "r_2": 0.25, "r_3": 0.5}


def test_arrays_and_time_are_told_apart() -> None:
    one = zs.surface("sum(i, (x - c[i])^2) - w", params={"c": [0.0, 1.0], "w": 2.0})
    two = zs.surface("sum(i, (y - c[i])^2) - w", params={"c": [0.0, 2.0], "w": 3.0})
    both = merged((one | two).with_bounds(3.0))
    assert {name: list(values) for name, values in both.arrays.items()} == {"c": [0.0, 1.0], "c_2": [0.0, 2.0]}
    assert dict(both.params) == {"w": 2.0, "w_2": 3.0}
    assert (
        both.field.digest
        == parse(
            "min(sum(i, (x - c[i])^2) - w, sum(i, (y - c_2[i])^2) - w_2)", params=("w_2",), arrays=("c", "c_2")
        ).digest
    )


def test_isovalues_are_surfaces_of_one_formula() -> None:
    shells = zs.surface("x^2 + y^2 + isovalue*z^2", params={"isovalue": 1.0}, bounds=2.0).with_isovalues((0.25, 1.0))
    inner, outer = plain_surfaces(shells)
    assert inner.field.digest == outer.field.digest
    assert inner.params["isovalue"] == outer.params["isovalue"] == 1.0
    hits = [float(zs.cast(s, [[0, 0, -5]], [[0, 0, 1]], device="cpu").t[0]) for s in (inner, outer)]
    assert hits == pytest.approx([4.5, 4.0], abs=1e-3)


def test_several_are_all_of_them() -> None:
    scene = zs.Scene([BALL, BALL - ROD, BALL.with_isovalues((0.0, 0.5))])
    assert len(plain_surfaces(scene.surface)) == 4
    assert plain_surfaces(BALL) == (BALL,)


def test_other_names() -> None:
    formula = parse("a*x + b*w + sum(k, c[k]*a)", params=("a", "b"), arrays=("c",))
    assert text(renamed(formula, {"a": "n", "c": "m", "w": "t"})) == text(
        parse("n*x + b*t + sum(k, m[k]*n)", params=("n", "b", "t"), arrays=("m",))
    )
    assert renamed(formula, {}) is formula
