"""Colour by what the surface is: which quantity, through which colour map, over which range.

``QUANTITIES`` lists what can be named; anything else is a formula in x, y, z, w and the surface's parameters. How a
quantity is computed is told in ``rendering.quantity``.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

from zeroset.errors import FormulaError, FormulaLimitError, ParameterError, UnknownNameError, ZerosetError, did_you_mean
from zeroset.expr import parse
from zeroset.scene.bounds import number
from zeroset.scene.colormap import find_map
from zeroset.scene.exprfield import MOST_WORK, ExprField
from zeroset.scene.parameters import TIME

if TYPE_CHECKING:
    from zeroset.scene.surface import Surface

Range = tuple[float, float]


class Quantity(NamedTuple):
    """Something that a surface can be coloured by.

    Attributes:
        title: what a legend calls it.
        signed: whether 0 is in its middle: then so it is in a range that is found.
        order: of the derivatives of f that it takes.
    """

    title: str
    signed: bool = False
    order: int = 0


QUANTITIES = {
    "gaussian-curvature": Quantity("Gaussian curvature", True, 2),
    "mean-curvature": Quantity("mean curvature", True, 2),
    "gradient": Quantity("|grad f|", False, 1),
    "steps": Quantity("evaluations"),
    "depth": Quantity("depth"),
    "isovalue": Quantity("isovalue"),
}
"""What can be named."""


@dataclass(frozen=True, slots=True)
class Coloring:
    """Colours that show a quantity.

    Attributes:
        by: ``gaussian-curvature`` (the product of the principal curvatures), ``mean-curvature`` (half their sum;
            positive where the surface bends away from growing f, 1/r for a ball with f < 0 inside), ``gradient``
            (the length of f's gradient), ``steps`` (evaluations of f for the ray), ``depth`` (distance along the
            viewing direction), ``isovalue`` (which one it is, where there are several), or a formula in x, y, z, w and
            the surface's parameters.
        map: a colour map: ``lagoon``, ``ember``, ``gray``, ``coolwarm``, ``earth`` or ``wheel``; None takes
            ``coolwarm`` for curvatures and ``lagoon`` for all else.
        range: values of the first and the last colour; None finds them from the picture: the 2nd and the 98th
            percentile of what is seen; for curvatures and diverging maps 0 is in the middle, and the 95th percentile
            of the sizes at the ends.

    Example:
        >>> import zeroset as zs
        >>> import numpy as np
        >>> by = zs.Coloring("gaussian-curvature", range=(-2, 2))
        >>> image = zs.render("x^2 + y^2 + z^2 = 1", size=32, color_by=by)
        >>> float(np.nanmax(abs(image.aov("value") - 1))) < 1e-4
        True
    """

    by: str = "gaussian-curvature"
    map: str | None = None
    range: Range | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.by, str) or not self.by.strip():
            raise ParameterError(f"what to colour by must be text, not {self.by!r}", hint=_known())
        if self.map is not None:
            find_map(self.map)
        if self.range is not None:
            object.__setattr__(self, "range", _range(self.range))

    @property
    def quantity(self) -> Quantity:
        """What is shown; a formula is called by its text."""
        return QUANTITIES.get(self.by) or Quantity(self.by.strip())

    @property
    def chosen_map(self) -> str:
        """The map that is used."""
        return self.map or ("coolwarm" if self.quantity.signed else "lagoon")

    @property
    def centred(self) -> bool:
        """Whether a range that is found has 0 in its middle."""
        return self.quantity.signed or find_map(self.chosen_map).kind == "diverging"

    @property
    def cyclic(self) -> bool:
        """Whether values beyond the range begin again at its other end."""
        return find_map(self.chosen_map).kind == "cyclic"


def as_coloring(value: Any) -> Coloring | None:
    """A Coloring, what to colour by as text, or None; anything else is a ``ParameterError``."""
    if value is None or isinstance(value, Coloring):
        return value
    if isinstance(value, str):
        return Coloring(value)
    raise ParameterError(f"a coloring must be a Coloring or text, not {value!r}", hint=_known())


def formula_of(coloring: Coloring, surface: Surface) -> ExprField | None:
    """The formula that a surface is to be coloured by; None where it is a quantity with a name.

    Raises:
        ParameterError: it is neither a quantity's name nor a formula.
        FormulaError: it is a formula with a mistake; the message shows where.
        FormulaLimitError: it is too long to be compiled.
    """
    if coloring.by == "isovalue":
        # What a ray meets where f is one of them is f.
        if not surface.isovalues:
            hint = "surface.with_isovalues((0.0, 0.5)), or --isovalues 0,0.5"
            raise ParameterError("the surface has no isovalues that it could be coloured by", hint=hint)
        return surface.field
    if coloring.by in QUANTITIES:
        return None
    try:
        made = _read(coloring.by, frozenset(surface.params) - {TIME}, frozenset(surface.arrays))
    except FormulaError as error:
        raise _mistaken(error, coloring.by, surface) from None
    if made.work > MOST_WORK:
        raise FormulaLimitError(f"the formula to colour by has more than {MOST_WORK:,} operations")
    return made


def value_range(coloring: Coloring, surface: Surface) -> Range | None:
    """The range that a quantity has by itself; None where it is found from the picture."""
    if coloring.by != "isovalue":
        return None
    low, high = surface.isovalues[0], surface.isovalues[-1]
    return (low, high) if low < high else (low - 1.0, high + 1.0)


@lru_cache(maxsize=32)
def _read(by: str, params: frozenset[str], arrays: frozenset[str]) -> ExprField:
    """A formula; kept, since every picture of a window asks for it."""
    return ExprField(parse(by, params=params, arrays=arrays))


def suited(coloring: Coloring | None, surface: Surface) -> Coloring | None:
    """The coloring, if a surface can be coloured so; None for a formula with parameters that it has not."""
    if coloring is not None:
        try:
            formula_of(coloring, surface)
        except ZerosetError:
            return None
    return coloring


def _mistaken(error: FormulaError, by: str, surface: Surface) -> ZerosetError:
    """What to say of a text that is no formula: perhaps it was meant as a quantity's name."""
    name = by.strip().lower()
    near = did_you_mean(re.sub(r"[_ ]+", "-", name), QUANTITIES)
    if near and (isinstance(error, UnknownNameError) or re.fullmatch(r"[a-z]+([-_ ][a-z]+)*", name)):
        return ParameterError(f"there is nothing to colour by that is called {by!r}", hints=(*near, _known()))
    if isinstance(error, UnknownNameError):
        # It is the surface that has parameters; a formula to colour by brings none of its own.
        known = ", ".join(sorted({*surface.params, *surface.arrays} - {TIME})) or "none"
        hints = (*did_you_mean(error.name, {*surface.params, *surface.arrays}), f"the surface's parameters: {known}")
        return UnknownNameError(error.message, name=error.name, text=by, position=error.position, hints=hints)
    return error


def _known() -> str:
    return f"there are {', '.join(QUANTITIES)}, and any formula in x, y, z"


def _range(values: Any) -> Range:
    try:
        low, high = (number(v, "an end of a colour range", ParameterError) for v in values)
    except (TypeError, ValueError) as error:
        if isinstance(error, ParameterError):
            raise
        raise ParameterError(f"a colour range must be two numbers, not {values!r}") from None
    if not low < high:
        raise ParameterError(f"a colour range must begin below its end, not {low!r} to {high!r}")
    return low, high
