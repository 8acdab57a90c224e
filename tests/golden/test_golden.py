from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from tests.golden import FOLDER, MEAN, MOST, SIZE, Golden, blurred, goldens


@pytest.mark.parametrize("golden", goldens(), ids=lambda golden: golden.name)
def test_the_picture_is_the_one_that_was_looked_at(golden: Golden) -> None:
    with Image.open(golden.path) as image:
        kept = np.asarray(image.convert("RGB"))
    difference = np.abs(blurred(np.ascontiguousarray(golden.draw().pixels)) - blurred(kept))
    assert kept.shape == (SIZE, SIZE, 3)
    assert difference.mean() < MEAN
    assert difference.max() < MOST


def test_a_wrong_picture_would_be_noticed() -> None:
    plain, other = (np.ascontiguousarray(golden.draw().pixels) for golden in goldens()[:2])
    shifted = np.roll(plain, 2, axis=1)
    for wrong in (other, shifted, np.flip(plain, 1), np.where(plain == 255, 255, plain // 8 * 7).astype(np.uint8)):
        difference = np.abs(blurred(plain) - blurred(np.ascontiguousarray(wrong)))
        assert difference.mean() > MEAN or difference.max() > MOST


def test_no_picture_is_left_over() -> None:
    assert {path.stem for path in FOLDER.glob("*.png")} == {golden.name for golden in goldens()}
