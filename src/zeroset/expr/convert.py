"""Python values as nodes: what may stand beside an `Expr` in an operator or a NumPy function.

A Python float means itself, the binary number it is, exactly (0.1 is 0.1000000000000000055...); the
decimal 0.1 in the text of a formula means one tenth.
"""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from numbers import Rational
from typing import Any

from zeroset.errors import FormulaError
from zeroset.expr.dag import Expr, constant, node

__all__ = ["as_expr", "as_numbers", "exact"]

_LOGICAL = frozenset({"and", "or", "not"})


def exact(value: Any) -> Fraction | None:
    """The exact value of a finite Python or NumPy number; None for what is no number.

    Raises:
        FormulaError: The number is infinite or not a number.
    """
    if isinstance(value, bool):
        return None
    if hasattr(value, "dtype"):
        if value.shape != () or value.dtype.kind not in "iuf":
            return None
        value = value.item()
    if isinstance(value, int | Rational):
        return Fraction(value)
    if not isinstance(value, float | Decimal):
        return None
    if not math.isfinite(value):
        raise FormulaError(f"the number {value} cannot stand in a formula: it is not finite")
    return Fraction(value)


def as_expr(value: Any) -> Expr | None:
    """The node of an `Expr` or number, None for anything else."""
    if isinstance(value, Expr):
        return value
    number = exact(value)
    return None if number is None else constant(number)


def as_numbers(op: str, args: tuple[Any, ...]) -> tuple[Expr, ...] | None:
    """The nodes of an operator's arguments, or None where one is of a foreign type.

    As in NumPy, a condition in arithmetic counts 1 where it holds and 0 elsewhere.
    """
    nodes = []
    for position, value in enumerate(args):
        expr = as_expr(value)
        if expr is None:
            return None
        wants_truth = op in _LOGICAL or (op == "select" and position == 0)
        if expr.is_condition and not wants_truth:
            expr = node("select", (expr, constant(1), constant(0)))
        nodes.append(expr)
    return tuple(nodes)
