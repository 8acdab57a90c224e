"""The same formula with other names for its parameters, so that formulas that share a name can be joined."""

from __future__ import annotations

from collections.abc import Mapping

from zeroset.expr.dag import Data, Expr, node, postorder

__all__ = ["renamed"]


def renamed(expr: Expr, names: Mapping[str, str]) -> Expr:
    """A formula whose parameters and arrays have other names.

    Args:
        expr: the formula.
        names: new names by old ones; names that are not in it stay. ``w`` becomes a parameter if it is.

    Example:
        >>> from zeroset.expr import parse, text
        >>> formula = parse("a x + sum(i, c[i] y)", ["a"], ["c"])
        >>> text(renamed(formula, {"a": "b", "c": "d"}))
        'b*x + sum(i, d[i]*y)'
    """
    made: dict[Expr, Expr] = {}
    for part in postorder(expr):
        made[part] = (
            _leaf(part, names)
            if not part.args
            else node(part.op, tuple(made[arg] for arg in part.args), _arrays(part, names))
        )
    return made[expr]


def _leaf(part: Expr, names: Mapping[str, str]) -> Expr:
    if part.op in ("parameter", "variable") and part.data[0] in names:
        return node("parameter", (), (names[str(part.data[0])],))
    if part.op == "element":
        array, index = map(str, part.data)
        return node("element", (), (names.get(array, array), index))
    return part


def _arrays(part: Expr, names: Mapping[str, str]) -> Data:
    """What a node holds besides its arguments: of a sum, its index and its arrays."""
    if part.op != "sum":
        return part.data
    index, *arrays = map(str, part.data)
    return (index, *(names.get(array, array) for array in arrays))
