"""Solids told by formulas that are defined everywhere: they hold the same points."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import zeroset as zs
from zeroset.expr import closed, parse, postorder, text

FORMULAS = [
    "z - sqrt(1 - x^2 - y^2)",
    "log(x) + y",
    "x^1.5 - z",
    "acos(2x) - 1 + asin(y + z)",
    "1/x - 1",
    "1/(x^2 - y) + sqrt(z)",
    "tan(3x) - y",
    "sqrt(log(x + 1)) - y",
    "-(1/(x - 1/3))",
    "max(sqrt(x) - 1, y)",
    "x^y - z",
]
NAMES: dict[str, Any] = {name: getattr(np, name) for name in ("sqrt", "log", "tan", "sin", "cos", "abs")}
NAMES |= {"acos": np.arccos, "asin": np.arcsin, "max": np.maximum, "min": np.minimum}


def value(formula: str, points: np.ndarray[Any, Any]) -> Any:
    with np.errstate(all="ignore"):
        return eval(formula.replace("^", "**"), {}, NAMES | dict(zip("xyz", points.T, strict=True)))


@pytest.mark.parametrize("formula", FORMULAS)
def test_it_holds_the_same_points(formula: str) -> None:
    f = parse(formula)
    points = np.random.default_rng(1).uniform(-1.5, 1.5, (4000, 3))
    inside, told = value(text(f), points) <= 0, value(text(closed(f)), points)
    assert np.all(np.isfinite(told))
    assert 0.02 < inside.mean() < 0.98
    assert np.array_equal(told <= 0, inside)


def test_what_is_defined_everywhere_stays_as_it_is() -> None:
    for formula in ("x^2 + y^2 - 1", "sqrt(x^2 + y^2) - 1", "exp(x) - log(1 + y^2)"):
        f = parse(formula)
        assert closed(f) is f


@pytest.mark.parametrize("formula", ["if(x > 0, sqrt(x), 1) - y", "sum(i, sqrt(x - c[i])) - y"])
def test_choices_and_sums_stay_as_they_are(formula: str) -> None:
    f = parse(formula, arrays={"c"} if "c[" in formula else set())
    assert set(postorder(closed(f))) == set(postorder(f))


BALL, CUBE = "x^2 + y^2 + z^2 - 1", "max(|x|, |y|, |z|) - 0.9"


@pytest.mark.parametrize(
    ("whole", "part", "volume"),
    [
        # Half a ball: behind the pole, 1/x - 1 is below 0; and nothing of the ball has x > 1.
        (BALL, "1/x - 1", 2 * math.pi / 3),
        # Where x > 1/2 and x <= 1/2 + 1/16: a slice of the ball.
        (BALL, "sqrt(x - 1/2) - 1/4", math.pi * (1 / 16 - ((9 / 16) ** 3 - (1 / 2) ** 3) / 3)),
        (CUBE, "log(x + 1/2) - log(1)", 1.0 * 1.8**2),
    ],
)
def test_the_mesh_of_a_solid_with_such_a_part_is_closed(whole: str, part: str, volume: float) -> None:
    solid = (zs.surface(whole) & zs.surface(part)).with_bounds(1.7)
    mesh = zs.mesh(solid, resolution=72, device="cpu")
    corners = mesh.vertices.astype(float)[mesh.faces]
    found = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert mesh.watertight
    assert found == pytest.approx(volume, rel=0.03)
