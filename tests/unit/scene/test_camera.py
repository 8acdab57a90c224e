from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from zeroset.errors import CameraError
from zeroset.scene.bounds import Ball, Box
from zeroset.scene.camera import Camera, fit_camera, parse_camera

Array = np.ndarray[Any, Any]


def ray(camera: Camera, u: float, v: float, width: int = 100, height: int = 100) -> tuple[Array, Array]:
    eye, across, upwards, forward, right, up = map(np.array, camera.rays(width, height))
    return eye + u * across + v * upwards, forward + u * right + v * up


def angle(a: Array, b: Array) -> float:
    return math.degrees(math.acos(np.dot(a, b) / np.linalg.norm(a) / np.linalg.norm(b)))


@pytest.mark.parametrize("height", [None, 3.0])
def test_the_middle_ray_goes_from_the_eye_to_the_target(height: float | None) -> None:
    camera = Camera(eye=(1, 2, 3), target=(4, 6, 3), height=height)
    origin, direction = ray(camera, 0, 0)
    assert np.allclose(origin, (1, 2, 3))
    assert np.allclose(direction, (0.6, 0.8, 0))


@pytest.mark.parametrize(("width", "height", "u", "v"), [(100, 100, 1, 1), (200, 100, 1, 0.5), (100, 300, 1 / 3, 1)])
def test_fov_spans_the_shorter_side(width: int, height: int, u: float, v: float) -> None:
    camera = Camera(fov=40)
    along = min(width, height) / max(width, height)
    if width <= height:
        left, right = ray(camera, -along, 0, width, height)[1], ray(camera, along, 0, width, height)[1]
    else:
        left, right = ray(camera, 0, -along, width, height)[1], ray(camera, 0, along, width, height)[1]
    assert angle(left, right) == pytest.approx(40)


def test_an_orthographic_camera_has_parallel_rays_its_height_apart() -> None:
    camera = Camera(eye=(0, -5, 0), height=3.0)
    (low, d0), (high, d1) = ray(camera, 0, -0.5, 200, 100), ray(camera, 0, 0.5, 200, 100)
    assert np.allclose(d0, d1)
    assert np.allclose(high - low, (0, 0, 3.0))


def test_right_is_right_and_up_is_up() -> None:
    camera = Camera(eye=(0, -5, 0))
    assert ray(camera, 0.5, 0)[1][0] > 0
    assert ray(camera, 0, 0.5)[1][2] > 0


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1)])
def test_looking_straight_along_up_still_gives_a_frame(axis: tuple[float, ...]) -> None:
    camera = Camera(eye=tuple(5.0 * v for v in axis), up=axis)
    _, _, _, forward, right, up = map(np.array, camera.rays(10, 10))
    assert np.allclose([forward @ right, forward @ up, right @ up], 0, atol=1e-12)
    assert np.linalg.norm(right) == pytest.approx(np.linalg.norm(up))


def test_orbit_turns_about_z_and_keeps_the_distance() -> None:
    camera = Camera(eye=(3, 0, 4), target=(0, 0, 0)).orbit(90)
    assert np.allclose(camera.eye, (0, 3, 4))
    assert np.allclose(camera.orbit(270).eye, (3, 0, 4))
    assert Camera(eye=(3, 0, 4)).orbit(0, 10).eye[2] > 4


def test_orbit_of_a_camera_above_turns_the_picture() -> None:
    above = Camera(eye=(0, 0, 5), up=(0, 1, 0))
    before, after = (np.array(camera.rays(10, 10).right) for camera in (above, above.orbit(90)))
    assert before @ after == pytest.approx(0, abs=1e-5 * (before @ before))


@pytest.mark.parametrize("bounds", [Ball(2.0), Ball(0.01, (5, 5, 5)), Box((0, 0, 0), (1, 2, 3))])
def test_the_fitted_camera_sees_the_whole_of_the_bounds(bounds: Ball | Box) -> None:
    camera = fit_camera(bounds)
    to_center = np.subtract(bounds.center, camera.eye)
    half = math.degrees(math.asin(bounds.reach / float(np.linalg.norm(to_center))))
    assert half < camera.fov / 2
    assert half > camera.fov / 2 * 0.9


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"eye": (1, 2)}, "eye must be three numbers"),
        ({"eye": "far"}, "eye must be three numbers"),
        ({"eye": (math.nan, 0, 0)}, "eye must be finite"),
        ({"target": (1e300, 0, 0)}, "target must be finite"),
        ({"eye": (0, 0, 0)}, "its own place"),
        ({"up": (0, 0, 0)}, "up must not be zero"),
        ({"fov": 0}, "fov"),
        ({"fov": 180}, "fov"),
        ({"fov": "wide"}, "fov must be a number"),
        ({"fov": None}, "fov"),
        ({"height": 0}, "height"),
        ({"height": math.inf}, "height must be finite"),
    ],
)
def test_a_camera_that_sees_nothing_is_refused(wrong: dict[str, Any], said: str) -> None:
    with pytest.raises(CameraError, match=said):
        Camera(**wrong)


def test_what_users_write() -> None:
    assert parse_camera({"eye": [1, 2, 3], "fov": 20}, Ball(1.0)) == Camera(eye=(1.0, 2.0, 3.0), fov=20)
    assert parse_camera(None, Ball(1.0)) == fit_camera(Ball(1.0))
    with pytest.raises(CameraError, match="no 'zoom'"):
        parse_camera({"zoom": 2}, Ball(1.0))
    with pytest.raises(CameraError, match="mapping"):
        parse_camera(5, Ball(1.0))
    with pytest.raises(CameraError, match="finite"):
        Camera().orbit(math.inf)
