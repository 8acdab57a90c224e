"""The state's changes: ranges, playing, parameters."""

from __future__ import annotations

from dataclasses import replace

import pytest

import zeroset as zs
from zeroset.scene.scene import Scene
from zeroset.solve import resolve_method
from zeroset.view import state as states
from zeroset.view.state import Motion, Span, State


def opened(formula: str = "x^2 + y^2 + a*z^2 = b", **params: float) -> State:
    surface = zs.surface(formula, params or {"a": 1.0, "b": 2.0}, bounds=3.0)
    return states.opened(Scene(surface), formula, resolve_method("auto"), "auto", None)


@pytest.mark.parametrize("value", [1e-12, 0.3, 1.0, 4.9, 5.0, 99.0, -7.0, 1e20])
def test_the_usual_range_is_round_and_holds_the_value(value: float) -> None:
    span = states.usual_span(value)
    assert span.low == -span.high
    assert 2.0 * abs(value) <= span.high * (1 + 1e-9)
    assert span.high <= 5.001 * abs(value)


def test_a_slider_keeps_its_range_while_its_value_changes() -> None:
    state = states.with_param(opened(), "a", 0.01)
    assert state.surface.params["a"] == 0.01
    assert states.span_of(state, "a") == Span(-2.0, 2.0)
    assert state.surface.field is opened().surface.field or state.surface.field.digest == opened().surface.field.digest


def test_a_range_can_be_edited_but_not_turned_around() -> None:
    state = states.with_span(opened(), "a", 0.0, 8.0)
    assert states.span_of(state, "a") == Span(0.0, 8.0)
    for low, high in ((3.0, 3.0), (4.0, 1.0), (float("nan"), 1.0), (0.0, float("inf"))):
        assert states.with_span(state, "a", low, high) is state


def test_to_and_fro_comes_back_and_a_loop_begins_again() -> None:
    span, value, rising = Span(0.0, 1.0), 0.0, True
    seen = []
    for _ in range(8):
        value, rising = states.moved(value, span, Motion(seconds=1.0, rising=rising), 0.25)
        seen.append(round(value, 9))
    assert seen == [0.25, 0.5, 0.75, 1.0, 0.75, 0.5, 0.25, 0.0]
    loop = Motion(seconds=1.0, loop=True)
    assert states.moved(0.75, span, loop, 0.5)[0] == pytest.approx(0.25)


def test_playing_moves_what_plays_and_nothing_else() -> None:
    state = states.with_motion(opened(), "a", Motion(playing=True, seconds=2.0))
    later = states.advanced(state, 0.5)
    assert later.playing
    assert later.surface.params["a"] == pytest.approx(2.0)
    assert later.surface.params["b"] == 2.0
    assert states.advanced(opened(), 1.0) == opened()


def test_the_play_key_starts_the_first_and_stops_all() -> None:
    playing = states.play_or_pause(opened())
    assert playing.motions["a"].playing
    stopped = states.play_or_pause(playing)
    assert not stopped.playing
    assert states.play_or_pause(stopped).playing
    plain = opened("x^2 + y^2 + w*z^2 = 1", w=0.5)
    assert states.play_or_pause(plain).motions["w"].playing, "w is a parameter like any other"


def test_a_window_shows_all_of_a_scene() -> None:
    glass, around = zs.Material(opacity=0.5, ior=1.5, reflectance=0.25), zs.Environment("park_{face}.png", 2.0)
    surface, camera = zs.surface("x^2 + y^2 + z^2 = 4", bounds=3), zs.Camera(eye=(0, -9, 0))
    scene = Scene(surface, camera, glass, (zs.Light(),), (0.5, 0.5, 0.5), True, around)
    state = states.opened(scene, "", resolve_method("auto"), "cpu", None)
    assert state.scene == scene
    assert state.picture == around
    assert opened().picture is None
    sky = states.opened(replace(scene, environment=zs.Environment("sky")), "", resolve_method("auto"), "cpu", None)
    assert sky.picture is None


def test_a_window_draws_inside_bounds_of_its_own() -> None:
    fitted = states.opened(Scene(zs.surface("x^2 + y^2 + z^2 = 4")), "", resolve_method("auto"), "cpu", None)
    assert fitted.refit
    assert fitted.surface.bounds == fitted.bounds
    assert not opened().refit
    assert fitted.scene.camera == fitted.home
