"""How large the numbers get that a formula calculates on its way, from how large what goes in is.

A kernel keeps its numbers below the largest that its enclosures know (`arith.format`). Exponentials, logarithms,
quotients and high powers watch over that themselves; sums and products do so only where they are told to, for it costs.
Whoever draws asks here first, once for each set of parameters and bounds, and plain floats are enough for that.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from zeroset.expr.constants import enclose
from zeroset.expr.dag import postorder

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from zeroset.expr.dag import Expr

__all__ = ["Magnitude"]

Sizes = tuple[float, ...]
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
        self._parts = tuple(postorder(expr))
        self._places = {part: i for i, part in enumerate(self._parts)}

    def largest(self, sizes: Mapping[str, float], arrays: Mapping[str, tuple[float, int]]) -> float:
        """The largest value of any part.

        Args:
            sizes: How large each variable and parameter may be.
            arrays: The same of each array's elements, and how many there are.

        Returns:
            A bound, to within rounding; infinite where it is beyond what a float holds.
        """
        known: list[float] = []
        for part in self._parts:
            size = self._size(part, known, sizes, arrays)
            # Infinity times 0 is no number, and no promise.
            known.append(math.inf if math.isnan(size) else size)
        return max(known, default=0.0)

    def _size(
        self,
        part: Expr,
        known: Sequence[float],
        sizes: Mapping[str, float],
        arrays: Mapping[str, tuple[float, int]],
    ) -> float:
        args = tuple(known[self._places[arg]] for arg in part.args)
        match part.op:
            case "const":
                return max(map(abs, enclose(part)))
            case "variable" | "parameter":
                return sizes[str(part.data[0])]
            case "element":
                return arrays[str(part.data[0])][0]
            case "sum":
                return args[0] * max(arrays[str(name)][1] for name in part.data[1:])
            case "powi":
                return _power(args[0], abs(int(part.data[0])))
            case "powr":
                over, under = part.data
                return _power(max(args[0], 1.0), float(over) / float(under))
        rule = _RULES.get(part.op)
        return _WATCHED if rule is None else rule(args)


def _power(size: float, exponent: float) -> float:
    try:
        return float(size**exponent)
    except OverflowError:
        return math.inf


def _sum(args: Sizes) -> float:
    return sum(args)


def _itself(args: Sizes) -> float:
    return args[0]


def _choice(args: Sizes) -> float:
    return max(args[-2:])


_RULES: Mapping[str, Callable[[Sizes], float]] = {
    "add": _sum,
    "sub": _sum,
    "mod": _sum,
    "mul": math.prod,
    "sqr": lambda args: args[0] * args[0],
    "neg": _itself,
    "abs": _itself,
    "sqrt": lambda args: max(args[0], 1.0),
    "cbrt": lambda args: max(args[0], 1.0),
    "floor": lambda args: args[0] + 1.0,
    "ceil": lambda args: args[0] + 1.0,
    "min": _choice,
    "max": _choice,
    "select": _choice,
    **dict.fromkeys(("sin", "cos", "asin", "acos", "atan", "atan2", "tanh", "sign"), lambda args: _BOUNDED),
    **dict.fromkeys(("lt", "le", "and", "or", "not"), lambda args: 0.0),
}
"""What is not here, such as an exponential or a quotient, is watched over."""
