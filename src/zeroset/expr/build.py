"""The rewriter as a whole: importing it brings in every rule.

`build` makes one node; `rewrite` does a whole DAG again from its leaves; `shared` makes `x + y` and `y + x`
one node wherever both occur.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.expr import choices, powers, products, sums
from zeroset.expr.dag import Expr, node, postorder
from zeroset.expr.ops import OPS
from zeroset.expr.rules import ONE, ZERO, build

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

__all__ = ["ONE", "RULES", "ZERO", "build", "rewrite", "shared", "sum_over"]

RULES = (sums, products, powers, choices)
"""The modules of rules, in reading order."""


def rewrite(expr: Expr) -> Expr:
    """The same function in normal form, for a DAG that was put together with `node`.

    Raises:
        FormulaError: A part of it is undefined everywhere, such as 1/0.
    """
    done: dict[Expr, Expr] = {}
    for part in postorder(expr):
        done[part] = build(part.op, tuple(done[arg] for arg in part.args), part.data)
    return done[expr]


def shared(expr: Expr, parts: Sequence[Expr] | None = None) -> Expr:
    """The same formula with commutative operations on the same two arguments made one node.

    The order met first stays, so sums read as they were written.

    Args:
        expr: The formula.
        parts: Its nodes in postorder, where the caller has them.
    """
    parts = list(postorder(expr)) if parts is None else parts
    swapped = {(part.op, part.args[::-1]) for part in parts if OPS[part.op].commutative}
    if not any((part.op, part.args) in swapped and part.args[0] is not part.args[1] for part in parts):
        return expr
    done: dict[Expr, Expr] = {}
    orders: dict[tuple[str, frozenset[Expr]], tuple[Expr, ...]] = {}
    for part in parts:
        args = tuple(done[arg] for arg in part.args)
        if OPS[part.op].commutative:
            args = orders.setdefault((part.op, frozenset(args)), args)
        changed = any(new is not old for new, old in zip(args, part.args, strict=True))
        done[part] = build(part.op, args, part.data) if changed else node(part.op, args, part.data)
    return done[expr]


def sum_over(index: str, body: Expr, arrays: Iterable[str] = ()) -> Expr:
    """The sum of a body over all elements of the arrays that it indexes by `index`.

    Args:
        index: Name of the index.
        body: The term.
        arrays: Further arrays that the sum runs along, though the rewritten body has lost them (as in 1 + 0*r[i]).

    Raises:
        FormulaError: The body has no array indexed by `index`.
    """
    found = {
        str(part.data[0])
        for part in postorder(body, lambda item: item.args if ("index", index) in item.symbols else ())
        if part.op == "element" and part.data[1] == index
    }
    return build("sum", (body,), (index, *sorted(found.union(arrays))))
