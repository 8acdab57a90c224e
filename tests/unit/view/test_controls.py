"""Mouse and keys, as events from a canvas."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import zeroset as zs
from zeroset.scene.scene import Scene
from zeroset.solve import resolve_method
from zeroset.view import orbit
from zeroset.view.controls import Controls, Pane, pick
from zeroset.view.painting import Picture, Shot, paint
from zeroset.view.state import State, opened

PANE = Pane(100.0, 0.0, 300.0, 200.0)


@pytest.fixture(scope="module")
def state() -> State:
    surface = zs.surface("x^2 + y^2 + a*z^2 = 1", {"a": 1.0}, bounds=1.2)
    return opened(Scene(surface, zs.Camera(eye=(1.0, -4.0, 1.5))), ("",), resolve_method("auto"), "auto", None)


@pytest.fixture(scope="module")
def picture(state: State) -> Picture:
    shot = Shot(state.scene, (150, 100), state.method, "auto", None, "none", moving=False)
    return paint(shot, lambda: False)


def event(kind: str, x: float = 250.0, y: float = 100.0, **more: Any) -> dict[str, Any]:
    return {"event_type": kind, "x": x, "y": y, "button": 1, "modifiers": (), **more}


def drag(state: State, picture: Picture | None, button: int, dx: float, dy: float, **more: Any) -> State:
    controls = Controls()
    state = controls.handle(event("pointer_down", button=button, **more), state, PANE, picture)
    assert controls.dragging
    for part in (0.5, 1.0):
        state = controls.handle(event("pointer_move", 250 + part * dx, 100 + part * dy), state, PANE, picture)
    state = controls.handle(event("pointer_up", 250 + dx, 100 + dy, button=button), state, PANE, picture)
    assert not controls.dragging
    return controls.handle(event("pointer_move", 0, 0), state, PANE, picture)


def key(state: State, name: str, **more: Any) -> State:
    return Controls().handle({"event_type": "key_down", "key": name, "modifiers": (), **more}, state, PANE, None)


def test_the_surface_point_under_the_pointer_is_found(state: State, picture: Picture) -> None:
    point = pick(picture, PANE, 250.0, 100.0)
    assert point is not None
    assert math.hypot(*point) == pytest.approx(1.0, abs=0.02)
    place, _ = orbit.project(state.camera, PANE.size, np.array([point]))
    assert place[0] == pytest.approx((150.0, 100.0), abs=1e-6)
    assert pick(picture, PANE, 101.0, 1.0) is None
    assert pick(picture, PANE, 50.0, 100.0) is None
    assert pick(None, PANE, 250.0, 100.0) is None


def test_left_turns_about_the_target(state: State, picture: Picture) -> None:
    turned = drag(state, picture, 1, 40.0, -10.0).camera
    assert turned.target == state.camera.target
    assert turned.eye != state.camera.eye
    assert orbit.distance(turned) == pytest.approx(orbit.distance(state.camera))


@pytest.mark.parametrize(("button", "more"), [(2, {}), (3, {}), (1, {"modifiers": ("Shift",)})], ids=str)
def test_right_middle_and_shift_left_take_the_surface_along(
    state: State, picture: Picture, button: int, more: dict[str, Any]
) -> None:
    point = pick(picture, PANE, 250.0, 100.0)
    moved = drag(state, picture, button, 40.0, -10.0, **more).camera
    assert point is not None
    place, _ = orbit.project(moved, PANE.size, np.array([point]))
    assert place[0] == pytest.approx((190.0, 90.0), abs=1e-6)


def test_a_drag_that_begins_beside_the_picture_is_none(state: State, picture: Picture) -> None:
    controls = Controls()
    assert controls.handle(event("pointer_down", 50.0), state, PANE, picture) == state
    assert controls.handle(event("pointer_move", 300.0), state, PANE, picture) == state


@pytest.mark.parametrize("flat", [False, True], ids=["perspective", "orthographic"])
def test_the_wheel_zooms_to_the_pointer(state: State, picture: Picture, flat: bool) -> None:
    if flat:
        state = replace(state, camera=orbit.orthographic(state.camera))
        picture = replace(picture, shot=replace(picture.shot, scene=state.scene))
    point = pick(picture, PANE, 265.0, 90.0)
    assert point is not None
    nearer = Controls().handle(event("wheel", 265.0, 90.0, dx=0.0, dy=-300.0), state, PANE, picture)
    place, _ = orbit.project(nearer.camera, PANE.size, np.array([point]))
    assert place[0] == pytest.approx((165.0, 90.0), abs=1e-6)
    assert nearer.camera != state.camera
    if not flat:
        assert math.dist(nearer.camera.eye, point) < 0.7 * math.dist(state.camera.eye, point)


def test_the_wheel_never_leaves_reach(state: State) -> None:
    for dy in (-2000.0, 2000.0):
        far = state
        for _ in range(200):
            far = Controls().handle(event("wheel", dx=0.0, dy=dy), far, PANE, None)
        assert 1e-6 < orbit.distance(far.camera) < 1e5
        assert np.isfinite(far.camera.eye).all()


def test_a_double_click_makes_the_point_the_target(state: State, picture: Picture) -> None:
    aimed = Controls().handle(event("double_click"), state, PANE, picture)
    assert math.hypot(*aimed.camera.target) == pytest.approx(1.0, abs=0.02)
    beside = Controls().handle(event("double_click", 105.0, 5.0), state, PANE, picture)
    assert beside == state


def test_keys(state: State) -> None:
    moved = replace(state, camera=orbit.turn(state.camera, 50.0))
    assert key(moved, "r").camera == state.home
    assert key(moved, "F").camera == orbit.fit(moved.camera, state.bounds)
    assert key(state, "5").camera == orbit.along(state.camera, orbit.AXES["5"])
    assert key(state, "o").camera.height is not None
    assert key(key(state, "o"), "o").camera.fov == pytest.approx(35.0)
    assert key(state, " ").playing
    assert key(state, "h").help
    assert not key(key(state, "h"), "Escape").help
    assert key(state, "r", modifiers=("Control",)) == state
    assert key(state, "F12") == state


def test_flight(state: State) -> None:
    flying = key(key(state, "o"), "g")
    assert flying.flying
    assert flying.camera.height is None, "whoever flies sees in perspective"
    controls = Controls()
    for name in ("w", "e"):
        controls.handle({"event_type": "key_down", "key": name, "modifiers": ()}, flying, PANE, None)
    moved = controls.flown(flying, 0.5)
    *_, forward = orbit.frame(flying.camera)
    assert np.dot(np.subtract(moved.camera.eye, flying.camera.eye), forward) > 0
    slow = controls.flown(replace(flying, fly_speed=0.5), 0.5)
    assert math.dist(slow.camera.eye, flying.camera.eye) == pytest.approx(
        0.5 * math.dist(moved.camera.eye, flying.camera.eye)
    )
    controls.handle({"event_type": "key_up", "key": "W", "modifiers": ()}, flying, PANE, None)
    controls.handle({"event_type": "key_up", "key": "e", "modifiers": ()}, flying, PANE, None)
    assert controls.flown(flying, 0.5) is flying
    assert not key(flying, "Escape").flying
    looked = drag(flying, None, 1, 30.0, 0.0).camera
    assert looked.eye == flying.camera.eye
    faster = controls.handle(event("wheel", dx=0.0, dy=-100.0), flying, PANE, None)
    assert faster.fly_speed > flying.fly_speed
    assert faster.camera == flying.camera


def test_letting_go_of_everything() -> None:
    controls = Controls()
    controls.keys.add("w")
    controls.release()
    assert not controls.keys


def test_unknown_events_change_nothing(state: State) -> None:
    assert Controls().handle({"event_type": "resize"}, state, PANE, None) is state
