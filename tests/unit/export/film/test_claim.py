"""One process at a time draws into a folder of frames; what disappears meanwhile is one clear error."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image

import zeroset as zs
from zeroset.errors import OutputError
from zeroset.export import animate as module
from zeroset.export.film.claim import claimed

BALL = zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 1.0}, bounds=2.0)
needs_locks = pytest.mark.skipif(sys.platform == "win32", reason="folders are not locked there")


def ball(path: Path, progress: Callable[[float], None] | None = None) -> zs.Movie:
    return zs.animate(BALL, path, {"r": (0.5, 1.5)}, frames=4, size=32, progress=progress)


@needs_locks
def test_a_folder_is_had_by_one_at_a_time(tmp_path: Path) -> None:
    folder = tmp_path / "a.gif.frames"
    with claimed(folder):
        with pytest.raises(OutputError, match=r"being drawn into (.|\n)*hint: wait until it is done"):
            ball(tmp_path / "a.gif")
        assert folder.is_dir()
    assert ball(tmp_path / "a.gif").drawn == 4
    assert [path.name for path in tmp_path.iterdir()] == ["a.gif"]


@needs_locks
def test_a_folder_that_was_removed_meanwhile_is_made_again(tmp_path: Path) -> None:
    folder = tmp_path / "a.frames"
    with claimed(folder):
        folder.rmdir()
        with claimed(folder):
            assert folder.is_dir()


@pytest.mark.parametrize("name", ["a.gif", "a.mp4", "a-#.png", "a-#.jpg"])
@pytest.mark.parametrize("when", [0.3, 0.7, 0.8])
def test_frames_that_disappear_are_one_clear_error(name: str, when: float, tmp_path: Path) -> None:
    def lose(share: float) -> None:
        if share >= when:
            for folder in tmp_path.glob("*.frames"):
                shutil.rmtree(folder)

    with pytest.raises(OutputError, match=r"cannot (read the frame|write|encode)") as caught:
        ball(tmp_path / name, lose)
    assert caught.value.__context__ is None or caught.value.__suppress_context__
    assert not (tmp_path / "a.gif").exists()


def test_a_frame_that_disappears_can_be_drawn_again(tmp_path: Path) -> None:
    def lose(share: float) -> None:
        if share >= module.DRAWING:
            (tmp_path / "a.gif.frames" / "000002.png").unlink(missing_ok=True)

    with pytest.raises(OutputError, match="cannot read the frame"):
        ball(tmp_path / "a.gif", lose)
    assert ball(tmp_path / "a.gif").drawn == 1


@needs_locks
def test_two_commands_at_once(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "zeroset", "animate", "tangle", "--orbit", "90", "--frames", "60", "-s", "64"]
    both = [
        subprocess.Popen([*command, "-o", "a.gif"], cwd=tmp_path, stderr=subprocess.PIPE, text=True) for _ in range(2)
    ]
    said = [process.communicate()[1] for process in both]
    assert "Traceback" not in "".join(said)
    ended = sorted(process.returncode for process in both)
    assert ended in ([0, 2], [0, 0])
    for process, text in zip(both, said, strict=True):
        assert process.returncode == 0 or "being drawn into" in text
    with Image.open(tmp_path / "a.gif") as movie:
        assert getattr(movie, "n_frames", 1) == 60
    assert [path.name for path in tmp_path.iterdir()] == ["a.gif"]
