"""Isovalues as the window edits them: each with its colour, in the order in which the user has listed them.

A slider needs a range, and a new isovalue a place where there is something to see: both follow from the values that f
takes inside the bounds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from zeroset.scene.bounds import Ball, Bounds
from zeroset.scene.fit import values_at
from zeroset.scene.isovalues import PALETTE
from zeroset.scene.light import Color
from zeroset.scene.surface import Surface
from zeroset.view.spans import Span, around, multiple, nice_step

SIDE = 9
"""Points along an axis at which f is looked at."""
RARE = 1.0
"""Percentile of f's values at either end that is left out: poles and corners."""


@dataclass(frozen=True, slots=True)
class Level:
    """An isovalue.

    Attributes:
        value: where f is met.
        color: of both sides, linear RGB.
    """

    value: float
    color: Color


def levels_of(surface: Surface) -> tuple[Level, ...]:
    """The isovalues that a surface has."""
    return tuple(Level(value, color) for value, color in zip(surface.isovalues, surface.colors, strict=True))


def value_span(surface: Surface, levels: Sequence[Level] = ()) -> Span:
    """The values that f takes inside the bounds, rare ones aside, with 0 and the isovalues that there are.

    Example:
        >>> import zeroset as zs
        >>> value_span(zs.surface("x^2 + y^2 + z^2 = 1", bounds=2.0))
        Span(low=-1.0, high=3.0)
    """
    values = values_at(surface, _points(surface.fitted))
    values = values[np.isfinite(values)]
    ends = np.percentile(values, (RARE, 100.0 - RARE)).tolist() if len(values) else []
    known = [*ends, 0.0, *(level.value for level in levels)]
    return around(min(known), max(known))


def _points(bounds: Bounds) -> npt.NDArray[np.float64]:
    """A grid inside the bounds, (N, 3)."""
    half = (
        np.full(3, bounds.radius)
        if isinstance(bounds, Ball)
        else 0.5 * (np.asarray(bounds.max) - np.asarray(bounds.min))
    )
    # Middles of cells rather than their corners: f is often special on planes of symmetry, and far off at the rim.
    cells = (np.arange(SIDE) + 0.5) / SIDE * 2.0 - 1.0
    grid = np.stack(np.meshgrid(cells, cells, cells), axis=-1).reshape(-1, 3)
    if isinstance(bounds, Ball):
        grid = grid[(grid**2).sum(axis=1) <= 1.0]
    return np.asarray(grid * half + np.asarray(bounds.center), np.float64)


def another(levels: Sequence[Level], span: Span) -> Level:
    """One more isovalue: in the middle of the widest gap that others leave, in a colour that none of them has.

    Example:
        >>> another((Level(0.0, PALETTE[0]),), Span(-1.0, 3.0)) == Level(1.5, PALETTE[1])
        True
    """
    taken = sorted({span.low, span.high, *(level.value for level in levels)})
    _, low, high = max((b - a, a, b) for a, b in pairwise(taken))
    step = nice_step(high - low)
    value = multiple(round(0.5 * (low + high) / step), step)
    colors = {level.color for level in levels}
    return Level(value, next((color for color in PALETTE if color not in colors), PALETTE[len(levels) % len(PALETTE)]))
