"""Several things in one scene: surfaces and solids, each with its own bounds, parameters and material."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from zeroset.errors import ParameterError
from zeroset.scene.bounds import Ball, Bounds
from zeroset.scene.camera import Camera
from zeroset.scene.exprfield import check_work
from zeroset.scene.light import Material
from zeroset.scene.solid import Solid, spread_params
from zeroset.scene.surface import Surface


@dataclass(frozen=True)
class Several:
    """Surfaces and solids that are drawn together, the nearest one in front.

    Attributes:
        things: what is drawn; at least one.
    """

    things: tuple[Surface | Solid, ...]

    def __post_init__(self) -> None:
        if not self.things:
            raise ParameterError("there is nothing to draw: give at least one surface")
        for thing in self.things:
            if not isinstance(thing, (Surface, Solid)):
                raise ParameterError(f"only surfaces and solids can be drawn together, not a {type(thing).__name__}")

    def __iter__(self) -> Iterator[Surface | Solid]:
        return iter(self.things)

    def __len__(self) -> int:
        return len(self.things)

    @property
    def name(self) -> str:
        """It has no name of its own."""
        return ""

    @property
    def camera(self) -> Camera | None:
        """It has no camera of its own."""
        return None

    @property
    def bounds(self) -> Bounds | None:
        """Around all of them; None as long as one of them is still to be fitted."""
        return None if any(thing.bounds is None for thing in self.things) else self.fitted

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """All surfaces that it is made of."""
        return tuple(surface for thing in self.things for surface in thing.surfaces)

    def materials(self, usual: Material) -> tuple[Material, ...]:
        """The material of each part; ``usual`` where a surface has none of its own."""
        return tuple(material for thing in self.things for material in thing.materials(usual))

    @cached_property
    def fitted(self) -> Bounds:
        """A ball around the bounds of all, or what they all have."""
        bounds = [thing.fitted for thing in self.things]
        if len(set(bounds)) == 1:
            return bounds[0]
        ends = [[(b.center[i] - b.reach, b.center[i] + b.reach) for b in bounds] for i in range(3)]
        x, y, z = (0.5 * (min(low for low, _ in axis) + max(high for _, high in axis)) for axis in ends)
        return Ball(max(math.dist((x, y, z), b.center) + b.reach for b in bounds), (x, y, z))

    def check_work(self) -> None:
        """Raise ``FormulaLimitError`` for formulas that no compiler digests while somebody waits."""
        check_work(sum(surface.field.work for surface in self.surfaces))

    def with_params(self, **values: Any) -> Several:
        """The same with other parameter values, in every surface that has a parameter of that name."""
        changed = iter(spread_params(self.surfaces, values))
        return self.mapped(lambda _: next(changed))

    def mapped(self, change: Callable[[Surface], Surface]) -> Several:
        """The same made of its surfaces, changed one after the other."""
        return Several(tuple(thing.mapped(change) for thing in self.things))


Drawable = Surface | Solid | Several
"""What a scene can show."""


def as_drawable(value: Any) -> Drawable:
    """A surface or a solid as it is, a sequence of them as one thing; raises ``ParameterError``."""
    if isinstance(value, (Surface, Solid, Several)):
        return value
    if isinstance(value, Sequence) and not isinstance(value, str):
        # One thing alone is itself: it pays for nothing that it does not use.
        several = Several(tuple(value))
        return several.things[0] if len(several) == 1 else several
    raise ParameterError(
        f"a scene's surface must be a Surface, a Solid or a sequence of them, not a {type(value).__name__}"
    )


def plain_surface(value: Drawable, what: str) -> Surface:
    """The surface f = 0 that something is about; raises ``ParameterError`` for solids, isovalues and several ones.

    Args:
        value: what a scene shows.
        what: what takes only a plain surface, for the error: ``"the window"``.
    """
    if isinstance(value, Surface) and not value.isovalues:
        return value
    found = "isovalues" if isinstance(value, Surface) else "a solid" if isinstance(value, Solid) else "several surfaces"
    raise ParameterError(
        f"{what} takes one surface f = 0, not {found}",
        hint="without that, zeroset render and zeroset view draw all of them",
    )
