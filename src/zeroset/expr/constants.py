"""Enclosures of constants: from a subtree without names to two doubles that hold its value between them.

Rationals are exact. Everything else is computed in decimal intervals (`decimals.py`) with as many digits as it
takes for the doubles to be neighbours, up to a limit that only pathological constants reach.
"""

from __future__ import annotations

import math
import weakref
from fractions import Fraction
from typing import TYPE_CHECKING, cast

from zeroset.errors import FormulaLimitError
from zeroset.expr.dag import postorder, rational
from zeroset.expr.ops import OPS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from zeroset.expr.balls import Ball
    from zeroset.expr.dag import Expr

__all__ = ["check_constants", "enclose", "is_number"]

_DIGITS = (50, 100, 200, 400)
_known: dict[int, weakref.WeakKeyDictionary[Expr, Ball | bool | None]] = {
    digits: weakref.WeakKeyDictionary() for digits in _DIGITS
}


def enclose(expr: Expr) -> tuple[float, float]:
    """Doubles lo <= value <= hi for a constant; lo == hi iff the value is that double exactly.

    Args:
        expr: A number that depends on no variable, parameter, or element.

    Raises:
        FormulaError: The constant is undefined, such as sqrt(-pi).
        FormulaLimitError: The constant is beyond the range of doubles.

    Example:
        >>> from zeroset.expr import PI
        >>> enclose(PI)
        (3.141592653589793, 3.1415926535897936)
    """
    if not is_number(expr):
        raise TypeError("only a number that depends on nothing can be enclosed")
    value = rational(expr)
    if value is not None:
        # Without + 0.0 there would be a -0.0.
        return _below(value), 0.0 - _below(-value)
    for digits in _DIGITS:
        ball = _ball(expr, digits)
        low, high = _below(Fraction(ball.lo)), -_below(-Fraction(ball.hi))
        if high <= math.nextafter(low, math.inf):
            break
    return low, high


def check_constants(parts: Iterable[Expr]) -> None:
    """Raise the error of any constant among the arguments of some nodes that is undefined or out of range."""
    for part in parts:
        if part.symbols:
            for arg in part.args:
                if is_number(arg) and rational(arg) != 0:
                    enclose(arg)


def is_number(expr: Expr) -> bool:
    """Whether a node is a constant with a numeric value."""
    return expr.is_constant and not expr.is_condition


def _ball(expr: Expr, digits: int) -> Ball:
    """The decimal enclosure of a constant; each is remembered as long as its node lives."""
    from zeroset.expr.decimals import Decimals

    arithmetic = Decimals(digits)
    known = _known[digits]
    for part in postorder(expr, lambda item: () if item in known else item.args):
        if part not in known:
            method = getattr(arithmetic, OPS[part.op].method)
            known[part] = method(*(known[arg] for arg in part.args), *part.data)
    return cast("Ball", known[expr])


def _below(value: Fraction) -> float:
    """The largest double that is no larger than a rational.

    Raises:
        FormulaLimitError: The rational is beyond the range of doubles.
    """
    try:
        nearest = float(value)
    except OverflowError:
        raise FormulaLimitError(
            "a constant in the formula is beyond the range of numbers",
            hints=("numbers go up to 1e308",),
        ) from None
    return nearest if Fraction(nearest) <= value else math.nextafter(nearest, -math.inf)
