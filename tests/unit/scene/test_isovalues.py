"""Isovalues of surfaces: order, colours, what is refused, bounds."""

from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.errors import ParameterError
from zeroset.scene.isovalues import PALETTE

BALL = zs.surface("x^2 + y^2 + z^2")


def test_values_rise_and_colours_go_with_them() -> None:
    red, blue = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    shells = BALL.with_isovalues((4, 1), colors=(red, blue))
    assert shells.isovalues == (1.0, 4.0)
    assert shells.colors == (blue, red)
    inner, outer = shells.materials(zs.Material(shininess=7))
    assert (inner.front, inner.back, outer.front) == (blue, blue, red)
    assert inner.shininess == 7


def test_colours_are_there_without_asking() -> None:
    assert BALL.with_isovalues((1, 2)).colors == PALETTE[:2]
    assert len(BALL.with_isovalues(range(1, 17)).colors) == 16


def test_numpy_s_numbers_are_numbers() -> None:
    assert BALL.with_isovalues(np.int64(3)).isovalues == (3.0,)
    assert BALL.with_isovalues(np.array([2.0, 1.0])).isovalues == (1.0, 2.0)


def test_none_is_the_plain_surface_again() -> None:
    assert BALL.with_isovalues((1, 2)).with_isovalues(None) == BALL
    assert BALL.with_isovalues(1) != BALL
    assert len({BALL, BALL.with_isovalues(1), BALL.with_isovalues(2)}) == 3


def test_bounds_hold_every_isovalue() -> None:
    fitted = BALL.with_isovalues((0.25, 9.0)).fitted
    assert 3.0 < fitted.reach < 1.2 * 3.0


@pytest.mark.parametrize(
    ("values", "complaint"),
    [
        ((), "from 1 to 16"),
        (range(17), "from 1 to 16"),
        ((1, 1.0), "twice"),
        ((float("nan"),), "finite"),
        ((1e31,), "below"),
        (("a",), "number"),
        ("ab", "number"),
    ],
)
def test_what_is_no_isovalue(values: object, complaint: str) -> None:
    with pytest.raises(ParameterError, match=complaint):
        BALL.with_isovalues(values)  # type: ignore[arg-type]


def test_colours_that_do_not_fit() -> None:
    with pytest.raises(ParameterError, match="2 isovalues but 1 colours"):
        BALL.with_isovalues((1, 2), colors=((1, 0, 0),))
    with pytest.raises(ParameterError, match="colour"):
        BALL.with_isovalues(1, colors=((1, 0),))
