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
from zeroset.view import orbit, painting
from zeroset.view.log import Log
from zeroset.view.session import Session
from zeroset.view.show import scene_of, start

SIZE = (96, 64)
PATIENCE = 60.0


class Driver:
    """A session that is ticked until something has come about."""

    def __init__(self, source: str, log: Path | None = None) -> None:
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
            return (
                session.resting
                and session.state.text == session._asked_text
                and picture is not None
                and picture.shot == session._wanted
            )

        self.until(there)

    def change(self, **changes: Any) -> None:
        self.session.state = replace(self.session.state, **changes)


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
    driver.until(lambda s: s.state.surface.name == "torus")
    after = driver.session.state
    assert (after.shadows, after.environment, after.material) == (True, zs.Environment("room"), glass)


def test_the_last_good_picture_stays_while_the_formula_is_wrong(driver: Driver, tmp_path: Path) -> None:
    driver.rest()
    before = driver.session.picture
    driver.change(text="x^2 + y^2 +")
    driver.until(lambda s: s.complaint is not None)
    assert driver.session.complaint is not None
    assert driver.session.complaint.place[1].strip() == "^"
    assert driver.session.picture is before
    driver.change(text="x^2 + y^2 + 2z^2 = 1")
    driver.rest()
    assert driver.session.complaint is None
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
    made.until(lambda s: s._asked_text == text and not s.compiling and not s._reader.busy)
    made.session.tick(SIZE)
    made.change(text="x^2 + y^2 + z^2 = 2")
    made.rest()
    assert made.session.complaint is None
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
        driver.change(surface=driver.session.state.surface.with_params(a=value))
        driver.rest()
        assert driver.session.picture is not None
        assert driver.session.picture.shot.scene.surface.params["a"] == value
    assert driver.session.trouble == ""


def test_a_surface_outside_of_the_old_bounds_is_looked_for() -> None:
    made = Driver("x^2 + y^2 + z^2 = 1")
    made.rest()
    made.change(surface=made.session.state.surface.with_bounds(1.2), refit=False)
    made.rest()
    made.change(text="x^2 + y^2 + z^2 = 100")
    made.rest()
    assert made.session.picture is not None
    assert made.session.picture.hits > 0
    assert made.session.state.bounds.reach == pytest.approx(10.0, rel=0.15)
    assert made.session.close()


def test_bounds_of_ones_own_are_kept_while_a_formula_is_edited(driver: Driver) -> None:
    driver.rest()
    driver.change(surface=driver.session.state.surface.with_bounds(0.9), refit=False)
    driver.change(text="x^2 + y^2 + a*z^2 = 0.7")
    driver.rest()
    assert driver.session.state.bounds == zs.Ball(0.9)
    driver.session.state = driver.session.state.ask("fit-bounds")
    driver.until(lambda s: s.state.refit)
    assert driver.session.state.bounds != zs.Ball(0.9)


def test_a_gallery_surface_comes_with_its_camera_and_text(driver: Driver) -> None:
    driver.rest()
    driver.session.state = driver.session.state.ask("gallery", "torus")
    driver.until(lambda s: s.state.surface.name == "torus")
    driver.rest()
    state = driver.session.state
    assert state.camera == state.home == zs.gallery["torus"].camera
    assert state.text == "(x^2 + y^2 + z^2 + R^2 - r^2)^2 = 4R^2 (x^2 + y^2)" or "x" in state.text
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
    driver.until(lambda s: s.complaint is not None)
    assert driver.session.complaint is not None
    assert driver.session.complaint.offer == "foo"
    driver.session.state = driver.session.state.ask("declare", "foo")
    driver.until(lambda s: "foo" in s.state.surface.params)
    assert driver.session.complaint is None


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
    assert scene.surface.field.digest == state.surface.field.digest
    assert replace(scene, surface=state.surface) == state.scene
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
