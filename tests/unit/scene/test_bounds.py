from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from zeroset.errors import BoundsError
from zeroset.scene.bounds import Ball, Box, parse_bounds


@pytest.mark.parametrize(
    ("given", "made"),
    [
        (None, None),
        (2, Ball(2.0)),
        (np.float32(0.5), Ball(0.5)),
        (Ball(1.0, (1, 2, 3)), Ball(1.0, (1.0, 2.0, 3.0))),
        ({"radius": 2}, Ball(2.0)),
        ({"radius": 2, "center": [1, 0, 0]}, Ball(2.0, (1.0, 0.0, 0.0))),
        ({"min": [0, 0, 0], "max": [1, 2, 3]}, Box((0.0, 0.0, 0.0), (1.0, 2.0, 3.0))),
        ([0, 0, 0, 1, 2, 3], Box((0.0, 0.0, 0.0), (1.0, 2.0, 3.0))),
        ([(0, 0, 0), (1, 2, 3)], Box((0.0, 0.0, 0.0), (1.0, 2.0, 3.0))),
        (np.array([[0, 0, 0], [1, 2, 3]]), Box((0.0, 0.0, 0.0), (1.0, 2.0, 3.0))),
    ],
)
def test_what_users_write(given: Any, made: Any) -> None:
    assert parse_bounds(given) == made


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (0, "radius"),
        (-1.0, "radius"),
        (math.nan, "finite"),
        (math.inf, "finite"),
        (1e-40, "radius"),
        (1e16, "radius"),
        ("wide", "number"),
        (object(), "number"),
        (10**400, "number"),
        ([1, 2, 3], "two corners"),
        (np.array([1.0, 2.0, 3.0]), "two corners"),
        ([1, 2], "two corners of three numbers each, not 1 and 2"),
        ([[1, 2], [3, 4]], "lower corner"),
        ({"radius": "wide"}, "radius"),
        ({"radius": 1, "size": 2}, "radius, size"),
        ({}, "nothing"),
        ({"min": [0, 0, 0]}, "min and max"),
        ([(0, 0, 0), (1, 0, 1)], "empty"),
        ([(0, 0, 0), (1, math.inf, 1)], "finite"),
        ([(0, 0, 0), (1, 1e15, 1)], "below 1e"),
        (1e15, r"at least 1e-15 and below 1e\+15, not"),
        (1e-16, "at least 1e-15"),
    ],
)
def test_bad_bounds_are_refused(given: Any, said: str) -> None:
    with pytest.raises(BoundsError, match=said):
        parse_bounds(given)


def test_the_measures_of_a_ball_and_of_a_box() -> None:
    ball, box = Ball(2.0, (1.0, 0.0, 0.0)), Box((-1.0, 0.0, 0.0), (1.0, 2.0, 1.0))
    assert (ball.extent, ball.reach, ball.center) == (4.0, 2.0, (1.0, 0.0, 0.0))
    assert (box.extent, box.reach, box.center) == (3.0, 1.5, (0.0, 1.0, 0.5))
