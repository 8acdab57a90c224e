from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import zeroset as zs
from zeroset.cli import animate as module
from zeroset.export.film.named import find, names

Run = Callable[..., Any]


def test_the_list(zeroset: Run) -> None:
    ran = zeroset("animate", "--list")
    assert ran.status == 0
    assert [line.split()[0] for line in ran.out.splitlines()[:-2]] == list(names())


def test_a_named_animation(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("animate", "moving-blobs", "-o", "a.mp4", "-s", "32", "--frames", "3")
    assert (ran.status, ran.err) == (0, "")
    assert ran.out.startswith("a.mp4: 32x32, 3 frames, 0.1 s at 30 a second; made in ")
    assert [path.name for path in tmp_path.iterdir()] == ["a.mp4"]


def test_a_formula_whose_parameters_move(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset(
        "animate", "-x^2 - a*y^2 - z^2 + b", "--vary", "a=1:3", "--vary", "b=1:2:ping-pong", "-b", "2", "-s", "24",
        "--frames", "2", "-o", "f-#.png",
    )  # fmt: skip
    assert (ran.status, ran.err) == (0, "")
    shape = zs.surface("-x^2 - a*y^2 - z^2 + b", {"a": 3.0, "b": 2.0}, bounds=2.0)
    with Image.open(tmp_path / "f-2.png") as image:
        assert np.array_equal(np.asarray(image), zs.render(shape, 24).pixels)


def test_named_animations_can_be_changed(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset(
        "animate", "twisting-superquadric", "-p", "m=6", "--vary", "t=0:1", "--frames", "2", "-s", "24", "-o", "t-#.png"
    )
    assert ran.status == 0
    item = find("twisting-superquadric")
    assert item is not None
    with Image.open(tmp_path / "t-2.png") as image:
        assert np.array_equal(np.asarray(image), zs.render(item.scene.surface.with_params(m=6.0, t=1.0), 24).pixels)


def test_a_camera_path(zeroset: Run, tmp_path: Path) -> None:
    keys = ["--key", "3,0,0", "--key", "0,3,0/0.1,0,0/20"]
    ran = zeroset("animate", "sphere", *keys, "--frames", "2", "-s", "24", "-o", "k-#.png")
    assert (ran.status, ran.err) == (0, "")
    camera = zs.Camera((0, 3, 0), (0.1, 0, 0), fov=20)
    with Image.open(tmp_path / "k-2.png") as image:
        assert np.abs(np.asarray(image).astype(int) - zs.render(zs.gallery["sphere"], 24, camera).pixels).mean() < 1


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["sphere"], "nothing moves(.|\n)*--orbit 360(.|\n)*--vary r=0:1"),
        (["sphere", "--vary", "q=1:2"], "no parameter 'q'(.|\n)*it has r"),
        (["sphere", "--vary", "r"], "write --vary a=1:5"),
        (["sphere", "-p", "r=1", "--vary", "r=1:2"], "r has a value and is to move"),
        (["sphere", "--vary", "r=1:2:sinus"], "did you mean sine"),
        (["blinn-blobby", "--vary", "cx=1:2"], "cx is an array"),
        (["x^2 + y^2 = q", "--orbit", "90"], "unknown name q"),
        (["moving-blob", "--orbit", "90"], "did you mean moving-blobs"),
        (["sphere", "--key", "1,2", "--key", "3,4,5"], "cannot read the eye"),
        (["sphere", "--key", "3,0,0/0,0,0/x", "--key", "3,4,5"], "cannot read the key"),
        (["sphere", "--key", "3,0,0", "--key", "-3,0,0"], "opposite sides"),
        (["sphere", "--orbit", "90", "--frames", "0"], "at least one"),
        (["sphere", "--orbit", "90", "--frames", "2", "--duration", "2"], "either a number of frames or a duration"),
        (["sphere", "--orbit", "90", "-o", "a.avi"], "use .mp4 or .gif"),
        (["sphere", "--orbit", "90", "-o", "a.gif", "--quality", "best"], "of MP4 files, and a.gif is none"),
        (["sphere", "--orbit", "90", "-o", "a.mp4", "--dither", "diffused"], "of GIF files, and a.mp4 is none"),
        (["sphere", "--orbit", "90", "-o", "none/a.mp4"], "there is no folder"),
        (["sphere", "--orbit", "90", "--lamp", "here"], "cannot read the lamp 'here'"),
        (["sphere", "--orbit", "90", "--depth", "2"], "nothing mirrors or is transparent"),
        (["sphere", "--orbit", "90", "--opacity", "0.5", "--depth", "99", "-o", "a.gif"], "from 0 to 32"),
        (["sphere", "--orbit", "90", "--shadow-tolerance", "1"], "there are no shadows"),
    ],
)
def test_mistakes(args: list[str], said: str, zeroset: Run, tmp_path: Path) -> None:
    import re

    ran = zeroset("animate", *args)
    assert ran.status == 2
    assert re.search(said, ran.err), ran.err
    assert list(tmp_path.iterdir()) == []


def test_frames_look_as_pictures_do(zeroset: Run, tmp_path: Path) -> None:
    look = ("--lamp", "0,-4,5", "--shadows", "--shadow-tolerance", "0.2", "--reflectance", "0.3", "--depth", "1")
    ran = zeroset("animate", "tangle", "--orbit", "60", "--frames", "3", "-s", "32", "-o", "a-#.png", *look)
    assert (ran.status, ran.err) == (0, "")
    assert zeroset("render", "tangle", "-s", "32", "-o", "b.png", *look).status == 0
    with Image.open(tmp_path / "a-1.png") as frame, Image.open(tmp_path / "b.png") as picture:
        assert np.array_equal(np.asarray(frame.convert("RGB")), np.asarray(picture.convert("RGB")))


def test_ctrl_c_says_how_to_go_on(zeroset: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Pressed(module.Progress):
        def __call__(self, share: float) -> None:
            if share > 0.4:
                raise KeyboardInterrupt

    command = ["animate", "sphere", "--orbit", "90", "--frames", "6", "-s", "24", "-o", "a.gif"]
    with monkeypatch.context() as patched:
        patched.setattr(module, "Progress", Pressed)
        ran = zeroset(*command)
    assert ran.status == 130
    assert "4 frames are kept in a.gif.frames: the same command goes on from there" in ran.err
    ran = zeroset(*command, "--fps", "60")
    assert "at most 50" in ran.err
    ran = zeroset(*command[:-4], "-s", "16", "-o", "a.gif")
    assert ran.status == 2
    assert "--restart throws them away" in ran.err
    ran = zeroset(*command)
    assert ran.status == 0
    assert "6 frames, 4 of them drawn before" in ran.out
    assert [path.name for path in tmp_path.iterdir()] == ["a.gif"]
