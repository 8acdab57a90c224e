"""A real window on a display of its own, used as a person would use it."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import zeroset as zs
from zeroset.view.state import BACKGROUND
from zeroset.view.theme import SIDEBAR

FORMULA = "x^2 + y^2 + a*z^2 = 1"
SIZE = (1280, 800)
PANE = (slice(0, 740), slice(int(SIDEBAR), SIZE[0]))
"""The picture on the screen, above the strip with its numbers."""
BOX, SLIDER = (150, 40), (232, 160)
"""The formula box, and the handle of the first slider at half of its range's upper part."""
GALLERY, COLOURS, LIGHT = (100, 230), (100, 358), (100, 326)
"""Heads of panels: the gallery's as the window opens, the others' when it is closed."""
SHADOWS, EDGES = (26, 557), (200, 589)
"""In the panel of light, where that alone is open."""
AROUND, MIRROR = (200, 519), (110, 679)
"""In the panel of colours, where that alone is open; the mirror's slider is at 0."""
SECOND, LOWER_BOX, ADD = (150, 57), (150, 104), (290, 164)
"""Where there are two surfaces: the second in the list, the formula box, and the button for one more."""
ASIDE = (100, 101)
"""A place where nothing happens."""
ROW = 22
"""Height of a row in a list."""
MIDDLE = (int(SIDEBAR) + (SIZE[0] - int(SIDEBAR)) // 2, SIZE[1] // 2)


def test_a_person_uses_the_window(at_window: Callable[..., Any]) -> None:
    person = at_window(FORMULA, "-p", "a=1", "-d", "cpu")
    person.wait("opened")
    window = person.window()

    # What stands on the screen is what render draws, pixel by pixel.
    first = person.wait("picture")
    surface = zs.surface(FORMULA, {"a": 1.0})
    wanted = zs.render(zs.Scene(surface, background=BACKGROUND), (first["size"][0], first["size"][1]), device="cpu")
    assert first["size"] == [SIZE[0] - SIDEBAR, SIZE[1]]
    assert first["hits"] == wanted.hits
    assert np.abs(person.screen()[PANE].astype(int) - wanted.pixels[PANE[0]].astype(int)).max() <= 1

    # A drag orbits: the eye moves and keeps its distance.
    person.drag(MIDDLE, (MIDDLE[0] + 120, MIDDLE[1] + 40))
    orbited = person.wait("camera")
    camera = zs.Camera(orbited["eye"], orbited["target"])
    assert camera.eye != wanted_camera(surface).eye
    assert math.dist(camera.eye, camera.target) == pytest.approx(math.dist(wanted_camera(surface).eye, (0, 0, 0)))

    # The wheel comes nearer.
    person.do("mousemove", *MIDDLE)
    person.do("click", 4)
    zoomed = person.wait("camera")
    assert math.dist(zoomed["eye"], zoomed["target"]) < 0.95 * math.dist(camera.eye, camera.target)
    person.wait("picture")
    before = person.screen()[PANE]

    # A mistake is said and ends nothing; the picture stays.
    person.replace_text(BOX, "(x^2 + y^2 + a*")
    error = person.wait("error", lambda facts: "a value is missing at the end after *" in facts["text"])
    assert error["text"].split("\n")[1:3] == ["  (x^2 + y^2 + a*", "                 ^"]
    assert np.array_equal(person.screen()[PANE], before)

    # Mended, it is another surface.
    person.do("type", "--delay", 30, "z^2) = x^4")
    formula = person.wait("formula", lambda facts: "x^4" in facts["formula"])
    assert formula["params"] == {"a": 1.0}
    person.wait("picture")
    assert not np.array_equal(person.screen()[PANE], before)

    # A slider moves the parameter.
    person.drag(SLIDER, (SLIDER[0] - 60, SLIDER[1]))
    moved = person.wait("picture", lambda facts: facts["params"]["a"] != 1.0)
    assert -1.0 < moved["params"]["a"] < 1.0

    # Closed by its cross, the process ends, in order.
    person.close(window)
    out, err = person.process.communicate(timeout=60)
    assert person.process.returncode == 0, err
    assert "Traceback" not in out + err
    assert person.events()[-1]["event"] == "closed"


def test_a_person_turns_on_shadows_glass_and_surroundings(at_window: Callable[..., Any]) -> None:
    person = at_window(FORMULA, "-p", "a=1", "-d", "cpu")
    person.wait("picture")
    window = person.window()
    surface = zs.surface(FORMULA, {"a": 1.0})

    def shown(material: zs.Material, around: str | None, **options: Any) -> None:
        """The screen shows what render draws, once no hint hangs over it."""
        person.do("mousemove", *ASIDE)
        time.sleep(0.5)
        scene = zs.Scene(surface, None, material, background=BACKGROUND, shadows=True, environment=around)
        wanted = zs.render(scene, (SIZE[0] - int(SIDEBAR), SIZE[1]), device="cpu", **options).pixels[PANE[0]]
        assert np.abs(person.screen()[PANE].astype(int) - wanted.astype(int)).max() <= 1

    def click(place: tuple[int, int]) -> None:
        person.do("mousemove", *place)
        time.sleep(0.3)
        person.do("click", 1)
        time.sleep(0.5)

    for header in (GALLERY, LIGHT):
        click(header)
    click(SHADOWS)
    person.wait("picture")
    shown(zs.Material(), None)
    # The second of the list is 4 rays; pictures that move have one.
    click(EDGES)
    click((EDGES[0], EDGES[1] + 2 * ROW))
    assert person.wait("picture")["antialias"] == 4
    shown(zs.Material(), None, antialias=4)
    for header in (LIGHT, COLOURS):
        click(header)
    # The second of the surroundings is the sky, and the slider's end a mirror.
    click(AROUND)
    click((AROUND[0], AROUND[1] + 2 * ROW))
    person.wait("picture")
    person.drag(MIRROR, (MIRROR[0] + 400, MIRROR[1]))
    person.wait("picture")
    shown(zs.Material(reflectance=1.0), "sky", antialias=4)
    person.close(window)
    out, err = person.process.communicate(timeout=60)
    assert (person.process.returncode, "Traceback" in out + err) == (0, False), err


def test_a_person_edits_the_second_of_two_surfaces_and_adds_one(at_window: Callable[..., Any], tmp_path: Path) -> None:
    place = tmp_path / "two.toml"
    ball = zs.surface("x^2 + y^2 + z^2 = a", {"a": 1.0}, bounds=2.0)
    ground = zs.surface("z + 1", bounds=zs.Box((-3, -3, -1.1), (3, 3, -0.9)))
    zs.save(zs.Scene([ball, ground.with_material(zs.Material(front=(0, 1, 0)))]), place)
    person = at_window(str(place), "-d", "cpu")
    first = person.wait("picture")
    assert first["params"] == {"1.a": 1.0}
    wanted = zs.render(zs.load(place), (first["size"][0], first["size"][1]), device="cpu")
    assert np.abs(person.screen()[PANE].astype(int) - wanted.pixels[PANE[0]].astype(int)).max() <= 1
    # The second surface is chosen, and what is typed is its formula.
    person.do("mousemove", *SECOND)
    person.do("click", 1)
    time.sleep(0.5)
    person.replace_text(LOWER_BOX, "z + b")
    # On a slow machine what is half typed may be shown before.
    person.wait("formula", lambda facts: facts["params"] == {"b": 1.0})
    person.wait("picture", lambda facts: facts["params"] == {"1.a": 1.0, "2.b": 1.0})
    person.do("mousemove", *ADD)
    person.do("click", 1)
    person.wait("picture", lambda facts: "3.c" in facts["params"])
    person.close(person.window())
    out, err = person.process.communicate(timeout=60)
    assert (person.process.returncode, "Traceback" in out + err) == (0, False), err


def wanted_camera(surface: zs.Surface) -> zs.Camera:
    from zeroset.scene.camera import fit_camera

    return fit_camera(surface.fitted)


SCRIPT = """
import zeroset as zs
for log, source in (("0", "x^2 + y^2 + z^2 = 1"), ("1", zs.gallery["torus"])):
    zs.show(source, size=(640, 480), device="cpu", log=log)
    print("closed", flush=True)
"""


def test_a_script_goes_on_when_its_window_is_closed_and_may_open_another(
    at_window: Callable[..., Any], tmp_path: Path
) -> None:
    person = at_window(program=SCRIPT)
    for log in ("0", "1"):
        person.begin_again(tmp_path / log)
        person.wait("opened")
        person.wait("picture")
        person.close(person.window())
        assert person.process.stdout.readline().strip() == "closed"
    out, err = person.process.communicate(timeout=60)
    assert (person.process.returncode, out) == (0, ""), err
    assert "Traceback" not in err
