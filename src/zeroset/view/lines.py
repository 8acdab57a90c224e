"""Axes, grid and the outline of the bounds as line segments over the picture, faint where the surface hides them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from zeroset.scene.bounds import Ball, Bounds
from zeroset.view import orbit
from zeroset.view.painting import Picture
from zeroset.view.spans import nice_step
from zeroset.view.state import State

Array = npt.NDArray[np.float64]
Color = tuple[float, float, float]

AXIS_COLORS: dict[str, Color] = {"x": (0.95, 0.36, 0.36), "y": (0.45, 0.82, 0.38), "z": (0.38, 0.58, 1.0)}
GRID_COLOR: Color = (0.55, 0.58, 0.64)
OUTLINE_COLOR: Color = (0.78, 0.80, 0.85)
PIECES = 32
"""Pieces that a long line is cut into, each hidden or seen."""
LINES = 8
"""Squares of the grid to either side, at most."""


@dataclass(frozen=True, eq=False)
class Stroke:
    """A run of connected points on the screen, in logical pixels of the picture's pane.

    Attributes:
        hidden: whether the surface is in front of it.
    """

    points: Array
    color: Color
    width: float
    hidden: bool


@dataclass(frozen=True, slots=True)
class Label:
    """A word beside a point of the screen."""

    text: str
    x: float
    y: float
    color: Color


def strokes(state: State, picture: Picture, size: tuple[float, float]) -> tuple[list[Stroke], list[Label]]:
    """Everything that is switched on, as the camera of the picture sees it."""
    bounds = state.bounds
    made: list[Stroke] = []
    labels: list[Label] = []
    for points, color, width in _curves(state, bounds):
        made += _seen(picture, size, points, color, width)
    if state.axes:
        for name, tip in _tips(bounds):
            place, depth = orbit.project(picture.camera, size, np.array([tip]))
            if depth[0] > 0 and np.isfinite(place).all():
                labels.append(Label(name, float(place[0, 0]), float(place[0, 1]), AXIS_COLORS[name]))
    return made, labels


def _curves(state: State, bounds: Bounds) -> Iterator[tuple[Array, Color, float]]:
    if state.grid:
        for line in _grid(bounds):
            yield line, GRID_COLOR, 1.0
    if state.outline:
        for own in dict.fromkeys(item.surface.fitted for item in state.items):
            for line in _outline(own):
                yield line, OUTLINE_COLOR, 1.0
    if state.axes:
        for name, tip in _tips(bounds):
            origin = np.asarray(bounds.center)
            yield _cut(2.0 * origin - np.asarray(tip), np.asarray(tip)), AXIS_COLORS[name], 1.8


def _tips(bounds: Bounds) -> list[tuple[str, tuple[float, float, float]]]:
    """Where the axes end: a little outside of the bounds."""
    x, y, z = bounds.center
    half = (
        (bounds.radius,) * 3
        if isinstance(bounds, Ball)
        else tuple(0.5 * (b - a) for a, b in zip(bounds.min, bounds.max, strict=True))
    )
    a, b, c = (1.08 * h for h in half)
    return [("x", (x + a, y, z)), ("y", (x, y + b, z)), ("z", (x, y, z + c))]


def _cut(start: Array, stop: Array) -> Array:
    return np.linspace(start, stop, PIECES + 1)


def _grid(bounds: Bounds) -> Iterator[Array]:
    """Lines of the plane through the centre of the bounds that is level, at round coordinates."""
    x, y, z = bounds.center
    reach = (
        bounds.radius
        if isinstance(bounds, Ball)
        else 0.5 * max(b - a for a, b in zip(bounds.min[:2], bounds.max[:2], strict=True))
    )
    step = nice_step(2.0 * reach)
    for i in range(-LINES, LINES + 1):
        for middle, along_x in ((x, True), (y, False)):
            place = (round(middle / step) + i) * step
            if abs(place - middle) <= reach * (1 + 1e-9):
                if along_x:
                    yield _cut(np.array((place, y - reach, z)), np.array((place, y + reach, z)))
                else:
                    yield _cut(np.array((x - reach, place, z)), np.array((x + reach, place, z)))


def _outline(bounds: Bounds) -> Iterator[Array]:
    """Three great circles of a ball, the twelve edges of a box."""
    if isinstance(bounds, Ball):
        angle = np.linspace(0.0, 2.0 * np.pi, 2 * PIECES + 1)
        circle = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=-1) * bounds.radius
        for axis in range(3):
            yield np.roll(circle, axis, axis=-1) + np.asarray(bounds.center)
        return
    low, high = np.asarray(bounds.min), np.asarray(bounds.max)
    for axis in range(3):
        for corner in range(4):
            start = low.copy()
            for bit, other in enumerate(a for a in range(3) if a != axis):
                start[other] = high[other] if corner >> bit & 1 else low[other]
            stop = start.copy()
            stop[axis] = high[axis]
            yield _cut(start, stop)


def _seen(picture: Picture, size: tuple[float, float], points: Array, color: Color, width: float) -> list[Stroke]:
    """A curve on the screen, broken where it goes behind the surface or comes out again."""
    place, depth = orbit.project(picture.camera, size, points)
    middle, middle_depth = 0.5 * (place[1:] + place[:-1]), 0.5 * (depth[1:] + depth[:-1])
    drawn = np.isfinite(middle).all(axis=-1) & (np.abs(place[1:] - place[:-1]).max(axis=-1) < 4 * max(size))
    hidden = _hidden(picture, size, middle, middle_depth)
    kinds = np.where(drawn, hidden.astype(int), 2)
    made, start = [], 0
    for i in range(1, len(kinds) + 1):
        if i == len(kinds) or kinds[i] != kinds[start]:
            if kinds[start] != 2:
                made.append(Stroke(place[start : i + 1], color, width, bool(kinds[start])))
            start = i
    return made


def _hidden(picture: Picture, size: tuple[float, float], place: Array, depth: Array) -> npt.NDArray[np.bool_]:
    """Which places lie behind the surface."""
    rows, columns = picture.depth.shape
    with np.errstate(invalid="ignore"):
        spot = np.nan_to_num(place * (columns / size[0], rows / size[1]), nan=-1.0, posinf=-1.0, neginf=-1.0)
    column, row = spot[:, 0].clip(-1, columns).astype(int), spot[:, 1].clip(-1, rows).astype(int)
    inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    front = np.full(len(place), np.inf)
    front[inside] = picture.depth[row[inside], column[inside]]
    return np.asarray(front < depth * (1.0 - 1e-3))
