"""What the renderer found out, as colours: evaluations, unresolved pixels, normals, depth.

Each overlay is computed from the outputs of a picture with NumPy, on the thread that draws.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.rendering.image import Image
from zeroset.solve.status import MISS, UNRESOLVED

Pixels = npt.NDArray[np.uint8]

HEAT = np.array(
    [(12, 8, 38), (58, 15, 110), (120, 28, 110), (180, 44, 84), (230, 84, 44), (250, 150, 30), (252, 240, 160)], float
)
"""Colours of the heat map from none to most, sRGB: brightness rises all the way."""
MARK = np.array((255, 40, 200), np.uint8)
"""Colour of an unresolved pixel."""


@dataclass(frozen=True, slots=True)
class Legend:
    """What the colours of an overlay mean.

    Attributes:
        title: what is shown.
        low: value of the first colour.
        high: value of the last one.
        heat: whether the colours are those of the heat map; grey from dark to bright otherwise.
        map: the colour map of a surface that is coloured by a quantity; "" for an overlay.
        values: the values that there are, rising, where these are few.
    """

    title: str
    low: float
    high: float
    heat: bool = True
    map: str = ""
    values: tuple[float, ...] = ()


def heat(share: npt.NDArray[Any]) -> Pixels:
    """Colours of the heat map for shares from 0 to 1.

    Example:
        >>> heat(np.array([0.0, 1.0])).tolist()
        [[12, 8, 38], [252, 240, 160]]
    """
    # A table of 256 colours: looking up is many times faster than interpolating each pixel.
    stops = np.linspace(0.0, 1.0, len(HEAT))
    table = np.stack([np.interp(np.linspace(0, 1, 256), stops, HEAT[:, c]) for c in range(3)], axis=-1)
    index = np.clip(np.nan_to_num(share) * 255.0 + 0.5, 0, 255).astype(np.uint8)
    return np.asarray(table.round().astype(np.uint8)[index])


def coloured(image: Image, overlay: str) -> tuple[Pixels, Legend | None]:
    """A picture's pixels under an overlay, (height, width, 3), and what the colours mean."""
    if overlay == "steps":
        return _steps(image)
    if overlay == "depth":
        return _depth(image)
    if overlay == "normals":
        return _normals(image), None
    if overlay == "unresolved":
        return _unresolved(image), None
    if image.coloring is not None and image.range is not None:
        low, high = image.range
        title, map_ = image.coloring.quantity.title, image.coloring.chosen_map
        return image.pixels, Legend(title, low, high, map=map_, values=image.values)
    return image.pixels, None


def _steps(image: Image) -> tuple[Pixels, Legend]:
    steps = image.aov("steps")
    most = int(steps.max(initial=0))
    # The root spreads the many small counts, where the differences are.
    share = np.sqrt(steps.astype(np.float32) / max(most, 1))
    return heat(share), Legend("evaluations a ray", 0.0, float(most))


def _depth(image: Image) -> tuple[Pixels, Legend]:
    depth = image.aov("depth")
    seen = np.isfinite(depth)
    near, far = (float(depth[seen].min()), float(depth[seen].max())) if seen.any() else (0.0, 1.0)
    share = np.where(seen, (far - depth) / max(far - near, 1e-30), 0.0)
    grey = np.where(seen, 40.0 + 215.0 * share, 12.0).astype(np.uint8)
    return np.repeat(grey[..., None], 3, axis=2), Legend("depth", far, near, heat=False)


def _normals(image: Image) -> Pixels:
    colours = (127.5 * (image.aov("normal") + 1.0)).astype(np.uint8)
    colours[image.aov("status") == MISS] = 12
    return np.asarray(colours)


def _unresolved(image: Image) -> Pixels:
    pixels: Pixels = (image.pixels.astype(np.uint16) * 2 // 5).astype(np.uint8)
    pixels[image.aov("status") == UNRESOLVED] = MARK
    return pixels
