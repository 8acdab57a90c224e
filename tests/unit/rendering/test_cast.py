from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import zeroset as zs
from zeroset.errors import ArrayShapeError, DeviceError, MethodError, ParameterError

BALL = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5)


def test_shapes_and_types() -> None:
    hits = zs.cast(BALL, np.tile([0, 0, 3], (4, 1)), [[0, 0, -1], [0, 0, 1], [0.1, 0, -1], [1, 0, 0]])
    assert hits.status.tolist() == [1, 0, 1, 0]
    assert (hits.t.shape, hits.t.dtype) == ((4,), np.float32)
    assert (hits.status.shape, hits.status.dtype) == ((4,), np.uint8)
    assert (hits.normal.shape, hits.normal.dtype) == ((4, 3), np.float32)
    assert (hits.steps.shape, hits.steps.dtype) == ((4,), np.uint32)
    assert hits.certified
    assert len(hits) == 4
    assert np.isnan(hits.t[1])


def test_one_origin_or_one_direction_serves_all() -> None:
    eye, down = [0, 0, 3], [0, 0, -1]
    assert zs.cast(BALL, eye, down).t.shape == (1,)
    assert zs.cast(BALL, eye, [down] * 3).t.shape == (3,)
    assert zs.cast(BALL, [eye] * 5, down).t.shape == (5,)
    assert zs.cast(BALL, np.zeros((0, 3)), down).t.shape == (0,)


def test_t_is_in_units_of_the_direction() -> None:
    down = np.array([[0.0, 0, -1]])
    for scale in (1e-9, 0.5, 4.0, 1e9):
        assert zs.cast(BALL, [0, 0, 3], down * scale).t[0] * scale == pytest.approx(2, abs=1e-3)


def test_formulas_and_scenes_are_cast_at_too() -> None:
    for target in ("x^2 + y^2 + z^2 = 1", zs.Scene(BALL)):
        assert zs.cast(target, [0, 0, 3], [0, 0, -1]).status[0] == zs.HIT


def test_what_is_found_does_not_change_with_the_next_cast() -> None:
    first = zs.cast(BALL, [0, 0, 3], [0, 0, -1])
    kept = first.t.copy(), first.normal.copy(), first.steps.copy()
    zs.cast(BALL, [0, 0, 2.5], [0, 0.1, -1])
    for now, then in zip((first.t, first.normal, first.steps), kept, strict=True):
        assert np.array_equal(now, then)


@pytest.mark.parametrize(
    ("origins", "directions", "said"),
    [
        ([0, 0], [0, 0, 1], "origins must have the shape"),
        ([[0, 0, 0, 0]], [0, 0, 1], "origins must have the shape"),
        (np.zeros((2, 2, 3)), [0, 0, 1], "origins must have the shape"),
        ("here", [0, 0, 1], "origins must be numbers"),
        ([[0, 0, 0], [0, 0]], [0, 0, 1], "origins must be numbers"),
        ([0, 0, math.nan], [0, 0, 1], "origins must be finite"),
        ([0, 0, 1e31], [0, 0, 1], "origins must be below 1e30"),
        ([0, 0, 0], [[0, 0, 1], [0, math.inf, 1]], "number 1"),
        ([0, 0, 0], [[0, 0, 1], [0, 0, 0]], "direction 1 is zero"),
        ([0, 0, 0], [0, 0, 1e-40], "too short"),
        (np.zeros((3, 3)), np.ones((2, 3)), "3 origins but 2 directions"),
        ([0, 0, 1j], [0, 0, 1], "origins must be numbers"),
    ],
)
@pytest.mark.filterwarnings("ignore::numpy.exceptions.ComplexWarning")
def test_bad_rays_are_refused(origins: Any, directions: Any, said: str) -> None:
    with pytest.raises(ArrayShapeError, match=said):
        zs.cast(BALL, origins, directions)


@pytest.mark.parametrize(
    ("options", "error", "said"),
    [
        ({"tolerance": 0}, ParameterError, "tolerance"),
        ({"tolerance": -1.0}, ParameterError, "tolerance"),
        ({"tolerance": math.nan}, ParameterError, "tolerance"),
        ({"tolerance": "fine"}, ParameterError, "tolerance"),
        ({"t_min": math.nan}, ParameterError, "t_min"),
        ({"t_max": "far"}, ParameterError, "t_max"),
        ({"method": "magic"}, MethodError, "magic"),
        ({"device": "gpuu"}, DeviceError, "gpuu"),
    ],
)
def test_bad_options_are_refused(options: dict[str, Any], error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        zs.cast(BALL, [0, 0, 3], [0, 0, -1], **options)
