from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.bench.meter import Meter
from zeroset.export import animate as module
from zeroset.kernel import Kernel, Type
from zeroset.rendering.frame import settle
from zeroset.runtime import Program, get_device

BALL = zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 1.0}, bounds=2.0)


def ball(path: Path | str, **options: Any) -> Any:
    return zs.animate(BALL, path, **{"vary": {"r": (0.5, 1.5)}, "frames": 4, "size": 32, **options})


def pixels(path: Path) -> Any:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"))


class Interrupted(BaseException):
    """Like Ctrl-C, but nothing else catches it."""


def after(frames: int, count: int = 4) -> Callable[[float], None]:
    """A progress that ends the work before a frame is drawn."""

    def progress(share: float) -> None:
        if share >= module.DRAWING * frames / count - 1e-9:
            raise Interrupted

    return progress


def test_single_frames_are_the_pictures_that_render_draws(tmp_path: Path) -> None:
    movie = ball(tmp_path / "a-##.png")
    assert [path.name for path in movie.files] == ["a-01.png", "a-02.png", "a-03.png", "a-04.png"]
    for path, r in zip(movie.files, np.linspace(0.5, 1.5, 4), strict=True):
        assert np.array_equal(pixels(path), zs.render(BALL.with_params(r=r), 32).pixels)
    assert sorted(os.listdir(tmp_path)) == [path.name for path in movie.files]


@pytest.mark.parametrize("name", ["a.mp4", "a.gif", "a-#.jpg", "shots/"])
def test_kinds_of_movies(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shares: list[float] = []
    movie = ball(name, fps=10, progress=shares.append)
    assert (movie.frames, movie.fps, movie.size, movie.drawn) == (4, 10.0, (32, 32), 4)
    assert all(path.stat().st_size > 300 for path in movie.files)
    assert os.listdir(tmp_path) == [name.strip("/")] if "#" not in name else len(os.listdir(tmp_path)) == 4
    assert shares == sorted(shares)
    assert 0 <= shares[0] < shares[-1] <= 1
    shown = movie._repr_html_()
    assert shown.startswith("<video" if name == "a.mp4" else "<img")
    assert "base64," in shown


def test_a_large_movie_is_not_put_into_a_notebook(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "SHOWN", 10)
    assert "base64" not in ball(tmp_path / "a.gif")._repr_html_()


class Counting(Meter):
    """A device that counts what frames must not do."""

    def __init__(self, name: str) -> None:
        super().__init__(get_device(name))
        self.asked = self.allocated = self.copied = 0

    def compile_cached(self, key: str, build: Callable[[], Kernel], quick: bool = False) -> Program:
        self.asked += 1
        return super().compile_cached(key, build, quick)

    def allocate(self, type_: Type, count: int, constant: bool = False) -> Any:
        self.allocated += 1
        return super().allocate(type_, count, constant)

    def copy(self, buffer: Any) -> Any:
        self.copied += 1
        return super().copy(buffer)


@pytest.mark.parametrize("where", ["cpu", pytest.param("gpu", marks=needs_gpu)])
@pytest.mark.parametrize(
    ("name", "light"),
    [("moving-blobs", {}), ("twisting-superquadric", {"shadows": True}), ("cloth", {"antialias": 4})],
)
def test_nothing_is_compiled_or_allocated_from_frame_to_frame(
    name: str, light: dict[str, Any], where: str, tmp_path: Path
) -> None:
    device = Counting(where)
    options: dict[str, Any] = {"orbit": 360, "size": 32, "device": device, **light}
    zs.animate(name, tmp_path / "first.gif", frames=1, **options)
    settle()
    before = device.asked, device.allocated
    assert min(before) > 0
    movie = zs.animate(name, tmp_path / "all.gif", frames=6, **options)
    settle()
    assert movie.drawn == 6
    assert (device.asked, device.allocated, device.copied) == (*before, 0)


@pytest.mark.parametrize("name", ["a.mp4", "a.gif", "a-#.png"])
def test_an_interrupted_animation_goes_on_where_it_stopped(name: str, tmp_path: Path) -> None:
    with pytest.raises(Interrupted):
        ball(tmp_path / name, progress=after(3))
    left = {path.name for path in tmp_path.rglob("*") if path.is_file()}
    assert left == {"manifest.json", "000000.png", "000001.png", "000002.png"}
    marks = {path.name: path.stat().st_mtime_ns for path in tmp_path.rglob("*.png")}
    with pytest.raises(Interrupted):
        ball(tmp_path / name, progress=after(4))
    assert {path.name: path.stat().st_mtime_ns for path in tmp_path.rglob("*.png")}.items() >= marks.items()
    movie = ball(tmp_path / name)
    assert movie.drawn == 0
    assert sorted(os.listdir(tmp_path)) == sorted(path.name for path in movie.files)
    other = tmp_path / "whole"
    other.mkdir()
    whole = ball(other / name)
    assert [path.read_bytes() for path in whole.files] == [path.read_bytes() for path in movie.files]


def test_an_interruption_before_the_first_frame_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(Interrupted):
        ball(tmp_path / "a.mp4", progress=after(0))
    assert os.listdir(tmp_path) == []


def test_frames_of_another_animation_are_in_the_way(tmp_path: Path) -> None:
    with pytest.raises(Interrupted):
        ball(tmp_path / "a.gif", progress=after(2))
    for changed, said in (({"size": 16}, "size 32x32, now 16x16"), ({"vary": {"r": (0.5, 1.4)}}, "other values")):
        with pytest.raises(zs.errors.OutputError, match=f"holds 2 frames of another animation: {said}"):
            ball(tmp_path / "a.gif", **changed)
    assert ball(tmp_path / "a.gif", size=16, restart=True).drawn == 4
    assert os.listdir(tmp_path) == ["a.gif"]


def test_pictures_of_a_longer_animation_are_in_the_way(tmp_path: Path) -> None:
    ball(tmp_path / "a-##.png", frames=5)
    with pytest.raises(zs.errors.OutputError, match="the pictures of a longer animation"):
        ball(tmp_path / "a-##.png", frames=3)
    assert len(os.listdir(tmp_path)) == 5
    assert ball(tmp_path / "a-##.png", frames=6).drawn == 6


def test_frames_with_other_surroundings_are_another_animation(tmp_path: Path) -> None:
    around = tmp_path / "around.png"
    scene = zs.Scene(BALL, environment=str(around))
    options: dict[str, Any] = {"vary": {"r": (0.5, 1.5)}, "frames": 4, "size": 32}
    with pytest.raises(zs.errors.ParameterError, match="there is no picture"):
        zs.animate(scene, tmp_path / "a.gif", **options)
    assert os.listdir(tmp_path) == []
    Image.new("RGB", (8, 4), (255, 0, 0)).save(around)
    with pytest.raises(Interrupted):
        zs.animate(scene, tmp_path / "a.gif", **options, progress=after(2))
    Image.new("RGB", (8, 4), (0, 255, 0)).save(around)
    with pytest.raises(zs.errors.OutputError, match="holds 2 frames of another animation: other values"):
        zs.animate(scene, tmp_path / "a.gif", **options)
    Image.new("RGB", (8, 4), (255, 0, 0)).save(around)
    assert zs.animate(scene, tmp_path / "a.gif", **options).drawn == 2


def test_how_a_movie_is_put_together_does_not_draw_it_again(tmp_path: Path) -> None:
    assert ball(tmp_path / "a.mp4", keep=True).drawn == 4
    assert ball(tmp_path / "a.mp4", keep=True, fps=5, quality="small").drawn == 0
    assert sorted(os.listdir(tmp_path)) == ["a.mp4", "a.mp4.frames"]


def test_a_frame_that_was_damaged_is_drawn_again(tmp_path: Path) -> None:
    with pytest.raises(Interrupted):
        ball(tmp_path / "a.gif", progress=after(3))
    (tmp_path / "a.gif.frames" / "000001.png").write_bytes(b"\x89PNG")
    assert ball(tmp_path / "a.gif").drawn == 2


PROGRAM = """
import os, resource, signal, sys
import zeroset as zs
how, at, path = sys.argv[1], float(sys.argv[2]), sys.argv[3]
def progress(share):
    if share >= at and how == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    if share >= at and how == "full":
        resource.setrlimit(resource.RLIMIT_FSIZE, (150, 150))
ball = zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 1.0}, bounds=2.0)
try:
    zs.animate(ball, path, {"r": (0.5, 1.5)}, frames=4, size=32, progress=progress)
except zs.errors.OutputError as error:
    print(error)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has neither kill nor limits on files")
@pytest.mark.parametrize("name", ["a.mp4", "a.gif"])
@pytest.mark.parametrize(("how", "share"), [("kill", 0.5), ("kill", 0.8), ("full", 0.5), ("full", 0.75)])
def test_killed_processes_and_full_disks_leave_whole_files_only(
    how: str, share: float, name: str, tmp_path: Path
) -> None:
    at = module.DRAWING * share if share < 0.7 else share
    command = [sys.executable, "-c", PROGRAM, how, str(at), str(tmp_path / name)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == (-9 if how == "kill" else 0), ran.stderr
    if how == "full":
        assert ran.stdout.startswith("cannot "), ran.stdout
    assert not (tmp_path / name).exists()
    kept = sorted((tmp_path / f"{name}.frames").glob("*.png"))
    assert len(kept) == (2 if share == 0.5 else 4)
    assert all(pixels(path).shape == (32, 32, 3) for path in kept)
    assert ball(tmp_path / name).drawn == 4 - len(kept)
    assert os.listdir(tmp_path) == [name]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"vary": None}, "nothing moves"),
        ({"vary": {"q": (0, 1)}}, "no parameter 'q'"),
        ({"frames": 0}, "at least one"),
        ({"size": (0, 3)}, "the size must be"),
        ({"size": 99999}, "the size must be"),
        ({"quality": "god"}, "did you mean good"),
        ({"dither": "difused"}, "did you mean diffused"),
        ({"fps": 60}, "at most 50 frames a second"),
        ({"method": "affin"}, "did you mean"),
        ({"device": "cpuu"}, "cpuu"),
        ({"tolerance": -1}, "tolerance"),
        ({"antialias": 0}, "antialias"),
    ],
)
def test_mistakes_leave_nothing_behind(options: dict[str, Any], said: str, tmp_path: Path) -> None:
    with pytest.raises(zs.ZerosetError, match=said):
        ball(tmp_path / "a.gif", **options)
    assert os.listdir(tmp_path) == []


def test_a_formula_and_a_named_animation(tmp_path: Path) -> None:
    assert zs.animate("x^2 + y^2 + z^2 = a", tmp_path / "a.gif", {"a": (1, 2)}, frames=2, size=16).frames == 2
    movie = zs.animate("water", tmp_path / "b.gif", fps=0.5, size=16)
    assert movie.frames == 2, "its own four seconds"


def test_edges_are_smoothed(tmp_path: Path) -> None:
    movie = ball(tmp_path / "a-#.png", antialias=16)
    assert np.array_equal(pixels(movie.files[3]), zs.render(BALL.with_params(r=1.5), 32, antialias=16).pixels)
    assert not np.array_equal(pixels(movie.files[3]), zs.render(BALL.with_params(r=1.5), 32).pixels)


def test_shadows_are_drawn(tmp_path: Path) -> None:
    light = zs.Light((0.3, -0.2, 1.0), headlight=False)
    shape = zs.surface("min(z + 1, x^2 + y^2 + (z - d)^2 - 0.3)", {"d": 0.0}, bounds=2.0)
    for name, shadows in (("lit", False), ("dark", True)):
        zs.animate(
            zs.Scene(shape, lights=(light,)), tmp_path / f"{name}-#.png", {"d": (0, 0.5)}, frames=2, size=32,
            shadows=shadows,
        )  # fmt: skip
    lit, dark = (pixels(tmp_path / f"{name}-2.png").astype(int) for name in ("lit", "dark"))
    assert dark.sum() < lit.sum()
