"""How large the numbers get that a formula calculates on its way, from how large what goes in is.

A kernel keeps its numbers below the largest that its enclosures know (`arith.format`). Exponentials, logarithms,
quotients and high powers watch over that themselves; sums and products do so only where they are told to, for it costs.
Whoever draws asks here first, once for each set of parameters and bounds, and plain floats are enough for that.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from zeroset.expr.constants import enclose, is_number
from zeroset.expr.dag import postorder

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from zeroset.expr.dag import Expr

__all__ = ["Magnitude"]

_BOUNDED = 4.0
"""More than any angle or wave."""
_WATCHED = 1.0
"""Stands for what kernels watch over by themselves, wherever it goes."""


class Magnitude:
    """How large the values of a formula's parts may be.

    Args:
        expr: The formula.

    Example:
        >>> from zeroset.expr import parse
        >>> size = Magnitude(parse("(x^2 + y^2) * a = 7", ["a"]))
        >>> size.largest({"x": 3.0, "y": 4.0, "a": 1e30}, {})
        2.5e+31
    """

    def __init__(self, expr: Expr) -> None:
        parts = tuple(postorder(expr, _arguments))
        places = {part: i for i, part in enumerate(parts)}
        # For each part its rule, what it takes beside sizes, and where those of its arguments are.
        self._steps = tuple((*_rule(part), tuple(places[arg] for arg in _arguments(part))) for part in parts)

    def largest(self, sizes: Mapping[str, float], arrays: Mapping[str, tuple[float, int]]) -> float:
        """The largest value of any part.

        Args:
            sizes: How large each variable and parameter may be.
            arrays: The same of each array's elements, and how many there are.

        Returns:
            A bound, to within rounding; infinite where it is beyond what a float holds.
        """
        known: list[float] = []
        for rule, data, places in self._steps:
            if rule is None:
                size = data
            elif rule == "name":
                size = sizes[data]
            elif rule == "element":
                size = arrays[data][0]
            elif rule == "sum":
                size = known[places[0]] * max(arrays[name][1] for name in data)
            elif rule == "power":
                size = _power(known[places[0]], data)
            else:
                size = rule(*[known[place] for place in places])
            # Infinity times 0 is no number, and no promise.
            known.append(size if size == size else math.inf)
        return max(known, default=0.0)


def _rule(part: Expr) -> tuple[Any, Any]:
    """How a part's size comes of those of its arguments, and what else that takes: a size itself for None."""
    if is_number(part):
        return None, max(map(abs, enclose(part)))
    match part.op:
        case "div" if is_number(part.args[1]):
            # Kernels multiply by one over it.
            return _quotient, None
        case "variable" | "parameter":
            return "name", str(part.data[0])
        case "element":
            return "element", str(part.data[0])
        case "sum":
            return "sum", tuple(map(str, part.data[1:]))
        case "powi":
            return "power", float(abs(int(part.data[0])))
        case "powr":
            over, under = part.data
            return "power", max(float(over) / float(under), 1.0)
    return (_RULES[part.op], None) if part.op in _RULES else (None, _WATCHED)


def _arguments(part: Expr) -> tuple[Expr, ...]:
    return () if is_number(part) else part.args


def _quotient(a: float, b: float) -> float:
    return a / b if b > 0.0 else math.inf


def _power(size: float, exponent: float) -> float:
    try:
        return float(size**exponent)
    except OverflowError:
        return math.inf


def _sum(a: float, b: float) -> float:
    return a + b


def _itself(a: float) -> float:
    return a


def _at_least_one(a: float) -> float:
    return max(a, 1.0)


def _step(a: float) -> float:
    return a + 1.0


def _choice(*args: float) -> float:
    return max(args[-2:])


_RULES: Mapping[str, Callable[..., float]] = {
    **dict.fromkeys(("add", "sub", "mod"), _sum),
    "mul": lambda a, b: a * b,
    "sqr": lambda a: a * a,
    **dict.fromkeys(("neg", "abs"), _itself),
    **dict.fromkeys(("sqrt", "cbrt"), _at_least_one),
    **dict.fromkeys(("floor", "ceil"), _step),
    **dict.fromkeys(("min", "max", "select"), _choice),
    **dict.fromkeys(("sin", "cos", "asin", "acos", "atan", "atan2", "tanh", "sign"), lambda *args: _BOUNDED),
    **dict.fromkeys(("lt", "le", "and", "or", "not"), lambda *args: 0.0),
}
"""What is not here, such as an exponential or a quotient, is watched over."""
