"""One surface of the scene as the window edits it: its text, what is drawn of it, its colours, and its sliders.

Everything here is a plain immutable value; functions go from an item to a changed one. What no surface can be, such as
one with two equal isovalues, changes nothing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from zeroset.errors import ParameterError
from zeroset.scene.bounds import Bounds, Box
from zeroset.scene.coloring import Coloring
from zeroset.scene.isovalues import PALETTE, isovalues_of
from zeroset.scene.light import Material
from zeroset.scene.surface import Surface, surface
from zeroset.view.levels import Level, another, levels_of, value_span
from zeroset.view.motion import Motion, moved
from zeroset.view.spans import UNIT, Span, usual_span

FRESH = ("z = c", 2, -1.0), ("y = c", 1, 1.0), ("x = c", 0, -1.0)
"""What surfaces are at first that the user adds, by turns: a ground, a wall behind, one aside. Each with its axis, and
on which side it lies of what is there: seen at once from almost anywhere, and easily typed over."""
FARTHER = 0.25
"""By how much of the scene's size those of the next turn lie farther out."""


@dataclass(frozen=True)
class Item:
    """A surface of the scene.

    Attributes:
        key: tells it from all others, for as long as the window is open.
        text: what stands in its formula box; may be ahead of the surface, or wrong.
        surface: f = 0 inside bounds of its own.
        material: its colours and reflectance.
        levels: isovalues at which f is met instead of 0, as the user has listed them.
        level_span: the range of their sliders.
        refit: whether bounds follow the formula, or are the user's own.
        named: longer names in the formula that the user has declared parameters.
        values: of parameters and arrays that earlier formulas had.
        spans: ranges of sliders that are not the usual one.
        motions: how parameters play.
    """

    key: int
    text: str
    surface: Surface
    material: Material = field(default_factory=Material)
    levels: tuple[Level, ...] = ()
    level_span: Span = UNIT
    refit: bool = True
    named: frozenset[str] = frozenset()
    values: Mapping[str, Any] = field(default_factory=dict, compare=False)
    spans: Mapping[str, Span] = field(default_factory=dict)
    motions: Mapping[str, Motion] = field(default_factory=dict)

    @cached_property
    def drawn(self) -> Surface:
        """The surface, met at its isovalues if it has any."""
        if not self.levels:
            return self.surface
        values, colors = zip(*((level.value, level.color) for level in self.levels), strict=True)
        return self.surface.with_isovalues(values, colors)

    @property
    def parts(self) -> int:
        """How many parts of a picture it is."""
        return max(len(self.levels), 1)

    @property
    def playing(self) -> bool:
        """Whether any of its parameters moves by itself."""
        return any(self.motions[name].playing for name in self.surface.params if name in self.motions)

    @property
    def known(self) -> dict[str, Any]:
        """Values for the names of another formula: those that it has, and those of earlier formulas."""
        return {**self.values, **self.surface.params, **self.surface.arrays}


def opened(key: int, shown: Surface, text: str, usual: Material) -> Item:
    """The item of a surface that the window is given; ``usual``: the material of surfaces that have none."""
    # The window dresses its surfaces itself, in isovalues and a material that panels can change.
    plain = shown.with_bounds(shown.fitted).with_isovalues(None).with_material(None)
    levels = levels_of(shown)
    item = Item(key, text, plain, shown.material or usual, levels, refit=shown.bounds is None)
    return replace(item, level_span=value_span(plain, levels)) if levels else item


def fresh(item: Item) -> bool:
    """Whether it is still what it was when it was added."""
    return any(item.text == formula for formula, _, _ in FRESH)


def added(key: int, bounds: Bounds, before: int = 0) -> Item:
    """A surface to begin with: a plane beside what fills such bounds, after so many others that are still as new."""
    formula, axis, side = FRESH[before % len(FRESH)]
    turn, reach = before // len(FRESH), bounds.reach
    place = bounds.center[axis] + side * reach * (1.0 + FARTHER * turn)
    half = reach * (1.5 + FARTHER * turn)
    x, y, z = bounds.center
    box = Box((x - half, y - half, z - half), (x + half, y + half, z + half))
    color = PALETTE[key % len(PALETTE)]
    return Item(key, formula, surface(formula, {"c": float(f"{place:.2g}")}, box), Material(front=color, back=color))


def recolored(item: Item, coloring: Coloring) -> Item:
    """The same coloured by something else; one that nothing colours stays as it is."""
    if item.material.coloring is None:
        return item
    return replace(item, material=replace(item.material, coloring=coloring))


def span_of(item: Item, name: str) -> Span:
    """The range of a parameter's slider."""
    known = item.spans.get(name)
    return known if known is not None else usual_span(item.surface.params[name])


def with_param(item: Item, name: str, value: float) -> Item:
    """Another value of a parameter; its slider keeps its range."""
    try:
        changed = item.surface.with_params(**{name: value})
    except ParameterError:
        return item
    return replace(item, surface=changed, spans={**item.spans, name: span_of(item, name)})


def with_span(item: Item, name: str, low: float, high: float) -> Item:
    """Another range of a parameter's slider; ends in the wrong order, or on one spot, change nothing."""
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        return item
    return replace(item, spans={**item.spans, name: Span(low, high)})


def with_motion(item: Item, name: str, motion: Motion) -> Item:
    """Another way for a parameter to play."""
    return replace(item, motions={**item.motions, name: motion})


def paused(item: Item) -> Item:
    """All of its parameters stop."""
    return replace(item, motions={name: replace(motion, playing=False) for name, motion in item.motions.items()})


def advanced(item: Item, seconds: float) -> Item:
    """The item after so much time: every parameter that plays has moved."""
    for name, motion in item.motions.items():
        if motion.playing and name in item.surface.params:
            value, rising = moved(item.surface.params[name], span_of(item, name), motion, seconds)
            item = with_motion(with_param(item, name, value), name, replace(motion, rising=rising))
    return item


def with_levels(item: Item, levels: Sequence[Level]) -> Item:
    """Other isovalues; none for f = 0 alone."""
    try:
        isovalues_of([level.value for level in levels] or None)
    except ParameterError:
        return item
    return replace(item, levels=tuple(levels))


def with_another_level(item: Item) -> Item:
    """One more isovalue, where something new is seen; the first one comes beside f = 0, which is drawn so far."""
    if not item.levels:
        item = replace(item, levels=(Level(0.0, PALETTE[0]),), level_span=value_span(item.surface))
    return with_levels(item, (*item.levels, another(item.levels, item.level_span)))
