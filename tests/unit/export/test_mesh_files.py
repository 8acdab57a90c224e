from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

import zeroset as zs
from zeroset.errors import OutputError
from zeroset.export.mesh_files import FORMATS

MESH = zs.mesh(zs.surface("(x^2 + y^2 + z^2 + 3/4)^2 = 4(x^2 + y^2)", bounds=1.6), 20)


@pytest.mark.parametrize("suffix", FORMATS)
def test_files_are_read_back_as_they_were(suffix: str, tmp_path: Path) -> None:
    path = MESH.save(tmp_path / f"torus{suffix}")
    assert list(tmp_path.iterdir()) == [path]
    read = trimesh.load_mesh(path, process=suffix == ".stl")
    assert read.is_watertight
    assert read.volume == pytest.approx(MESH.volume, rel=1e-4)
    assert read.area == pytest.approx(MESH.area, rel=1e-4)
    assert len(read.faces) == len(MESH.faces)
    if suffix != ".stl":
        # glTF is upwards along y.
        expected = MESH.vertices[:, [0, 2, 1]] * (1, 1, -1) if suffix == ".glb" else MESH.vertices
        assert np.allclose(read.vertices, expected, atol=1e-6)
        assert np.array_equal(read.faces, MESH.faces)


def test_normals_are_written(tmp_path: Path) -> None:
    lines = MESH.save(tmp_path / "a.obj").read_text().splitlines()
    normals = [[float(part) for part in line.split()[1:]] for line in lines if line.startswith("vn ")]
    assert np.allclose(normals, MESH.normals, atol=1e-6)
    head, _, body = MESH.save(tmp_path / "a.ply").read_bytes().partition(b"end_header\n")
    assert head.index(b"float z") < head.index(b"float nx") < head.index(b"element face")
    rows = np.frombuffer(body, np.float32, 6 * len(MESH.vertices)).reshape(-1, 6)
    assert np.allclose(rows[:, 3:], MESH.normals, atol=1e-6)
    assert b'"NORMAL"' in MESH.save(tmp_path / "a.glb").read_bytes()


def test_the_same_file_again_and_in_the_place_of_another(tmp_path: Path) -> None:
    path = tmp_path / "a.PLY"
    path.write_text("something else")
    first = MESH.save(path).read_bytes()
    assert MESH.save(str(path)).read_bytes() == first
    assert [p.name for p in tmp_path.iterdir()] == ["a.PLY"]


@pytest.mark.parametrize(
    ("name", "said"),
    [("a.stk", "did you mean .stl"), ("a", "without a suffix"), ("a.png", "use .stl, .obj, .ply, .glb"),
     ("none/a.stl", "no folder")],
)  # fmt: skip
def test_what_cannot_be_written_is_said(name: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=said):
        MESH.save(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_closed_is_said(tmp_path: Path) -> None:
    (tmp_path / "a.stl").mkdir()
    with pytest.raises(OutputError, match="it is a folder"):
        MESH.save(tmp_path / "a.stl")


def test_without_trimesh_the_cure_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(OutputError, match="pip install"):
        MESH.save(tmp_path / "a.stl")
    assert list(tmp_path.iterdir()) == []
