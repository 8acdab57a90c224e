from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

import zeroset as zs
from zeroset.export.film.storyboard import digest, paths, source_scene, storyboard, timing


def board(surface: Any, count: int = 4, vary: Mapping[str, Any] | None = None, **options: Any) -> list[zs.Scene]:
    moving = paths(vary)
    return storyboard(source_scene(surface, moving, options.get("params")), count, moving, **options)


def test_timing() -> None:
    assert timing(None, None, 30) == (120, 30)
    assert timing(None, 0.5, 25) == (12, 25)
    assert timing(7, None, 29.97) == (7, pytest.approx(29.97))


@pytest.mark.parametrize(
    ("frames", "duration", "fps", "said"),
    [
        (0, None, 30, "at least one, not 0"),
        (2.5, None, 30, "whole number of frames"),
        (10, 2.0, 30, "either a number of frames or a duration"),
        (None, 0, 30, "more than 0 seconds"),
        (None, float("inf"), 30, "must be finite"),
        (None, None, 0, "from 0.01 to 240"),
        (None, None, "fast", "must be a number"),
        (None, 1e6, 30, "more than 100,000"),
    ],
)
def test_impossible_timing(frames: Any, duration: Any, fps: Any, said: str) -> None:
    with pytest.raises(zs.errors.ParameterError, match=said):
        timing(frames, duration, fps)


def test_several_parameters_move_at_once() -> None:
    scenes = board("x^2 + a*y^2 + z^2 = b", 3, {"a": (1, 3), "b": "2:4:ping-pong"})
    assert [s.surface.params["a"] for s in scenes] == [1, 2, 3]
    assert [s.surface.params["b"] for s in scenes] == pytest.approx([2, 2 + 4 / 3, 2 + 4 / 3])
    assert len({id(s.surface.field) for s in scenes}) == 1


def test_arrays_move_by_a_function() -> None:
    def moved(s: float) -> Mapping[str, Any]:
        return {"c": [s, -s]}

    scenes = board("sum(i, 0.1/((x - c[i])^2 + y^2 + z^2)) = 1", 3, params=moved)
    assert [s.surface.arrays["c"].tolist() for s in scenes] == [[0, 0], [0.5, -0.5], [1, -1]]
    scenes = board("sum(i, 0.1/((x - c[i])^2 + y^2 + z^2)) = 1", 4, params=moved, closed=True)
    assert [s.surface.arrays["c"][0] for s in scenes] == [0, 0.25, 0.5, 0.75]


def test_bounds_that_nobody_gave_hold_the_surface_at_all_times_and_stay() -> None:
    scenes = board("x^2 + y^2 + (z - c)^2 = r^2", 24, {"r": "0.5:2:sine", "c": (0, 3)})
    bounds = scenes[0].surface.bounds
    assert isinstance(bounds, zs.Ball)
    assert all(s.surface.bounds == bounds and s.camera == scenes[0].camera for s in scenes)
    for scene in scenes:
        r, c = scene.surface.params["r"], scene.surface.params["c"]
        assert np.linalg.norm(np.subtract(bounds.center, (0, 0, c))) + r <= bounds.radius


def test_cameras() -> None:
    ball = zs.gallery["sphere"]
    a, b = zs.Camera((4, 0, 0)), zs.Camera((0, 4, 0))
    assert [s.camera for s in board(ball, 2, camera=lambda s: b if s > 0.5 else a)] == [a, b]
    assert np.allclose(board(ball, 3, camera=[a, b])[1].camera.eye, (8**0.5, 8**0.5, 0))  # type: ignore[union-attr]
    assert np.allclose(board(ball, 4, camera=a, orbit=360)[1].camera.eye, (0, 4, 0))  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({}, "nothing moves(.|\n)*it has m"),
        ({"camera": zs.Camera()}, "nothing moves"),
        ({"vary": {"n": (1, 2)}}, "no parameter 'n'(.|\n)*it has m"),
        ({"vary": {"w": (1, 2)}}, "no parameter 'w'"),
        ({"vary": [1]}, "vary must be a mapping"),
        ({"params": lambda s: {"n": s}}, "no parameter 'n'"),
        ({"params": lambda s: s}, "params must give a mapping"),
        ({"params": lambda s: {"m": float("nan") if s > 0.9 else 2.0}}, "must be finite"),
        ({"camera": lambda s: s}, "must be a Camera"),
        ({"orbit": float("nan")}, "must be finite"),
    ],
)
def test_what_cannot_move(options: dict[str, Any], said: str) -> None:
    with pytest.raises(zs.ZerosetError, match=said):
        board(zs.gallery["superquadric"], **options)


def test_an_array_does_not_move_as_a_number() -> None:
    with pytest.raises(zs.errors.ParameterError, match="cx is an array"):
        board(zs.gallery["blinn-blobby"], vary={"cx": (0, 1)})


def test_the_digest_tells_storyboards_apart() -> None:
    ball = zs.gallery["sphere"]
    first = digest(board(ball, vary={"r": (0.5, 1)}))
    assert first == digest(board(ball, vary={"r": (0.5, 1)}))
    others = [
        board(ball, vary={"r": (0.5, 0.9)}),
        board(ball, vary={"r": (0.5, 1)}, orbit=1),
        board(ball.with_bounds(1.3), vary={"r": (0.5, 1)}),
        board(zs.Scene(ball, background=(0, 0, 0)), vary={"r": (0.5, 1)}),
        board(ball, vary={"r": (0.5, 1)}, count=5),
    ]
    assert len({first, *map(digest, others)}) == 6
