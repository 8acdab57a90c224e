"""Evaluate a formula on any number system: lowering f is evaluating f.

On floats that is a value, on intervals an enclosure, on numbers over kernel values it emits the code. The walk
keeps its own stack, does each node once, and hoists out of a sum what does not depend on its index.
"""

from __future__ import annotations

from collections import ChainMap
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from zeroset.expr.constants import enclose, is_number
from zeroset.expr.dag import Expr, node, postorder
from zeroset.expr.ops import OPS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, MutableMapping

__all__ = ["Env", "System", "evaluate"]

N = TypeVar("N")
Made = TypeVar("Made", covariant=True)


class System(Protocol[Made]):
    """What evaluation needs of a number system."""

    def constant(self, lo: float, hi: float) -> Made:
        """The real number known to lie in [lo, hi]."""


class Env(Protocol[N]):
    """Where the leaves of a formula get their numbers."""

    def variable(self, name: str) -> N:
        """The number that stands for x, y, z, or w."""

    def parameter(self, name: str) -> N:
        """The number that stands for a scalar parameter."""

    def sum(self, system: Any, arrays: tuple[str, ...], body: Callable[[Mapping[str, N]], N]) -> N:
        """The sum of `body` over all indices; it takes the element of each array at the index."""


def evaluate(expr: Expr, system: System[N], env: Env[N]) -> N:
    """The value of a formula in a number system.

    Args:
        expr: The formula.
        system: Makes numbers of constants, each enclosed between two doubles.
        env: Gives the numbers of variables and parameters, and loops over arrays.

    Returns:
        What the methods of the numbers, named as in `OPS`, make of the formula.

    Example:
        >>> from zeroset.expr import parse
        >>> class Plain(float):
        ...     def add(self, other): return Plain(self + other)
        ...     def sqr(self): return Plain(self * self)
        >>> class Floats:
        ...     def constant(self, lo, hi): return Plain((lo + hi) / 2)
        ...     def variable(self, name): return Plain({"x": 3, "y": 4}[name])
        >>> evaluate(parse("x^2 + y^2"), Floats(), Floats())
        25.0
    """
    value: N = _Evaluation(system, env).value(expr, {}, frozenset())
    return value


class _Evaluation:
    """One evaluation. In each scope, `known` holds the values so far, `indices` those whose elements are known."""

    def __init__(self, system: Any, env: Any) -> None:
        self.system = system
        self.env = env

    def value(self, expr: Expr, known: MutableMapping[Expr, Any], indices: frozenset[str]) -> Any:
        """The value of a node, after all that it needs."""

        def needs(part: Expr) -> Iterable[Expr]:
            if part in known or is_number(part):
                return ()
            return _hoisted(part, indices) if part.op == "sum" else part.args

        for part in postorder(expr, needs):
            if part not in known:
                known[part] = self._apply(part, known, indices)
        return known[expr]

    def _apply(self, part: Expr, known: MutableMapping[Expr, Any], indices: frozenset[str]) -> Any:
        """The value of a node whose needs are known."""
        if is_number(part):
            return self.system.constant(*enclose(part))
        match part.op:
            case "variable":
                return self.env.variable(part.data[0])
            case "parameter":
                return self.env.parameter(part.data[0])
            case "sum":
                return self._sum(part, known, indices)
        first, *rest = (known[arg] for arg in part.args)
        return getattr(first, OPS[part.op].method)(*rest, *_method_data(part))

    def _sum(self, part: Expr, known: MutableMapping[Expr, Any], indices: frozenset[str]) -> Any:
        """The environment loops; the body is evaluated in a scope of its own."""
        index, *arrays = map(str, part.data)
        outside = known
        if index in indices:
            # The sum's own index hides that of a sum around it.
            outside = {item: number for item, number in known.items() if ("index", index) not in item.symbols}

        def body(elements: Mapping[str, Any]) -> Any:
            own = {node("element", (), (array, index)): number for array, number in elements.items()}
            return self.value(part.args[0], ChainMap(own, outside), indices | {index})

        return self.env.sum(self.system, tuple(arrays), body)


def _hoisted(part: Expr, indices: frozenset[str]) -> list[Expr]:
    """The largest parts of a sum's body that need no index beyond those known outside it."""
    found: list[Expr] = []

    def needs(item: Expr) -> Iterable[Expr]:
        if item.indices <= indices:
            found.append(item)
            return ()
        return item.args

    for _ in postorder(part.args[0], needs):
        pass
    return found


def _method_data(part: Expr) -> tuple[Any, ...]:
    """What a method gets besides numbers: `powi(n)`, `powr((p, q))`."""
    return (part.data,) if part.op == "powr" else part.data
