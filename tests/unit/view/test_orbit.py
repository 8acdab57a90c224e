"""Camera control: what stays where it is, and what moves with the pointer."""

from __future__ import annotations

import math

import numpy as np
import pytest

import zeroset as zs
from zeroset.view import orbit

PERSPECTIVE = zs.Camera(eye=(3.0, -5.0, 2.0), target=(0.2, 0.1, -0.3), fov=40.0)
FLAT = zs.Camera(eye=(3.0, -5.0, 2.0), target=(0.2, 0.1, -0.3), height=4.0)
Y_UP = zs.Camera(eye=(1.0, 2.0, 6.0), up=(0.0, 1.0, 0.0), fov=30.0)
CAMERAS = pytest.mark.parametrize("camera", [PERSPECTIVE, FLAT, Y_UP], ids=["perspective", "flat", "y up"])
SIZE = (640.0, 480.0)


def seen(camera: zs.Camera, point: tuple[float, float, float]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.asarray(orbit.project(camera, SIZE, np.array([point]))[0][0])


@CAMERAS
def test_project_undoes_unproject(camera: zs.Camera) -> None:
    for x, y, depth in ((0.5, 0.5, 3.0), (320.0, 240.0, 6.0), (600.0, 33.0, 8.5)):
        place, found = orbit.project(camera, SIZE, np.array([orbit.unproject(camera, SIZE, x, y, depth)]))
        assert place[0] == pytest.approx((x, y), abs=1e-6)
        assert found[0] == pytest.approx(depth)


@CAMERAS
def test_pixels_are_where_the_renderer_has_them(camera: zs.Camera) -> None:
    surface = zs.surface("(x-0.5)^2 + (y+0.2)^2 + (z-0.1)^2 = 0.04", bounds=zs.Ball(0.3, (0.5, -0.2, 0.1)))
    image = zs.render(surface, (160, 120), camera)
    rows, columns = np.nonzero(image.aov("status"))
    place, _ = orbit.project(camera, (160.0, 120.0), np.array([(0.5, -0.2, 0.1)]))
    assert (columns.mean() + 0.5, rows.mean() + 0.5) == pytest.approx(tuple(place[0]), abs=0.6)


@CAMERAS
def test_zoom_keeps_the_point_under_the_pointer(camera: zs.Camera) -> None:
    point = orbit.unproject(camera, SIZE, 500.0, 100.0, 5.0)
    nearer = orbit.zoom(camera, 0.5, point)
    assert seen(nearer, point) == pytest.approx((500.0, 100.0), abs=1e-6)
    other = orbit.unproject(camera, SIZE, 480.0, 100.0, 5.0)
    assert math.dist(seen(nearer, other), (500.0, 100.0)) == pytest.approx(40.0, rel=0.01)


@CAMERAS
def test_pan_moves_what_is_at_its_depth_with_the_pointer(camera: zs.Camera) -> None:
    point = orbit.unproject(camera, SIZE, 200.0, 200.0, 4.5)
    moved = orbit.pan(camera, SIZE, 30.0, -12.0, 4.5)
    assert seen(moved, point) == pytest.approx((230.0, 188.0), abs=1e-6)


@CAMERAS
def test_turning_keeps_target_and_distance(camera: zs.Camera) -> None:
    turned = orbit.turn(camera, 33.0, -20.0)
    assert turned.target == camera.target
    assert orbit.distance(turned) == pytest.approx(orbit.distance(camera))
    assert orbit.turn(turned, -33.0, 20.0).eye == pytest.approx(camera.eye)


@CAMERAS
def test_turning_stops_short_of_the_poles(camera: zs.Camera) -> None:
    above = orbit.turn(camera, 0.0, 500.0)
    up = np.asarray(camera.up)
    assert np.dot(np.subtract(above.eye, above.target), up) == pytest.approx(orbit.distance(camera), rel=1e-5)
    right, *_ = orbit.frame(above)
    assert right == pytest.approx(orbit.frame(camera)[0], abs=1e-6)


@CAMERAS
def test_looking_keeps_the_eye(camera: zs.Camera) -> None:
    turned = orbit.look(camera, 25.0, 10.0)
    assert turned.eye == camera.eye
    assert orbit.distance(turned) == pytest.approx(orbit.distance(camera))


def test_walking_goes_along_the_cameras_own_axes() -> None:
    moved = orbit.walk(zs.Camera(eye=(0, -4, 0)), 1.0, 0.5, 0.25)
    assert moved.eye == pytest.approx((0.5, -3.0, 0.25))


@pytest.mark.parametrize("key", sorted(orbit.AXES))
@CAMERAS
def test_each_axis_view_looks_from_its_side(camera: zs.Camera, key: str) -> None:
    seen_from = orbit.along(camera, orbit.AXES[key])
    side = np.asarray(orbit.AXES[key]) / np.linalg.norm(orbit.AXES[key])
    offset = np.subtract(seen_from.eye, seen_from.target) / orbit.distance(seen_from)
    assert float(side @ offset) > 0.999999
    assert orbit.distance(seen_from) == pytest.approx(orbit.distance(camera))


def test_from_the_top_y_is_upwards() -> None:
    _, up, _ = orbit.frame(orbit.along(PERSPECTIVE, orbit.AXES["5"]))
    assert up == pytest.approx((0.0, 1.0, 0.0), abs=1e-2)


def test_the_target_is_as_large_in_both_projections() -> None:
    flat = orbit.orthographic(PERSPECTIVE)
    side = orbit.frame(PERSPECTIVE)[0] * 0.01
    x, y, z = (float(v) for v in np.add(PERSPECTIVE.target, side))
    assert seen(flat, (x, y, z)) == pytest.approx(seen(PERSPECTIVE, (x, y, z)), abs=1e-6)
    back = orbit.perspective(flat, 40.0)
    assert back.eye == pytest.approx(PERSPECTIVE.eye)
    assert orbit.perspective(PERSPECTIVE, 20.0).fov == 20.0


@CAMERAS
@pytest.mark.parametrize("bounds", [zs.Ball(2.5, (1.0, 0.0, 0.0)), zs.Box((-1, -2, -3), (1, 2, 3))], ids=str)
def test_fit_shows_the_whole_of_the_bounds(camera: zs.Camera, bounds: zs.Ball | zs.Box) -> None:
    fitted = orbit.fit(camera, bounds)
    angle = np.linspace(0, 2 * np.pi, 60)
    right, up, _ = orbit.frame(fitted)
    rim = np.asarray(bounds.center) + bounds.reach * (np.outer(np.cos(angle), right) + np.outer(np.sin(angle), up))
    place, _ = orbit.project(fitted, SIZE, rim)
    assert place.min() >= 0
    assert place[:, 0].max() <= SIZE[0]
    assert place[:, 1].max() <= SIZE[1]
    assert np.ptp(place[:, 1]) > 0.85 * SIZE[1]


def test_the_camera_follows_the_bounds() -> None:
    moved = orbit.refitted(PERSPECTIVE, zs.Ball(1.0), zs.Ball(2.0, (5.0, 0.0, 0.0)))
    assert moved.eye == pytest.approx((11.0, -10.0, 4.0))
    assert orbit.refitted(FLAT, zs.Ball(1.0), zs.Ball(2.0)).height == 8.0
