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

from zeroset import figures

Run = Callable[..., Any]


def test_the_list_has_every_figure(zeroset: Run) -> None:
    ran = zeroset("figure")
    assert ran.status == 0
    for name in figures.names():
        assert f"{name} " in ran.out
        assert figures.find(name).title in ran.out


def test_one_figure_is_drawn(zeroset: Run, tmp_path: Path) -> None:
    path = tmp_path / "barth.jpg"
    ran = zeroset("figure", "K09-8", "-o", str(path), "--size", "16", "-d", "cpu")
    assert ran.status == 0
    assert "barth.jpg" in ran.out
    with Image.open(path) as picture:
        assert picture.format == "JPEG"
        assert picture.size == figures.draw("k09-8", 16, "cpu").shape[1::-1]


def test_a_figure_is_called_by_its_name(zeroset: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert zeroset("figure", "K09-8", "-s", "8", "-d", "cpu").status == 0
    assert np.array_equal(np.asarray(Image.open("k09-8.png")), figures.draw("k09-8", 8, "cpu"))


def test_all_figures_go_into_a_folder(zeroset: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(figures, "names", lambda: ("k09-8", "k09-10"))
    folder = tmp_path / "figures"
    ran = zeroset("figure", "all", "-o", str(folder), "-s", "8", "-d", "cpu")
    assert ran.status == 0
    assert sorted(path.name for path in folder.iterdir()) == ["k09-10.png", "k09-8.png"]


@pytest.mark.parametrize("name", ["k09-5", "k09-6"])
def test_a_figure_is_the_same_with_and_without_what_was_compiled_before(name: str, tmp_path: Path) -> None:
    cache = {**os.environ, "ZEROSET_CACHE_DIR": str(tmp_path / "cache")}
    command = [sys.executable, "-m", "zeroset", "figure", name, "-s", "24", "-d", "cpu", "-o"]
    pictures = []
    for turn in range(2):
        path = tmp_path / f"{turn}.png"
        subprocess.run([*command, str(path)], env=cache, capture_output=True, check=True)
        pictures.append(path.read_bytes())
    assert pictures[0] == pictures[1]


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (("sn10-44",), "did you mean sn10-4"),
        (("sn10-3",), "diagram"),
        (("k09-8", "-o", "out.txt"), "picture format"),
        (("k09-8", "-o", "nowhere/out.png"), "no folder"),
        (("k09-8", "-s", "4"), "8<=x<=2048"),
        (("k09-8", "-d", "abacus"), "abacus"),
        (("all", "-o", "file/deeper"), "cannot make the folder"),
        (("all", "-o", "file"), "give the name of a folder"),
    ],
)
def test_mistakes_are_told(
    zeroset: Run, args: tuple[str, ...], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("file").write_text("no folder")
    ran = zeroset("figure", *args)
    assert ran.status == 2
    assert said in ran.err
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
