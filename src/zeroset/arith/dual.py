"""Dual numbers: a value and its gradient, over any other system.

``Dual[Real]`` gives exact normals, ``Dual[Interval]`` the range of the gradient that Mitchell's method asks for, and
``Dual[Dual[...]]`` second derivatives. The rules are in ``dual_rules``. A derivative that is zero while tracing is None
and costs nothing.
"""

from __future__ import annotations

from typing import Generic, TypeVar

from zeroset.arith.dual_rules import DualRules
from zeroset.arith.format import Format
from zeroset.arith.number import Condition, Number, System
from zeroset.arith.scalar import Scalar

__all__ = ["Dual", "DualCondition", "DualSystem"]

N = TypeVar("N", bound=Number)


class Dual(DualRules[N], Generic[N]):
    """A value with its derivatives along some directions; ``DualRules`` tells of its attributes.

    Example:
        >>> from zeroset.arith import F64, DualSystem, RealSystem
        >>> system = DualSystem(RealSystem(F64), 1)
        >>> x = system.variable(RealSystem(F64).exact(3.0), 0)
        >>> (x.sqr() + x).derivative(0).value
        7.0
    """

    __slots__ = ("_system", "gradient", "value")

    def __init__(self, system: DualSystem[N], value: N, gradient: tuple[N | None, ...]) -> None:
        self._system = system
        self.value = value
        self.gradient = gradient

    def __repr__(self) -> str:
        return f"Dual({self.value!r}, {self.gradient!r})"

    @property
    def system(self) -> DualSystem[N]:
        """The system that made this number."""
        return self._system

    def make(self, value: N, gradient: tuple[N | None, ...]) -> Dual[N]:
        """A number of the same system."""
        return Dual(self._system, value, gradient)

    def watched(self) -> Dual[N]:
        """The value watched, and with it every derivative that it goes into."""
        return self.make(self.value.watched(), self.gradient)

    def lt(self, other: Dual[N], /) -> DualCondition[N]:
        """The comparison of the values."""
        return DualCondition(self.value.lt(other.value))

    def le(self, other: Dual[N], /) -> DualCondition[N]:
        """The comparison of the values."""
        return DualCondition(self.value.le(other.value))


class DualCondition(Condition[Dual[N]], Generic[N]):
    """A comparison of values, which picks gradients too.

    Attributes:
        inner: the condition of the inner system.
    """

    __slots__ = ("inner",)

    def __init__(self, inner: Condition[N]) -> None:
        self.inner = inner

    def and_(self, other: DualCondition[N]) -> DualCondition[N]:
        """Both."""
        return DualCondition(self.inner.and_(other.inner))

    def or_(self, other: DualCondition[N]) -> DualCondition[N]:
        """Either."""
        return DualCondition(self.inner.or_(other.inner))

    def not_(self) -> DualCondition[N]:
        """The opposite."""
        return DualCondition(self.inner.not_())

    def select(self, a: Dual[N], b: Dual[N]) -> Dual[N]:
        """One of two values with its gradient; where undecided, what holds both."""
        gradient = tuple(
            None if g is None and h is None else self.inner.select(a.derivative(i), b.derivative(i))
            for i, (g, h) in enumerate(zip(a.gradient, b.gradient, strict=True))
        )
        return a.make(self.inner.select(a.value, b.value), gradient)


class DualSystem(System[Dual[N]], Generic[N]):
    """Makes dual numbers.

    Args:
        inner: the system of values and derivatives.
        count: how many derivatives a number carries.

    Attributes:
        inner: as given.
        count: as given.
    """

    def __init__(self, inner: System[N], count: int) -> None:
        self.inner = inner
        self.count = count

    @property
    def fmt(self) -> Format:
        """The floating-point format of the scalars."""
        return self.inner.fmt

    def lift(self, value: N) -> Dual[N]:
        """A number that depends on no direction."""
        return Dual(self, value, (None,) * self.count)

    def variable(self, value: N, index: int) -> Dual[N]:
        """The variable of one direction."""
        return Dual(
            self, value, tuple(self.inner.constant(1.0, 1.0) if i == index else None for i in range(self.count))
        )

    def constant(self, lo: float, hi: float) -> Dual[N]:
        """A constant of the inner system."""
        return self.lift(self.inner.constant(lo, hi))

    def enclose(self, value: Scalar, error: Scalar) -> Dual[N]:
        """A run-time scalar, independent of all directions."""
        return self.lift(self.inner.enclose(value, error))

    def general(self, number: Dual[N]) -> Dual[N]:
        """The number with every derivative present and general."""
        derivatives = (number.derivative(i) for i in range(self.count))
        return Dual(self, self.inner.general(number.value), tuple(self.inner.general(d) for d in derivatives))

    def components(self, number: Dual[N]) -> list[Scalar]:
        """Those of the value, then of each derivative."""
        parts = [number.value, *(number.derivative(i) for i in range(self.count))]
        return [scalar for part in parts for scalar in self.inner.components(part)]

    def rebuild(self, components: list[Scalar]) -> Dual[N]:
        """The number of these components."""
        size = len(components) // (self.count + 1)
        parts = [self.inner.rebuild(components[i : i + size]) for i in range(0, len(components), size)]
        return Dual(self, parts[0], tuple(parts[1:]))
