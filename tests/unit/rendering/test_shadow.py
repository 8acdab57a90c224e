"""Shadows against closed forms: a ball above a plane, lit from far away and from near."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.errors import ParameterError, SceneFileError

RADIUS, HEIGHT = 0.5, 1.5
BALL_OVER_PLANE = zs.surface(
    "z (x^2 + y^2 + (z - h)^2 - r^2)", {"h": HEIGHT, "r": RADIUS}, bounds=zs.Box((-3, -3, -0.5), (3, 3, 2.2))
)
CAMERA = zs.Camera(eye=(0, -9, 7), target=(0, 0, 0.5), fov=40)
DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]


def on_the_plane(image: zs.Image, size: int) -> tuple[np.ndarray, np.ndarray]:
    """World x and y of each pixel's point, and which points are on the plane."""
    rays = CAMERA.rays(size, size)
    u = (np.arange(size) + 0.5) * 2 / size - 1
    eye, _, _, forward, right, up = (np.asarray(v) for v in rays)
    direction = forward + u[None, :, None] * right - u[:, None, None] * up
    point = eye + image.aov("t")[..., None] * direction
    return point[..., :2], (image.aov("status") == zs.HIT) & (np.abs(point[..., 2]) < 0.01)


def lit_and_dark(light: zs.Light, device: str, size: int = 192) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points on the plane, and whether they are darker with shadows than without."""
    images = [
        zs.render(BALL_OVER_PLANE, size, camera=CAMERA, lights=[light], shadows=shadows, device=device)
        for shadows in (False, True)
    ]
    place, plane = on_the_plane(images[0], size)
    free, dark = (np.asarray(image).astype(int).sum(axis=-1) for image in images)
    return place[plane], (dark < free - 6)[plane], (dark > free)[plane]


@pytest.mark.parametrize("device", DEVICES)
def test_a_light_far_away_throws_the_ball_s_own_size(device: str) -> None:
    light = zs.Light(direction=(0.4, 0.0, 1.0), headlight=False)
    place, dark, brighter = lit_and_dark(light, device)
    assert not brighter.any()
    # Along the light the shadow of a ball on a plane is an ellipse, moved by the height.
    shift = -0.4 * HEIGHT
    stretch = np.hypot(1.0, 0.4)
    from_middle = np.hypot((place[:, 0] - shift) / stretch, place[:, 1])
    assert np.all(dark[from_middle < RADIUS - 0.02])
    assert not np.any(dark[from_middle > RADIUS + 0.02])
    assert np.count_nonzero(dark) > 200


@pytest.mark.parametrize("device", DEVICES)
def test_a_light_at_a_place_throws_a_larger_one(device: str) -> None:
    lamp = 4.0
    place, dark, _ = lit_and_dark(zs.Light(position=(0, 0, lamp), headlight=False), device)
    # The cone of rays that touch the ball: sin of its half angle is the radius over the distance.
    edge = lamp * np.tan(np.arcsin(RADIUS / (lamp - HEIGHT)))
    distance = np.hypot(*place.T)
    assert np.all(dark[distance < edge - 0.02])
    assert not np.any(dark[distance > edge + 0.02])


def test_what_is_behind_a_lamp_throws_no_shadow() -> None:
    place, dark, _ = lit_and_dark(zs.Light(position=(0, 0, 0.8), headlight=False), "cpu")
    assert len(place) > 1000
    assert not dark.any()


def test_a_convex_surface_has_no_shadow_on_itself() -> None:
    ball = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5)
    light = [zs.Light(direction=(1, -1, 1), headlight=False)]
    free, dark = (np.asarray(zs.render(ball, 200, lights=light, shadows=s)).astype(int) for s in (False, True))
    assert np.abs(free - dark).max() <= 2


def test_each_light_has_its_own() -> None:
    lights = [zs.Light(direction=(0.5, 0, 1), headlight=False), zs.Light(direction=(-0.5, 0, 1), headlight=False)]
    image = zs.render(BALL_OVER_PLANE, 192, camera=CAMERA, lights=lights, shadows=True)
    everywhere, plane = on_the_plane(image, 192)
    place, light = everywhere[plane], np.asarray(image).astype(int).sum(axis=-1)[plane]
    left, right = (np.hypot((place[:, 0] - s) / 1.118, place[:, 1]) for s in (0.75, -0.75))
    both = light[(left > RADIUS + 0.05) & (right > RADIUS + 0.05) & (np.hypot(*place.T) < 2)]
    one = light[(left < RADIUS - 0.05) & (right > RADIUS + 0.05)]
    assert one.max() < both.min()


def test_shadows_in_scene_files(tmp_path: Path) -> None:
    lamp = zs.Light(position=(1, 2, 3), headlight=False)
    scene = zs.Scene(BALL_OVER_PLANE, lights=(lamp,), shadows=True)
    again = zs.load(zs.save(scene, tmp_path / "scene.toml"))
    assert again.shadows
    assert again.lights == (lamp,)
    text = (tmp_path / "scene.toml").read_text()
    (tmp_path / "wrong.toml").write_text(text.replace("shadows = true", 'shadows = "yes"'))
    with pytest.raises(SceneFileError, match="true or false"):
        zs.load(tmp_path / "wrong.toml")


def test_shadows_that_cannot_be() -> None:
    with pytest.raises(ParameterError, match="shadow tolerance"):
        zs.render(BALL_OVER_PLANE, 32, shadows=True, shadow_tolerance=0.0)
    with pytest.raises(ParameterError, match="position"):
        zs.Light(position=(1, 2))  # type: ignore[arg-type]
