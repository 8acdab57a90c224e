from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from zeroset.errors import OutputError
from zeroset.export.film.frames import Frames
from zeroset.rendering.image import encode

ASKED = {"size": "8x8", "values": "abc"}


def picture(value: int) -> bytes:
    return encode(np.full((8, 8, 3), value, np.uint8), "PNG")


@pytest.fixture
def frames(tmp_path: Path) -> Frames:
    made = Frames(tmp_path / "a.frames", ASKED, 3)
    made.open()
    made.put(0, picture(10))
    made.put(2, picture(30))
    return made


def test_frames_are_kept(frames: Frames) -> None:
    assert [frames.has(i) for i in range(3)] == [True, False, True]
    assert frames.kept() == 2
    again = Frames(frames.folder, ASKED, 3)
    again.open()
    assert int(again[2][0, 0, 0]) == 30


def test_half_a_frame_is_no_frame(frames: Frames) -> None:
    whole = frames.path(2).read_bytes()
    for broken in (b"", whole[:20], whole[: len(whole) // 2], b"\0" * len(whole)):
        frames.path(2).write_bytes(broken)
        assert not frames.has(2)


def test_frames_of_another_animation_are_not_touched(frames: Frames) -> None:
    other = Frames(frames.folder, {**ASKED, "size": "9x9"}, 3)
    with pytest.raises(OutputError, match="holds 2 frames of another animation: size 8x8, now 9x9"):
        other.open()
    with pytest.raises(OutputError, match="other values, cameras or lights"):
        Frames(frames.folder, {**ASKED, "values": "x"}, 3).open()
    assert frames.kept() == 2
    other.open(restart=True)
    assert other.kept() == 0


def test_a_folder_of_somebody_else_is_not_touched(tmp_path: Path) -> None:
    (tmp_path / "a.frames").mkdir()
    (tmp_path / "a.frames" / "letter.txt").write_text("dear")
    for restart in (False, True):
        with pytest.raises(OutputError, match=r"no animation's|is no animation(.|\n)*letter"):
            Frames(tmp_path / "a.frames", ASKED, 3).open(restart)
    assert (tmp_path / "a.frames" / "letter.txt").read_text() == "dear"
    (tmp_path / "b.frames").write_text("a file")
    with pytest.raises(OutputError, match="cannot make the folder"):
        Frames(tmp_path / "b.frames", ASKED, 3).open()


def test_an_unreadable_manifest_is_another_animation(frames: Frames) -> None:
    (frames.folder / "manifest.json").write_text("[")
    with pytest.raises(OutputError, match="it cannot be read"):
        Frames(frames.folder, ASKED, 3).open()


def test_only_what_is_ours_is_removed(frames: Frames) -> None:
    (frames.folder / ".zeroset-0123456789ab.part").write_bytes(b"left by a process that was killed")
    (frames.folder / "notes.txt").write_text("keep")
    frames.close()
    assert [path.name for path in frames.folder.iterdir()] == ["notes.txt"]


def test_nothing_is_left_when_all_is_done(frames: Frames) -> None:
    frames.close()
    assert not frames.folder.exists()
