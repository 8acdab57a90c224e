"""What is known of a node without evaluating it: its domain, its sign, the names in it.

The rewriter may drop a part (`0*x`) only if that part is defined everywhere, and may write sqrt(u)^2 = u
only if u is never negative. Both are derived bottom-up, once for each node, from the operator table.
A sign is a statement about the points where the node is defined.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Protocol

from zeroset.errors import FormulaError
from zeroset.expr.limits import POWER
from zeroset.expr.ops import OPS, Data

if TYPE_CHECKING:
    from collections.abc import Sequence

TOTAL = 1
"""Defined at every real point."""
NONNEGATIVE = 2
"""Never below zero where defined."""
POSITIVE = 4
"""Above zero where defined."""
CONDITION = 8
"""A truth, not a number."""

_EVEN = range(0, POWER + 1, 2)
_SIGNS = {"": 0, "nonnegative": NONNEGATIVE, "positive": NONNEGATIVE | POSITIVE}


class Known(Protocol):
    """A node, or all that is known of one."""

    @property
    def flags(self) -> int:
        """The facts."""


def flags_of(op: str, args: Sequence[Known], data: Data) -> int:
    """The facts of a new node, from those of its arguments."""
    if not args:
        return TOTAL | _sign_of_leaf(op, data)
    row = OPS[op]
    flags = _sign(op, args, data)
    if row.kind == "condition":
        flags |= CONDITION
    every = args[0].flags
    for arg in args[1:]:
        every &= arg.flags
    if every & TOTAL and (row.total or _inside_domain(op, args)):
        flags |= TOTAL
    return flags


def _sign_of_leaf(op: str, data: Data) -> int:
    """The sign flags of a constant, or of a parameter that comes with what is known of it."""
    if op == "parameter":
        return int(data[1]) & (NONNEGATIVE | POSITIVE) if len(data) > 1 else 0
    if op == "const" and isinstance(data[0], Fraction):
        return NONNEGATIVE * (data[0] >= 0) | POSITIVE * (data[0] > 0)
    # pi is the only constant that is no fraction.
    return NONNEGATIVE | POSITIVE if op == "const" else 0


def _inside_domain(op: str, args: Sequence[Known]) -> bool:
    """Whether the arguments of a partial function can only lie where it is defined."""
    match op:
        case "sqrt" | "powr":
            return bool(args[0].flags & NONNEGATIVE)
        case "log":
            return bool(args[0].flags & POSITIVE)
        case "pow":
            return bool(args[0].flags & (POSITIVE if not args[1].flags & POSITIVE else NONNEGATIVE))
        case "div" | "mod":
            return bool(args[1].flags & POSITIVE)
    return False


def _sign(op: str, args: Sequence[Known], data: Data) -> int:
    """The sign flags of a new node."""
    first = args[0].flags & (NONNEGATIVE | POSITIVE)
    last = args[-1].flags & (NONNEGATIVE | POSITIVE)
    match op:
        case "add" | "max":
            both = first & last & NONNEGATIVE
            if op == "max":
                return first | last
            return both | ((first | last) & POSITIVE if both else 0)
        case "mul" | "div" | "min":
            return first & last
        case "select":
            return args[1].flags & last
        case "powi":
            return first | (NONNEGATIVE if data[0] in _EVEN else 0)
        case "mod":
            return last & NONNEGATIVE if last & POSITIVE else 0
        case "floor":
            return first & NONNEGATIVE
        case "ceil":
            return first
        case "sum":
            # A sum over no elements is zero.
            return first & NONNEGATIVE
    sign = OPS[op].sign
    if sign == "kept":
        return first
    return NONNEGATIVE | first & POSITIVE if sign == "magnitude" else _SIGNS[sign]


def check_kinds(op: str, args: Sequence[Known]) -> None:
    """Refuse `(x < 1) + 2` and `if(x, 1, 2)`.

    Raises:
        FormulaError: A truth stands where a number belongs, or the other way round.
    """
    for position, arg in enumerate(args):
        wants_truth = op in {"and", "or", "not"} or (op == "select" and position == 0)
        is_truth = bool(arg.flags & CONDITION)
        if wants_truth and not is_truth:
            raise FormulaError(
                "a number stands where a condition belongs",
                hints=("compare it with something: x > 0",),
            )
        if is_truth and not wants_truth:
            raise FormulaError(
                "a condition stands where a number belongs",
                hints=("make a number of it: if(x < 1, 1, 0)",),
            )
