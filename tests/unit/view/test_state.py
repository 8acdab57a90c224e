"""The state's changes: ranges, playing, parameters."""

from __future__ import annotations

from dataclasses import replace

import pytest

import zeroset as zs
from zeroset.scene.scene import Scene
from zeroset.solve import resolve_method
from zeroset.view import item as items
from zeroset.view import state as states
from zeroset.view.levels import Level
from zeroset.view.motion import Motion, moved
from zeroset.view.spans import Span, usual_span
from zeroset.view.state import State


def opened(formula: str = "x^2 + y^2 + a*z^2 = b", **params: float) -> State:
    surface = zs.surface(formula, params or {"a": 1.0, "b": 2.0}, bounds=3.0)
    return states.opened(Scene(surface), (formula,), resolve_method("auto"), "auto", None)


@pytest.mark.parametrize("value", [1e-12, 0.3, 1.0, 4.9, 5.0, 99.0, -7.0, 1e20])
def test_the_usual_range_is_round_and_holds_the_value(value: float) -> None:
    span = usual_span(value)
    assert span.low == -span.high
    assert 2.0 * abs(value) <= span.high * (1 + 1e-9)
    assert span.high <= 5.001 * abs(value)


def test_a_slider_keeps_its_range_while_its_value_changes() -> None:
    item = items.with_param(opened().item, "a", 0.01)
    assert item.surface.params["a"] == 0.01
    assert items.span_of(item, "a") == Span(-2.0, 2.0)
    assert item.surface.field.digest == opened().item.surface.field.digest


def test_a_value_that_no_parameter_can_have_changes_nothing() -> None:
    item = opened().item
    assert items.with_param(item, "a", 1e35) is item


def test_a_range_can_be_edited_but_not_turned_around() -> None:
    item = items.with_span(opened().item, "a", 0.0, 8.0)
    assert items.span_of(item, "a") == Span(0.0, 8.0)
    for low, high in ((3.0, 3.0), (4.0, 1.0), (float("nan"), 1.0), (0.0, float("inf"))):
        assert items.with_span(item, "a", low, high) is item


def test_to_and_fro_comes_back_and_a_loop_begins_again() -> None:
    span, value, rising = Span(0.0, 1.0), 0.0, True
    seen = []
    for _ in range(8):
        value, rising = moved(value, span, Motion(seconds=1.0, rising=rising), 0.25)
        seen.append(round(value, 9))
    assert seen == [0.25, 0.5, 0.75, 1.0, 0.75, 0.5, 0.25, 0.0]
    loop = Motion(seconds=1.0, loop=True)
    assert moved(0.75, span, loop, 0.5)[0] == pytest.approx(0.25)


def test_playing_moves_what_plays_and_nothing_else() -> None:
    state = opened().with_item(items.with_motion(opened().item, "a", Motion(playing=True, seconds=2.0)))
    later = states.advanced(state, 0.5)
    assert later.playing
    assert later.item.surface.params["a"] == pytest.approx(2.0)
    assert later.item.surface.params["b"] == 2.0
    assert states.advanced(opened(), 1.0) == opened()


def test_the_play_key_starts_the_first_and_stops_all() -> None:
    playing = states.play_or_pause(opened())
    assert playing.item.motions["a"].playing
    stopped = states.play_or_pause(playing)
    assert not stopped.playing
    assert states.play_or_pause(stopped).playing
    plain = opened("x^2 + y^2 + w*z^2 = 1", w=0.5)
    assert states.play_or_pause(plain).item.motions["w"].playing, "w is a parameter like any other"


def test_a_window_shows_all_of_a_scene() -> None:
    glass, around = zs.Material(opacity=0.5, ior=1.5, reflectance=0.25), zs.Environment("park_{face}.png", 2.0)
    surface, camera = zs.surface("x^2 + y^2 + z^2 = 4", bounds=3), zs.Camera(eye=(0, -9, 0))
    scene = Scene(surface, camera, glass, (zs.Light(),), (0.5, 0.5, 0.5), True, around)
    state = states.opened(scene, ("",), resolve_method("auto"), "cpu", None)
    assert state.scene == scene
    assert state.picture == around
    assert opened().picture is None
    sky = states.opened(replace(scene, environment=zs.Environment("sky")), ("",), resolve_method("auto"), "cpu", None)
    assert sky.picture is None


def test_a_window_draws_inside_bounds_of_its_own() -> None:
    fitted = states.opened(Scene(zs.surface("x^2 + y^2 + z^2 = 4")), ("",), resolve_method("auto"), "cpu", None)
    assert fitted.item.refit
    assert fitted.item.surface.bounds == fitted.bounds
    assert not opened().item.refit
    assert fitted.scene.camera == fitted.home


def two() -> State:
    ball = zs.surface("x^2 + y^2 + a*z^2 = 1", {"a": 1.0}, bounds=1.5)
    ground = zs.surface("z + a", {"a": 1.0}, bounds=zs.Box((-3, -3, -1.1), (3, 3, -0.9)))
    scene = Scene([ball, ground.with_material(zs.Material(reflectance=0.25))])
    return states.opened(scene, ("ball", "ground"), resolve_method("auto"), "cpu", None)


def test_several_surfaces_are_drawn_as_the_scene_says() -> None:
    state = two()
    ball, ground = state.scene.surface.surfaces
    assert (ball.material, ground.material) == (None, zs.Material(reflectance=0.25))
    assert state.scene.materials == (zs.Material(), zs.Material(reflectance=0.25))
    assert state.bounds == zs.Scene([ball, ground]).surface.fitted
    assert [item.text for item in state.items] == ["ball", "ground"]
    # A material for all becomes each one's, so that one of them can be changed.
    green = zs.Material(front=(0, 1, 0))
    dyed = states.opened(Scene([ball, ball], material=green), ("", ""), resolve_method("auto"), "cpu", None)
    assert dyed.scene.materials == (green, green)
    assert dyed.edited(material=zs.Material()).scene.materials == (zs.Material(), green)


def test_panels_act_on_the_chosen_surface_alone() -> None:
    state = replace(two(), chosen=1)
    changed = state.with_item(items.with_param(state.item, "a", 0.5)).edited(material=zs.Material(opacity=0.5))
    assert [item.surface.params["a"] for item in changed.items] == [1.0, 0.5]
    assert [material.opacity for material in changed.scene.materials] == [1.0, 0.5]
    assert changed.items[0] is state.items[0]


def test_a_surface_more_and_one_less() -> None:
    state = states.with_another_item(two())
    assert (state.chosen, len(state.items)) == (2, 3)
    assert len({item.key for item in state.items}) == 3
    # Under all that is there.
    assert state.item.surface.params["c"] == pytest.approx(two().bounds.center[2] - two().bounds.reach, rel=0.1)
    assert len(state.scene.surface.surfaces) == 3
    assert states.without_item(state, 2).items == two().items
    for place, chosen in ((0, 1), (1, 1), (2, 1)):
        assert states.without_item(state, place).chosen == chosen
    left = states.without_item(replace(state, chosen=0), 0)
    assert (left.chosen, left.item.text) == (0, "ground")
    one = states.without_item(left, 1)
    assert states.without_item(one, 0) is one
    assert isinstance(one.scene.surface, zs.Surface)
    assert one.scene.material == zs.Material(reflectance=0.25)


def test_a_quantity_colours_one_surface_among_others() -> None:
    by, other = zs.Coloring("gaussian-curvature"), zs.Coloring("z", "ember")
    state = states.with_another_item(opened().edited(material=zs.Material(coloring=by)))
    assert [material.coloring for material in state.scene.materials] == [by, None]
    assert states.without_item(state, 1).scene.material.coloring == by
    # A picture has one coloring: another one is that of all that are coloured.
    both = state.colored_by(other)
    assert [material.coloring for material in both.scene.materials] == [other, other]
    first = replace(both, chosen=0)
    assert [material.coloring for material in first.colored_by(by).scene.materials] == [by, by]
    assert [material.coloring for material in first.colored_by(None).scene.materials] == [None, other]
    again = states.opened(both.scene, ("", ""), both.method, "auto", None)
    assert again.scene == both.scene


def test_a_formula_that_means_nothing_any_more_colours_nothing() -> None:
    state = states.with_another_item(opened().colored_by(zs.Coloring("nobody*x")))
    assert [material.coloring for material in state.scene.materials] == [None, None]
    # The plane that was added has a parameter c.
    by = zs.Coloring("c*x")
    assert state.colored_by(by).scene.colored is not None
    assert states.without_item(state.colored_by(by), 1).scene.coloring is None


def test_isovalues_keep_the_users_order_and_the_surface_has_them_rising() -> None:
    levels = Level(2.0, (1, 0, 0)), Level(-1.0, (0, 1, 0))
    state = opened().with_item(items.with_levels(opened().item, levels))
    assert state.item.levels == levels
    shown = state.scene.surface.surfaces[0]
    assert (shown.isovalues, shown.colors) == ((-1.0, 2.0), ((0, 1, 0), (1, 0, 0)))
    assert [material.front for material in state.scene.materials] == [(0, 1, 0), (1, 0, 0)]
    again = states.opened(state.scene, ("",), state.method, "auto", None)
    assert again.scene == state.scene
    # What cannot be changes nothing.
    for value in (2.0, float("inf"), 1e35):
        assert items.with_levels(state.item, (levels[0], Level(value, (0, 0, 0)))) is state.item
    assert items.with_levels(state.item, ()).drawn == opened().item.surface


def test_the_first_isovalue_comes_beside_0_and_there_is_an_end_to_them() -> None:
    state = states.with_another_level(opened())
    values = [level.value for level in state.item.levels]
    assert values[0] == 0.0
    assert len(set(values)) == 2
    assert state.item.level_span.low <= min(values) < max(values) <= state.item.level_span.high
    for _ in range(40):
        state = states.with_another_level(state)
    assert len(state.scene.materials) == 16
    state = states.with_another_item(state)
    for _ in range(40):
        state = states.with_another_item(states.with_another_level(state))
    assert state.full
    assert len(state.scene.materials) == 32
