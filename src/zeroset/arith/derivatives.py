"""First and second derivatives of a function at a point, by dual numbers over any system."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from zeroset.arith.dual import DualSystem
from zeroset.arith.number import Number, System

__all__ = ["PAIRS", "first_derivatives", "second_derivatives"]

N = TypeVar("N", bound=Number)
Function = Callable[..., Any]
"""Is given a system and one of its numbers for each variable."""
PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))
"""The second derivatives of a function of three variables in their order: xx, xy, xz, yy, yz, zz."""


def first_derivatives(system: System[N], function: Function, point: Sequence[N]) -> tuple[N, list[N]]:
    """The value and the gradient.

    Args:
        system: of the point's coordinates.
        function: is called once, with a system of dual numbers.
        point: its coordinates.

    Example:
        >>> from zeroset.arith import F64, RealSystem
        >>> real = RealSystem(F64)
        >>> value, gradient = first_derivatives(real, lambda _, x, y: x * y, [real.exact(2.0), real.exact(3.0)])
        >>> value.value, [g.value for g in gradient]
        (6.0, [3.0, 2.0])
    """
    dual = DualSystem(system, len(point))
    result = function(dual, *(dual.variable(p, i) for i, p in enumerate(point)))
    return result.value, [result.derivative(i) for i in range(len(point))]


def second_derivatives(system: System[N], function: Function, point: Sequence[N]) -> tuple[N, list[N], list[N]]:
    """The value, the gradient, and the second derivatives in the order of ``PAIRS``, of a function of three variables.

    Dual numbers over dual numbers: the derivatives of the derivatives. Each mixed one is there twice, in either order;
    of the one that is not used nothing is left in a kernel.

    Args:
        system: of the point's coordinates.
        function: is called once.
        point: three coordinates.

    Example:
        >>> from zeroset.arith import F64, RealSystem
        >>> real = RealSystem(F64)
        >>> at = [real.exact(v) for v in (2.0, 3.0, 5.0)]
        >>> _, _, second = second_derivatives(real, lambda _, x, y, z: x.sqr() * y + z, at)
        >>> [h.value for h in second]
        [6.0, 4.0, 0.0, 0.0, 0.0, 0.0]
    """
    inner = DualSystem(system, 3)
    outer = DualSystem(inner, 3)
    result = function(outer, *(outer.variable(inner.variable(p, i), i) for i, p in enumerate(point)))
    gradient = [result.value.derivative(i) for i in range(3)]
    return result.value.value, gradient, [result.derivative(i).derivative(j) for i, j in PAIRS]
