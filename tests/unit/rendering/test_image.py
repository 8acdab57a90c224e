from __future__ import annotations

import copy
import io
import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

import zeroset as zs
from zeroset.errors import OutputError, ZerosetError
from zeroset.rendering.image import AOVS, FORMATS, encode, picture_format

BALL = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.2)
CAMERA = zs.Camera(eye=(0, -4, 0), fov=35)


@pytest.fixture(scope="module")
def image() -> zs.Image:
    return zs.render(BALL, (48, 32), CAMERA)


def test_the_outputs_fit_together(image: zs.Image) -> None:
    status, depth, t = (image.aov(name) for name in ("status", "depth", "t"))
    seen = status > 0
    assert image.hits == seen.sum() > 300
    assert image.unresolved == np.sum(status == zs.UNRESOLVED)
    assert np.array_equal(np.isfinite(depth), seen)
    assert np.array_equal(np.isnan(t), ~seen)
    assert np.array_equal(depth[seen], t[seen])
    assert image.aov("steps").dtype == np.uint32
    # The nearest point is a unit before the ball's middle, four units from the eye.
    assert depth.min() == pytest.approx(3, abs=0.01)
    assert depth[seen].max() <= 4
    assert np.allclose(image.aov("normal")[16, 24], (0, -1, 0), atol=0.08)
    assert np.all(image.aov("normal")[~seen] == 0)


def test_unknown_outputs_are_named(image: zs.Image) -> None:
    with pytest.raises(ZerosetError, match="did you mean depth"):
        image.aov("deph")
    for nothing in (3, None, ["depth"], np.arange(2)):
        with pytest.raises(ZerosetError, match=r"there is no output(.|\n)*there are depth, normal"):
            image.aov(nothing)  # type: ignore[arg-type]
    assert {name: image.aov(name).shape[:2] for name in AOVS} == dict.fromkeys(AOVS, (32, 48))


def test_it_is_an_array(image: zs.Image) -> None:
    assert np.asarray(image).dtype == np.uint8
    assert np.asarray(image, dtype=float).dtype == float
    copied = np.array(image)
    copied[:] = 0
    assert np.asarray(image).max() == 255


@pytest.mark.parametrize("suffix", FORMATS)
def test_every_format_is_written(image: zs.Image, suffix: str, tmp_path: Path) -> None:
    path = image.save(tmp_path / f"a{suffix.upper()}")
    with Pillow.open(path) as read:
        assert read.format == FORMATS[suffix]
        assert read.size == (48, 32)
        difference = np.abs(np.asarray(read.convert("RGB")).astype(int) - np.asarray(image))
    assert difference.mean() < (4 if FORMATS[suffix] in ("JPEG", "WEBP") else 1e-9)
    assert list(tmp_path.iterdir()) == [path]


def test_it_shows_itself_in_a_notebook(image: zs.Image) -> None:
    with Pillow.open(io.BytesIO(image._repr_png_())) as read:
        assert np.array_equal(np.asarray(read), np.asarray(image))
    assert "48x32" in repr(image)


@pytest.mark.parametrize("name", ["a", "a.xyz", "a.png.gz", ".png"])
def test_other_formats_are_refused(image: zs.Image, name: str, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot tell a picture format"):
        image.save(tmp_path / name)
    with pytest.raises(OutputError, match=r"use \.png"):
        picture_format(name)
    assert list(tmp_path.iterdir()) == []


def test_pictures_that_a_format_cannot_hold() -> None:
    with pytest.raises(OutputError, match=r"as WEBP.*\n.*use .png"):
        encode(np.zeros((1, 20000, 3), np.uint8), "WEBP")


@pytest.mark.parametrize("again", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy], ids=["pickle", "deepcopy"])
@pytest.mark.parametrize("color_by", [None, "z"])
def test_pictures_can_be_sent_and_copied(again: Callable[[zs.Image], zs.Image], color_by: str | None) -> None:
    image = zs.render(BALL, (48, 32), CAMERA, color_by=color_by)
    other = again(image)
    assert np.array_equal(other.pixels, image.pixels)
    for name in image.outputs:
        assert np.array_equal(other.aov(name), image.aov(name), equal_nan=True)
    assert (other.range, other.certified, repr(other)) == (image.range, image.certified, repr(image))
    # The frame that has drawn it goes on drawing.
    zs.render(BALL.with_bounds(0.5), (48, 32), CAMERA, color_by=color_by)
    assert np.array_equal(other.aov("t"), image.aov("t"), equal_nan=True)
