from __future__ import annotations

import numpy as np
import pytest

from zeroset.errors import CameraError
from zeroset.export.film.camera_path import Keys, slerp, turned
from zeroset.export.film.path import Moment
from zeroset.scene.camera import Camera

AROUND = [Camera((4, 0, 0)), Camera((0, 4, 1)), Camera((-4, 0, 2)), Camera((0, -4, 1))]


def distance(camera: Camera) -> float:
    return float(np.linalg.norm(np.subtract(camera.eye, camera.target)))


@pytest.mark.parametrize("cameras", [AROUND, [*AROUND, AROUND[0]], AROUND[:2]])
def test_the_way_passes_through_its_cameras(cameras: list[Camera]) -> None:
    closed = cameras[0] == cameras[-1]
    count = 4 * (len(cameras) - 1) + (not closed)
    for i, key in enumerate(cameras[:-1] if closed else cameras):
        camera = Keys(cameras).at(Moment(4 * i, count))
        assert np.allclose(camera.eye, key.eye)
        assert np.allclose(camera.up, key.up)
        assert camera.fov == pytest.approx(key.fov)


def test_a_closed_way_begins_again() -> None:
    way = Keys([*AROUND, AROUND[0]])
    assert way.closed
    assert np.allclose(way.at(Moment(40, 40)).eye, way.at(Moment(0, 40)).eye)


def test_the_way_is_smooth_and_goes_around() -> None:
    way = Keys([*AROUND, AROUND[0]])
    eyes = np.array([way.at(Moment(i, 400)).eye for i in range(400)])
    steps = np.linalg.norm(np.roll(eyes, -1, axis=0) - eyes, axis=1)
    turns = np.linalg.norm(np.roll(eyes, -1, axis=0) - 2 * eyes + np.roll(eyes, 1, axis=0), axis=1)
    assert steps.max() < 2 * steps.min()
    assert turns.max() < 0.05 * steps.max()
    assert np.linalg.norm(eyes, axis=1).min() > 3.9, "straight lines would pass the surface at 2.8"


def test_zooming_is_even_and_targets_move() -> None:
    way = Keys([Camera((1, 0, 0), fov=20), Camera((5, 0, 0), (1, 0, 0), fov=20)])
    cameras = [way.at(Moment(i, 5)) for i in range(5)]
    assert [distance(camera) for camera in cameras] == pytest.approx([1, 2**0.5, 2, 8**0.5, 4])
    assert [camera.target[0] for camera in cameras] == pytest.approx([0, 0.25, 0.5, 0.75, 1])


def test_orthographic_cameras() -> None:
    way = Keys([Camera((4, 0, 0), height=1), Camera((0, 4, 0), height=4)])
    middle = way.at(Moment(1, 3))
    assert (middle.fov, middle.height) == (None, pytest.approx(2))


def test_great_circles() -> None:
    a, b = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.6, 0.8])
    assert np.allclose(slerp(a, b, 0.5), (a + b) / 2**0.5)
    assert np.allclose(slerp(a, b, 2.0), -a)
    assert slerp(a, a, 0.3) is a


@pytest.mark.parametrize(
    ("cameras", "said"),
    [
        ([Camera((4, 0, 0)), Camera((-4, 0, 0))], "cameras 1 and 2 are on opposite sides"),
        ([Camera((4, 0, 0)), Camera((0, 4, 0), up=(0, 0, -1))], "up of cameras 1 and 2"),
        ([Camera((4, 0, 0))], "at least two"),
        ([Camera((4, 0, 0)), Camera((0, 4, 0), height=2)], "perspective to orthographic"),
        ([Camera((4, 0, 0)), (0, 4, 0)], "made of Cameras"),
        (3.0, "must be a Camera"),
    ],
)
def test_what_is_no_way(cameras: list[Camera], said: str) -> None:
    with pytest.raises(CameraError, match=said):
        Keys(cameras)


def test_turning() -> None:
    camera = Camera((4, 0, 1))
    assert turned(camera, 0.0, Moment(3, 8)) is camera
    assert np.allclose(turned(camera, 360.0, Moment(2, 8)).eye, (0, 4, 1)), "a whole turn leaves the end out"
    assert np.allclose(turned(camera, 90.0, Moment(2, 3)).eye, (0, 4, 1)), "a part of one reaches it"
