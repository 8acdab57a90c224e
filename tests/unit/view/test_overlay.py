"""Overlays against the outputs that they show."""

from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.view.overlay import HEAT, MARK, coloured, heat
from zeroset.view.state import OVERLAYS


@pytest.fixture(scope="module")
def image() -> zs.Image:
    # A double plane is UNRESOLVED, the ball is not.
    return zs.render(zs.surface("(z + 0.5)^2 * (x^2 + y^2 + (z - 0.5)^2 - 0.2)", bounds=1.2), (64, 48))


def test_no_overlay_is_the_picture(image: zs.Image) -> None:
    pixels, legend = coloured(image, "none")
    assert np.array_equal(pixels, image.pixels)
    assert legend is None


def test_steps_rise_from_dark_to_bright_up_to_the_legends_end(image: zs.Image) -> None:
    pixels, legend = coloured(image, "steps")
    steps = image.aov("steps")
    assert legend is not None
    assert legend.high == steps.max() > 0
    row, column = np.unravel_index(steps.argmax(), steps.shape)
    assert pixels[row, column].tolist() == HEAT[-1].tolist()
    bright = pixels.astype(float) @ (0.2126, 0.7152, 0.0722)
    order = np.argsort(steps, axis=None)
    assert np.all(np.diff(bright.ravel()[order]) >= -6), "more steps are never clearly darker"


def test_unresolved_pixels_are_marked_and_no_others(image: zs.Image) -> None:
    pixels, _ = coloured(image, "unresolved")
    marked = (pixels == MARK).all(axis=-1)
    assert np.array_equal(marked, image.aov("status") == zs.UNRESOLVED)
    assert marked.any()


def test_depth_is_brightest_where_it_is_nearest(image: zs.Image) -> None:
    pixels, legend = coloured(image, "depth")
    depth = image.aov("depth")
    seen = np.isfinite(depth)
    assert pixels[seen][:, 0][depth[seen].argmin()] == 255
    assert pixels[~seen].max() < pixels[seen].min()
    assert legend is not None
    assert (legend.high, legend.low) == (depth[seen].min(), depth[seen].max())


def test_normals_are_colours(image: zs.Image) -> None:
    pixels, _ = coloured(image, "normals")
    normal, hit = image.aov("normal"), image.aov("status") == zs.HIT
    assert np.abs(pixels[hit] / 127.5 - 1.0 - normal[hit]).max() < 0.01


@pytest.mark.parametrize("overlay", OVERLAYS)
def test_an_empty_picture_has_every_overlay(overlay: str) -> None:
    empty = zs.render(zs.surface("x^2 + y^2 + z^2 + 1", bounds=1.0), 16)
    pixels, _ = coloured(empty, overlay)
    assert pixels.shape == (16, 16, 3)
    assert pixels.dtype == np.uint8


def test_the_heat_map_takes_anything() -> None:
    assert heat(np.array([-1.0, 2.0, np.nan])).shape == (3, 3)
    assert np.all(np.diff(heat(np.linspace(0, 1, 50)).astype(float) @ (0.2126, 0.7152, 0.0722)) > -1.0)


def test_a_few_values_are_told_each() -> None:
    shells = zs.surface("x^2 + y^2 + z^2", bounds=1.5).with_isovalues((0.25, 1.0, 2.0))
    image = zs.render(shells, 24, material=zs.Material(coloring="isovalue"), device="cpu")
    _, legend = coloured(image, "none")
    assert legend is not None
    assert legend.values == (0.25, 1.0, 2.0)
    assert (legend.low, legend.high) == (0.25, 2.0)
