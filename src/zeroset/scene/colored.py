"""A coloring on what is drawn: the formula that is meant, which surfaces have it, and the range known beforehand.

A formula to colour by may use a surface's parameters, so that only both together tell what it means. A picture has one
coloring. Surfaces that are given none keep their own colours, and so do those for which it means nothing.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from zeroset.errors import FormulaError, FormulaLimitError, ParameterError, UnknownNameError, ZerosetError, did_you_mean
from zeroset.expr import parse
from zeroset.scene.coloring import QUANTITIES, Coloring, Range, offered
from zeroset.scene.exprfield import MOST_WORK, ExprField
from zeroset.scene.light import Material
from zeroset.scene.parameters import TIME
from zeroset.scene.several import Drawable
from zeroset.scene.surface import Surface


class Colored(NamedTuple):
    """What a picture is coloured by, and where.

    Attributes:
        coloring: by what.
        surfaces: all that are drawn, in the order in which their parts are counted.
        shown: for each of them whether it is coloured.
    """

    coloring: Coloring
    surfaces: tuple[Surface, ...]
    shown: tuple[bool, ...]

    @property
    def range(self) -> Range | None:
        """The range that the quantity has by itself; None where it is found from the picture."""
        if not self.values:
            return None
        low, high = self.values[0], self.values[-1]
        return (low, high) if low < high else (low - 1.0, high + 1.0)

    @property
    def values(self) -> tuple[float, ...]:
        """The values that there are, rising, where these are few: isovalues."""
        if self.coloring.by != "isovalue":
            return ()
        pairs = zip(self.surfaces, self.shown, strict=True)
        return tuple(sorted({value for surface, on in pairs if on for value in surface.isovalues}))


def colored(thing: Drawable, usual: Material) -> Colored | None:
    """What something is coloured by, and which of its surfaces; None for nothing.

    Args:
        thing: what is drawn.
        usual: the material of surfaces that have none of their own.

    Raises:
        ZerosetError: there are two colorings, or one that means nothing for any surface that has it.
    """
    colorings = [(surface.material or usual).coloring for surface in thing.surfaces]
    chosen = tuple(dict.fromkeys(coloring for coloring in colorings if coloring is not None))
    if not chosen:
        return None
    if len(chosen) > 1:
        raise ParameterError(
            f"a picture has one coloring, and its surfaces have two: {chosen[0]!r} and {chosen[1]!r}",
            hint="give the same one to all that are to be coloured; surfaces without any keep their own colours",
        )
    found = Colored(chosen[0], thing.surfaces, _shown(chosen[0], thing.surfaces, colorings))
    _check_work(found)
    return found


def _shown(coloring: Coloring, surfaces: Sequence[Surface], colorings: Sequence[Coloring | None]) -> tuple[bool, ...]:
    """For each surface whether a coloring is given to it and means something; raises where it does so for none."""
    shown = [own is not None for own in colorings]
    asked = [i for i, on in enumerate(shown) if on]
    errors: list[ZerosetError] = []
    for i in asked:
        try:
            _meant(coloring, surfaces[i])
        except ZerosetError as error:
            shown[i] = False
            errors.append(error)
    if not any(shown):
        raise _told(errors[0], coloring.by, [surfaces[i] for i in asked])
    return tuple(shown)


def _check_work(found: Colored) -> None:
    """Raise for a formula that is too long, taken once for each surface whose numbers it has."""
    formulas = [formula_of(found.coloring, s) for s, on in zip(found.surfaces, found.shown, strict=True) if on]
    own = [f for f in formulas if f is not None and has_numbers(f)]
    if found.coloring.by not in QUANTITIES and sum(f.work for f in own) > MOST_WORK:
        raise FormulaLimitError(
            f"the formula to colour by has more than {MOST_WORK:,} operations, taken for each of {len(own)} surfaces"
        )


def has_numbers(formula: ExprField) -> bool:
    """Whether a formula depends on a surface's parameters, and not on the point alone."""
    return bool(formula.parameters or formula.arrays)


def formula_of(coloring: Coloring, surface: Surface) -> ExprField | None:
    """The formula that a surface is to be coloured by; None where it is a quantity with a name.

    Raises:
        ParameterError: it is neither a quantity's name nor a formula.
        FormulaError: it is a formula with a mistake; the message shows where.
        FormulaLimitError: it is too long to be compiled.
    """
    try:
        return _meant(coloring, surface)
    except FormulaError as error:
        raise _told(error, coloring.by, (surface,)) from None


def _meant(coloring: Coloring, surface: Surface) -> ExprField | None:
    """The same, with errors as the formula's own."""
    if coloring.by == "isovalue":
        # What a ray meets where f is one of them is f.
        if not surface.isovalues:
            hint = "surface.with_isovalues((0.0, 0.5)), or --isovalues 0,0.5"
            raise ParameterError("the surface has no isovalues that it could be coloured by", hint=hint)
        return surface.settled.field
    if coloring.by in QUANTITIES:
        return None
    made = _read(coloring.by, frozenset(surface.params) - {TIME}, frozenset(surface.arrays))
    if made.work > MOST_WORK:
        raise FormulaLimitError(f"the formula to colour by has more than {MOST_WORK:,} operations")
    return made


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


def _told(error: ZerosetError, by: str, surfaces: Sequence[Surface]) -> ZerosetError:
    """What to say of a text that is no formula: perhaps it was meant as a quantity's name."""
    if not isinstance(error, FormulaError):
        return error
    name = by.strip().lower()
    near = did_you_mean(re.sub(r"[_ ]+", "-", name), QUANTITIES)
    if near and (isinstance(error, UnknownNameError) or re.fullmatch(r"[a-z]+([-_ ][a-z]+)*", name)):
        return ParameterError(f"there is nothing to colour by that is called {by!r}", hints=(*near, offered()))
    if isinstance(error, UnknownNameError):
        # It is the surface that has parameters; a formula to colour by brings none of its own.
        known = sorted({name for surface in surfaces for name in (*surface.params, *surface.arrays)} - {TIME})
        whose = "the surface's" if len(surfaces) == 1 else "the surfaces'"
        hints = (*did_you_mean(error.name, known), f"{whose} parameters: {', '.join(known) or 'none'}")
        return UnknownNameError(error.message, name=error.name, text=by, position=error.position, hints=hints)
    return error
