from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
import trimesh

Run = Callable[..., object]
BALL = "x^2 + y^2 + z^2 = 1"


def test_a_formula_becomes_a_file_of_triangles(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("mesh", BALL, "-b", "1.5", "-r", "24", "-o", "ball.stl")
    assert (ran.status, ran.err) == (0, "")
    assert ran.out.startswith("ball.stl: ")
    assert "watertight, volume 4.1" in ran.out
    assert list(tmp_path.iterdir()) == [tmp_path / "ball.stl"]
    assert trimesh.load_mesh(tmp_path / "ball.stl").is_watertight


def test_a_surface_that_is_inside_out_is_told(zeroset: Run) -> None:
    ran = zeroset("mesh", "1 - x^2 - y^2 - z^2", "-b", "1.5", "-r", "17", "-o", "in.stl")
    assert ran.status == 0
    assert "its faces look inwards" in ran.err


def test_gallery_names_scene_files_and_parameters(zeroset: Run, tmp_path: Path) -> None:
    assert zeroset("mesh", "clebsch", "-r", "16", "-o", "a.obj").status == 0
    assert zeroset("render", "clebsch", "-s", "8", "-o", "a.png", "--save-scene", "a.toml").status == 0
    ran = zeroset("mesh", "a.toml", "-r", "16", "-o", "b.obj")
    assert ", open, " in ran.out
    assert (tmp_path / "a.obj").read_bytes() == (tmp_path / "b.obj").read_bytes()
    capped = zeroset("mesh", "a.toml", "-r", "16", "--cap", "--precision", "f32", "-d", "cpu", "-o", "b.glb")
    assert "watertight" in capped.out
    assert zeroset("mesh", "x^2 + y^2 + z^2 = a", "-p", "a=0.5", "-b", "1", "-r", "8", "-o", "c.ply").status == 0
    assert zeroset("mesh", "-x^2 + y", "-b", "-1,-1,-1,1,1,1", "-r", "8", "-o", "d.ply").status == 0


def test_isovalues_become_one_file(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("mesh", "x^2 + y^2 + z^2", "-b", "1.5", "-r", "24", "--isovalues", "0.25,1", "-o", "shells.ply")
    assert (ran.status, ran.err) == (0, "")
    both = trimesh.load_mesh(tmp_path / "shells.ply")
    assert both.is_watertight
    assert both.volume == pytest.approx(4 / 3 * 3.14159 * (1 + 0.125), rel=0.02)


BAD = [
    ([BALL, "--isovalues", "0,a"], ["cannot read the isovalues '0,a'"]),
    (["x^2 + "], ["a value is missing", "^"]),
    (["a*x + y"], ["unknown name a", "-p a=1"]),
    (["barth-sextik"], ["did you mean barth-sextic"]),
    (["none.toml"], ["No such file"]),
    ([BALL, "-o", "a.stk"], ["cannot tell a mesh format", "did you mean .stl"]),
    ([BALL, "-o", "a.png"], ["use .stl, .obj, .ply, .glb"]),
    ([BALL, "-o", "none/a.stl"], ["cannot write", "no folder"]),
    ([BALL, "-r", "0"], ["resolution must be from 2"]),
    ([BALL, "-r", "2000"], ["resolution must be from 2"]),
    ([BALL, "-r", "fine"], ["fine"]),
    ([BALL, "-b", "0"], ["radius"]),
    ([BALL, "-d", "cpuu"], ["did you mean cpu"]),
    ([BALL, "--precision", "f16"], ["there is no precision 'f16'"]),
    ([BALL, "-p", "a=1"], ["no parameter 'a'"]),
    (["x^2 + y^2 + z^2 + 1"], ["does not change its sign", "--bounds 3.0"]),
    (["1/x", "-b", "1", "-r", "9"], ["poles"]),
    ([], ["Missing argument"]),
]


@pytest.mark.parametrize(("args", "said"), BAD, ids=[" ".join(args)[:40] for args, _ in BAD])
def test_a_mistake_gets_one_clear_message(args: list[str], said: list[str], zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("mesh", *args, *([] if "-o" in args else ["-o", "out.stl"]))
    assert ran.status == 2
    assert ran.out == ""
    for part in said:
        assert part in ran.err
    assert list(tmp_path.iterdir()) == []
