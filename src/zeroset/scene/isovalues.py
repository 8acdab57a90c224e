"""The isovalues of a surface and their colours: from what users write to numbers in rising order."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from numbers import Real
from typing import Any

from zeroset.errors import ParameterError
from zeroset.scene.bounds import number
from zeroset.scene.light import Color, color
from zeroset.scene.parameters import LARGEST

MOST_ISOVALUES = 16
"""Isovalues of a surface: each is looked for in every evaluation of f."""
PALETTE: tuple[Color, ...] = (
    (0.90, 0.27, 0.07),
    (0.06, 0.30, 0.75),
    (0.95, 0.68, 0.08),
    (0.08, 0.50, 0.22),
    (0.45, 0.12, 0.55),
    (0.05, 0.52, 0.60),
    (0.75, 0.15, 0.30),
    (0.50, 0.50, 0.50),
)
"""Colours for values that are given none, easily told apart; after the last one the first is used again."""


def isovalues_of(values: float | Sequence[float] | None) -> tuple[tuple[float, ...], tuple[int, ...]]:
    """The values in rising order, and the place that each had before; raises ``ParameterError``."""
    if values is None:
        return (), ()
    given: Any = [values] if isinstance(values, Real) else values
    try:
        made = [number(value, "an isovalue", ParameterError) for value in given]
    except TypeError:
        raise ParameterError(f"isovalues must be numbers, not {values!r}", hint="try (0.0, 0.5, 1.0)") from None
    if any(abs(value) > LARGEST for value in made):
        raise ParameterError(f"an isovalue must be below {LARGEST:g}")
    if not 1 <= len(made) <= MOST_ISOVALUES:
        raise ParameterError(
            f"there must be from 1 to {MOST_ISOVALUES} isovalues, not {len(made)}", hint="None draws f = 0 alone"
        )
    order = tuple(sorted(range(len(made)), key=made.__getitem__))
    rising = tuple(made[i] for i in order)
    for a, b in pairwise(rising):
        if a == b:
            raise ParameterError(f"the isovalue {a:g} is there twice")
    return rising, order


def colors_of(colors: Sequence[Iterable[float]] | None, order: tuple[int, ...]) -> tuple[Color, ...]:
    """The colour of each isovalue, in the values' rising order; raises ``ParameterError``."""
    if colors is None:
        return tuple(PALETTE[i % len(PALETTE)] for i in range(len(order)))
    made = [color(each, "an isovalue's colour") for each in colors]
    if len(made) != len(order):
        raise ParameterError(f"there are {len(order)} isovalues but {len(made)} colours")
    return tuple(made[i] for i in order)
