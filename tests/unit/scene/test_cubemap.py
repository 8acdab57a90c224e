"""Surroundings from six faces: each direction shows its face, however the six came in."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from PIL import Image as Pillow
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.errors import ParameterError
from zeroset.scene.cubemap import FACES, NAMES, shrunk
from zeroset.scene.environment import LARGEST_SIDE, Environment

DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]
DIRECTIONS = {
    "right": (1, 0, 0),
    "left": (-1, 0, 0),
    "top": (0, 0, 1),
    "bottom": (0, 0, -1),
    "front": (0, 1, 0),
    "back": (0, -1, 0),
}
COLORS = {
    "right": (255, 0, 0),
    "left": (0, 255, 255),
    "top": (0, 255, 0),
    "bottom": (255, 0, 255),
    "front": (0, 0, 255),
    "back": (255, 255, 0),
}
Picture = npt.NDArray[np.uint8]
SIDE = 8


def plain() -> dict[str, Picture]:
    """Six faces of one colour each."""
    return {face: np.full((SIDE, SIDE, 3), color, np.uint8) for face, color in COLORS.items()}


def directed(side: int = SIDE) -> dict[str, Picture]:
    """Six faces whose colour is the direction, by the table of the OpenGL specification (section 8.13), y upwards.

    Red is x, green their y and blue their z, -1 as 0 and 1 as 255, on the unit cube.
    """
    s, t = np.meshgrid(*[(np.arange(side) + 0.5) * 2 / side - 1] * 2)
    one = np.ones_like(s)
    table = {
        "right": (one, -t, -s),
        "left": (-one, -t, s),
        "top": (s, one, t),
        "bottom": (s, -one, -t),
        "front": (s, -t, one),
        "back": (-s, -t, -one),
    }
    return {face: np.round((np.stack(v, -1) + 1) * 127.5).astype(np.uint8) for face, v in table.items()}


def six(faces: Mapping[str, Picture], folder: Path, names: tuple[str, ...] = FACES) -> str:
    for face, name in zip(FACES, names, strict=True):
        Pillow.fromarray(faces[face]).save(folder / f"sky_{name}.png")
    return str(folder / "sky_{face}.png")


def listed(faces: Mapping[str, Picture], folder: Path) -> list[str]:
    pattern = six(faces, folder)
    return [pattern.format(face=face) for face in ("back", "top", "left", "right", "front", "bottom")]


def numbered(faces: Mapping[str, Picture], folder: Path) -> list[str]:
    files = [folder / f"{i}.png" for i in range(6)]
    for file, face in zip(files, FACES, strict=True):
        Pillow.fromarray(faces[face]).save(file)
    return list(map(str, files))


def in_one(rows: str) -> Callable[[Mapping[str, Picture], Path], str]:
    """All in one picture; rows of first letters, with r l t d(own) f b, B for a back that hangs upside down."""

    def write(faces: Mapping[str, Picture], folder: Path) -> str:
        side = len(faces["right"])
        tiles = {face[0]: picture for face, picture in faces.items()} | {"d": faces["bottom"], "b": faces["back"]}
        tiles |= {".": np.zeros((side, side, 3), np.uint8), "B": faces["back"][::-1, ::-1]}
        lines = [np.concatenate([tiles[letter] for letter in row], axis=1) for row in rows.split("/")]
        Pillow.fromarray(np.concatenate(lines)).save(folder / "all.png")
        return str(folder / "all.png")

    return write


def radiance(faces: Mapping[str, Picture], folder: Path) -> str:
    """Six ``.hdr`` files, four times as bright as white where the bytes are 255."""
    for face, name in zip(FACES, NAMES[1], strict=True):
        rgbe = np.concatenate([faces[face], np.full((SIDE, SIDE, 1), 130, np.uint8)], axis=-1)
        head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {SIDE} +X {SIDE}\n".encode()
        (folder / f"sky-{name}.hdr").write_bytes(head + rgbe.tobytes())
    return str(folder / "sky-{face}.hdr")


WAYS = {
    "places": six,
    "axes": lambda faces, folder: six(faces, folder, NAMES[1]),
    "short": lambda faces, folder: six(faces, folder, NAMES[2]),
    "listed": listed,
    "numbered": numbered,
    "cross": in_one(".t../lfrb/.d.."),
    "standing cross": in_one(".t./lfr/.d./.B."),
    "strip": in_one("rltdfb"),
    "standing strip": in_one("r/l/t/d/f/b"),
}


@pytest.mark.parametrize("way", WAYS)
def test_every_texel_shows_its_own_direction(way: str, tmp_path: Path) -> None:
    made = Environment(WAYS[way](directed(), tmp_path)).texels().reshape(6, SIDE, SIDE, 3)
    # sRGB back to the cube's coordinates, and their y and z changed for ours.
    encoded = np.where(made <= 0.0031308, made * 12.92, 1.055 * np.maximum(made, 0.0031308) ** (1 / 2.4) - 0.055)
    seen = (encoded * 2 - 1)[..., [0, 2, 1]]
    ticks = (np.arange(SIDE) + 0.5) * 2 / SIDE - 1
    u, v = np.meshgrid(ticks, -ticks)
    for i, (axis, sign) in enumerate(itertools.product(range(3), (1, -1))):
        wanted = np.insert(np.stack([u, v], -1), axis, sign, axis=-1)
        assert np.abs(seen[i] - wanted).max() < 0.005, (axis, sign)


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("face", FACES)
def test_a_camera_sees_the_face_that_it_looks_at(face: str, device: str, tmp_path: Path) -> None:
    ahead = np.array(DIRECTIONS[face], float)
    camera = zs.Camera(eye=tuple(5 * ahead), target=tuple(6 * ahead), up=(0.1, 0.2, 1), fov=60)
    scene = zs.Scene(zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5), camera, environment=six(plain(), tmp_path))
    image = zs.render(scene, 16, device=device)
    assert image.hits == 0
    assert np.asarray(image).reshape(-1, 3).tolist() == [list(COLORS[face])] * 256


def test_a_mirror_shows_the_face_behind_the_camera(tmp_path: Path) -> None:
    scene = zs.Scene(
        zs.surface("y", bounds=zs.Box((-9, -1, -9), (9, 1, 9))),
        zs.Camera(eye=(0, -5, 0), target=(0, 0, 0), fov=30),
        zs.Material(ambient=0, diffuse=0, specular=0, reflectance=1.0),
        environment=six(plain(), tmp_path),
    )
    assert np.asarray(zs.render(scene, 16)).reshape(-1, 3).tolist() == [list(COLORS["back"])] * 256


def test_light_beyond_white_stays(tmp_path: Path) -> None:
    made = Environment(radiance(plain(), tmp_path), 0.5).texels().reshape(6, -1, 3)
    full = 255 / 256 * 4 * 0.5
    assert made[0, 0].tolist() == [full, 0, 0]
    assert made[4, 5].tolist() == [0, full, 0]


def test_large_faces_become_means() -> None:
    face = np.random.default_rng(1).random((30, 30, 3)).astype(np.float32)
    small = shrunk(face, 12)
    assert small.shape == (12, 12, 3)
    assert small.mean(axis=(0, 1)) == pytest.approx(face.mean(axis=(0, 1)), rel=1e-5)
    # A texel covers two rows and a half.
    weights = np.zeros(30)
    weights[:3] = 1, 1, 0.5
    assert small[0, 0] == pytest.approx(np.einsum("i,j,ijk->k", weights, weights, face) / 6.25, rel=1e-5)
    assert shrunk(face, 30) is face


def test_a_large_cube_map_is_made_smaller(tmp_path: Path) -> None:
    side = LARGEST_SIDE + 16
    Pillow.new("RGB", (6 * side, side), (255, 255, 255)).save(tmp_path / "white.png")
    assert Environment(str(tmp_path / "white.png")).texels().shape == (LARGEST_SIDE**2 * 18,)


def test_a_changed_picture_is_read_again(tmp_path: Path) -> None:
    around = Environment(six(plain(), tmp_path))
    assert around.texels()[:3].tolist() == [1, 0, 0]
    (tmp_path / "sky_right.png").unlink()
    Pillow.new("RGB", (SIDE, SIDE), (0, 255, 0)).save(tmp_path / "sky_right.png")
    assert around.texels()[:3].tolist() == [0, 1, 0]


# ------------------------------------------------------------- what cannot be


def spoilt(what: str, folder: Path) -> str | list[str]:
    """A cube map with something wrong."""
    pattern = six(plain(), folder)
    top, right = folder / "sky_top.png", folder / "sky_right.png"
    if what == "two missing":
        top.unlink()
        right.unlink()
    elif what == "all missing":
        return str(folder / "night_{face}.png")
    elif what == "other size":
        Pillow.new("RGB", (9, 9)).save(top)
    elif what == "not square":
        Pillow.new("RGB", (8, 9)).save(top)
    elif what == "no picture":
        top.write_text("words")
    elif what == "half a picture":
        Pillow.effect_noise((64, 64), 50).convert("RGB").save(top)
        for face in FACES:
            (folder / f"sky_{face}.png").write_bytes(top.read_bytes())
        right.write_bytes(top.read_bytes()[:2000])
    elif what == "odd shape":
        Pillow.new("RGB", (30, 20)).save(folder / "odd.png")
        return str(folder / "odd.png")
    elif what == "a folder":
        top.unlink()
        top.mkdir()
    elif what == "too large":
        (folder / "big.hdr").write_bytes(b"#?RADIANCE\n\n-Y 20000 +X 40000\n\x02\x02")
        return str(folder / "big.hdr")
    elif what == "five":
        return [str(folder / f"sky_{face}.png") for face in FACES if face != "bottom"]
    return pattern


@pytest.mark.parametrize(
    ("what", "said", "cure"),
    [
        ("two missing", r"lacks '.*sky_right.png', '.*sky_top.png'", "its six faces are right, left"),
        ("all missing", r"no picture '.*night_\{face\}.png'", "night_right.png, night_posx.png, night_px.png"),
        ("other size", r"different sizes: '.*sky_right.png' is 8 pixels wide, '.*sky_top.png' 9", "same size"),
        ("not square", r"face '.*sky_top.png' is not square: 8 by 9", "as wide as high"),
        ("no picture", r"cannot read the picture '.*sky_top.png'", "a whole .png"),
        ("half a picture", r"cannot read the picture '.*sky_right.png'", "a whole .png"),
        ("odd shape", r"picture '.*odd.png' of 30 by 20 pixels has no shape of surroundings", "4:3 or 3:4"),
        ("a folder", r"lacks '.*sky_top.png'", "six faces"),
        ("too large", r"picture '.*big.hdr' is too large: 40000 by 20000", "at most"),
        ("five", "six pictures, not 5: it lacks bottom", "in the order right, left, top"),
    ],
)
def test_what_is_wrong_is_said_with_the_file_and_the_cure(what: str, said: str, cure: str, tmp_path: Path) -> None:
    source = spoilt(what, tmp_path)
    with pytest.raises(ParameterError, match=said) as caught:
        Environment(source).texels()  # type: ignore[arg-type]
    assert cure in caught.value.hint
    if what != "half a picture":
        # The heads of the files tell it already.
        with pytest.raises(ParameterError, match=said):
            Environment(source).check()  # type: ignore[arg-type]


@pytest.mark.parametrize("source", [5, None, ["a.png", 5], [], ("a.png",) * 7, "skye", "room.", ""])
def test_what_is_no_surroundings(source: object) -> None:
    with pytest.raises(ParameterError, match=r"environment|six pictures"):
        Environment(source)  # type: ignore[arg-type]


@pytest.mark.parametrize("strength", [-1, float("nan"), float("inf"), True, "much", 1e9])
def test_what_is_no_strength(strength: object) -> None:
    with pytest.raises(ParameterError, match="strength"):
        Environment("sky", strength)  # type: ignore[arg-type]
