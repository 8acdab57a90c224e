"""How the rewriter is put together: one rule an operator, found by the operator's name.

A rule gets the arguments of its operator, already rewritten, and answers with a node that means exactly
the same: the same real function on the same domain. Rules are local and never expand products: how often
a variable occurs decides how tight an enclosure is. An operator without a rule of its own gets the general
one, which reads the operator table.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.errors import FormulaError
from zeroset.expr.dag import Data, Expr, constant, node, rational
from zeroset.expr.limits import small
from zeroset.expr.ops import OPS

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

    Rule = Callable[[tuple[Expr, ...], Data], Expr]

__all__ = ["ONE", "ZERO", "build", "folded", "general", "rule"]

ZERO = constant(0)
ONE = constant(1)

_rules: dict[str, Rule] = {}


def rule(name: str) -> Callable[[Rule], Rule]:
    """Decorator: the function rewrites the operator `name`."""

    def register(function: Rule) -> Rule:
        _rules[name] = function
        return function

    return register


def build(op: str, args: tuple[Expr, ...] = (), data: Data = ()) -> Expr:
    """The node of an operator applied to rewritten nodes, rewritten.

    Raises:
        FormulaError: The operation is undefined everywhere (a constant divided by zero, the logarithm
            of a negative constant), or a condition stands where a number belongs.
        FormulaLimitError: A power past the limit.
    """
    own = _rules.get(op)
    return own(args, data) if own else general(op, args, data)


def general(op: str, args: tuple[Expr, ...], data: Data = ()) -> Expr:
    """What the operator table alone can do: check the domain, fold constants, take out signs."""
    value = folded(op, args)
    if value is not None:
        return value
    row = OPS[op]
    if len(args) == 1:
        arg = args[0]
        if row.parity and arg.op == "neg":
            inside = build(op, arg.args)
            return inside if row.parity == "even" else build("neg", (inside,))
        if row.parity and arg.op in {"const", "mul"} and _has_minus(arg):
            inside = build(op, (build("neg", (arg,)),))
            return inside if row.parity == "even" else build("neg", (inside,))
        if row.parity == "even" and arg.op == "abs":
            return build(op, arg.args)
        if row.idempotent and arg.op == op:
            return arg
    elif row.idempotent and args[0] is args[1]:
        return args[0]
    return node(op, args, data)


def folded(op: str, args: tuple[Expr, ...]) -> Expr | None:
    """The exact value of an operator on rational constants, if it is rational and short.

    Raises:
        FormulaError: The operator is undefined there.
    """
    values: list[Fraction] = []
    for arg in args:
        value = rational(arg)
        if value is None:
            return None
        values.append(value)
    row = OPS[op]
    if row.defined is not None and not row.defined(*values):
        shown = ", ".join(_shown(value) for value in values)
        raise FormulaError(f"{_title(op)} is undefined at ({shown})", hints=_DOMAINS.get(op, ()))
    if row.exact is not None:
        result = row.exact(*values)
        return constant(result) if result is not None and small(result) else None
    known = row.values.get(values[0]) if len(values) == 1 else None
    return None if known is None else constant(known)


_DOMAINS = {
    "sqrt": ("sqrt(x) needs x >= 0",),
    "log": ("log(x) needs x > 0",),
    "asin": ("asin(x) needs -1 <= x <= 1",),
    "acos": ("acos(x) needs -1 <= x <= 1",),
    "powr": ("x^y with y not a whole number needs x >= 0; the cube root of any number is cbrt(x)",),
    "mod": ("mod(x, y) needs y that is not zero",),
}


def _title(op: str) -> str:
    return "a real power" if op == "powr" else op


def _shown(value: Fraction) -> str:
    """A rational, cut short where it would fill the line."""
    if value.numerator.bit_length() + value.denominator.bit_length() > 200:
        return "..."
    return str(value)


def _has_minus(expr: Expr) -> bool:
    """Whether a constant, or the constant factor of a product, is negative."""
    value = rational(expr if expr.op == "const" else expr.args[0])
    return value is not None and value < 0
