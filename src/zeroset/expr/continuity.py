"""Whether a formula is defined and continuous everywhere, for values of its parameters that nobody knows yet.

What depends on it is which number system suits a formula, and what a picture takes for nothing; no proof rests on it.
So parameters count as what they mostly are, positive: |x|^m has no pole, nor has 1/(x^2 + epsilon).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from zeroset.expr.dag import postorder
from zeroset.expr.facts import NONNEGATIVE, POSITIVE, TOTAL, flags_of
from zeroset.expr.ops import OPS

if TYPE_CHECKING:
    from zeroset.expr.dag import Expr

__all__ = ["continuous"]


class _Known(NamedTuple):
    """What is known of a part."""

    flags: int


def continuous(expr: Expr) -> bool:
    """Whether a formula has no jumps, poles and ends of its domain where its parameters are positive.

    Example:
        >>> from zeroset.expr import parse
        >>> [continuous(parse(text, params=["a"])) for text in ("1/(x^2 + a)", "1/x", "floor(x)", "sqrt(x)")]
        [True, False, False, False]
    """
    known: dict[Expr, _Known] = {}
    for part in postorder(expr):
        if OPS[part.op].jumps:
            return False
        if part.args:
            known[part] = _Known(flags_of(part.op, [known[arg] for arg in part.args], part.data))
        else:
            positive = part.op in ("parameter", "element")
            known[part] = _Known(part.flags | (NONNEGATIVE | POSITIVE if positive else 0))
    return bool(known[expr].flags & TOTAL)
