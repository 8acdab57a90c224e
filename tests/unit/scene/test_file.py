from __future__ import annotations

from pathlib import Path

import pytest

import zeroset as zs
from zeroset.errors import OutputError, SceneFileError
from zeroset.scene.file import LARGEST, dumps, loads

SCENES = [
    zs.Scene(zs.surface("x^2 + y^2 + z^2 = 1")),
    zs.Scene(
        zs.surface("x^4 - a*x^2 + y + w", {"a": 5.5, "w": 0.1}, bounds=zs.Box((-1, -1, -1), (1, 2, 3)), name="tangle"),
        zs.Camera((4, -7, 4), (0, 0, 0.1), (0, 0.1, 1), 35),
        zs.Material(front=(0.9, 0.5, 0.1), shininess=12.5),
        (zs.Light((0.1, 0.2, 0.3), (0.1, 0.1, 0.1), headlight=False),),
        (0.1, 0.2, 0.3),
    ),
    zs.Scene(
        zs.surface("sum(i, (x - c[i])^2) + pi*y", {"c": [0.1, 1e-9, -3.0]}, bounds=zs.Ball(0.5, (1, 2, 3))),
        zs.Camera(height=2.5),
        lights=(),
    ),
]


@pytest.mark.parametrize("scene", SCENES)
def test_what_is_written_is_read_back_the_same(scene: zs.Scene, tmp_path: Path) -> None:
    assert zs.load(zs.save(scene, tmp_path / "scene.toml")) == scene
    assert dumps(loads(dumps(scene))) == dumps(scene)


def test_a_surface_is_saved_as_a_scene_with_its_own_camera(tmp_path: Path) -> None:
    surface = zs.gallery["barth-sextic"]
    scene = zs.load(zs.save(surface, tmp_path / "b.toml"))
    assert scene.camera == surface.camera
    assert scene.surface.fitted == surface.fitted
    assert scene.surface.field.digest == surface.field.digest


def test_the_short_forms() -> None:
    scene = loads('formula = "x^2 = a"\nbounds = 3\nparams = {a = 1}\n[camera]\neye = [1, 2, 3]\n')
    assert scene.surface.bounds == zs.Ball(3.0)
    assert scene.camera == zs.Camera(eye=(1.0, 2.0, 3.0))
    assert scene.lights == zs.Scene(scene.surface).lights


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("formula = ", 1, "no TOML"),
        ("x = [" + "[" * 5000, None, "no TOML"),
        ("bounds = 1", None, "needs a formula"),
        ("formula = 3", 1, "needs a formula"),
        ('formula = "x^2"\nbunds = 1', 2, "did you mean bounds"),
        ('bounds = 1\n\nformula = "x^2 + "', 3, "value is missing"),
        ('formula = "x"\nbounds = -1', 2, "radius"),
        ('formula = "x"\nbounds = [1]', 2, "two corners"),
        ('formula = "x"\nbackground = "red"', 2, "background"),
        ('formula = "x"\nbackground = [1, 2]', 2, "background"),
        ('formula = "x"\nparams = 3', 2, "params must be a table"),
        ('formula = "x"\nparams = {a = 1}', 1, "no parameter 'a'"),
        ('formula = "x"\n[camera]\neye = [1, 2]', 3, "eye must be three numbers"),
        ('formula = "x"\n[camera]\nfov = 50\neye = [0, 0, 0]', 4, "its own place"),
        ('formula = "x"\n[camera]\neye = [1, 2, 3]\nfov = "wide"', 4, "fov must be a number"),
        ('formula = "x"\n[camera]\nzoom = 2', 3, "camera has no 'zoom'"),
        ('formula = "x"\ncamera = 3', 2, "camera must be a table"),
        ('formula = "x"\n[material]\nshininess = 10\nambient = "dark"', 4, "ambient must be a number"),
        ('formula = "x"\n[[lights]]\ncolour = [1, 1, 1]', 3, "did you mean color"),
        ('formula = "x"\nlights = 3', 2, "lights must be a list"),
        ('formula = "x"\n[[lights]]\ndirection = [0, 0, 0]', 3, "direction must not be zero"),
        ('formula = "x"\n' + "[[lights]]\n" * 33, 2, "at most 32"),
    ],
)
def test_mistakes_are_named_with_file_and_line(text: str, line: int | None, said: str) -> None:
    with pytest.raises(SceneFileError, match=said) as caught:
        loads(text, "my.toml")
    assert caught.value.path == "my.toml"
    assert caught.value.line == line
    assert "in my.toml" in str(caught.value)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(SceneFileError, match="No such file"):
        zs.load(tmp_path / "none.toml")
    with pytest.raises(SceneFileError, match="format"):
        zs.load(tmp_path / "scene.json")
    (tmp_path / "bytes.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(SceneFileError, match="UTF-8"):
        zs.load(tmp_path / "bytes.toml")
    (tmp_path / "large.toml").write_bytes(b"#" * (LARGEST + 1))
    with pytest.raises(SceneFileError, match="larger"):
        zs.load(tmp_path / "large.toml")
    (tmp_path / "folder.toml").mkdir()
    with pytest.raises(SceneFileError, match="directory"):
        zs.load(tmp_path / "folder.toml")


def test_files_that_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(SceneFileError, match="format"):
        zs.save(zs.surface("x"), tmp_path / "scene.json")
    with pytest.raises(OutputError, match="no folder"):
        zs.save(zs.surface("x"), tmp_path / "none" / "scene.toml")
    assert list(tmp_path.iterdir()) == []
