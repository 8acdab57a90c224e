from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.scene.bounds import Ball
from zeroset.scene.fit import UNBOUNDED


@pytest.mark.parametrize("radius", [1e-4, 0.01, 0.5, 3.0, 20.0, 1000.0, 1e5])
def test_a_sphere_gets_a_ball_a_little_larger(radius: float) -> None:
    bounds = zs.surface("x^2 + y^2 + z^2 = r^2", {"r": radius}).fitted
    assert isinstance(bounds, Ball)
    assert bounds.center == (0.0, 0.0, 0.0)
    assert radius < bounds.radius < 1.4 * radius


def test_a_surface_away_from_the_origin_is_found() -> None:
    bounds = zs.surface("(x - 10)^2 + (y + 7)^2 + z^2 = 1").fitted
    assert np.linalg.norm(np.subtract(bounds.center, (10, -7, 0))) < 0.5
    assert np.linalg.norm(np.subtract(bounds.center, (10, -7, 0))) + 1 < bounds.reach < 2.5


def test_so_is_one_far_away() -> None:
    bounds = zs.surface("(x - 1000)^2 + (y + 500)^2 + z^2 = 1").fitted
    assert np.linalg.norm(np.subtract(bounds.center, (1000, -500, 0))) + 1 < bounds.reach < 2.5


@pytest.mark.parametrize("distance", [30, 100, 50_000])
def test_what_goes_on_for_ever_and_begins_far_out_is_in_sight(distance: int) -> None:
    assert distance < zs.surface(f"x = {distance}").fitted.reach < 10 * distance


@pytest.mark.parametrize("formula", ["z", "sin(x) + sin(y) + sin(z)", "x*y*z", "y^2 + z^2 = 1"])
def test_what_goes_on_for_ever_is_shown_around_the_origin(formula: str) -> None:
    assert zs.surface(formula).fitted == Ball(UNBOUNDED) == Ball(6.0)


@pytest.mark.parametrize("formula", ["x^2 + y^2 + z^2 + 1", "exp(x) + 1", "sqrt(x) + 1"])
def test_where_there_is_no_zero_the_unit_ball_does(formula: str) -> None:
    assert zs.surface(formula).fitted == Ball(1.0)


def test_sums_over_arrays_and_time_are_fitted_too() -> None:
    surface = zs.surface("sum(i, 1/((x - c[i])^2 + y^2 + z^2)) = 1 + w", {"c": [-2.0, 2.0]})
    assert 2.9 < surface.fitted.reach < 5
    assert surface.with_params(w=3.0).fitted.reach < surface.fitted.reach


def test_terms_that_cancel_far_out_are_seen_to() -> None:
    """Along its diagonals no interval of a sixteenth of the distance excludes it."""
    terms = "x^4 + y^4 + z^4 + a*(x^2 + y^2 + z^2)^2 + b*(x^2 + y^2 + z^2) + c"
    goursat = zs.surface(terms, {"a": -0.25, "b": -1.0, "c": 0.4})
    assert 3.4 < goursat.fitted.reach < 4.5
    assert 3.0 < (goursat & zs.surface("x")).fitted.reach < 4.5


def test_bounds_that_were_given_are_kept() -> None:
    assert zs.surface("z", bounds=0.25).fitted == Ball(0.25)
