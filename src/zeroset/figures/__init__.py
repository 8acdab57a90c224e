"""The figures of the two papers, each made anew by one command: ``zeroset figure sn10-5``.

A figure is data (``data/*.toml``): rows of panels, and for each panel what is drawn and how. ``load`` reads them,
``subject`` makes a scene of a panel's settings, ``panel`` draws it (``raster`` where it is a mesh), ``layout`` says
where everything stands on the page and ``page`` puts it there.
"""

from zeroset.figures.entry import Figure, Panel, Row
from zeroset.figures.load import find, names
from zeroset.figures.page import draw

__all__ = ["Figure", "Panel", "Row", "draw", "find", "names"]
