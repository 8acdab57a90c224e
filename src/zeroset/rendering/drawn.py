"""What a scene shows, laid out for kernels: the shape that they are made for, and the numbers that they read.

One plain surface has the names that its numbers always had. Where there is more, each surface's names and each body's
bounds begin with a prefix of their own.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from zeroset.kernel.types import F32, Type
from zeroset.rendering.values import Arrays, parameter_uniforms
from zeroset.scene.bounds import Ball, Bounds, bounds_kind, bounds_uniforms
from zeroset.scene.several import Drawable, Several
from zeroset.scene.solid import Solid
from zeroset.scene.surface import Surface
from zeroset.solve.method import Method
from zeroset.solve.shape import Body, Complement, Join, Leaf, Shape, Tree

GUESS = Ball(64.0)
"""Bounds that are taken as long as others are to be fitted: most are smaller."""


class Drawn(NamedTuple):
    """What a scene shows, for kernels.

    Attributes:
        thing: what it is.
        shape: what of it shapes kernels.
        surfaces: all surfaces, with the prefix of their names.
        bounded: what has bounds of its own, with the prefix of their names.
    """

    thing: Drawable
    shape: Shape
    surfaces: tuple[tuple[str, Surface], ...]
    bounded: tuple[tuple[str, Surface | Solid], ...]

    @property
    def parts(self) -> int:
        """How many parts can be told apart."""
        return self.shape.parts

    @property
    def fitted(self) -> Bounds:
        """Bounds around everything."""
        return self.thing.fitted

    @property
    def smallest(self) -> Bounds:
        """The smallest bounds of anything: what is asked of it decides how closely all roots are found."""
        return min((thing.fitted for _, thing in self.bounded), key=lambda bounds: bounds.extent)

    @property
    def arrays(self) -> bool:
        """Whether there are array parameters."""
        return any(surface.arrays for _, surface in self.surfaces)

    def with_fitted_bounds(self) -> Drawn:
        """The same, once all bounds are known: they tell how large numbers may get."""
        if all(thing.bounds for _, thing in self.bounded):
            return self
        for _, thing in self.bounded:
            # It is kept.
            thing.fitted  # noqa: B018
        return as_drawn(self.thing)

    def check(self, method: Method) -> None:
        """Raise ``MethodError`` where a method cannot treat it, ``FormulaLimitError`` where nothing can."""
        method.check_shape(self.shape)
        self.thing.check_work()

    def parameters(self, method: Method, type_: Type = F32) -> dict[str, float]:
        """All parameters and the method's options by uniform name."""
        named: dict[str, float] = {}
        for prefix, surface in self.surfaces:
            named |= parameter_uniforms(surface, method, type_, prefix)
        return named

    def limits(self) -> dict[str, float]:
        """The numbers of all bounds by uniform name."""
        named: dict[str, float] = {}
        for prefix, thing in self.bounded:
            named |= bounds_uniforms(thing.fitted, prefix)
        return named

    def bind(self, arrays: Arrays, type_: Type = F32) -> dict[str, Any]:
        """The buffers of all array parameters by name, with the values in them."""
        bound: dict[str, Any] = {}
        for prefix, surface in self.surfaces:
            bound |= arrays.bind(surface, type_, prefix)
        return bound


def as_drawn(thing: Drawable | Drawn) -> Drawn:
    """Something to be drawn, laid out for kernels."""
    if isinstance(thing, Drawn):
        return thing
    things = thing.things if isinstance(thing, Several) else (thing,)
    bodies: list[Body] = []
    surfaces: list[tuple[str, Surface]] = []
    bounded: list[tuple[str, Surface | Solid]] = []
    part = 0
    for i, each in enumerate(things):
        prefix = f"s{i}_" if len(things) > 1 else ""
        leaves: dict[Surface, Leaf] = {}
        for k, surface in enumerate(each.surfaces):
            name = f"{prefix}k{k}_" if isinstance(each, Solid) else prefix
            leaves[surface] = Leaf(surface.drawn_in(_bounds(each)), name, part, len(surface.isovalues))
            surfaces.append((name, surface))
            part += leaves[surface].parts
        bodies.append(Body(_tree(each, leaves), bounds_kind(each.bounds), prefix))
        bounded.append((prefix, each))
    return Drawn(thing, Shape(tuple(bodies)), tuple(surfaces), tuple(bounded))


def _bounds(thing: Surface | Solid) -> Bounds:
    """Its bounds; a guess where they have not been fitted yet, which takes a while."""
    return thing.bounds or vars(thing).get("fitted", GUESS)


def _tree(thing: Surface | Solid, leaves: Mapping[Surface, Leaf]) -> Tree:
    if isinstance(thing, Surface):
        return leaves[thing]
    trees = [_tree(part, leaves) for part in thing.of]
    return Complement(trees[0]) if thing.op == "not" else Join(trees[0], trees[1], thing.op == "or")
