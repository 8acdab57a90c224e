from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import zeroset as zs
from zeroset import shelf

Run = Callable[..., object]


def test_the_list_has_every_surface(zeroset: Run) -> None:
    ran = zeroset("gallery")
    assert ran.status == 0
    listed = [line.split()[0] for line in ran.out.splitlines() if line][:-2]
    assert listed == [*zs.gallery, *zs.gallery.solids]


def test_one_surface_is_described(zeroset: Run) -> None:
    ran = zeroset("gallery", "barth-sextic")
    assert ran.status == 0
    assert "phi^2" in ran.out
    assert "SN10" in ran.out
    ran = zeroset("gallery", "barth")
    assert ran.status == 2
    assert "did you mean" in ran.err


def test_one_solid_is_described(zeroset: Run) -> None:
    ran = zeroset("gallery", "sesc-csg")
    assert ran.status == 0
    assert "se - sc" in ran.out
    assert "1.741" in ran.out
    assert "K09" in ran.out


def test_a_sheet_of_all_surfaces(zeroset: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    few = {"ding-dong": 0, "cayley": 1, "clebsch": 2}
    monkeypatch.setattr(shelf.Gallery, "__iter__", lambda _: iter(few))
    monkeypatch.setattr(shelf.Gallery, "__len__", lambda _: len(few))
    ran = zeroset("gallery", "--sheet", "all.png", "--cell", "40")
    assert (ran.status, ran.out) == (0, "all.png: 3 surfaces, 2 solids\n")
    with Image.open(tmp_path / "all.png") as image:
        assert image.size == (8 * 40, 40 + 18)
        pixels = np.asarray(image.convert("RGB").crop((0, 0, 120, 40)))
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 50


def test_a_sheet_of_one_surface_is_a_picture(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("gallery", "tangle", "--sheet", "one.png")
    assert ran.status == 2
    assert "to draw tangle: zeroset render tangle -o one.png" in ran.err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("target", ["none/all.png", "all.xyz"])
def test_a_sheet_that_cannot_be_written_is_not_drawn(target: str, zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("gallery", "--sheet", target)
    assert ran.status == 2
    assert list(tmp_path.iterdir()) == []
