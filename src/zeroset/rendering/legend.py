"""The legend: a colour bar with numbers and the quantity's name, drawn onto the picture.

Where the colours stand for a few values alone, such as isovalues, the bar has a block of one colour for each.

It stands on a plate of its own at the right, light over a light picture and dark over a dark one. All its sizes follow
from the picture's; in a very small picture the name goes first, then the numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.rendering.ticks import exact_labels, labels, ticks
from zeroset.scene.colormap import NEUTRAL, find_map, table

Pixels = npt.NDArray[np.uint8]
SMALLEST, LARGEST = 9, 48
"""Height of letters in pixels."""
NONE = "no value"
BLOCK = 2.2
"""Height of a value's block where there are a few, in letters."""
LIGHT, DARK = (255, 255, 255, 208), (18, 20, 24, 200)
"""Plates, with their opacity."""


@dataclass(frozen=True, slots=True)
class Key:
    """What the colours mean.

    Attributes:
        title: the quantity's name.
        map: the colour map's name.
        range: values of the first and the last colour.
        below: whether something seen lies below the range.
        above: whether something lies above.
        missing: whether something seen has no value.
        values: the values that there are, in rising order, where those are a few; else there may be any.
    """

    title: str
    map: str
    range: tuple[float, float]
    below: bool = False
    above: bool = False
    missing: bool = False
    values: tuple[float, ...] = ()


def with_legend(pixels: Pixels, key: Key) -> Pixels:
    """A picture with its legend.

    Args:
        pixels: (height, width, 3), sRGB.
        key: what the colours mean.

    Returns:
        A copy, (height, width, 3).
    """
    from PIL import Image as Pillow

    height, width = pixels.shape[:2]
    plan = _Plan(key, width, height)
    x0, y0, x1, y1 = plan.plate
    under = pixels[max(y0, 0) : y1, max(x0, 0) : x1]
    dark = bool(under.size) and float(under.mean()) < 110
    picture = Pillow.fromarray(np.ascontiguousarray(pixels)).convert("RGBA")
    plate = Pillow.new("RGBA", picture.size, (0, 0, 0, 0))
    plan.draw(plate, dark)
    picture.alpha_composite(plate)
    return np.asarray(picture)[..., :3].copy()


def bar_colors(name: str, count: int) -> Pixels:
    """So many colours of a map from its first to its last, sRGB, (count, 3)."""
    return map_colors(name, np.linspace(0.0, 1.0, max(count, 1)))


def map_colors(name: str, shares: npt.NDArray[np.float64]) -> Pixels:
    """The colours at places of a map, from 0 to 1; sRGB, (count, 3). Beyond them is what a surface shows there.

    Example:
        >>> map_colors("gray", np.array([1.0, 7.0])).tolist()
        [[245, 245, 245], [245, 245, 245]]
    """
    inside = shares - np.floor(shares) if find_map(name).kind == "cyclic" else np.clip(shares, 0.0, 1.0)
    place = inside * (len(table(name)) - 1.0)
    linear = np.stack([np.interp(place, np.arange(len(table(name))), c) for c in table(name).T], axis=-1)
    return _bytes(linear)


def _bytes(linear: npt.NDArray[np.float64]) -> Pixels:
    curve = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
    return (np.clip(curve, 0, 1) * 255 + 0.5).astype(np.uint8)


def _halved(text: str) -> list[str]:
    """A name on two lines, where it has a space between words."""
    words = text.split(" ")
    if len(words) == 1 or any(not word.isalpha() for word in words):
        return [text]
    cut = min(range(1, len(words)), key=lambda i: max(len(" ".join(words[:i])), len(" ".join(words[i:]))))
    return [" ".join(words[:cut]), " ".join(words[cut:])]


class _Plan:
    """Where everything of a legend is."""

    def __init__(self, key: Key, width: int, height: int) -> None:
        from PIL import ImageFont

        short = min(width, height)
        size = min(max(round(short * 0.030), SMALLEST), LARGEST)
        self.key = key
        self.font: Any = ImageFont.load_default(size)
        self.size = size
        self.pad = pad = max(round(size * 0.7), 2)
        margin = max(round(short * 0.025), 2)
        tall = round(height * 0.45)
        if key.values:
            tall = min(tall, round(len(key.values) * size * BLOCK))
        self.bar = (max(round(size * 1.1), 5), max(tall, 8))
        self.ticks, self.labels = self._numbers()
        numbers = max(map(self.wide, self.labels), default=0)
        beside = self.bar[0] + round(size * 0.7) + numbers
        # What does not fit is left out: first the patch for what has no value, then the name, then the numbers.
        if beside > width * 0.45 or height < 60:
            self.ticks, self.labels, beside = [], [], self.bar[0]
        self.missing = key.missing and bool(self.labels)
        self.title = self._lines(key.title, beside, max(round(width * 0.4), beside)) if width >= 90 else []
        room = height - 2 * margin
        if self.missing and self._tall() > room:
            self.missing = False
        if self.title and self._tall() > room:
            self.title = []
        w = 2 * pad + max(beside, *map(self.wide, self.title), self.wide(NONE) + self.size * 2 if self.missing else 0)
        h = self._tall()
        # Surfaces are round, and leave corners free.
        x0, y0 = width - margin - w, max(height - margin - h, 0)
        self.plate = (x0, y0, x0 + w, y0 + h)
        self.corner = (x0 + pad, y0 + pad + self._above() + self._ends())

    def _numbers(self) -> tuple[list[float], list[str]]:
        """What stands beside the bar, and how it is written."""
        key, most = self.key, max(round(self.bar[1] / (self.size * 1.7)), 2)
        if key.values:
            each = -(-len(key.values) // most)
            return list(key.values[::each]), exact_labels(key.values)[::each]
        found = ticks(*key.range, most)
        if len(found) < 2:
            # No two round numbers lie in the range.
            return list(key.range), [f"{v:.3g}" for v in key.range]
        return found, labels(found)

    def _level(self, value: float) -> float:
        """How far below the bar's top a value stands."""
        h = self.bar[1]
        if self.key.values:
            return h * (1 - (self.key.values.index(value) + 0.5) / len(self.key.values))
        low, high = self.key.range
        return (h - 1) * (1 - (value - low) / (high - low))

    def _colors(self) -> Pixels:
        """The bar's colours from its top."""
        h, key = self.bar[1], self.key
        if not key.values:
            return bar_colors(key.map, h)[::-1]
        low, high = key.range
        blocks = map_colors(key.map, (np.asarray(key.values) - low) / (high - low))
        return blocks[np.arange(h) * len(blocks) // h][::-1]

    def _ends(self) -> int:
        """Room beyond the bar's ends, into which numbers and arrows stick out."""
        return round(self.size * (0.8 if self.labels else 0.4))

    def _above(self) -> int:
        return round(self.size * (0.6 + 1.25 * len(self.title))) if self.title else 0

    def _tall(self) -> int:
        below = round(self.size * 1.9) if self.missing else 0
        return self.bar[1] + self._above() + below + 2 * (self._ends() + self.pad)

    def _lines(self, title: str, narrow: int, wide: int) -> list[str]:
        """The name on one line or two, cut where it is too long."""
        lines = [title] if self.wide(title) <= narrow * 1.2 else _halved(title)
        return [self._short(line, wide) for line in lines]

    def wide(self, text: str) -> int:
        """Width of a text in pixels."""
        return round(self.font.getlength(text)) if text else 0

    def _short(self, text: str, most: int) -> str:
        if self.wide(text) <= most:
            return text
        while text and self.wide(text + "…") > most:
            text = text[:-1]
        return text + "…"

    def draw(self, plate: Any, dark: bool) -> None:
        """Draw it onto a transparent picture of the whole's size."""
        from PIL import Image as Pillow
        from PIL import ImageDraw

        pen = ImageDraw.Draw(plate)
        ink, faint = ((235, 237, 240), (150, 155, 162)) if dark else ((28, 30, 34), (110, 114, 120))
        pen.rounded_rectangle(
            self.plate, radius=max(round(self.size * 0.5), 2), fill=DARK if dark else LIGHT, outline=(128, 128, 128, 70)
        )
        x, y = self.corner
        w, h = self.bar
        colors = self._colors()
        plate.paste(Pillow.fromarray(np.repeat(colors[:, None], w, axis=1)), (x, y))
        self._arrows(pen, colors)
        for value, label in zip(self.ticks, self.labels, strict=True):
            level = y + self._level(value)
            pen.line((x + w, level, x + w + round(self.size * 0.3), level), fill=faint, width=max(self.size // 14, 1))
            pen.text((x + w + round(self.size * 0.6), level), label, font=self.font, fill=ink, anchor="lm")
        for i, line in enumerate(self.title):
            level = self.plate[1] + self.pad + round(self.size * (0.5 + 1.25 * i))
            pen.text((x, level), line, font=self.font, fill=ink, anchor="lm")
        if self.missing:
            level = y + h + round(self.size * 1.2)
            grey = tuple(int(v) for v in _bytes(np.full(3, NEUTRAL)))
            pen.rectangle((x, level, x + self.size, level + self.size), fill=grey)
            middle = level + self.size / 2
            pen.text((x + round(self.size * 1.5), middle), NONE, font=self.font, fill=ink, anchor="lm")

    def _arrows(self, pen: Any, colors: Pixels) -> None:
        """Points at the ends beyond which there is more."""
        x, y = self.corner
        w, h = self.bar
        tip = round(w * 0.5)
        if self.key.above:
            pen.polygon([(x, y - 1), (x + w - 1, y - 1), (x + w // 2, y - tip)], fill=tuple(map(int, colors[0])))
        if self.key.below:
            end = y + h
            pen.polygon([(x, end), (x + w - 1, end), (x + w // 2, end + tip - 1)], fill=tuple(map(int, colors[-1])))
