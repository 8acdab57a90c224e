from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest

import zeroset as zs
from zeroset.errors import CameraError, ParameterError, ZerosetError
from zeroset.rendering.frame import settle
from zeroset.runtime import Device, get_device

Array = np.ndarray[Any, Any]
TORUS = zs.surface("(x^2 + y^2 + z^2 + a)^2 = 4(x^2 + y^2)", {"a": 0.75}, bounds=1.7)
SIDE = zs.Camera(eye=(2.0, -4.0, 1.5))
FLAT = zs.Camera(eye=(2.0, -4.0, 1.5), height=3.2)


def pixel_rays(camera: zs.Camera, width: int, height: int) -> tuple[Array, Array]:
    """Origins and directions of all pixels, row by row."""
    eye, across, upwards, forward, right, up = map(np.array, camera.rays(width, height))
    longer = max(width, height)
    u = ((2 * (np.arange(width) + 0.5) - width) / longer)[None, :, None]
    v = (-(2 * (np.arange(height) + 0.5) - height) / longer)[:, None, None]
    origins = (eye + u * across + v * upwards).reshape(-1, 3)
    return origins, (forward + u * right + v * up).reshape(-1, 3)


@pytest.mark.parametrize("method", ["auto", "interval", "marching-points"])
@pytest.mark.parametrize("camera", [SIDE, FLAT], ids=["perspective", "orthographic"])
def test_a_picture_is_a_cast_of_its_pixels(camera: zs.Camera, method: str) -> None:
    width, height = 45, 30
    image = zs.render(TORUS, (width, height), camera, method)
    hits = zs.cast(TORUS, *pixel_rays(camera, width, height), method=method)
    status, t = image.aov("status").ravel(), image.aov("t").ravel()
    # The two make a pixel's ray in different precisions: at the very edge they may see different things.
    same = (status > 0) == (hits.status > 0)
    assert same.mean() > 0.99
    both = (status == 1) & (hits.status == 1)
    assert both.sum() > 300
    close = np.abs(t - hits.t)[both] < 4 * 3.4 * 2.0**-14 + 1e-3
    assert close.mean() > 0.99
    turned = np.einsum("ij,ij->i", image.aov("normal").reshape(-1, 3), hits.normal)[both]
    assert np.mean(turned > 0.999) > 0.98


@pytest.mark.parametrize("size", [(1, 1), (7, 5), (1, 33), (513, 31)])
def test_odd_sizes(size: tuple[int, int]) -> None:
    image = zs.render(TORUS, size, zs.Camera(eye=(0, -0.1, 4)))
    width, height = size
    assert image.size == size
    assert np.asarray(image).shape == (height, width, 3)
    assert image.aov("depth").shape == (height, width)
    assert image.aov("normal").shape == (height, width, 3)
    square = zs.render(TORUS, max(size), zs.Camera(eye=(0, -0.1, 4), fov=170))
    assert square.size == (max(size), max(size))


def test_a_frame_that_is_cut_from_a_larger_one_is_the_same() -> None:
    # Same pixels on screen, other tiles: what tiling does must not show.
    big = zs.render(TORUS, (64, 64), FLAT)
    small = zs.render(TORUS, (32, 32), zs.Camera(eye=FLAT.eye, height=1.6))
    inner = big.aov("status")[16:48, 16:48]
    assert np.mean(inner == small.aov("status")) > 0.99


def test_drawing_again_compiles_nothing_and_other_numbers_show(monkeypatch: pytest.MonkeyPatch) -> None:
    device = get_device("cpu")
    first = zs.render(TORUS, 48, SIDE)
    # What was made in a hurry for the first picture is made again, once, in the background.
    settle()

    def refuse(*_: object) -> None:
        raise AssertionError("compiled again")

    known = device.compile_cached
    monkeypatch.setattr(device, "compile", refuse)
    monkeypatch.setattr(device, "compile_cached", lambda key, _, quick=False: known(key, refuse, quick))
    hits = first.hits
    thinner = zs.render(TORUS.with_params(a=0.9), 48, SIDE)
    nearer = zs.render(TORUS, 48, zs.Camera(eye=(1.0, -2.5, 1.0)))
    dark = zs.render(TORUS, 48, SIDE, background=(0.0, 0.0, 0.0))
    smaller = zs.render(TORUS.with_bounds(1.2), 48, SIDE)
    assert thinner.hits < hits
    assert nearer.hits > hits
    assert dark.pixels[0, 0].tolist() == [0, 0, 0]
    assert first.pixels[0, 0].tolist() == [255, 255, 255]
    assert smaller.hits < hits
    again = zs.render(TORUS, 48, SIDE)
    assert np.array_equal(again.pixels, first.pixels)


def test_an_image_stays_what_it_was_after_the_next_draw() -> None:
    first = zs.render(TORUS, 40, SIDE)
    depth, pixels = first.aov("depth"), first.pixels.copy()
    second = zs.render(TORUS.with_params(a=0.9), 40, SIDE)
    assert np.array_equal(first.aov("depth"), depth)
    assert np.array_equal(first.pixels, pixels)
    assert not np.array_equal(second.aov("depth"), depth)


def test_progress_runs_from_nothing_to_all_and_may_stop_the_work() -> None:
    shares: list[float] = []
    watched = zs.render(TORUS, 100, SIDE, progress=shares.append)
    assert shares[0] == 0
    assert all(a < b <= 1 for a, b in itertools.pairwise(shares))
    assert len(shares) > 5
    assert np.array_equal(watched.pixels, zs.render(TORUS, 100, SIDE).pixels)

    def stop(share: float) -> None:
        if share > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        zs.render(TORUS, 100, SIDE, progress=stop)
    assert np.array_equal(watched.pixels, zs.render(TORUS, 100, SIDE).pixels)


def test_empty_pictures_are_background() -> None:
    image = zs.render(zs.surface("x^2 + y^2 + z^2 + 1", bounds=1.0), 32, background=(0.0, 1.0, 0.0))
    assert (image.hits, image.unresolved, image.certified) == (0, 0, True)
    assert np.all(image.pixels == (0, 255, 0))
    assert np.all(np.isinf(image.aov("depth")))
    assert np.all(np.isnan(image.aov("t")))


def test_both_sides_have_their_colours() -> None:
    material = zs.Material(front=(1, 0, 0), back=(0, 0, 1), specular=0.0)
    plane = zs.surface("z", bounds=1.0)
    above = zs.render(plane, 16, zs.Camera(eye=(0, 0, 4), up=(0, 1, 0)), material=material).pixels[8, 8]
    below = zs.render(plane, 16, zs.Camera(eye=(0, 0, -4), up=(0, 1, 0)), material=material).pixels[8, 8]
    assert above[0] > 100 > above[2]
    assert below[2] > 100 > below[0]


def test_lights_shine_from_where_they_are() -> None:
    ball = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.2)
    camera = zs.Camera(eye=(0, -4, 0))
    for headlight in (True, False):
        sun = zs.Light((1.0, 0.0, 0.0), headlight=headlight)
        picture = zs.render(ball, 32, camera, lights=[sun]).pixels.astype(int).sum(axis=2)
        assert picture[16, 22] > picture[16, 10] + 100
    unlit = zs.render(ball, 32, camera, lights=[], material=zs.Material(ambient=0.0)).pixels
    assert unlit[16, 16].tolist() == [0, 0, 0]


@pytest.mark.parametrize(
    ("options", "error", "said"),
    [
        ({"size": 0}, ZerosetError, "from 1 to"),
        ({"size": -1}, ZerosetError, "from 1 to"),
        ({"size": 99999}, ZerosetError, "from 1 to"),
        ({"size": (16384, 16384)}, ZerosetError, "more than"),
        ({"size": (3,)}, ZerosetError, "width and height"),
        ({"size": (3, 4, 5)}, ZerosetError, "width and height"),
        ({"size": 2.5}, ZerosetError, "width and height"),
        ({"size": math.inf}, ZerosetError, "width and height"),
        ({"size": "64"}, ZerosetError, "width and height"),
        ({"tolerance": 0.0}, ParameterError, "tolerance"),
        ({"tolerance": math.inf}, ParameterError, "tolerance"),
        ({"background": "white"}, ParameterError, "background"),
        ({"background": (1.0, 2.0)}, ParameterError, "background"),
        ({"lights": [3]}, ParameterError, "Lights"),
        ({"material": "gold"}, ParameterError, "Material"),
        ({"camera": "there"}, CameraError, "camera"),
        ({"surface": 3}, ZerosetError, "cannot draw"),
    ],
)
def test_bad_arguments_are_refused(options: dict[str, Any], error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        zs.render(**{"surface": TORUS, "size": 8, **options})


def test_a_device_can_be_given() -> None:
    device: Device = get_device("interp")
    plane = zs.surface("z", bounds=1.0)
    slow, fast = (zs.render(plane, 8, SIDE, device=d, method="marching-points") for d in (device, "cpu"))
    assert np.mean(slow.aov("status") == fast.aov("status")) > 0.95


@pytest.mark.parametrize("formula", ["floor(x) = 1/2", "sign(x) + sign(y) + sign(z)", "if(x < 0, 1, -1)", "0^x + y"])
@pytest.mark.parametrize("method", ["auto", "interval"])
def test_what_is_constant_piece_by_piece_is_drawn_where_it_jumps(formula: str, method: str) -> None:
    image = zs.render(zs.surface(formula, bounds=2), 48, method=method, device="cpu")
    assert image.hits > 100
    assert image.unresolved > 100


def test_where_functions_overflow_a_ray_is_left_open_and_not_walked_along_for_minutes() -> None:
    tower = zs.surface("exp(exp(exp(x))) = y + 5", bounds=3)
    hits = zs.cast(tower, [-2.5, 0, 0], [1, 0, 0], max_hits=3, device="cpu")
    assert hits.status[0].tolist() == [zs.HIT, zs.UNRESOLVED, zs.MISS]
    assert hits.t[0, 0] == pytest.approx(2.5 + np.log(np.log(np.log(5))), abs=1e-3)
    assert hits.steps.max() < 40_000


def test_searches_in_f64_can_be_given_up() -> None:
    """All rays of a jump are searched again, one after the other: who waits hears of it every now and then."""
    shares: list[float] = []
    image = zs.render(zs.surface("z = floor(x)", bounds=2.0), 128, device="cpu", progress=shares.append)
    assert image.unresolved > 1200
    assert shares.count(1.0) >= 3

    class GivenUpError(Exception):
        pass

    def give_up(share: float) -> None:
        if share == 1.0:
            raise GivenUpError

    with pytest.raises(GivenUpError):
        zs.render(zs.surface("z = floor(x)", bounds=2.0), 128, device="cpu", progress=give_up)
