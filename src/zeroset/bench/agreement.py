"""How far two pictures of one surface agree: what a sampling method leaves out, it does not pay for."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Depth = npt.NDArray[np.float32]

APART = 0.01
"""How far apart two methods may see the surface and still agree: a part of the bounds' extent."""


def other_pixels(depth: Depth, truth: Depth, slack: float) -> float:
    """The share of pixels where two pictures disagree.

    Args:
        depth: (height, width), world units along the viewing direction, inf where nothing is shown.
        truth: the other picture's, of the same shape.
        slack: world length up to which two depths are the same.

    Returns:
        From 0 to 1: where only one shows surface, or both do farther apart than the slack.

    Example:
        >>> ours, truth = np.float32([[1.0, 2.0, np.inf, np.inf]]), np.float32([[1.1, 3.0, 4.0, np.inf]])
        >>> other_pixels(ours, truth, 0.5)
        0.5
    """
    seen, there = np.isfinite(depth), np.isfinite(truth)
    apart = np.zeros(depth.shape, bool)
    both = seen & there
    apart[both] = np.abs(depth[both] - truth[both]) > slack
    return float(np.mean((seen != there) | apart))
