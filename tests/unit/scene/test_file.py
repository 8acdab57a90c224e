from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image as Pillow

import zeroset as zs
from zeroset.errors import OutputError, SceneFileError
from zeroset.scene.file import LARGEST, dumps, loads
from zeroset.scene.places import for_folder, from_folder

SCENES = [
    zs.Scene(zs.surface("x^2 + y^2 + z^2 = 1")),
    zs.Scene(
        zs.surface("x^4 - a*x^2 + y + w", {"a": 5.5, "w": 0.1}, bounds=zs.Box((-1, -1, -1), (1, 2, 3)), name="tangle"),
        zs.Camera((4, -7, 4), (0, 0, 0.1), (0, 0.1, 1), 35),
        zs.Material(front=(0.9, 0.5, 0.1), shininess=12.5, opacity=0.5, last_solid=True),
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
        ('formula = "x"\nparams = {a = 1}', 2, "no parameter 'a'"),
        ('formula = "x"\n[camera]\neye = [1, 2]', 3, "eye must be three numbers"),
        ('formula = "x"\n[camera]\nfov = 50\neye = [0, 0, 0]', 4, "its own place"),
        ('formula = "x"\n[camera]\neye = [1, 2, 3]\nfov = "wide"', 4, "fov must be a number"),
        ('formula = "x"\n[camera]\nzoom = 2', 3, "camera has no 'zoom'"),
        ('formula = "x"\ncamera = 3', 2, "camera must be a table"),
        ('formula = "x"\n[material]\nshininess = 10\nambient = "dark"', 4, "ambient must be a number"),
        ('formula = "x"\n[[lights]]\ncolour = [1, 1, 1]', 3, "did you mean color"),
        ('formula = "x"\nlights = 3', 2, "lights must be a list"),
        ('formula = "x"\n[[lights]]\ndirection = [0, 0, 0]', 3, "direction must not be zero"),
        ('formula = "x"\n' + "[[lights]]\n" * 33, 34, "at most 32"),
    ],
)
def test_mistakes_are_named_with_file_and_line(text: str, line: int | None, said: str) -> None:
    with pytest.raises(SceneFileError, match=said) as caught:
        loads(text, "my.toml")
    assert caught.value.path == "my.toml"
    assert caught.value.line == line
    assert "in my.toml" in str(caught.value)


F = 'formula = "x"'
LIGHTS = f"{F}\n[[lights]]\ndirection = [0, 0, 1]\n\n[[lights]]\n"


@pytest.mark.parametrize(
    ("text", "line", "said", "cure"),
    [
        # of a wrong kind
        ("name = 3\n" + F, 1, "name must be text, not 3", ""),
        (F + "\nshadows = 1", 2, "shadows must be true or false, not 1", ""),
        (F + '\nshadows = "yes"', 2, "shadows must be true or false", ""),
        (F + "\nbackground = true", 2, "background must be three numbers, not true", ""),
        (F + '\nbackground = [1, "1", 1]', 2, r"background\[1\] must be a number, not '1'", ""),
        (F + '\nbounds = "3"', 2, "bounds must be a number", ""),
        (F + "\nbounds = true", 2, "bounds must be a number", ""),
        (F + "\nbounds = [[0, 0, 0],\n [1, 1]]", 2, "upper corner of the bounds must be three numbers", ""),
        (F + "\n[bounds]\nmin = [0, 0, 0]\nmax = [1, 1]", 4, "three numbers", ""),
        (F + "\n[bounds]\nradius = 2\ncenter = [0, 0]", 4, "centre", ""),
        (F + "\n[bounds]\ncenter = [0, 0, 0]\nradius = -1", 4, "radius", "bounds = 3.0"),
        (F + "\n[bounds]\nmin = [0, 0, 0]\nmax = [1, 1, 0]", 2, "empty", ""),
        (F + "\n[bounds]\nradios = 3", 3, "either min and max, or center and radius", ""),
        (F + "\nmaterial = []", 2, r"the material must be a table, not \[\]", ""),
        (F + "\n[[material]]\nopacity = 1", 2, "the material must be a table", ""),
        (F + '\n[material]\nfront = "red"', 3, "front must be three numbers, not 'red'", ""),
        (F + "\n[material]\nopacity = 0.5\nior = 1979-05-27", 4, "ior must be a number, not 1979-05-27", ""),
        (F + '\n[camera]\nup = "123"', 3, "camera.up must be three numbers", ""),
        (F + "\n[lights]\ndirection = [0, 0, 1]", 2, "lights must be a list", "[[lights]]"),
        (F + "\nlights = [\n  {color = [1, 1, 1]},\n  3]", 4, "a light must be a table, not 3", ""),
        (F + "\n[material]\nlast_solid = 1", 3, "last_solid must be true or false", ""),
        (LIGHTS + "headlight = 1", 6, "headlight must be true or false", ""),
        ('formula = ["x"]', 1, "needs a formula as text", "formula = "),
        ('formula = """\nx^2 +\n"""', 1, "value is missing", ""),
        # of the second of several
        (LIGHTS + "direction = [0, 0, 0]", 6, "direction must not be zero", ""),
        (LIGHTS + "\ncolour = [1, 1, 1]", 7, "a light has no 'colour'", "did you mean color"),
        (LIGHTS + "color = [1, 1, -1]", 6, "colour must be three numbers, 0 for none", ""),
        (LIGHTS + "position = [1, 1, inf]", 6, "position must be finite", ""),
        (F + "\nlights = [{},\n {color = [2, 1, 1]},\n {color = [2, 1]}]", 4, "colour must be three", ""),
        # impossible
        (F + "\n[material]\nior = 1.5\nopacity = 2", 4, "opacity must be from 0 to 1, not 2.0", ""),
        (F + "\n[material]\nopacity = 0.5\nior = 0", 4, "index of refraction must be from 0.1 to 10", ""),
        (F + "\nmaterial = {ior = 1.5, shininess = -1}", 2, "shininess must be above 0", ""),
        (F + "\n[material]\nreflectance = -0.1", 3, "reflectance must be from 0 to 1", ""),
        (F + "\n[material]\nopacity = nan", 3, "opacity must be finite", ""),
        (F + "\n[camera]\nfov = inf", 3, "fov must be finite", ""),
        (F + "\n[camera]\nfov = 180", 3, "fov must be between 0 and 180", ""),
        (F + "\n[camera]\nfov = 30\nheight = 3", 4, "both a fov and a height", "height alone"),
        (F + "\n[camera]\nup = [0, 0, 0]", 3, "up must not be zero", "up = [0, 0, 1]"),
        (F + "\n[camera]\n\neye = [1, nan, 1]", 4, "eye must be finite", ""),
        (F + "\nbackground = [0, 0, inf]", 2, "background must be finite", ""),
        (F + "\n\nbackground = [0, 0, -1]", 3, "background must be three numbers, 0 for none", ""),
        (F + "\nbounds = nan", 2, "finite", ""),
        # parameters
        ('formula = "a*x"', 1, "a", ""),
        ('formula = "a*x + b"\n[params]\na = 1\nb = inf', 4, "parameter b must be finite", ""),
        ('formula = "a*x + b"\n[params]\na = 1\nb = "2"', 4, "params.b must be a number, not '2'", ""),
        ('formula = "a*x + b"\n[params]\nc = 1\na = 1\nb = 1', 3, "no parameter 'c'", ""),
        ('formula = "sum(i, (x - c[i])^2)"\n[params]\nc = [1, nan]', 3, "array parameter c must be finite", ""),
        ('formula = "sum(i, (x - c[i])^2)"\n[params]\nc = [[1], [2]]', 3, "one row of numbers", ""),
        ('formula = "sum(i, c[i]*d[i] + x)"\n[params]\nc = [1, 2]\nd = [1]', 2, "equally long: c, d", ""),
        # surroundings
        (F + '\nenvironment = "skye"', 2, "no environment 'skye'", "did you mean sky"),
        (F + '\nenvironment = "none.png"', 2, "there is no picture 'none.png'", "it was looked for as /"),
        (F + '\n[environment]\nstrength = 2\nsource = "none.hdr"', 4, "there is no picture 'none.hdr'", ""),
        (F + '\nenvironment = "no_{face}.png"', 2, "there is no picture 'no_{face}.png'", "no_posx.png"),
        (F + '\nenvironment = ["a.png",\n"b.png"]', 2, "a cube map has six pictures, not 2", "in the order"),
        (F + "\nenvironment = 3", 2, "environment must be text, not 3", ""),
        (F + "\nenvironment = {}", 2, "the environment needs a source", 'source = "sky"'),
        (F + '\n[environment]\nsource = "sky"\nstrength = -1', 4, "strength must be a number from 0", ""),
        (F + '\n[environment]\nsource = "sky"\nstrenght = 1', 4, "no 'strenght'", "did you mean strength"),
        (F + "\n[environment]\nsource = true", 3, "environment.source must be text, not true", ""),
        (
            F + "\n[[lights]]\nposition = [1, 2, 3]\ndirection = [1, 0, 0]",
            2,
            "either a direction or a position",
            "from there",
        ),
        # no TOML
        (F + "\n\n" + F, 3, "Cannot overwrite a value", "each key and each table may stand once"),
        (F + "\n[camera]\n[camera]", 3, "Cannot declare", "may stand once"),
        (F + "\ncamera = {fov = 3, fov = 4}", 2, "no TOML", ""),
        ("formula = x^2", 1, "no TOML", "text stands in quotes"),
        (F + "\nbounds = 1" + "0" * 5000, None, "no TOML.*digits", ""),
        (F + "\nbounds = " + "[" * 3000 + "]" * 3000, None, "nested too deeply", ""),
        (F + "\nbounds = " + "[" * 100 + "]" * 100, 2, "two corners", ""),
        (F + "\nbounds = [1, 2]", 2, "three numbers each, not 1 and 2", r"try bounds = [[-1, -1, -1], [1, 1, 1]]"),
        (F + '\nisovalues = "a"', 2, "isovalues must be a list", "isovalues = [0.0, 0.5]"),
        (F + "\nisovalues = 1.5", 2, "isovalues must be a list", "isovalues = [0.0, 0.5]"),
        (F + "\nbounds = 1" + "0" * 400, 2, "bounds must be a number", ""),
    ],
)
def test_each_mistake_has_its_line_and_its_cure(text: str, line: int | None, said: str, cure: str) -> None:
    with pytest.raises(SceneFileError, match=said) as caught:
        loads(text, "my.toml")
    assert caught.value.line == line
    assert (f"in my.toml:{line}" if line else "in my.toml") in str(caught.value)
    assert cure in "; ".join(caught.value.hints)
    # It is told in a few lines, however long what is wrong may be.
    assert len(str(caught.value)) < 900


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
    with pytest.raises(SceneFileError, match="null"):
        zs.load("nul\0.toml")


# ------------------------------------------------------------- pictures


def folder_with(folder: Path, *names: str) -> Path:
    """A folder with red pictures: one all around, or six faces."""
    folder.mkdir(parents=True)
    for name in names:
        Pillow.new("RGB", (4, 4) if len(names) == 6 else (8, 4), (255, 0, 0)).save(folder / name)
    return folder


def first_texel(scene: zs.Scene) -> list[float]:
    assert scene.environment is not None
    texel: list[float] = scene.environment.texels()[:3].tolist()
    return texel


@pytest.mark.parametrize("written", ["sky.png", "./sky.png", "../project/sky.png", "deep/../sky.png"])
def test_pictures_are_named_from_the_folder_of_the_scene(
    written: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = folder_with(tmp_path / "project", "sky.png")
    (folder / "deep").mkdir()
    (folder / "scene.toml").write_text(f'formula = "x"\nenvironment = "{written}"\n')
    for place, path in ((tmp_path, "project/scene.toml"), (folder, "scene.toml"), (Path("/"), folder / "scene.toml")):
        monkeypatch.chdir(place)
        assert first_texel(zs.load(path)) == [1, 0, 0]


@pytest.mark.parametrize("kind", ["one", "pattern", "list"])
def test_a_scene_is_saved_with_names_that_load_again(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    faces = [f"{face}.png" for face in ("right", "left", "top", "bottom", "front", "back")]
    folder_with(tmp_path / "pictures", *(["sky.png"] if kind == "one" else faces))
    monkeypatch.chdir(tmp_path)
    made = {"one": "sky.png", "pattern": "{face}.png"}.get(kind)
    source = f"pictures/{made}" if made else tuple(f"pictures/{face}" for face in faces)
    scene = zs.Scene(zs.surface("x"), environment=zs.Environment(source, 2.0))
    (tmp_path / "scenes").mkdir()
    zs.save(scene, "scenes/scene.toml")
    assert zs.load("scenes/scene.toml") == scene
    text = Path("scenes/scene.toml").read_text()
    assert '"../pictures/' in text
    # From another folder it is the same scene with the same text, and it may be saved there.
    monkeypatch.chdir(tmp_path / "scenes")
    again = zs.load("scene.toml")
    assert first_texel(again) == [2, 0, 0]
    assert zs.save(again, "other.toml").read_text() == text
    assert "pictures" not in zs.save(again, tmp_path / "pictures" / "third.toml").read_text()
    # All may be moved together.
    (tmp_path / "moved").mkdir()
    for name in ("scenes", "pictures"):
        (tmp_path / name).rename(tmp_path / "moved" / name)
    monkeypatch.chdir(tmp_path)
    assert first_texel(zs.load("moved/scenes/other.toml")) == [2, 0, 0]


def test_links_on_the_way_to_a_picture(tmp_path: Path) -> None:
    """``link/..`` is the folder above what the link leads to."""
    inner = folder_with(tmp_path / "real" / "inner")
    folder_with(tmp_path / "real" / "pictures", "sky.png")
    (tmp_path / "link").symlink_to(inner)
    scene = zs.Scene(zs.surface("x"), environment=str(tmp_path / "real" / "pictures" / "sky.png"))
    zs.save(scene, tmp_path / "link" / "scene.toml")
    for path in (tmp_path / "link" / "scene.toml", inner / "scene.toml"):
        assert first_texel(zs.load(path)) == [1, 0, 0]


def test_a_picture_with_nothing_in_common_is_named_in_full() -> None:
    around = for_folder(zs.Environment("/there/sky.png"), "/here/deep")
    assert around.source == "/there/sky.png"
    assert from_folder(around, "/here/deep") == around
    assert for_folder(zs.Environment("sky"), "/here") == zs.Environment("sky")


def test_a_name_that_is_no_unicode(tmp_path: Path) -> None:
    scene = zs.Scene(zs.surface("x"), environment="\udcff.png")
    with pytest.raises(SceneFileError, match="UTF-8"):
        zs.save(scene, tmp_path / "scene.toml")
    assert list(tmp_path.iterdir()) == []


def test_files_that_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(SceneFileError, match="format"):
        zs.save(zs.surface("x"), tmp_path / "scene.json")
    with pytest.raises(OutputError, match="no folder"):
        zs.save(zs.surface("x"), tmp_path / "none" / "scene.toml")
    assert list(tmp_path.iterdir()) == []


def test_a_light_at_a_place_has_no_direction() -> None:
    lamp = zs.Scene(zs.surface("x", bounds=1.0), lights=(zs.Light(position=(1, 2, 3), headlight=False),))
    assert "direction" not in dumps(lamp)
    assert loads(dumps(lamp)) == lamp
    # Scenes that were saved before have the direction that every light has.
    old = dumps(lamp).replace("position", "direction = [-0.45, 0.7, 0.75]\nposition", 1)
    assert loads(old) == lamp
