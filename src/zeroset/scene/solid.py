"""Solids: what is inside surfaces, joined by ``a & b`` (both), ``a | b`` (either), ``a - b`` and ``~a``.

A surface in a solid stands for f <= 0. A solid is a tree; each of its surfaces keeps its own parameters and material,
and one that occurs twice is there once. Its bounds are its own: those of its surfaces do not cut it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from zeroset.errors import ParameterError, did_you_mean
from zeroset.scene.bounds import Bounds, parse_bounds
from zeroset.scene.camera import Camera
from zeroset.scene.exprfield import check_work
from zeroset.scene.light import Material
from zeroset.scene.surface import Surface

MOST_LEAVES = 64
"""Surfaces of a solid, each counted as often as it occurs."""


@dataclass(frozen=True, eq=False)
class Solid:
    """A boolean combination of surfaces, each meaning f <= 0.

    Attributes:
        op: ``"and"``, ``"or"`` or ``"not"``.
        of: what it combines: two for ``and`` and ``or``, one for ``not``.
        bounds: where it is drawn; None is fitted on first use.
        camera: how it is seen by default; None fits the bounds.
        name: what it is called, or "".

    Example:
        >>> import zeroset as zs
        >>> ball, hole = zs.surface("x^2 + y^2 + z^2 = 1"), zs.surface("x^2 + y^2 = 0.2")
        >>> zs.cast(ball - hole, [0, -5, 0], [[0, 1, 0]], max_hits=4).status.tolist()
        [[1, 1, 1, 1]]
    """

    op: str
    of: tuple[Surface | Solid, ...]
    bounds: Bounds | None = None
    camera: Camera | None = None
    name: str = ""

    def __post_init__(self) -> None:
        for part in self.of:
            if isinstance(part, Surface) and part.isovalues:
                raise ParameterError(
                    "a surface with isovalues cannot be part of a solid",
                    hint="surface.with_isovalues(None) is the same surface where f = 0 alone",
                )
        if sum(1 for _ in self._leaves()) > MOST_LEAVES:
            raise ParameterError(f"a solid has at most {MOST_LEAVES} surfaces")

    def _leaves(self) -> Iterator[Surface]:
        for part in self.of:
            if isinstance(part, Surface):
                yield part
            else:
                yield from part._leaves()

    @cached_property
    def surfaces(self) -> tuple[Surface, ...]:
        """The surfaces it is made of, each once, from the left: its parts, in the order in which they are counted."""
        return tuple(dict.fromkeys(self._leaves()))

    def materials(self, usual: Material) -> tuple[Material, ...]:
        """The material of each part; ``usual`` where a surface has none of its own."""
        return tuple(surface.material or usual for surface in self.surfaces)

    @cached_property
    def fitted(self) -> Bounds:
        """The bounds, fitted by interval subdivision where none were given."""
        if self.bounds is not None:
            return self.bounds
        from zeroset.scene.fit import fit_bounds

        self.check_work()
        return fit_bounds(self)

    def check_work(self) -> None:
        """Raise ``FormulaLimitError`` for formulas that no compiler digests while somebody waits."""
        check_work(sum(surface.field.work for surface in self.surfaces))

    def with_bounds(self, bounds: Any) -> Solid:
        """The same solid inside other bounds."""
        return dataclasses.replace(self, bounds=parse_bounds(bounds))

    def with_params(self, **values: Any) -> Solid:
        """The same solid with other parameter values, in every surface that has a parameter of that name."""
        changed = spread_params(self.surfaces, values)
        return self.replaced(dict(zip(self.surfaces, changed, strict=True)))

    def mapped(self, change: Callable[[Surface], Surface]) -> Solid:
        """The same solid made of its surfaces, changed."""
        return self.replaced({surface: change(surface) for surface in self.surfaces})

    def replaced(self, to: Mapping[Surface, Surface]) -> Solid:
        """The same solid made of other surfaces."""
        of = tuple(to[part] if isinstance(part, Surface) else part.replaced(to) for part in self.of)
        return dataclasses.replace(self, of=of)

    def __and__(self, other: object) -> Solid:
        return join("and", self, other)

    def __or__(self, other: object) -> Solid:
        return join("or", self, other)

    def __sub__(self, other: object) -> Solid:
        return subtract(self, other)

    def __invert__(self) -> Solid:
        return Solid("not", (self,))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Solid) and self._identity() == other._identity()

    def __hash__(self) -> int:
        return hash(self._identity())

    def _identity(self) -> tuple[object, ...]:
        return self.op, self.of, self.bounds, self.camera, self.name

    def __repr__(self) -> str:
        return f"<zeroset.Solid {self.name!r} of {len(self.surfaces)} surfaces>"


def _operand(value: object) -> Surface | Solid:
    if not isinstance(value, (Surface, Solid)):
        raise ParameterError(
            f"a solid is made of surfaces and solids, not of a {type(value).__name__}",
            hint="make a surface of a formula: zs.surface(...)",
        )
    return value


def join(op: str, left: object, right: object) -> Solid:
    """Both of two (``and``), or one at least (``or``)."""
    return Solid(op, (_operand(left), _operand(right)))


def subtract(left: object, right: object) -> Solid:
    """What is inside the left and outside the right one."""
    return Solid("and", (_operand(left), Solid("not", (_operand(right),))))


def spread_params(surfaces: Sequence[Surface], values: Mapping[str, Any]) -> list[Surface]:
    """Surfaces with other values, each of the parameters that it has; raises for one that none of them has."""
    known = {name for surface in surfaces for name in (*surface.params, *surface.arrays)}
    for name in values:
        if name not in known:
            raise ParameterError(
                f"no surface has a parameter {name!r}",
                hints=(*did_you_mean(name, known), f"they have {', '.join(sorted(known)) or 'none'}"),
            )
    own = ({k: v for k, v in values.items() if k in surface.params or k in surface.arrays} for surface in surfaces)
    return [surface.with_params(**some) if some else surface for surface, some in zip(surfaces, own, strict=True)]
