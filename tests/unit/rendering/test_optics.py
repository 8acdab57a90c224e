"""Rays beyond the first hit, against closed forms: layers, a plane mirror, a slab, a ball lens, total reflection."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.errors import ParameterError, SceneFileError
from zeroset.scene.encoding import srgb
from zeroset.scene.environment import Environment, sky
from zeroset.scene.radiance import radiance

DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]
SIZE = 96
DARK = {"ambient": 0.0, "diffuse": 0.0, "specular": 0.0}


def bytes_of(linear: np.ndarray) -> np.ndarray:
    return np.vectorize(srgb)(np.clip(linear, 0, 1)) * 255


def directions(camera: zs.Camera) -> tuple[np.ndarray, np.ndarray]:
    """The eye and each pixel's unit direction."""
    eye, _, _, forward, right, up = (np.asarray(v) for v in camera.rays(SIZE, SIZE))
    u = (np.arange(SIZE) + 0.5) * 2 / SIZE - 1
    d = forward + u[None, :, None] * right - u[:, None, None] * up
    return eye, d / np.linalg.norm(d, axis=-1, keepdims=True)


def agrees(image: zs.Image, direction: np.ndarray, where: np.ndarray, share: float = 0.99) -> None:
    """The image shows the sky of these directions, but near the sun, which is sharper than the map."""
    wanted = bytes_of(sky(direction))
    smooth = where & (direction @ np.array((0.48, -0.60, 0.64)) < 0.97) & (np.abs(direction[..., 2]) > 0.02)
    assert np.count_nonzero(smooth) > 300
    apart = np.abs(np.asarray(image).astype(float) - wanted).max(axis=-1)[smooth]
    assert np.mean(apart <= 3) >= share, np.sort(apart)[-20:]


@pytest.mark.parametrize("name", ["sphere", "endrass", "barth-decic"])
def test_a_picture_has_as_many_layers_as_rays_have_roots(name: str) -> None:
    """Each layer halves the light that comes from a white background."""
    surface, black = zs.gallery[name], zs.Material(front=(0, 0, 0), back=(0, 0, 0), **DARK, opacity=0.5)
    image = zs.render(surface, SIZE, material=black, background=(1, 1, 1), depth=9, thin=False, device="cpu")
    assert surface.camera is not None
    eye, ways = directions(surface.camera)
    hits = zs.cast(surface, eye, ways.reshape(-1, 3), max_hits=10)
    roots = np.count_nonzero(hits.status, axis=1).reshape(SIZE, SIZE)
    shades = np.array([bytes_of(np.array(0.5**n)) for n in range(11)])
    layers = np.abs(np.asarray(image)[..., :1].astype(float) - shades).argmin(axis=-1)
    # A few more are pairs of roots so close behind another that f32 takes them for it.
    assert np.all(layers <= roots)
    assert np.mean(layers < roots) < 0.004
    assert roots.max() >= 2


@pytest.mark.parametrize("device", DEVICES)
def test_layers_add_up_from_front_to_back(device: str) -> None:
    shells = zs.surface("(r2 - 1)(r2 - 2)(r2 - 3)".replace("r2", "(x^2+y^2+z^2)"), bounds=2.0)
    red = zs.Material(front=(1, 0, 0), back=(1, 0, 0), ambient=1, diffuse=0, specular=0, opacity=0.3)
    for depth, layers in ((None, 4), (0, 1), (2, 3), (9, 6)):
        image = zs.render(shells, SIZE, material=red, background=(0, 0, 1), depth=depth, device=device)
        left = 0.7**layers
        wanted = bytes_of(np.array((1 - left, 0, left)))
        assert np.asarray(image)[SIZE // 2, SIZE // 2] == pytest.approx(wanted, abs=1.01), depth
        assert np.asarray(image)[0, 0].tolist() == [0, 0, 255]


@pytest.mark.parametrize("device", DEVICES)
def test_the_last_layer_may_be_solid(device: str) -> None:
    """K09 section 6.2: transparency counts only in front of another surface."""
    shells = zs.surface("(r2 - 1)(r2 - 2)(r2 - 3)".replace("r2", "(x^2+y^2+z^2)"), bounds=2.0)
    sides = zs.Material((1, 0, 0), (0, 1, 0), ambient=1, diffuse=0, specular=0, opacity=0.3, last_solid=True)
    for depth, layers in ((None, 4), (0, 1), (2, 3), (9, 6)):
        image = zs.render(shells, SIZE, material=sides, background=(0, 0, 1), depth=depth, device=device)
        shares = [0.3 * 0.7**k for k in range(layers - 1)] + [0.7 ** (layers - 1)]
        # Ever by turns a ray sees the side that it enters by and the one that it leaves by.
        wanted = bytes_of(np.array((sum(shares[::2]), sum(shares[1::2]), 0)))
        assert np.asarray(image)[SIZE // 2, SIZE // 2] == pytest.approx(wanted, abs=1.01), depth
        assert np.asarray(image)[0, 0].tolist() == [0, 0, 255]


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("more", [{}, {"reflectance": 0.4}, {"ior": 1.3}, {"reflectance": 0.4, "ior": 1.3}], ids=str)
def test_alone_a_surface_whose_last_layer_is_solid_is_solid(more: dict[str, float], device: str) -> None:
    floor = zs.surface("z", bounds=zs.Box((-4, -4, -0.5), (4, 4, 0.5)))
    camera = zs.Camera(eye=(0, -6, 3), target=(0, 0, 0.4), fov=50)
    solid = zs.Material(**{**more, "ior": 1.0})
    glass = zs.Material(**more, opacity=0.3, last_solid=True)
    a, b = (
        np.asarray(zs.render(floor, SIZE, camera=camera, material=m, environment="sky", device=device)).astype(int)
        for m in (solid, glass)
    )
    assert np.abs(a - b).max() <= 1


def test_each_part_says_whether_its_last_layer_is_solid() -> None:
    flat = {"ambient": 1.0, "diffuse": 0.0, "specular": 0.0, "opacity": 0.5}
    balls = [
        zs.surface(f"(x - {x})^2 + y^2 + z^2 - 1", bounds=zs.Ball(1.2, (x, 0, 0))).with_material(
            zs.Material((1, 0, 0), (0, 1, 0), **flat, last_solid=last)
        )
        for x, last in ((-1.5, True), (1.5, False))
    ]
    camera = zs.Camera(eye=(0, -9, 0), height=6.0)
    image = np.asarray(zs.render(zs.Scene(balls, camera=camera), SIZE, background=(0, 0, 1)))
    left, right = image[SIZE // 2, SIZE // 4], image[SIZE // 2, 3 * SIZE // 4]
    assert left == pytest.approx(bytes_of(np.array((0.5, 0.5, 0.0))), abs=1.01)
    assert right == pytest.approx(bytes_of(np.array((0.5, 0.25, 0.25))), abs=1.01)


@pytest.mark.parametrize("device", DEVICES)
def test_a_plane_mirror_shows_the_sky_upside_down(device: str) -> None:
    floor = zs.surface("z", bounds=zs.Box((-4, -4, -0.5), (4, 4, 0.5)))
    camera = zs.Camera(eye=(0, -6, 3), target=(0, 0, 0.4), fov=50)
    image = zs.render(
        floor, SIZE, camera=camera, material=zs.Material(reflectance=1.0), environment="sky", device=device
    )
    _, d = directions(camera)
    seen = np.where((image.aov("status") > 0)[..., None], d * (1, 1, -1), d)
    agrees(image, seen, np.ones((SIZE, SIZE), bool))


@pytest.mark.parametrize("device", DEVICES)
def test_a_slab_bends_light_and_bends_it_back(device: str) -> None:
    slab = zs.surface("z^2 - 0.04", bounds=zs.Box((-4, -4, -0.5), (4, 4, 0.5)))
    glass = zs.Material(**DARK, opacity=0.0, ior=1.5)
    camera = zs.Camera(eye=(0, -2, 5), target=(0, 0, 0), fov=30)
    image = zs.render(slab, SIZE, camera=camera, material=glass, environment="sky", device=device)
    _, d = directions(camera)
    assert image.hits == SIZE * SIZE
    agrees(image, d, np.ones((SIZE, SIZE), bool))


@pytest.mark.parametrize("device", DEVICES)
def test_a_ball_lens_obeys_snell(device: str) -> None:
    ball = zs.surface("x^2 + y^2 + z^2 - 1", bounds=1.2)
    index = 1.4
    glass = zs.Material(**DARK, opacity=0.0, ior=index)
    camera = zs.Camera(eye=(1, -4, -2.5), target=(0, 0, 0), fov=30)
    image = zs.render(ball, SIZE, camera=camera, material=glass, environment="sky", device=device)
    eye, d = directions(camera)
    middle = -(d @ eye)
    nearest = eye + middle[..., None] * d
    offset = np.linalg.norm(nearest, axis=-1)
    inside = offset < 0.9
    # In and out the ray turns by the same angle, in its plane with the centre.
    turn = 2 * (np.arcsin(np.minimum(offset, 1)) - np.arcsin(np.minimum(offset, 1) / index))
    towards = -nearest / np.maximum(offset, 1e-9)[..., None]
    bent = np.cos(turn)[..., None] * d + np.sin(turn)[..., None] * towards
    agrees(image, bent, inside, share=0.97)


def test_total_reflection_keeps_light_inside() -> None:
    """Seen from inside a dense block, a face beyond the critical angle is a mirror."""
    water = zs.surface("z", bounds=zs.Box((-40, -40, -3), (40, 40, 1)))
    camera = zs.Camera(eye=(0, 0, -2.5), target=(0, 10, -1.0), fov=40)
    image = zs.render(water, SIZE, camera=camera, material=zs.Material(**DARK, opacity=0, ior=1.5), environment="sky")
    _, d = directions(camera)
    beyond = (image.aov("status") > 0) & (np.hypot(d[..., 0], d[..., 1]) > 1.02 / 1.5)
    agrees(image, d * (1, 1, -1), beyond)


def test_a_pixel_without_a_hit_shows_the_surroundings() -> None:
    ball = zs.surface("x^2 + y^2 + z^2 - 1", bounds=1.2)
    image = zs.render(ball, SIZE, environment=Environment("sky", 0.5))
    plain = zs.render(ball, SIZE, environment="sky")
    missed = image.aov("status") == 0
    half, full = (np.asarray(i).astype(int).sum(axis=-1)[missed] for i in (image, plain))
    assert np.all(half < full)
    assert np.array_equal(image.aov("status"), zs.render(ball, SIZE).aov("status"))


def test_shadows_fall_on_what_mirrors_too() -> None:
    scene = zs.surface("z (x^2 + y^2 + (z - 1.5)^2 - 0.25)", bounds=zs.Box((-3, -3, -0.5), (3, 3, 2.2)))
    sun = [zs.Light(direction=(0, 0, 1), headlight=False)]
    camera = zs.Camera(eye=(0, -9, 7), target=(0, 0, 0.5), fov=40)
    material = zs.Material(reflectance=0.1)
    free, dark = (
        np.asarray(zs.render(scene, SIZE, camera=camera, lights=sun, material=material, shadows=s)).astype(int)
        for s in (False, True)
    )
    assert np.count_nonzero((free - dark).sum(axis=-1) > 20) > 50


# ------------------------------------------------------------- surroundings


def test_a_picture_all_around(tmp_path: Path) -> None:
    rows = np.zeros((32, 64, 3), np.uint8)
    rows[:16] = (255, 0, 0)
    rows[16:, :32] = (0, 255, 0)
    rows[16:, 32:] = (0, 0, 255)
    Pillow.fromarray(rows).save(tmp_path / "around.png")
    faces = Environment(str(tmp_path / "around.png")).texels().reshape(6, 16, 16, 3)
    assert faces[4].reshape(-1, 3).tolist() == [[1, 0, 0]] * 256
    # The left half of the picture is towards +y.
    assert faces[2][12, 8].tolist() == [0, 1, 0]
    assert faces[3][12, 8].tolist() == [0, 0, 1]


def test_radiance_pictures() -> None:
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n"
    plain = head + bytes([128, 64, 0, 130]) * 8
    assert radiance(plain)[0, 3].tolist() == [2.0, 1.0, 0.0]
    runs = (
        head
        + b"\x02\x02\x00\x08"
        + b"\x88\x80"
        + b"\x84\x40\x84\x20"
        + b"\x88\x00"
        + b"\x03"
        + bytes([130] * 3)
        + b"\x85\x81"
    )
    made = radiance(runs)
    assert made[0, 0].tolist() == [2.0, 1.0, 0.0]
    assert made[0, 7].tolist() == [1.0, 0.25, 0.0]
    for wrong in (b"", b"#?RADIANCE\n\n-Y 2 +X 8\n", plain[:-9], head + b"\x02\x02\x00\x08\xff\x00"):
        with pytest.raises(ParameterError, match="no Radiance"):
            radiance(wrong)


def test_optics_in_scene_files(tmp_path: Path) -> None:
    ball = zs.surface("x^2 + y^2 + z^2 - 1")
    for around in ("sky", Environment("room", 2.0)):
        scene = zs.Scene(ball, material=zs.Material(opacity=0.5, reflectance=0.25, ior=1.5), environment=around)
        assert zs.load(zs.save(scene, tmp_path / "scene.toml")) == scene
    text = (tmp_path / "scene.toml").read_text()
    (tmp_path / "wrong.toml").write_text(text.replace("ior = 1.5", "ior = 0.0"))
    with pytest.raises(SceneFileError, match="index of refraction") as error:
        zs.load(tmp_path / "wrong.toml")
    assert "wrong.toml:25" in str(error.value)


@pytest.mark.parametrize(
    ("arguments", "wrong"),
    [
        ({"environment": "skye"}, "no environment 'skye'"),
        ({"environment": "nowhere.png"}, "there is no picture 'nowhere.png'"),
        ({"environment": 5}, "an environment must be"),
        ({"depth": 33, "environment": "sky"}, "the depth must be"),
    ],
    ids=lambda v: str(v) if isinstance(v, str) else "",
)
def test_optics_that_cannot_be(arguments: dict, wrong: str) -> None:
    with pytest.raises(ParameterError, match=wrong):
        zs.render("x^2 + y^2 + z^2 - 1", 16, **arguments)


@pytest.mark.parametrize("name", ["opacity", "reflectance"])
def test_materials_that_cannot_be(name: str) -> None:
    for value in (-0.1, 1.1, float("nan")):
        with pytest.raises(ParameterError, match=name):
            zs.Material(**{name: value})


def test_a_surface_that_a_ray_comes_from_is_not_met_again() -> None:
    """A ball has two layers wherever it is seen; at its outline f is hardly more than rounding for a while."""
    black = zs.Material(front=(0, 0, 0), back=(0, 0, 0), ambient=1, diffuse=0, specular=0, opacity=0.5)
    ball = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.05)
    camera = zs.Camera(eye=(3, -2, 1.5), target=(0, 0, 0), fov=35)
    image = zs.render(ball, 256, camera=camera, material=black, background=(1, 1, 1), depth=8, device="cpu")
    values, counts = np.unique(image.pixels[..., 0], return_counts=True)
    found = dict(zip(values.tolist(), counts.tolist(), strict=True))
    # White, and a quarter of it in sRGB.
    assert found.pop(255) + found.pop(137) >= 256 * 256 - 30
    assert min(found, default=99) >= 99, "four layers"
