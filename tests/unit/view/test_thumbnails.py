"""Thumbnails: what they show, where they are kept, when they are drawn."""

from __future__ import annotations

import threading
from pathlib import Path

import numpy as np
import pytest

from zeroset.view import thumbnails
from zeroset.view.thumbnails import SIDE, Thumbnails


def test_they_are_clear_where_nothing_is() -> None:
    pixels = thumbnails.draw("torus")
    assert pixels.shape == (SIDE, SIDE, 4)
    assert pixels[0, 0, 3] == 0
    assert (pixels[..., 3] == 255).mean() > 0.1
    edge = pixels[(pixels[..., 3] > 0) & (pixels[..., 3] < 255)]
    assert len(edge), "edges are smooth"
    assert edge[:, :3].max(axis=-1).mean() > 60, "and not darkened by what is not there"


def test_they_are_kept_on_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ZEROSET_CACHE_DIR", str(tmp_path))
    monkeypatch.delenv("ZEROSET_CACHE", raising=False)
    assert thumbnails.load("torus") is None
    pixels = np.zeros((SIDE, SIDE, 4), np.uint8)
    pixels[3, 4] = (1, 2, 3, 255)
    thumbnails.keep("torus", pixels)
    found = thumbnails.load("torus")
    assert found is not None
    assert np.array_equal(found, pixels)
    (file,) = (tmp_path / "thumbnails").iterdir()
    file.write_bytes(b"no picture")
    assert thumbnails.load("torus") is None


def test_without_a_cache_nothing_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ZEROSET_CACHE_DIR", str(tmp_path))
    monkeypatch.setenv("ZEROSET_CACHE", "0")
    thumbnails.keep("torus", np.zeros((SIDE, SIDE, 4), np.uint8))
    assert thumbnails.load("torus") is None
    assert list(tmp_path.iterdir()) == []


def test_they_wait_until_the_window_rests(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("ZEROSET_CACHE_DIR", str(tmp_path))
    monkeypatch.delenv("ZEROSET_CACHE", raising=False)
    drawn: list[str] = []
    monkeypatch.setattr(
        thumbnails, "draw", lambda name, device: drawn.append(name) or np.zeros((SIDE, SIDE, 4), np.uint8)
    )
    rest, woken, asked = threading.Event(), threading.Event(), threading.Event()

    def resting() -> bool:
        asked.set()
        return rest.is_set()

    made = Thumbnails("auto", resting, woken.set)
    made.want("torus")
    assert asked.wait(10)
    assert drawn == []
    made.want("torus")
    rest.set()
    assert woken.wait(10)
    assert [name for name, _ in made.made()] == ["torus"]
    made.want("torus")
    assert drawn == ["torus"]
    assert made.close(10)
