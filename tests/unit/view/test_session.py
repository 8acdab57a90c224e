"""What runs behind a window, without one: as a window would drive it."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import zeroset as zs
from zeroset.rendering.frame import settle
from zeroset.view import item as items
from zeroset.view import orbit, painting
from zeroset.view import state as states
from zeroset.view.formula import Complaint
from zeroset.view.log import Log
from zeroset.view.motion import Motion
from zeroset.view.session import Session
from zeroset.view.show import scene_of, start
from zeroset.view.state import OVERLAYS

SIZE = (96, 64)
PATIENCE = 60.0


class Driver:
    """A session that is ticked until something has come about."""

    def __init__(self, source: Any, log: Path | None = None) -> None:
        state = start(*scene_of(source), zs.methods.Auto(), "cpu", None)
        self.session = Session(state, Log(log))

    def until(self, done: Callable[[Session], object]) -> None:
        end = time.monotonic() + PATIENCE
        while not done(self.session):
            assert time.monotonic() < end, "it never came about"
            self.session.tick(SIZE)
            time.sleep(0.002)

    def rest(self) -> None:
        """Wait for the full picture of the present state."""
        self.session.tick(SIZE)

        def there(session: Session) -> bool:
            picture = session.picture
            return session.resting and picture is not None and picture.shot == session._wanted

        self.until(there)

    def change(self, **changes: Any) -> None:
        """Changes of the chosen surface, and of all else."""
        own = {name: changes.pop(name) for name in ("text", "surface", "material", "refit") if name in changes}
        self.session.state = replace(self.session.state.edited(**own), **changes)

    @property
    def complaint(self) -> Complaint | None:
        return self.session.complaint(self.session.state.item)


@pytest.fixture
def driver(tmp_path: Path) -> Iterator[Driver]:
    made = Driver("x^2 + y^2 + a*z^2 = 1", tmp_path / "log.jsonl")
    yield made
    made.session.close()


def events(tmp_path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]


def test_the_picture_at_rest_is_what_render_draws(driver: Driver) -> None:
    driver.rest()
    picture, state = driver.session.picture, driver.session.state
    assert picture is not None
    assert np.array_equal(picture.pixels[..., :3], zs.render(state.scene, SIZE).pixels)
    assert picture.shot.size == SIZE
    assert picture.certified


def test_light_is_drawn_in_full_at_rest_and_cheaper_while_it_moves(driver: Driver, tmp_path: Path) -> None:
    driver.rest()
    glass = zs.Material(opacity=0.5, ior=1.25, reflectance=0.25)
    driver.change(shadows=True, environment=zs.Environment("room"), material=glass, antialias=4)
    asked: list[dict[str, Any]] = []
    with pytest.MonkeyPatch.context() as patched:
        draw = painting.render
        patched.setattr(painting, "render", lambda *args, **options: (asked.append(options), draw(*args, **options))[1])
        driver.rest()
    seen = [(one["draft"], one["antialias"], one["depth"]) for one in asked]
    assert set(seen) == {(True, 1, painting.DRAFT_DEPTH), (False, 4, None)}
    assert seen[-1][0] is False
    picture, scene = driver.session.picture, driver.session.state.scene
    assert picture is not None
    assert np.array_equal(picture.pixels[..., :3], zs.render(scene, SIZE, device="cpu", antialias=4).pixels)
    # It is saved so too, and stays for another surface.
    place = tmp_path / "picture.png"
    driver.session.state = driver.session.state.ask("save-picture", f"{place}\n")
    driver.until(lambda s: place.exists())
    assert np.array_equal(np.asarray(Image.open(place)), picture.pixels[..., :3])
    driver.session.state = driver.session.state.ask("gallery", "torus")
    driver.until(lambda s: s.state.item.surface.name == "torus")
    after = driver.session.state
    assert (after.shadows, after.environment, after.item.material) == (True, zs.Environment("room"), glass)


def test_the_last_good_picture_stays_while_the_formula_is_wrong(driver: Driver, tmp_path: Path) -> None:
    driver.rest()
    before = driver.session.picture
    driver.change(text="x^2 + y^2 +")
    driver.until(lambda s: s.complaint(s.state.item))
    assert driver.complaint is not None
    assert driver.complaint.place[1].strip() == "^"
    assert driver.session.picture is before
    driver.change(text="x^2 + y^2 + 2z^2 = 1")
    driver.rest()
    assert driver.complaint is None
    assert driver.session.picture is not before
    assert [e["event"] for e in events(tmp_path) if e["event"] != "picture"] == ["error", "formula"]


@pytest.mark.parametrize(
    "text",
    ["", "x", "x^", "1", "x^2 + y^2 + z^2 + 1", "x" * 5000, "((((", "é", "x^2 = nan", "T(999999, x)", "1/x", "x/0"],
)
def test_nothing_typed_ends_it(text: str) -> None:
    made = Driver("x^2 + y^2 + z^2 = 1")
    made.rest()
    made.change(text=text)
    made.until(lambda s: not s._boxes.waiting(s.state.items) and not s.compiling)
    made.session.tick(SIZE)
    made.change(text="x^2 + y^2 + z^2 = 2")
    made.rest()
    assert made.complaint is None
    assert made.session.picture is not None
    assert made.session.picture.hits > 0
    assert made.session.close()


def test_a_slider_needs_no_compiler(driver: Driver, monkeypatch: pytest.MonkeyPatch) -> None:
    driver.rest()
    from zeroset.codegen import llvm

    def fail(*_: object) -> None:
        raise AssertionError("compiled")

    settle()
    monkeypatch.setattr(llvm, "to_object", fail)
    for value in (1.5, 2.0, 0.5):
        driver.change(surface=driver.session.state.item.surface.with_params(a=value))
        driver.rest()
        assert driver.session.picture is not None
        assert driver.session.picture.shot.scene.surface.params["a"] == value
    assert driver.session.trouble == ""


def test_a_surface_outside_of_the_old_bounds_is_looked_for() -> None:
    made = Driver("x^2 + y^2 + z^2 = 1")
    made.rest()
    made.change(surface=made.session.state.item.surface.with_bounds(1.2), refit=False)
    made.rest()
    made.change(text="x^2 + y^2 + z^2 = 100")
    made.rest()
    assert made.session.picture is not None
    assert made.session.picture.hits > 0
    assert made.session.state.bounds.reach == pytest.approx(10.0, rel=0.15)
    assert made.session.close()


def test_bounds_of_ones_own_are_kept_while_a_formula_is_edited(driver: Driver) -> None:
    driver.rest()
    driver.change(surface=driver.session.state.item.surface.with_bounds(0.9), refit=False)
    driver.change(text="x^2 + y^2 + a*z^2 = 0.7")
    driver.rest()
    assert driver.session.state.bounds == zs.Ball(0.9)
    driver.session.state = driver.session.state.ask("fit-bounds")
    driver.until(lambda s: s.state.item.refit)
    assert driver.session.state.bounds != zs.Ball(0.9)


def test_a_gallery_surface_comes_with_its_camera_and_text(driver: Driver) -> None:
    driver.rest()
    driver.session.state = driver.session.state.ask("gallery", "torus")
    driver.until(lambda s: s.state.item.surface.name == "torus")
    driver.rest()
    state = driver.session.state
    assert state.camera == state.home == zs.gallery["torus"].camera
    assert state.item.text == "(x^2 + y^2 + z^2 + R^2 - r^2)^2 = 4R^2 (x^2 + y^2)" or "x" in state.item.text
    assert state.bounds == zs.gallery["torus"].bounds


def test_whoever_turns_while_the_compiler_works_keeps_the_view(driver: Driver) -> None:
    driver.rest()
    driver.change(text="x^2 + y^2 + a*z^2 = 0.97")
    driver.until(lambda s: s._compiler.busy)
    turned = orbit.turn(driver.session.state.camera, 40.0)
    driver.change(camera=turned)
    driver.rest()
    assert driver.session.state.camera == turned


def test_a_longer_name_can_be_declared(driver: Driver) -> None:
    driver.rest()
    driver.change(text="x^2 + y^2 + foo*z^2 = 1")
    driver.until(lambda s: s.complaint(s.state.item))
    assert driver.complaint is not None
    assert driver.complaint.offer == "foo"
    driver.session.state = driver.session.state.ask("declare", "foo")
    driver.until(lambda s: "foo" in s.state.item.surface.params)
    assert driver.complaint is None


def test_a_method_that_cannot_says_so_and_another_one_mends_it(driver: Driver) -> None:
    driver.change(text="sin(x) + y^2 + z^2 = 0.5")
    driver.rest()
    driver.change(method=zs.methods.MitchellExact())
    driver.until(lambda s: s.trouble)
    assert "degree" in driver.session.trouble or "polynomial" in driver.session.trouble
    assert driver.session.picture is not None
    driver.change(method=zs.methods.Affine())
    driver.rest()
    assert driver.session.trouble == ""


def test_overlays_change_the_picture_and_what_is_saved(driver: Driver, tmp_path: Path) -> None:
    driver.rest()
    plain = driver.session.picture
    driver.change(overlay="steps")
    driver.rest()
    assert driver.session.picture is not None
    assert plain is not None
    assert driver.session.picture.legend is not None
    assert not np.array_equal(driver.session.picture.pixels, plain.pixels)
    place = tmp_path / "steps.png"
    driver.session.state = driver.session.state.ask("save-picture", f"{place}\n")
    driver.until(lambda s: place.exists())
    assert np.array_equal(np.asarray(Image.open(place)), driver.session.picture.pixels[..., :3])


def test_scene_and_snippets(driver: Driver, tmp_path: Path) -> None:
    driver.rest()
    copied: list[str] = []
    driver.session.clipboard = lambda text: copied.append(text) is None
    place = tmp_path / "scene.toml"
    driver.change(shadows=True, environment=zs.Environment("sky", 0.5))
    state = driver.session.state
    driver.session.state = state.ask("save-scene", str(place)).ask("copy-python").ask("copy-command")
    driver.until(lambda s: place.exists())
    scene = zs.load(place)
    assert scene.surface.field.digest == state.item.surface.field.digest
    assert replace(scene, surface=state.drawn) == state.scene
    assert (scene.shadows, scene.environment) == (True, zs.Environment("sky", 0.5))
    assert copied[0].startswith("import zeroset")
    assert "zeroset render" in copied[1]
    assert driver.session.snippet == copied[1]


@pytest.mark.parametrize(
    ("what", "value"),
    [
        ("save-picture", "no/such/folder.png\n"),
        ("save-picture", "a.xyz\n"),
        ("save-picture", "a.png\n3x"),
        ("save-scene", "a.png"),
    ],
)
def test_what_cannot_be_saved_is_said(
    driver: Driver, what: str, value: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    driver.session.state = driver.session.state.ask(what, value)
    driver.until(lambda s: any(e["event"] == "error" for e in events(tmp_path)))
    driver.until(lambda s: "cannot" in s.notes.latest)


def test_playing_goes_on_and_pictures_follow(driver: Driver) -> None:
    from zeroset.view.state import play_or_pause

    driver.rest()
    driver.session.state = play_or_pause(driver.session.state)
    seen: set[float] = set()

    def moved(session: Session) -> bool:
        if session.picture is not None:
            seen.add(session.picture.shot.scene.surface.params["a"])
        return len(seen) > 5

    driver.until(moved)


def test_closing_ends_the_threads_and_the_log(tmp_path: Path) -> None:
    made = Driver("x^2 + y^2 + z^2 = 1", tmp_path / "log.jsonl")
    made.rest()
    assert made.session.close()
    assert events(tmp_path)[-1]["event"] == "closed"
    seconds = [e["seconds"] for e in events(tmp_path)]
    assert seconds == sorted(seconds)


BALL = zs.surface("x^2 + y^2 + a*z^2 = 1", {"a": 1.0}, bounds=1.5)
ROD = zs.surface("x^2 + y^2 = r^2", {"r": 0.25}, bounds=zs.Box((-1, -1, -2), (1, 1, 2)))


@pytest.fixture
def two(tmp_path: Path) -> Iterator[Driver]:
    made = Driver(zs.Scene([BALL, ROD.with_material(zs.Material(front=(0, 1, 0)))]), tmp_path / "log.jsonl")
    yield made
    made.session.close()


def drawn_like_render(driver: Driver, **options: Any) -> bool:
    """Whether the picture at rest is what ``render`` draws of the state's scene."""
    driver.rest()
    picture = driver.session.picture
    assert picture is not None
    return np.array_equal(picture.pixels[..., :3], zs.render(driver.session.state.scene, SIZE, **options).pixels)


def test_several_surfaces_are_drawn_and_each_is_edited(two: Driver, tmp_path: Path) -> None:
    assert drawn_like_render(two)
    before = two.session.state
    two.change(chosen=1)
    two.change(text="x^2 + y^2 - 2r^2")
    assert drawn_like_render(two)
    state = two.session.state
    assert state.items[0] == before.items[0]
    assert dict(state.item.surface.params) == {"r": 0.25}
    assert state.item.surface.bounds == ROD.bounds
    assert state.camera == before.camera
    two.change(surface=state.item.surface.with_params(r=0.5), material=zs.Material(opacity=0.5))
    assert drawn_like_render(two)
    full = [event for event in events(tmp_path) if event["event"] == "picture"]
    assert full[-1]["params"] == {"1.a": 1.0, "2.r": 0.5}


def test_mistakes_stand_by_their_formulas(two: Driver) -> None:
    two.rest()
    two.change(text="x +")
    two.change(chosen=1)
    two.change(text="y + foo")
    two.until(lambda s: all(s.complaint(item) for item in s.state.items))
    wrong = [two.session.complaint(item) for item in two.session.state.items]
    assert [bool(one and one.offer) for one in wrong] == [False, True]
    two.session.state = two.session.state.ask("declare", "foo")
    two.until(lambda s: "foo" in s.state.item.surface.params)
    assert two.complaint is None
    two.change(chosen=0)
    assert two.complaint is wrong[0]
    assert two.session.state.item.surface == BALL


def test_formulas_of_two_surfaces_are_read_at_once(two: Driver) -> None:
    two.rest()
    two.change(text="x^2 + y^2 + a*z^2 = 0.9")
    two.change(chosen=1)
    two.change(text="x^2 + y^2 = 0.1")
    assert drawn_like_render(two)
    assert [item.surface.formula for item in two.session.state.items] == ["x^2 + y^2 + a*z^2 - 0.9", "x^2 + y^2 - 0.1"]


def test_one_of_several_is_looked_for_where_it_is(two: Driver) -> None:
    two.rest()
    # Inside the ball nothing is seen of it, but it is there: the bounds stay.
    two.change(chosen=1)
    two.change(text="x^2 + y^2 + z^2 = 0.01")
    two.rest()
    two.change(text="x^2 + y^2 + z^2 = 0.02")
    two.rest()
    kept = two.session.state.item.surface.bounds
    two.change(text="(x - 9)^2 + y^2 + z^2 = 0.02")
    assert drawn_like_render(two)
    assert two.session.state.item.surface.bounds != kept
    assert two.session.state.item.surface.fitted.center[0] == pytest.approx(9.0, abs=0.1)
    # All of it is in view.
    assert two.session.state.bounds.center[0] == pytest.approx(4.0, abs=0.5)
    assert two.session.state.camera.target[0] == pytest.approx(4.0, abs=0.5)


def test_planes_that_are_added_stand_around_what_is_there(two: Driver) -> None:
    two.rest()
    before = two.session.state
    for _ in range(5):
        two.session.state = states.with_another_item(two.session.state)
    added = two.session.state.items[len(before.items) :]
    assert [item.text for item in added] == ["z = c", "y = c", "x = c", "z = c", "y = c"]
    places = [abs(item.surface.params["c"]) for item in added]
    assert max(places) < 2 * before.bounds.reach
    assert places[3] > places[0]
    assert max(item.surface.fitted.reach for item in added) < 5 * before.bounds.reach


def test_what_takes_a_planes_place_leaves_the_view_as_it_is(two: Driver) -> None:
    two.rest()
    two.session.state = states.with_another_item(two.session.state)
    two.rest()
    before = two.session.state
    two.change(text="x^2 + y^2 + (z - 1)^2 = 0.2")
    assert drawn_like_render(two)
    after = two.session.state
    assert after.bounds.reach < before.bounds.reach
    assert after.camera == before.camera
    assert after.home == before.home


def test_a_plane_beside_others_stays_in_its_bounds(two: Driver) -> None:
    two.rest()
    two.session.state = states.with_another_item(two.session.state)
    two.rest()
    before = two.session.state
    two.change(text="z + 1.5 + sin(x) sin(y)")
    assert drawn_like_render(two)
    assert two.session.state.item.surface.bounds == before.item.surface.bounds
    assert two.session.state.camera == before.camera


def test_a_surface_is_added_typed_over_and_removed_again(two: Driver) -> None:
    two.rest()
    two.session.state = states.with_another_item(two.session.state)
    assert drawn_like_render(two)
    assert len(two.session.state.items) == 3
    two.change(text="x^2 + z^2 = 0.1")
    assert drawn_like_render(two)
    two.change(text="x +")
    two.until(lambda s: s.complaint(s.state.item))
    two.session.state = states.without_item(two.session.state, 2)
    assert drawn_like_render(two)
    assert two.complaint is None
    two.session.state = states.without_item(two.session.state, 1)
    assert drawn_like_render(two)
    assert two.session.state.scene.surface == BALL


def test_what_is_removed_while_it_is_read_stays_away(two: Driver) -> None:
    two.rest()
    two.change(chosen=1)
    two.change(text="x^2 + y^2 + z^2 = 0.3")
    two.until(lambda s: s.compiling)
    two.session.state = states.without_item(two.session.state, 1)
    assert drawn_like_render(two)
    assert len(two.session.state.items) == 1


def test_a_gallery_surface_takes_the_place_of_the_chosen_one(two: Driver) -> None:
    two.rest()
    two.change(chosen=1)
    two.session.state = two.session.state.ask("gallery", "torus")
    two.until(lambda s: s.state.item.surface.name == "torus")
    assert drawn_like_render(two)
    state = two.session.state
    assert state.items[0].surface == BALL
    assert state.item.material == zs.Material(front=(0, 1, 0))
    assert [surface.name for surface in state.scene.surface.surfaces] == ["", "torus"]


def test_every_surface_plays_its_own_parameters(two: Driver) -> None:
    two.rest()
    moving = items.with_motion(two.session.state.items[1], "r", Motion(playing=True))
    two.session.state = two.session.state.with_item(moving)
    two.until(lambda s: s.state.items[1].surface.params["r"] > 0.3)
    assert two.session.state.items[0].surface.params["a"] == 1.0


@pytest.mark.parametrize("overlay", OVERLAYS)
def test_overlays_of_several_surfaces_and_isovalues(overlay: str) -> None:
    shells = zs.surface("x^2 + y^2 + z^2", bounds=1.5).with_isovalues((0.5, 1.5))
    made = Driver(zs.Scene([shells.with_material(zs.Material(opacity=0.5)), ROD]))
    made.change(overlay=overlay, axes=True, outline=True)
    made.rest()
    picture = made.session.picture
    assert picture is not None
    assert picture.hits > 0
    assert len(np.unique(picture.pixels.reshape(-1, 4), axis=0)) > (1 if overlay == "unresolved" else 8)
    assert (picture.legend is None) == (overlay in ("none", "unresolved", "normals"))
    assert made.session.close()


@pytest.fixture
def shells(tmp_path: Path) -> Iterator[Driver]:
    surface = zs.surface("x^2 + y^2 + a*z^2", {"a": 1.0}, bounds=2.0).with_isovalues((2.0, 0.5))
    made = Driver(surface.with_material(zs.Material(opacity=0.5)), tmp_path / "log.jsonl")
    yield made
    made.session.close()


def test_isovalues_are_drawn_and_other_values_need_no_compiler(shells: Driver, monkeypatch: pytest.MonkeyPatch) -> None:
    assert drawn_like_render(shells)
    from zeroset.codegen import llvm

    def fail(*_: object) -> None:
        raise AssertionError("compiled")

    settle()
    with monkeypatch.context() as patched:
        patched.setattr(llvm, "to_object", fail)
        item = shells.session.state.item
        green = replace(item.levels[0], color=(0.0, 1.0, 0.0))
        for value in (1.0, 3.0, 0.25):
            # It passes the other one on its way.
            state = shells.session.state
            shells.session.state = state.with_item(
                items.with_levels(item, (replace(green, value=value), item.levels[1]))
            )
            assert drawn_like_render(shells)
            assert sorted(shells.session.state.scene.surface.surfaces[0].isovalues) == sorted((value, 2.0))
    shells.session.state = states.with_another_level(shells.session.state)
    assert drawn_like_render(shells)
    assert len(shells.session.state.scene.materials) == 3
    shells.session.state = shells.session.state.with_item(items.with_levels(shells.session.state.item, ()))
    assert drawn_like_render(shells)
    assert shells.session.trouble == ""


def test_isovalues_stay_for_a_formula_that_is_typed_and_go_with_one_of_the_gallery(shells: Driver) -> None:
    shells.rest()
    levels = shells.session.state.item.levels
    shells.change(text="x^2 + 2y^2 + a*z^2", refit=True)
    assert drawn_like_render(shells)
    state = shells.session.state
    assert state.item.levels == levels
    # Fitted to the outermost of them.
    assert state.bounds.reach == pytest.approx(2.0**0.5, rel=0.1)
    shells.session.state = state.ask("gallery", "torus")
    shells.until(lambda s: s.state.item.surface.name == "torus")
    assert shells.session.state.item.levels == ()
    assert drawn_like_render(shells)


def test_a_method_that_knows_no_isovalues_says_so_and_ends_nothing(shells: Driver) -> None:
    shells.rest()
    shells.change(method=zs.methods.MarchingPoints())
    shells.until(lambda s: s.trouble)
    assert "marching-points cannot treat several isovalues" in shells.session.trouble
    shells.change(text="x^2 + y^2 + a*z^2 + z")
    shells.until(lambda s: s.complaint(s.state.item))
    shells.change(method=zs.methods.Auto(), text="x^2 + y^2 + a*z^2 + 0.5z")
    assert drawn_like_render(shells)
    assert (shells.session.trouble, shells.complaint) == ("", None)


@pytest.mark.parametrize("name", ["two", "shells"])
def test_such_scenes_are_saved_and_opened_again(name: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    driver: Driver = request.getfixturevalue(name)
    driver.rest()
    place = tmp_path / "scene.toml"
    driver.session.state = driver.session.state.ask("save-scene", str(place))
    driver.until(lambda s: place.exists())
    again = start(*scene_of(zs.load(place)), zs.methods.Auto(), "cpu", None)
    assert again.scene == driver.session.state.scene
    assert [item.levels for item in again.items] == [
        tuple(sorted(item.levels, key=lambda level: level.value)) for item in driver.session.state.items
    ]
