from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image as Pillow

from zeroset.rendering import png


@pytest.mark.parametrize("size", [(1, 1), (1, 7), (7, 1), (31, 17)])
@pytest.mark.parametrize("band", [1, 100, 1 << 20])
def test_what_was_written_is_read(size: tuple[int, int], band: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(png, "_BAND", band)
    pixels = np.random.default_rng(1).integers(0, 256, (*size, 3), np.uint8)
    read = Pillow.open(io.BytesIO(png.encode(pixels)))
    assert read.format == "PNG"
    assert read.mode == "RGB"
    assert np.array_equal(np.asarray(read), pixels)


def test_pixels_need_not_lie_in_a_row() -> None:
    pixels = np.arange(4 * 6 * 4, dtype=np.uint8).reshape(4, 6, 4)[:, ::-1, :3]
    assert np.array_equal(np.asarray(Pillow.open(io.BytesIO(png.encode(pixels)))), pixels)


def test_a_smooth_picture_is_small() -> None:
    shade = np.linspace(0, 255, 256).astype(np.uint8)
    pixels = np.broadcast_to(shade[:, None, None], (256, 256, 3))
    assert len(png.encode(pixels)) < 2000
