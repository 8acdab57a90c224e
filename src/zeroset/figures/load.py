"""Reads the figures' TOML files: a paper a file, a figure a table.

A figure has ``rows`` of ``panels``; whatever else a row or the figure's ``all`` says goes for each of their panels.
Where a row lists no panels it has those of the figure: four surfaces and four methods are eight lines.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

from zeroset.errors import UnknownFigureError, did_you_mean
from zeroset.figures.entry import Figure, Panel, Row

DATA = Path(__file__).parent / "data"
PAPERS = ("sn10", "k09")
"""The data files: Singh & Narayanan 2010 and Knoll et al. 2009."""
DIAGRAMS = ("sn10-2", "sn10-3", "sn10-7", "k09-2", "k09-3", "k09-4")
"""Figures of the papers that explain a method by a drawing."""


@cache
def _tables() -> Mapping[str, Any]:
    tables: dict[str, Any] = {}
    for paper in PAPERS:
        tables |= tomllib.loads((DATA / f"{paper}.toml").read_text(encoding="utf-8"))
    return MappingProxyType(tables)


def names() -> tuple[str, ...]:
    """The names of all figures, paper by paper.

    Example:
        >>> "sn10-5" in names()
        True
    """
    return tuple(_tables())


def find(name: str) -> Figure:
    """The figure of that name, in small letters or large.

    Raises:
        UnknownFigureError: there is none; the message has the nearest names.

    Example:
        >>> find("SN10-5").source
        'SN10, figure 5'
    """
    key = name.strip().lower()
    table = _tables().get(key)
    if table is None:
        raise _unknown(key)
    common = table.get("all", {})
    shared = table.get("panels", [])
    rows = tuple(_row(row, common, shared) for row in table.get("rows", [{}]))
    widest = max(len(row.panels) for row in rows)
    columns, aspect = table.get("columns", widest), float(table.get("aspect", 1.0))
    return Figure(key, " ".join(table["title"].split()), columns, table.get("size", 360), aspect, rows)


def _row(row: Mapping[str, Any], common: Mapping[str, Any], shared: list[Mapping[str, Any]]) -> Row:
    own = {key: value for key, value in row.items() if key not in ("title", "panels")}
    base = _merged(common, own)
    panels = tuple(_panel(_merged(base, panel)) for panel in row.get("panels", shared))
    return Row(row.get("title", ""), panels)


def _panel(settings: dict[str, Any]) -> Panel:
    label = settings.pop("label", "")
    return Panel(label, MappingProxyType(settings))


def _merged(base: Mapping[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    """Settings with others on top; of two tables the upper one's entries win."""
    merged = dict(base)
    for key, value in over.items():
        below = merged.get(key)
        merged[key] = {**below, **value} if isinstance(value, dict) and isinstance(below, dict) else value
    return merged


def _unknown(name: str) -> UnknownFigureError:
    if name in DIAGRAMS:
        paper, _, number = name.partition("-")
        return UnknownFigureError(
            f"figure {number} of {paper.upper()} is a diagram that shows no surface",
            hint="zeroset figure lists those that can be drawn",
        )
    hints = (*did_you_mean(name, names()), "zeroset figure lists all names")
    return UnknownFigureError(f'there is no figure "{name[:80]}"', hints=hints)
