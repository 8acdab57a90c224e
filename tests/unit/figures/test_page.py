from __future__ import annotations

import numpy as np
import pytest

from zeroset.errors import UnknownFigureError, ZerosetError
from zeroset.figures import draw, find, names
from zeroset.figures.layout import plan
from zeroset.figures.page import composed, width_of

TINY = 12


@pytest.mark.parametrize("name", names())
def test_every_figure_is_drawn_tiny(name: str):
    pixels = draw(name, TINY, "cpu")
    figure = find(name)
    made = plan(figure, [panel.label for panel in figure.panels], TINY, width_of)
    assert pixels.shape == (made.height, made.width, 3)
    wide, high = made.panel
    for (x, y), panel in zip(made.corners, figure.panels, strict=True):
        inside = pixels[y : y + high, x : x + wide]
        assert len(np.unique(inside.reshape(-1, 3), axis=0)) > 1, panel


def test_labels_are_written_in_larger_ones():
    pixels = draw("k09-8", 80, "cpu")
    figure = find("k09-8")
    made = plan(figure, [panel.label for panel in figure.panels], 80, width_of)
    for text in made.texts:
        line = pixels[text.y : text.y + text.size]
        assert line.min() < 80, text


def test_panels_lie_where_they_are_planned():
    figure = find("k09-8")
    made = plan(figure, ["", ""], 20, width_of)
    panels = [np.full((20, 20, 3), value, np.uint8) for value in (40, 90)]
    pixels = composed(made, panels)
    for (x, y), value in zip(made.corners, (40, 90), strict=True):
        assert np.all(pixels[y : y + 20, x : x + 20] == value)
    assert tuple(pixels[0, 0]) == (255, 255, 255)


def test_progress_rises_to_the_end():
    shares: list[float] = []
    draw("k09-8", 16, "cpu", shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert len(shares) > 2


@pytest.mark.parametrize("size", [0, 7, 2049, 12.5, True])
def test_sizes_that_cannot_be_used(size: object):
    with pytest.raises(ZerosetError, match="size"):
        draw("k09-8", size)  # type: ignore[arg-type]


def test_unknown_figures():
    with pytest.raises(UnknownFigureError):
        draw("sn10-99")
