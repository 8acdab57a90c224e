"""Where everything stands on a figure's page: panels in rows, labels under them, titles above, a caption at the end.

All sizes follow from the panels' width. What would not be legible is left out: labels under panels that are narrower
than a few words, the caption of a page that is narrower than a line.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from zeroset.figures.entry import Figure

Measure = Callable[[str, int], float]
"""Width in pixels of a text in letters of so many pixels."""

SMALLEST, LARGEST = 11, 40
"""Height of letters in pixels."""
NARROWEST = 56
"""Pixels of a panel's width below which nothing is written under it."""
NARROWEST_PAGE = 160
"""Pixels of a page's width below which it has no caption."""
MOST_LINES = 4
"""Lines of a label."""
LINE = 1.3
"""Height of a line, in letters."""


@dataclass(frozen=True, slots=True)
class Text:
    """A line of text.

    Attributes:
        text: what it says.
        x: its middle, or its left end.
        y: its upper edge.
        size: height of its letters.
        middle: whether x is its middle.
    """

    text: str
    x: int
    y: int
    size: int
    middle: bool = True


@dataclass(frozen=True, slots=True)
class Plan:
    """A page.

    Attributes:
        width: in pixels.
        height: in pixels.
        panel: width and height of each panel.
        corners: upper left corner of each panel, in reading order.
        texts: all lines of text.
    """

    width: int
    height: int
    panel: tuple[int, int]
    corners: tuple[tuple[int, int], ...]
    texts: tuple[Text, ...]


def panel_size(figure: Figure, width: int) -> tuple[int, int]:
    """Width and height of a figure's panels, from their width."""
    return width, max(round(width * figure.aspect), 1)


def plan(figure: Figure, labels: Sequence[str], side: int, measure: Measure) -> Plan:
    """The page of a figure.

    Args:
        figure: what is shown.
        labels: what stands under each panel, in reading order.
        side: width of a panel in pixels.
        measure: tells how wide a text is.
    """
    sheet = _Sheet(figure, side, measure)
    rest = iter(labels)
    for row in figure.rows:
        sheet.title(row.title)
        panels = [next(rest) for _ in row.panels]
        for first in range(0, len(panels), figure.columns):
            sheet.line(panels[first : first + figure.columns])
    sheet.caption(f"{figure.source}: {figure.title}")
    return Plan(sheet.width, sheet.y, panel_size(figure, side), tuple(sheet.corners), tuple(sheet.texts))


def wrapped(text: str, width: float, measure: Callable[[str], float], most: int) -> list[str]:
    """A text in at most so many lines, none wider than ``width``; what does not fit ends in an ellipsis.

    Example:
        >>> wrapped("one two three", 7, len, 3)
        ['one two', 'three']
        >>> wrapped("one two three", 7, len, 1)
        ['one tw…']
    """
    lines: list[str] = []
    words = text.split()
    while words and len(lines) < most:
        count = 1
        while count < len(words) and measure(" ".join(words[: count + 1])) <= width:
            count += 1
        line = " ".join(words[:count])
        if len(lines) == most - 1 and count < len(words):
            line = " ".join(words)
        lines.append(_cut(line, width, measure))
        words = words[count:]
    return lines


def _cut(text: str, width: float, measure: Callable[[str], float]) -> str:
    if measure(text) <= width:
        return text
    while text and measure(text + "…") > width:
        text = text[:-1]
    return text + "…"


class _Sheet:
    """A page that grows downwards."""

    def __init__(self, figure: Figure, side: int, measure: Measure) -> None:
        columns = min(figure.columns, max(len(row.panels) for row in figure.rows))
        self._side, self._height = panel_size(figure, side)
        self._measure = measure
        self._gap = max(round(side * 0.03), 2)
        self._size = min(max(round(side * 0.052), SMALLEST), LARGEST)
        self.width = columns * side + (columns + 1) * self._gap
        self.y = self._gap
        self.corners: list[tuple[int, int]] = []
        self.texts: list[Text] = []

    def title(self, text: str) -> None:
        """A row's title."""
        if text and self._side >= NARROWEST:
            self._write(text, self._gap, round(self._size * 1.12), False, self.width - 2 * self._gap, 2)
            self.y += self._gap // 2

    def line(self, labels: Sequence[str]) -> None:
        """Panels side by side, with their labels."""
        corners = [(self._gap + i * (self._side + self._gap), self.y) for i in range(len(labels))]
        self.corners += corners
        top = self.y + self._height
        lowest = top
        for (x, _), label in zip(corners, labels, strict=True):
            self.y = top + self._gap // 2
            if self._side >= NARROWEST and label:
                self._write(label, x + self._side // 2, self._size, True, self._side, MOST_LINES)
                lowest = max(lowest, self.y)
        self.y = lowest + self._gap

    def caption(self, text: str) -> None:
        """What the whole page shows."""
        if self.width >= NARROWEST_PAGE:
            self._write(text, self._gap, self._size, False, self.width - 2 * self._gap, 8)
            self.y += self._gap

    def _write(self, text: str, x: int, size: int, middle: bool, width: int, most: int) -> None:
        for line in wrapped(text, width, lambda part: self._measure(part, size), most):
            self.texts.append(Text(line, x, self.y, size, middle))
            self.y += round(size * LINE)
