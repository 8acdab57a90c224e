"""What is copied makes the same picture."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import zeroset as zs
from zeroset.cli import main
from zeroset.scene.isovalues import PALETTE
from zeroset.scene.light import DEFAULT_BACKGROUND
from zeroset.scene.scene import Scene
from zeroset.solve import resolve_method
from zeroset.view import snippet
from zeroset.view.state import State, opened

SIZE = (48, 40)
GLASS = zs.Material(opacity=0.25, ior=1.25, reflectance=0.125)


def plain() -> State:
    surface = zs.surface("x^2 + y^2 + a*z^2 = 1", {"a": -0.25}, bounds=1.7)
    scene = Scene(surface, zs.Camera(eye=(-1.0, -4.0, 2.5), fov=31.0), background=DEFAULT_BACKGROUND)
    return opened(scene, ("",), resolve_method("auto"), "auto", None)


def of(**look: Any) -> State:
    """The plain state in another material."""
    return plain().edited(material=zs.Material(**look))


def isovalues(values: Sequence[float], *more: Any) -> State:
    surface = zs.surface("x^2 + y^2 + a*z^2", {"a": 0.5}, bounds=1.7).with_isovalues(values, *more)
    scene = Scene(surface, zs.Camera(eye=(-1.0, -4.0, 2.5)), background=DEFAULT_BACKGROUND)
    return opened(scene, ("",), resolve_method("auto"), "auto", None)


def several() -> State:
    """Two of a name, one of them with isovalues and colours that it does not pass on."""
    ball = zs.surface("x^2 + y^2 + z^2 = r", {"r": 1.5}, bounds=1.5, name="ball")
    shells = zs.surface("(x - 2)^2 + y^2 + z^2", bounds=zs.Ball(1.0, (2, 0, 0)), name="ball")
    shells = shells.with_isovalues((0.5, 0.25)).with_material(GLASS)
    scene = Scene([ball, shells], material=zs.Material(front=(0.1, 0.5, 0.1), coloring=None))
    return opened(scene, ("", ""), resolve_method("auto"), "auto", None)


def states() -> dict[str, State]:
    light = zs.Light((0.0, -1.0, 0.2), (1.0, 0.5, 0.25), headlight=False)
    arrays = zs.gallery["blinn-blobby"]
    moved = zs.surface("x^2 + y^2 + z^2 = w", {"w": 0.75}, bounds=zs.Ball(1.1, (0.1, 0.0, 0.2)))
    boxed = zs.surface("x y z = 0.01", bounds=zs.Box((-1, -1, -0.5), (1, 0.75, 1)))
    return {
        "plain": plain(),
        "coloured": replace(of(front=(0, 1, 0), shininess=7.0), background=(0.0, 0.1, 0.2)),
        "by curvature": of(coloring=zs.Coloring("mean-curvature", "earth", (-1, 1))),
        "by a formula": of(coloring=zs.Coloring("a*x + z"), specular=0.0),
        "by no formula of its own": of(coloring=zs.Coloring("q*x + z")),
        "lit": replace(plain(), lights=(light,)),
        "arrays": opened(Scene(arrays), ("",), resolve_method("auto"), "auto", None),
        "off centre": opened(Scene(moved), ("",), resolve_method("auto"), "auto", 0.001),
        "box": opened(Scene(boxed, zs.Camera(height=3.0)), ("",), zs.methods.Affine(axis="k", delta=0.5), "auto", None),
        "shadows": replace(plain(), shadows=True, lights=(light,), antialias=4),
        "sky": replace(plain(), environment=zs.Environment("sky")),
        "glass": replace(plain(), environment=zs.Environment("room", 1.5)).edited(material=GLASS),
        "isovalues": isovalues((0.3, 1.0)),
        "isovalues in colours": isovalues((1.0, 0.3), [(0, 1, 0), (0, 0, 1)]),
        "several": several(),
        "one of several by a formula": several().colored_by(zs.Coloring("r*z", "ember")),
        "sampled": replace(plain(), method=zs.methods.AdaptiveMarchingPoints(steps=50, silhouettes=False)),
    }


def wanted(state: State) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    return zs.render(
        state.scene, SIZE, method=state.method, tolerance=state.tolerance, antialias=state.antialias
    ).pixels


@pytest.mark.parametrize("name", states())
def test_the_python_program_makes_the_same_picture(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    state = states()[name]
    monkeypatch.chdir(tmp_path)
    exec(snippet.python(state, SIZE), {})
    assert np.array_equal(np.asarray(Image.open("picture.png")), wanted(state))


@pytest.mark.parametrize("name", states())
def test_the_command_makes_the_same_picture(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    state = states()[name]
    monkeypatch.chdir(tmp_path)
    text = snippet.command(state, SIZE)
    *scene, last = text.rstrip("\n").split("\n")
    if scene:
        # What the shell does with the lines between the two marks.
        assert (scene[0], scene[-1]) == ("cat > scene.toml <<'END'", "END")
        Path("scene.toml").write_text("\n".join(scene[1:-1]) + "\n")
    words = shlex.split(last)
    assert words[0] == "zeroset"
    assert main(words[1:]) == 0
    assert np.array_equal(np.asarray(Image.open("picture.png")), wanted(state))


def test_a_plain_picture_is_a_plain_command() -> None:
    assert "scene.toml" not in snippet.command(plain(), SIZE)
    assert "Material" not in snippet.python(plain(), SIZE)
    assert "--isovalues=0.3,1.0" in snippet.command(isovalues((1.0, 0.3), PALETTE[1::-1]), SIZE)
