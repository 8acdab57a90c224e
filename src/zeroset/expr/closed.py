"""A solid f <= 0 told by a formula that is defined everywhere: for what makes one formula of a solid's parts.

Where f has no value is outside. So a root's argument is cut off at the end of its domain, and where it was is one more
condition: sqrt(u) - 1 <= 0 is max(sqrt(max(u, 0)) - 1, -u) <= 0. A quotient N/D has the sign of N D, which has no pole.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from zeroset.expr.build import ONE, build
from zeroset.expr.dag import Expr, constant, node, postorder
from zeroset.expr.facts import NONNEGATIVE, POSITIVE
from zeroset.expr.fraction import fraction

__all__ = ["closed"]

_LEAST = constant(Fraction(1, 10**30))
_ZERO = constant(Fraction(0))


def _from(least: Expr) -> Callable[[Expr], tuple[Expr, Expr]]:
    return lambda u: (build("max", (u, least)), -u)


def _within_one(u: Expr) -> tuple[Expr, Expr]:
    return build("max", (build("min", (u, ONE)), -ONE)), build("abs", (u,)) - 1


_CUT: dict[str, Callable[[Expr], tuple[Expr, Expr]]] = {
    "sqrt": _from(_ZERO),
    "powr": _from(_ZERO),
    "pow": _from(_LEAST),
    "log": _from(_LEAST),
    "asin": _within_one,
    "acos": _within_one,
}
"""Of what is not defined for all first arguments: these cut off, and what is above 0 where they were not."""
_INSIDE = {"sqrt": NONNEGATIVE, "powr": NONNEGATIVE, "pow": POSITIVE, "log": POSITIVE, "asin": 0, "acos": 0}
"""What must be known of an argument that needs no cut."""


def closed(expr: Expr) -> Expr:
    """A formula that is at most 0 just where ``expr`` is defined and at most 0.

    What stands inside a sum or a choice stays as it is: there it depends on the element, or on what is chosen.

    Example:
        >>> from zeroset.expr import parse, text
        >>> [text(closed(parse(f))) for f in ("x^2 + y^2 - 1", "1/x - 1", "z - sqrt(x)")]
        ['x^2 + y^2 - 1', '(1 - x)*x', 'max(z - sqrt(max(x, 0)), -x)']
    """
    parts = fraction(expr)
    whole = expr if parts is None else parts[0] * parts[1]
    made: dict[Expr, Expr] = {}
    conditions: dict[Expr, dict[Expr, None]] = {}
    for part in postorder(whole):
        if part.op in ("select", "sum"):
            made[part], conditions[part] = part, {}
            continue
        args = [made[arg] for arg in part.args]
        conditions[part] = {one: None for arg in part.args for one in conditions[arg]}
        if part.op in _CUT and not part.args[0].flags & _INSIDE[part.op]:
            args[0], outside = _CUT[part.op](args[0])
            conditions[part][outside] = None
        made[part] = node(part.op, tuple(args), part.data) if part.args else part
    result = made[whole]
    for outside in conditions[whole]:
        result = build("max", (result, outside))
    return result
