from __future__ import annotations

from pathlib import Path

import pytest

from zeroset.errors import OutputError
from zeroset.export.film.target import read_target


@pytest.mark.parametrize(
    ("name", "kind", "folder", "first"),
    [
        ("out.mp4", "mp4", "out.mp4.frames", None),
        ("out.GIF", "gif", "out.GIF.frames", None),
        ("out-####.png", "PNG", "out.png.frames", "out-0001.png"),
        ("##.jpg", "JPEG", "out.jpg.frames", "01.jpg"),
        ("shots/", "PNG", "shots.frames", "shots/0001.png"),
    ],
)
def test_names(
    name: str, kind: str, folder: str, first: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    target = read_target(name)
    assert (target.kind, target.folder) == (kind, Path(folder))
    assert target.movie == (first is None)
    if first is not None:
        assert target.still(0, 10) == Path(first)


def test_numbers_have_room(tmp_path: Path) -> None:
    target = read_target(tmp_path / "a#.png")
    assert [target.still(i, 100).name for i in (0, 99)] == ["a001.png", "a100.png"]


def test_a_folder_that_is_there(tmp_path: Path) -> None:
    target = read_target(tmp_path)
    assert target.still(4, 9) == tmp_path / "0005.png"
    assert target.folder == tmp_path.with_name(f"{tmp_path.name}.frames")


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("a.avi", r"suffix '.avi'(.|\n)*use .mp4 or .gif"),
        ("a.mp", "did you mean .mp4"),
        ("a", "a name without a suffix"),
        ("a.png", "'a-####.png' gives each its number"),
        ("none/a.mp4", "there is no folder"),
        ("none/a-##.png", "there is no folder"),
        ("none/a/", "there is no folder"),
        ("a-##.xyz", "cannot tell a picture format"),
        ("file/", "it is a file"),
    ],
)
def test_what_cannot_be_written(name: str, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match=said):
        read_target(name)
