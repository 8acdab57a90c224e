"""Antialiasing against what pixels should hold: the share of each that a disc covers."""

from __future__ import annotations

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.errors import ParameterError

SIZE = 64
BALL = zs.surface("x^2 + y^2 + z^2 - 1", bounds=1.5)
FLAT = zs.Material(front=(1, 1, 1), back=(1, 1, 1), ambient=1, diffuse=0, specular=0)
CAMERA = zs.Camera(eye=(0, 0, 5), up=(0, 1, 0), height=3.0)


def linear(image: zs.Image) -> np.ndarray:
    encoded = np.asarray(image)[..., 0] / 255
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def coverage(fine: int = 40) -> np.ndarray:
    """The share of each pixel that the unit disc covers."""
    ticks = (np.arange(SIZE * fine) + 0.5) * 3.0 / (SIZE * fine) - 1.5
    inside = np.hypot(*np.meshgrid(ticks, ticks)) < 1
    return inside.reshape(SIZE, fine, SIZE, fine).mean(axis=(1, 3))


def draw(**arguments: object) -> zs.Image:
    return zs.render(BALL, SIZE, camera=CAMERA, material=FLAT, background=(0, 0, 0), **arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize("device", ["cpu", pytest.param("gpu", marks=needs_gpu)])
@pytest.mark.parametrize("how", [{"antialias": 64}, {"samples": 64}], ids=str)
def test_edges_show_how_much_is_covered(how: dict[str, int], device: str) -> None:
    wanted = coverage()
    smooth = linear(draw(**how, device=device))
    assert np.abs(smooth - wanted).max() < 0.08
    assert np.abs(smooth - wanted).mean() < 0.15 * np.abs(linear(draw()) - wanted).mean()
    assert smooth.sum() == pytest.approx(np.pi * (SIZE / 3) ** 2, rel=2e-3)


def test_only_edges_cost_more() -> None:
    tangle = zs.gallery["tangle"]
    plain, smooth = (zs.render(tangle, 200, antialias=n) for n in (1, 16))
    apart = np.abs(np.asarray(plain).astype(int) - np.asarray(smooth)).max(axis=-1)
    assert 0.01 < np.mean(apart > 2) < 0.15
    assert np.array_equal(plain.aov("status"), smooth.aov("status"))


def test_creases_and_sheets_behind_each_other_are_edges() -> None:
    crease = zs.surface("z - |x|", bounds=zs.Box((-1, -1, -0.5), (1, 1, 1.2)))
    camera = zs.Camera(eye=(0.5, -3, 3), target=(0.01, 0, 0.2))
    plain, smooth = (zs.render(crease, 96, camera=camera, antialias=n) for n in (1, 16))
    changed = np.abs(np.asarray(plain).astype(int) - np.asarray(smooth)).max(axis=-1) > 2
    normal = plain.aov("normal")
    # Where the surface is seen on both sides of the crease, that lies between two columns.
    at = [(row, c) for row in range(40, 56) for c in range(1, 95) if normal[row, c, 0] * normal[row, c + 1, 0] < 0]
    assert len(at) > 10
    assert np.mean([changed[row, c] or changed[row, c + 1] for row, c in at]) > 0.7
    steps = zs.surface("(z - 0.5 + floor(x))", bounds=zs.Box((-2, -1, -2), (2, 1, 2)))
    assert zs.render(steps, 64, antialias=8).hits > 0


def test_what_is_thinner_than_a_pixel_stays() -> None:
    steiner = zs.gallery["steiner"]
    plain, smooth = (zs.render(steiner, 200, antialias=n) for n in (1, 16))
    thin = plain.aov("status") == zs.UNRESOLVED
    assert thin.sum() > 50
    assert np.abs(np.asarray(plain).astype(int) - np.asarray(smooth))[thin].max() <= 2


def test_methods_without_beams_too() -> None:
    smooth = linear(draw(antialias=16, method="marching-points"))
    assert np.abs(smooth - coverage()).max() < 0.2


def test_as_many_rays_as_there_may_be() -> None:
    everything = linear(draw(samples=256))
    assert np.abs(everything - coverage()).max() < 0.05


@pytest.mark.parametrize("name", ["antialias", "samples"])
@pytest.mark.parametrize("wrong", [0, 257, 1.5, "many"])
def test_numbers_of_rays_that_cannot_be(name: str, wrong: object) -> None:
    with pytest.raises(ParameterError, match=name):
        draw(**{name: wrong})
