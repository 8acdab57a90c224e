"""From the text in the formula box to a surface: names that have no value yet become parameters with sliders.

A single letter without a value is taken for a parameter at once, as anybody reads it on paper. A longer name may as
well be a slip of the keyboard: the error says so, and the user may declare it a parameter.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from zeroset.errors import FormulaError, UnknownNameError, ZerosetError, excerpt
from zeroset.expr import Expr, parse
from zeroset.scene.bounds import Bounds
from zeroset.scene.parameters import TIME
from zeroset.scene.surface import Surface, surface
from zeroset.view.worker import Superseded

FRESH = 1.0
"""Value of a parameter that has none yet."""
MOST_NEW = 32
"""Letters that one formula may make into parameters; the alphabet has fewer."""
ALIKE = 0.75
"""Share of characters in common from which on two formulas are taken for versions of one."""
LONG = 400
"""Characters of each that are compared."""


@dataclass(frozen=True)
class Reading:
    """A formula that has been read.

    Attributes:
        surface: what it means, with a value for every parameter.
        fresh: parameters that had no value before.
    """

    surface: Surface
    fresh: tuple[str, ...] = ()


def read(
    text: str,
    values: Mapping[str, Any],
    named: Collection[str] = (),
    bounds: Bounds | None = None,
) -> Reading:
    """The surface of a formula.

    Args:
        text: what the user has typed.
        values: values of parameters and arrays, of earlier formulas too; what the formula does not use is left out.
        named: longer names that the user has declared parameters.
        bounds: where to draw it; None fits it.

    Raises:
        FormulaError: the text is no formula.
        ParameterError: a value does not fit.

    Example:
        >>> reading = read("x^2 + a*y^2 = b", {"a": 2.0, "c": 3.0})
        >>> dict(reading.surface.params), reading.fresh
        ({'a': 2.0, 'b': 1.0}, ('b',))
    """
    scalars = {name: v for name, v in values.items() if isinstance(v, (int, float)) and name != TIME}
    arrays = {name: v for name, v in values.items() if not isinstance(v, (int, float))}
    expr, fresh = _parsed(text, set(scalars) | set(named), set(arrays))
    used = {name: scalars.get(name, FRESH) for name in sorted(expr.parameters)}
    used |= {name: arrays[name] for name in sorted(expr.arrays)}
    if TIME in expr.variables:
        used[TIME] = values.get(TIME, 0.0)
    fresh += [name for name in used if name in named and name not in scalars]
    return Reading(surface(expr, used, bounds), tuple(sorted(set(fresh))))


@dataclass(frozen=True)
class Text:
    """A formula that is to be read: what ``read`` is given, and what is to come of it.

    Attributes:
        key: of the surface in whose box it stands.
        refit: whether the surface's bounds are to be fitted.
    """

    key: int
    text: str
    values: dict[str, Any]
    named: frozenset[str]
    refit: bool


@dataclass(frozen=True)
class Read:
    """A formula that has been read as it was asked."""

    asked: Text
    reading: Reading


def read_typed(asked: Text, superseded: Superseded) -> Read:
    """What has been typed, read; a job of the window's reader."""
    return Read(asked, read(asked.text, asked.values, asked.named))


def _parsed(text: str, params: set[str], arrays: set[str]) -> tuple[Expr, list[str]]:
    """The formula's expression, and the letters that became parameters on the way."""
    fresh: list[str] = []
    while True:
        try:
            return parse(text, params | set(fresh), arrays), fresh
        except UnknownNameError as error:
            name = error.name
            indexed = error.position is not None and text[error.position + len(name) :].lstrip().startswith("[")
            if len(name) != 1 or not name.isalpha() or name in fresh or indexed or len(fresh) >= MOST_NEW:
                raise
            fresh.append(name)


@dataclass(frozen=True)
class Complaint:
    """What is wrong with a formula, in pieces that can be laid out.

    Attributes:
        message: one line.
        place: the spot of the formula, and a line with carets under it; empty where no spot can be named.
        hints: likely cures.
        offer: a longer name that may be declared a parameter, or "".
    """

    message: str
    place: tuple[str, ...] = ()
    hints: tuple[str, ...] = ()
    offer: str = ""


def complaint(error: Exception, text: str, columns: int) -> Complaint:
    """What an error says, its excerpt no wider than so many columns.

    Args:
        error: what was raised.
        text: what is said of an error that is none of ours.
        columns: how many characters fit beside each other.
    """
    if not isinstance(error, ZerosetError):
        return Complaint(text)
    # Hints that speak of Python's arguments help nobody here.
    hints = tuple(hint for hint in error.hints if "params=" not in hint)
    if not isinstance(error, FormulaError) or error.text is None or error.position is None:
        return Complaint(error.message, hints=hints)
    return Complaint(error.message, _place(error, columns - 4), hints, _declarable(error))


def _place(error: FormulaError, columns: int) -> tuple[str, ...]:
    """The excerpt, cut to a width: four more columns are for the dots at its ends."""
    text, position = error.text or "", error.position or 0
    start = max(0, min(position - columns // 2, len(text) - columns))
    piece = text[start : start + columns]
    dots = "… " if start else "", " …" if start + columns < len(text) else ""
    shown, carets = excerpt(piece, position - start, error.length).split("\n")
    return dots[0] + shown[2:] + dots[1], " " * len(dots[0]) + carets[2:]


def _declarable(error: FormulaError) -> str:
    """The longer name that an error complains of and that may be declared a parameter, or an empty string."""
    if not isinstance(error, UnknownNameError) or not error.name.isidentifier() or error.text is None:
        return ""
    after = error.text[(error.position or 0) + len(error.name) :].lstrip()[:1]
    return "" if after in ("(", "[") else error.name


def differ(before: str, after: str) -> bool:
    """Whether a formula is another one, rather than an earlier one with a change here and there.

    Example:
        >>> differ("x^2 + y^2 + z^2 = 1", "x^2 + y^2 + 2z^2 = 1"), differ("x^2 + y^2 + z^2 = 1", "sin(4x) = y z")
        (False, True)
    """
    from difflib import SequenceMatcher

    return SequenceMatcher(None, before[:LONG], after[:LONG], autojunk=False).ratio() < ALIKE
