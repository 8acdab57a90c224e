"""What is known of a figure before anything is drawn: plain values, as ``load`` reads them.

A panel's settings are those of its figure, its row and its own, the nearest winning; ``SETTINGS`` says what there is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

SETTINGS = {
    "surface": "a name of the gallery",
    "solid": "a solid of the gallery",
    "isovalues": "values v for which f = v is drawn instead of f = 0",
    "colors": "the isovalues' colours",
    "formula": "a formula; beside a surface, in its place, with its bounds and camera",
    "animation": "a named animation, in which params move",
    "at": "how far the animation is, 0 to 1",
    "params": "values of parameters",
    "bounds": "as in scene files",
    "camera": "what is changed of the surface's own camera: eye, target, up, fov, height",
    "orbit": "degrees by which the camera is turned about z",
    "method": "a ray method: its name, with its options",
    "bits": "the tolerance: 2^-bits of the bounds' extent",
    "material": "as in scene files, coloring included",
    "lights": "as in scene files",
    "background": "linear RGB",
    "shadows": "whether lights throw shadows",
    "environment": "what is seen all around",
    "depth": "surfaces that a ray may meet after the first",
    "antialias": "rays of a pixel at an edge",
    "thin": "whether what lies between the rays is drawn too",
    "draft": "whether second looks in f64 are left out",
    "beams": "whether tiles of pixels share beams; drafts wait for none, so that they have to do without",
    "legend": "whether a colour bar is drawn",
    "crop": "a square of the picture, magnified: left, top and width as parts of the side",
    "mesh": "cells a side of a mesh that is drawn instead of rays",
    "label": "what stands under the panel; see ``NUMBERS``",
}
"""What a panel can be told, and what it means."""

NUMBERS = {
    "steps": "evaluations of a ray, the mean of all",
    "open": "share of the surface's pixels that are UNRESOLVED",
    "wrong": "pixels that show something else than a certified picture does",
}
"""Numbers that a label may ask for, as ``{steps}``."""


@dataclass(frozen=True)
class Panel:
    """One picture of a figure.

    Attributes:
        label: what stands under it; may be empty.
        settings: what is drawn and how, by the names of ``SETTINGS``.
    """

    label: str
    settings: Mapping[str, Any]


@dataclass(frozen=True)
class Row:
    """Panels side by side.

    Attributes:
        title: what stands above them; may be empty.
        panels: from left to right; those that do not fit go on below.
    """

    title: str
    panels: tuple[Panel, ...]


@dataclass(frozen=True)
class Figure:
    """A figure of a paper.

    Attributes:
        name: its key: ``sn10-5``.
        title: what it shows, in a line of our own.
        columns: most panels side by side.
        size: usual width of a panel in pixels.
        aspect: height of a panel, as a share of its width.
        rows: its panels.
    """

    name: str
    title: str
    columns: int
    size: int
    aspect: float
    rows: tuple[Row, ...]

    @property
    def source(self) -> str:
        """Paper and number: ``SN10, figure 5``."""
        paper, _, number = self.name.partition("-")
        return f"{paper.upper()}, figure {number}"

    @property
    def panels(self) -> tuple[Panel, ...]:
        """All panels, in reading order."""
        return tuple(panel for row in self.rows for panel in row.panels)
