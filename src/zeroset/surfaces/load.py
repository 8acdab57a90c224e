"""Reads the gallery's TOML files: a family a file, a surface a table.

Only the family that holds the wanted surface is parsed. Which family that is, and the list of all
names, comes from the files' table headers, so that asking whether a word names a surface (every
command does, before it reads the word as a formula) costs about a millisecond, once.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from zeroset.surfaces.entry import BallBounds, BoxBounds, GalleryEntry, SolidEntry, SolidPart, Source, Vector, View

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["DATA", "FAMILIES", "SOLIDS", "family", "index", "solid_names", "solids"]

FAMILIES = (
    "cubics",
    "quartics",
    "quintics",
    "sextics",
    "septics-and-octics",
    "decics-and-up",
    "chmutov",
    "nonalgebraic",
    "knoll",
)
"""The data files, in the order in which the gallery is listed."""

DATA = Path(__file__).parent / "data"
"""Where the files are."""

SOLIDS = "solids"
"""The data file of the solids, which are no surfaces and have a list of their own."""

_HEADER = re.compile(r"^\[([a-z0-9-]+)\]$", re.MULTILINE)


@cache
def index() -> Mapping[str, str]:
    """The family of each surface, by the surface's name, in the gallery's order."""
    return MappingProxyType({name: each for each in FAMILIES for name in _HEADER.findall(_text(each))})


@cache
def family(which: str) -> Mapping[str, GalleryEntry]:
    """The entries of one of `FAMILIES`, by name."""
    import tomllib

    tables = tomllib.loads(_text(which))
    return MappingProxyType({name: _entry(name, table) for name, table in tables.items()})


@cache
def _text(which: str) -> str:
    return (DATA / f"{which}.toml").read_text(encoding="utf-8")


def _entry(name: str, table: Mapping[str, Any]) -> GalleryEntry:
    arrays = {key: tuple(map(float, values)) for key, values in table.get("arrays", {}).items()}
    return GalleryEntry(
        name=name,
        title=table["title"],
        formula=_one_line(table["formula"]),
        bounds=_bounds(table["bounds"]),
        camera=_view(table["camera"]),
        degree=table["degree"],
        source=_sources(table["source"]),
        params=MappingProxyType({key: float(value) for key, value in table.get("params", {}).items()}),
        arrays=MappingProxyType(arrays),
        note=_one_line(table["note"]),
    )


@cache
def solid_names() -> tuple[str, ...]:
    """The solids' names, in the gallery's order; that takes no parsing either."""
    return tuple(_HEADER.findall(_text(SOLIDS)))


@cache
def solids() -> Mapping[str, SolidEntry]:
    """The solids by name."""
    import tomllib

    return MappingProxyType({name: _solid(name, table) for name, table in tomllib.loads(_text(SOLIDS)).items()})


def _solid(name: str, table: Mapping[str, Any]) -> SolidEntry:
    return SolidEntry(
        name=name,
        title=table["title"],
        solid=table["solid"],
        parts=MappingProxyType({key: _part(part) for key, part in table["parts"].items()}),
        bounds=_bounds(table["bounds"]),
        camera=_view(table["camera"]),
        source=_sources(table["source"]),
        note=_one_line(table["note"]),
    )


def _part(table: Mapping[str, Any]) -> SolidPart:
    params = MappingProxyType({key: float(value) for key, value in table.get("params", {}).items()})
    return SolidPart(_one_line(table["formula"]), _vector(table["front"]), _vector(table["back"]), params)


def _sources(tables: list[Mapping[str, Any]]) -> tuple[Source, ...]:
    return tuple(Source(each["paper"], each["where"], tuple(each["figures"])) for each in tables)


def _bounds(value: Any) -> BallBounds | BoxBounds:
    """A number is the radius of a ball at the origin; a table is a ball or a box."""
    if not isinstance(value, dict):
        return BallBounds((0.0, 0.0, 0.0), float(value))
    if "radius" in value:
        return BallBounds(_vector(value["center"]), float(value["radius"]))
    return BoxBounds(_vector(value["min"]), _vector(value["max"]))


def _view(value: Mapping[str, Any]) -> View:
    return View(_vector(value["eye"]), _vector(value["target"]), _vector(value["up"]), float(value["fov"]))


def _vector(values: list[float]) -> Vector:
    x, y, z = map(float, values)
    return x, y, z


def _one_line(text: str) -> str:
    return " ".join(text.split())
