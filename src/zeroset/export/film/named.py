"""Animations by name: those of the papers, as data in ``animations.toml``.

An animation is a surface of the gallery or a formula with bounds and camera, the motions of its parameters as text,
those of its array parameters as swings, and how long it takes. Nothing is read until a name is asked for.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path as File
from types import MappingProxyType
from typing import Any

from zeroset.export.film.path import Moment, Path, Swing, read_motion
from zeroset.scene.bounds import parse_bounds
from zeroset.scene.camera import Camera
from zeroset.scene.scene import Scene
from zeroset.scene.surface import Surface, surface
from zeroset.shelf import gallery

DATA = File(__file__).with_name("animations.toml")


@dataclass(frozen=True)
class Named:
    """An animation of the list.

    Attributes:
        name: its key.
        title: what it shows.
        source: where it comes from: a paper and a figure.
        scene: what is drawn.
        vary: what moves.
        orbit: degrees by which the camera turns.
        duration: seconds.
    """

    name: str
    title: str
    source: str
    scene: Scene
    vary: Mapping[str, Path]
    orbit: float
    duration: float


@cache
def _tables() -> Mapping[str, Any]:
    return MappingProxyType(tomllib.loads(DATA.read_text(encoding="utf-8")))


def names() -> tuple[str, ...]:
    """The names of all animations.

    Example:
        >>> "cloth" in names()
        True
    """
    return tuple(_tables())


def find(name: str) -> Named | None:
    """The animation of that name, if there is one."""
    table = _tables().get(name)
    if table is None:
        return None
    vary: dict[str, Path] = {key: read_motion(key, text) for key, text in table.get("vary", {}).items()}
    shape = _surface(name, table, {key: path.at(Moment(0, 1)) for key, path in vary.items()})
    for key, swing in table.get("swing", {}).items():
        vary[key] = Swing(shape.arrays[key].tolist(), **swing)
    orbit, duration = float(table.get("orbit", 0.0)), float(table["duration"])
    return Named(name, table["title"], table["source"], Scene(shape), vary, orbit, duration)


def _surface(name: str, table: Mapping[str, Any], starts: Mapping[str, Any]) -> Surface:
    """A surface of the gallery, with room to move in, or one of the animation's own."""
    values, camera = {**table.get("params", {}), **starts}, table.get("camera")
    view = None if camera is None else Camera(**camera)
    limits = parse_bounds(table.get("bounds"))
    if "surface" in table:
        return surface(gallery[table["surface"]], values, limits, view)
    return surface(table["formula"], values, limits, view, name)
