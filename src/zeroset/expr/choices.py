"""Rewriting of functions, conditions, choices and sums over arrays, as far as the table does not say it.

An inverse is taken away only where that changes no domain: log(exp(u)) is u, exp(log(u)) is u only for a u that is
known to be positive. A condition between constants decides a choice at once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.errors import FormulaError
from zeroset.expr.dag import PI, Expr, node, rational
from zeroset.expr.rules import ZERO, build, general, rule

if TYPE_CHECKING:
    from zeroset.expr.dag import Data

__all__: list[str] = []


@rule("abs")
def _abs(args: tuple[Expr, ...], data: Data) -> Expr:
    return args[0] if args[0].is_nonnegative else general("abs", args)


@rule("exp")
def _exp(args: tuple[Expr, ...], data: Data) -> Expr:
    arg = args[0]
    if arg.op == "log" and arg.args[0].is_positive:
        return arg.args[0]
    return general("exp", args)


@rule("log")
def _log(args: tuple[Expr, ...], data: Data) -> Expr:
    return args[0].args[0] if args[0].op == "exp" else general("log", args)


@rule("cbrt")
def _cbrt(args: tuple[Expr, ...], data: Data) -> Expr:
    arg = args[0]
    if arg.op == "powi" and int(arg.data[0]) % 3 == 0:
        return build("powi", arg.args, (int(arg.data[0]) // 3,))
    return general("cbrt", args)


@rule("acos")
def _acos(args: tuple[Expr, ...], data: Data) -> Expr:
    return PI if rational(args[0]) == -1 else general("acos", args)


@rule("min")
def _min(args: tuple[Expr, ...], data: Data) -> Expr:
    return args[0] if args[0] is args[1] else general("min", args)


@rule("max")
def _max(args: tuple[Expr, ...], data: Data) -> Expr:
    return args[0] if args[0] is args[1] else general("max", args)


@rule("not")
def _not(args: tuple[Expr, ...], data: Data) -> Expr:
    inner = args[0]
    if inner.op == "not":
        return inner.args[0]
    if inner.op in {"lt", "le"}:
        low, high = inner.args
        return node("le" if inner.op == "lt" else "lt", (high, low))
    return node("not", args)


@rule("and")
def _and(args: tuple[Expr, ...], data: Data) -> Expr:
    decided = _decided(args, True)
    return general("and", args) if decided is None else decided


@rule("or")
def _or(args: tuple[Expr, ...], data: Data) -> Expr:
    decided = _decided(args, False)
    return general("or", args) if decided is None else decided


@rule("select")
def _select(args: tuple[Expr, ...], data: Data) -> Expr:
    condition, then, otherwise = args
    known = _known(condition)
    if known is not None:
        return then if known else otherwise
    if then is otherwise and condition.is_total:
        return then
    if condition.op == "not":
        return build("select", (condition.args[0], otherwise, then))
    return node("select", args)


@rule("sum")
def _sum(args: tuple[Expr, ...], data: Data) -> Expr:
    if len(data) < 2:
        raise FormulaError(
            f"the sum over {data[0]} has no array parameter indexed by {data[0]}",
            hints=(f"use an array in it, such as r[{data[0]}]: its length says how many terms there are",),
        )
    return ZERO if args[0] is ZERO else node("sum", args, data)


def _known(condition: Expr) -> bool | None:
    """Whether a comparison of rational constants holds; None for any other condition."""
    if condition.op not in {"lt", "le"}:
        return None
    low, high = (rational(arg) for arg in condition.args)
    if low is None or high is None:
        return None
    return low < high if condition.op == "lt" else low <= high


def _decided(args: tuple[Expr, ...], neutral: bool) -> Expr | None:
    """`and` (neutral True) or `or` (neutral False) where one side is known beforehand."""
    for one, other in (args, args[::-1]):
        known = _known(one)
        if known is neutral:
            return other
        if known is not None and other.is_total:
            return one
    return None
