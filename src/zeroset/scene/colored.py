"""A coloring on a surface: the formula that is meant, the range that is known before any picture, and whether it suits.

A formula to colour by may use the surface's parameters, so that only both together tell what it means.
"""

from __future__ import annotations

import re
from functools import lru_cache

from zeroset.errors import FormulaError, FormulaLimitError, ParameterError, UnknownNameError, ZerosetError, did_you_mean
from zeroset.expr import parse
from zeroset.scene.coloring import QUANTITIES, Coloring, Range, offered
from zeroset.scene.exprfield import MOST_WORK, ExprField
from zeroset.scene.parameters import TIME
from zeroset.scene.surface import Surface


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
        return ParameterError(f"there is nothing to colour by that is called {by!r}", hints=(*near, offered()))
    if isinstance(error, UnknownNameError):
        # It is the surface that has parameters; a formula to colour by brings none of its own.
        known = ", ".join(sorted({*surface.params, *surface.arrays} - {TIME})) or "none"
        hints = (*did_you_mean(error.name, {*surface.params, *surface.arrays}), f"the surface's parameters: {known}")
        return UnknownNameError(error.message, name=error.name, text=by, position=error.position, hints=hints)
    return error
