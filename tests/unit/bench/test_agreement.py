"""How far two pictures agree: pixels of one alone, pixels of both but apart, and nothing else."""

from __future__ import annotations

import numpy as np
import pytest

from zeroset.bench.agreement import other_pixels

NONE = np.inf


@pytest.mark.parametrize(
    ("depth", "truth", "share"),
    [
        ([1.0, NONE], [1.0, NONE], 0.0),
        ([1.0, NONE], [1.09, NONE], 0.0),
        ([1.0, NONE], [1.2, NONE], 0.5),
        ([1.2, NONE], [1.0, NONE], 0.5),
        ([NONE, NONE], [1.0, 2.0], 1.0),
        ([1.0, 2.0], [NONE, 2.0], 0.5),
    ],
)
def test_pixels_that_differ(depth: list[float], truth: list[float], share: float) -> None:
    assert other_pixels(np.float32([depth]), np.float32([truth]), 0.1) == share
