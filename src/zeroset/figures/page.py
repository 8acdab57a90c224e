"""A figure is drawn: each panel by itself, then all of them and the texts onto one page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from zeroset.errors import ZerosetError
from zeroset.figures.layout import Plan, panel_size, plan
from zeroset.figures.load import find
from zeroset.figures.panel import draw_panel
from zeroset.runtime import Device, get_device

if TYPE_CHECKING:
    from PIL.ImageFont import FreeTypeFont, ImageFont

Pixels = npt.NDArray[np.uint8]
Progress = Callable[[float], None]
LEAST, MOST = 8, 2048
"""Pixels of a panel's width."""
INK, FRAME = (28, 30, 34), (205, 207, 210)


def draw(name: str, size: int | None = None, device: str | Device = "auto", progress: Progress | None = None) -> Pixels:
    """A figure of the papers, drawn anew.

    Args:
        name: as ``names()`` lists them: ``"sn10-5"``.
        size: width of a panel in pixels, 8 to 2048; None takes the figure's usual one.
        device: as in ``render``.
        progress: called now and then with the share that is done, from 0 to 1.

    Returns:
        (height, width, 3), sRGB.

    Raises:
        UnknownFigureError: there is no such figure.
        ZerosetError: the size cannot be used, or the device fails.

    Example:
        >>> draw("k09-8", size=32).ndim
        3
    """
    figure = find(name)
    side = figure.size if size is None else size
    if isinstance(side, bool) or not isinstance(side, int) or not LEAST <= side <= MOST:
        raise ZerosetError(f"a panel's size must be a whole number from {LEAST} to {MOST}, not {side!r}")
    target = get_device(device)
    pictures, labels = [], []
    for i, panel in enumerate(figure.panels):
        pixels, label = draw_panel(panel, panel_size(figure, side), target, _part(progress, i, len(figure.panels)))
        pictures.append(pixels)
        labels.append(label)
    if progress is not None:
        progress(1.0)
    return composed(plan(figure, labels, side, width_of), pictures)


def composed(page: Plan, pictures: Sequence[Pixels]) -> Pixels:
    """The page with its panels and texts.

    Args:
        page: where everything stands.
        pictures: each panel's pixels, (height, width, 3).

    Returns:
        (height, width, 3).
    """
    from PIL import Image, ImageDraw

    sheet = Image.new("RGB", (page.width, page.height), "white")
    pen = ImageDraw.Draw(sheet)
    for (x, y), picture in zip(page.corners, pictures, strict=True):
        sheet.paste(Image.fromarray(np.ascontiguousarray(picture)), (x, y))
        pen.rectangle((x - 1, y - 1, x + page.panel[0], y + page.panel[1]), outline=FRAME)
    for text in page.texts:
        anchor = "ma" if text.middle else "la"
        pen.text((text.x, text.y), text.text, font=_font(text.size), fill=INK, anchor=anchor)
    return np.asarray(sheet)


def width_of(text: str, size: int) -> float:
    """Width of a text in pixels."""
    return float(_font(size).getlength(text))


@cache
def _font(size: int) -> FreeTypeFont | ImageFont:
    from PIL import ImageFont

    made: Any = ImageFont.load_default(size)
    return made  # type: ignore[no-any-return]


def _part(progress: Progress | None, part: int, parts: int) -> Progress | None:
    """The progress of one panel as progress of the whole figure."""
    return None if progress is None else lambda done: progress((part + done) / parts)
