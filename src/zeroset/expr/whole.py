"""What a node must satisfy to be a whole formula, however it was written."""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.errors import FormulaError
from zeroset.expr.build import shared
from zeroset.expr.constants import check_constants
from zeroset.expr.dag import postorder
from zeroset.expr.limits import check_nodes

if TYPE_CHECKING:
    from zeroset.expr.dag import Expr

__all__ = ["whole"]


def whole(expr: Expr) -> Expr:
    """The formula, checked, with `x + y` and `y + x` shared.

    Raises:
        FormulaError: It is a condition, depends on no variable, or has a constant part that is undefined.
        FormulaLimitError: It has too many operations, or a constant out of range.
    """
    if expr.is_condition:
        raise FormulaError(
            "an inequality is a solid, not a surface",
            hints=("for its boundary take the difference of both sides", "a choice is if(c, a, b)"),
        )
    if not expr.variables:
        raise FormulaError(
            "the formula depends on none of the variables x, y, z, w, so it is the same number everywhere",
            hints=("try x^2 + y^2 + z^2 = 1",),
        )
    parts = list(postorder(expr))
    check_nodes(len(parts))
    check_constants(parts)
    return shared(expr, parts)
