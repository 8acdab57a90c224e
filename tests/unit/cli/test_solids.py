"""The command line with isovalues, solids and several surfaces."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import zeroset as zs
from zeroset.scene.solid import Solid

Run = Callable[..., object]
BALL, TUBE = zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 1.0}, name="ball"), zs.surface("x^2 + y^2 = 0.1", name="tube")


@pytest.fixture
def files(tmp_path: Path) -> Path:
    zs.save(BALL - TUBE, tmp_path / "solid.toml")
    zs.save([BALL, zs.surface("x + y = 3", bounds=4)], tmp_path / "several.toml")
    return tmp_path


def test_isovalues(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset(
        "render", "x^2 + y^2 + z^2", "-b", "2", "--isovalues", "0.5,1,3", "-o", "a.png", "-s", "24",
        "--save-scene", "a.toml", "--save-outputs", "a.npz",
    )  # fmt: skip
    assert ran.status == 0
    saved = zs.load(tmp_path / "a.toml").surface
    assert isinstance(saved, zs.Surface)
    assert saved.isovalues == (0.5, 1.0, 3.0)
    with np.load(tmp_path / "a.npz") as outputs:
        assert outputs["part"].max() == 2
    ran = zeroset("render", "x", "--isovalues", "a", "-o", "b.png")
    assert ran.status == 2
    assert "cannot read the isovalues" in ran.err


def test_solids_and_several_from_files(zeroset: Run, files: Path) -> None:
    for name in ("solid", "several"):
        assert zeroset("render", f"{name}.toml", "-o", f"{name}.png", "-s", "32").status == 0
        with Image.open(files / f"{name}.png") as image:
            assert len(image.convert("RGB").getcolors(1024) or []) > 20
    ran = zeroset(
        "render", "solid.toml", "-p", "r=0.5", "-b", "0.7", "-o", "c.png", "-s", "16", "--save-scene", "c.toml"
    )
    assert ran.status == 0
    changed = zs.load(files / "c.toml").surface
    assert isinstance(changed, Solid)
    assert changed.surfaces[0].params["r"] == 0.5
    assert changed.bounds == zs.Ball(0.7)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("render", "several.toml", "-b", "2"), "bounds of their own"),
        (("render", "solid.toml", "-p", "q=1"), "no surface has a parameter 'q'"),
        (("render", "solid.toml", "--isovalues", "1"), "--isovalues takes one surface f = 0, not a solid"),
        (("render", "solid.toml", "-m", "mitchell"), "mitchell cannot treat solids"),
    ],
)
def test_what_cannot_be(arguments: tuple[str, ...], said: str, zeroset: Run, files: Path) -> None:
    ran = zeroset(*arguments)
    assert ran.status == 2
    assert said in ran.err
    assert "Traceback" not in ran.err


def test_they_are_meshed(zeroset: Run, files: Path) -> None:
    for name, closed in (("solid", "watertight"), ("several", "open")):
        ran = zeroset("mesh", f"{name}.toml", "-o", f"{name}.stl", "-r", "24")
        assert ran.status == 0, ran.err
        assert closed in ran.out
        assert (files / f"{name}.stl").stat().st_size > 1000


def test_they_are_explained(zeroset: Run, files: Path) -> None:
    ran = zeroset("explain", "solid.toml")
    assert ran.status == 0
    assert "solid       ball - tube" in ran.out
    assert "tube        x^2 + y^2 - 0.1 = 0" in ran.out
    ran = zeroset("explain", "several.toml")
    assert ran.out.count("formula  ") == 2
    ran = zeroset("explain", "several.toml", "--kernel", "primary", "--target", "wgsl")
    assert ran.status == 0
    assert "s1_" in ran.out


def test_gallery_solids_are_drawn_by_name(zeroset: Run) -> None:
    assert zeroset("render", "sesc-csg", "-o", "a.png", "-s", "16").status == 0
    ran = zeroset("render", "sesc-cgs", "-o", "a.png", "-s", "16")
    assert ran.status == 2
    assert "sesc-csg" in ran.err


def test_how_it_looks_goes_for_every_surface(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("render", "sesc-csg", "-o", "a.png", "-s", "16", "--opacity", "0.5", "--save-scene", "a.toml")
    assert ran.status == 0
    assert [material.opacity for material in zs.load(tmp_path / "a.toml").materials] == [0.5, 0.5]


def test_an_animation_of_a_solid(zeroset: Run, files: Path) -> None:
    (files / "frames").mkdir()
    ran = zeroset(
        "animate", "solid.toml", "--vary", "r=0.6:1", "--frames", "2", "--size", "24", "-o", "frames/f-##.png"
    )
    assert ran.status == 0, ran.err
    made = sorted((files / "frames").glob("*.png"))
    assert len(made) == 2
    assert made[0].read_bytes() != made[1].read_bytes()
