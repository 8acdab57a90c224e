"""Lines over the picture: what they trace, and where the surface hides them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import zeroset as zs
from zeroset.scene.scene import Scene
from zeroset.solve import resolve_method
from zeroset.view.lines import GRID_COLOR, OUTLINE_COLOR, strokes
from zeroset.view.painting import Picture, Shot, paint
from zeroset.view.spans import nice_step
from zeroset.view.state import State, opened

SIZE = (200.0, 150.0)


def shown(surface: zs.Surface, **changes: bool) -> tuple[State, Picture]:
    scene = Scene(surface, zs.Camera(eye=(0.0, -6.0, 0.0), fov=40.0))
    state = replace(opened(scene, ("",), resolve_method("auto"), "auto", None), **changes)
    return state, paint(Shot(state.scene, (200, 150), state.method, "auto", None, "none", False), lambda: False)


def test_an_axis_is_hidden_inside_the_ball_and_seen_outside() -> None:
    made, labels = strokes(*shown(zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5), axes=True), SIZE)
    assert [label.text for label in labels] == ["x", "y", "z"]
    red = [stroke for stroke in made if stroke.color == made[0].color]
    assert [stroke.hidden for stroke in red] == [False, True, False]
    # The ball's edge is at 100 -+ 34.8 pixels; pieces are a thirty-second of the axis long.
    assert red[1].points[0, 0] == pytest.approx(65.2, abs=4.0)
    assert red[1].points[-1, 0] == pytest.approx(134.8, abs=4.0)


def test_a_box_has_twelve_edges() -> None:
    empty = zs.surface("x^2 + y^2 + z^2 + 1", bounds=zs.Box((-1, -1, -1), (1, 1, 1)))
    made, _ = strokes(*shown(empty, outline=True), SIZE)
    assert len(made) == 12
    assert all(not stroke.hidden and stroke.color == OUTLINE_COLOR for stroke in made)


def test_a_balls_circles_have_its_radius() -> None:
    made, _ = strokes(*shown(zs.surface("x^2 + y^2 + z^2 + 1", bounds=2.0), outline=True), SIZE)
    facing = max(made, key=lambda stroke: np.ptp(stroke.points, axis=0).min())
    # The circle facing the camera is seen with a radius of 2 at a distance of 6.
    assert np.ptp(facing.points[:, 0]) == pytest.approx(2 * 2 / 6 / np.tan(np.radians(20)) * 75, rel=0.01)


def test_the_grid_lies_at_round_places() -> None:
    empty = zs.surface("x^2 + y^2 + z^2 + 1", bounds=3.3)
    state, picture = shown(empty, grid=True)
    made, _ = strokes(state, picture, SIZE)
    assert len(made) >= 10
    assert {stroke.color for stroke in made} == {GRID_COLOR}


@pytest.mark.parametrize("length", [1e-6, 0.7, 3.0, 12.0, 9.9e7])
def test_steps_are_round_and_few(length: float) -> None:
    step = nice_step(length)
    assert 2 <= length / step <= 11
    assert float(f"{step:.0e}") == pytest.approx(step)


def test_lines_behind_the_eye_are_left_out() -> None:
    state, picture = shown(zs.surface("x^2 + y^2 + z^2 + 1", bounds=20.0), axes=True, outline=True, grid=True)
    made, _ = strokes(state, picture, SIZE)
    assert all(np.isfinite(stroke.points).all() for stroke in made)
