"""GIF files: one palette for the whole movie, chosen from frames all over it, so that colours do not flicker."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path as File
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from zeroset.export.film.frames import Pictures, Pixels

if TYPE_CHECKING:
    from PIL.Image import Image

DITHERS = ("none", "diffused")
"""How colours between those of the palette are shown: as the nearest, which rests where the picture rests and makes
small files; or by spreading each pixel's error, which is finer where colours are many, and crawls as they move."""
COLORS = 255
"""Of 256, so that one is left for what has not changed since the frame before."""
MOST_COMMON = 32
"""Colours that may be kept as they are because they cover much."""
SAMPLES = 12
"""Frames from which the palette is chosen."""
FASTEST = 50
"""Frames a second: players show shorter delays than 2/100 s far longer instead."""


def write_gif(scratch: File, frames: Pictures, fps: Fraction, dither: str, progress: Callable[[float], None]) -> None:
    """Write frames as an animation that repeats for ever."""
    from zeroset.atomic import replacing

    palette = Palette(frames)

    def drawn() -> Iterator[Image]:
        for i, pixels in enumerate(frames):
            progress(i / len(frames))
            yield palette.reduced(pixels, dither)

    images = drawn()
    first = next(images)
    options: dict[str, Any] = {"loop": 0, "optimize": False, "disposal": 1}
    with replacing(scratch) as file:
        first.save(file, "GIF", save_all=True, append_images=images, duration=delays(len(frames), fps), **options)


def delays(count: int, fps: Fraction) -> list[int]:
    """Milliseconds that each frame is shown: hundredths of a second, whose sum does not drift.

    Example:
        >>> delays(3, Fraction(30))
        [30, 40, 30]
    """
    ends = [round(Fraction(100 * i) / fps) for i in range(count + 1)]
    return [10 * (b - a) for a, b in itertools.pairwise(ends)]


class Palette:
    """Colours for all frames of a movie, and each frame in them."""

    def __init__(self, frames: Pictures) -> None:
        from PIL import Image as Pillow

        chosen = sorted({round(i) for i in np.linspace(0, len(frames) - 1, SAMPLES)})
        # A few hundred thousand pixels tell enough.
        step = max(1, math.isqrt(len(chosen) * frames[0].size // (3 * 400_000)))
        pixels = np.concatenate([frames[i][::step, ::step].reshape(-1, 3) for i in chosen])
        colors, counts = np.unique(pixels, axis=0, return_counts=True)
        # What covers large areas, such as the background, is kept as it is. All others count once, so that a few pixels
        # of many colours have their share.
        common = np.argsort(-counts)[:MOST_COMMON]
        common = common[counts[common] > len(pixels) // 256]
        others = np.delete(colors, common, axis=0)
        chosen_colors = [colors[common]]
        if len(others):
            few = Pillow.fromarray(others[None]).quantize(COLORS - len(common), Pillow.Quantize.MEDIANCUT, kmeans=1)
            chosen_colors.append(np.unique(np.asarray(few.convert("RGB"))[0], axis=0))
        held = np.concatenate(chosen_colors)
        self._image = Pillow.new("P", (1, 1))
        self._image.putpalette(held.tobytes())
        self._colors = held.astype(np.float32)
        # Pillow looks colours up by their six highest bits, which shifts them. This table is exact: 0 for colours that
        # have not been met, and one more than the number of the nearest for others. Most of it is never touched.
        self._known = np.zeros(1 << 24, np.uint8)

    def reduced(self, pixels: Pixels, dither: str) -> Image:
        """A frame in the palette's colours."""
        from PIL import Image as Pillow

        if dither == "diffused":
            return Pillow.fromarray(pixels).quantize(palette=self._image, dither=Pillow.Dither.FLOYDSTEINBERG)
        image = Pillow.fromarray(self._nearest(pixels))
        image.putpalette(self._image.getpalette() or [])
        return image

    def _nearest(self, pixels: Pixels) -> npt.NDArray[np.uint8]:
        """The number of the palette's nearest colour for each pixel."""
        keys = np.asarray(pixels, np.int32) @ np.array([1 << 16, 1 << 8, 1], np.int32)
        new = np.unique(keys[self._known[keys] == 0])
        for part in np.array_split(new, len(new) // 50_000 + 1):
            colors = np.stack([part >> 16, part >> 8 & 255, part & 255], axis=-1).astype(np.float32)
            # The square of the distance, without the colour's own square, which all candidates share.
            distance = (self._colors**2).sum(axis=1) - 2.0 * colors @ self._colors.T
            self._known[part] = distance.argmin(axis=1) + 1
        return self._known[keys] - np.uint8(1)
