"""What a number system is: numbers with one method for each operator, and a system that makes them.

The method names are the operator names of the expression table. A number is generic over its scalar (see
``scalar``), so evaluating a formula on numbers of Python floats computes, and on numbers of kernel Values writes a
kernel. Operators that are combinations of others are written here once; a system overrides what it can do better.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, Generic, Self, TypeVar

from zeroset.arith.format import Format
from zeroset.arith.scalar import Scalar

__all__ = ["Condition", "Number", "System"]


class Number(ABC):
    """A number of some system; ``system`` makes further ones of its kind."""

    __slots__ = ()

    @property
    @abstractmethod
    def system(self) -> System[Self]:
        """The system this number belongs to."""

    @abstractmethod
    def add(self, other: Self, /) -> Self:
        """``self + other``."""

    @abstractmethod
    def neg(self) -> Self:
        """``-self``."""

    @abstractmethod
    def mul(self, other: Self, /) -> Self:
        """``self * other``."""

    @abstractmethod
    def div(self, other: Self, /) -> Self:
        """``self / other``; undefined where ``other`` is 0."""

    @abstractmethod
    def sqr(self) -> Self:
        """``self**2``."""

    def sub(self, other: Self, /) -> Self:
        """``self - other``."""
        return self.add(other.neg())

    def powi(self, n: int, /) -> Self:
        """``self**n`` by repeated squares, so that even powers are seen as such."""
        if n < 0:
            return self.literal(1.0).div(self.powi(-n))
        if n == 0:
            return self.literal(1.0)
        if n % 2:
            return self if n == 1 else self.mul(self.powi(n - 1))
        return self.powi(n // 2).sqr()

    @abstractmethod
    def pow(self, other: Self, /) -> Self:
        """``self**other`` as exp(other log self): for self > 0, and 0 for self = 0 < other."""

    @abstractmethod
    def powr(self, exponent: tuple[int, int], /) -> Self:
        """``self**(p/q)`` for self >= 0 and a rational exponent ``(p, q)`` that is no integer."""

    @abstractmethod
    def cbrt(self) -> Self:
        """The real cube root."""

    @abstractmethod
    def sqrt(self) -> Self:
        """The square root; undefined below 0."""

    @abstractmethod
    def exp(self) -> Self:
        """e**self."""

    @abstractmethod
    def log(self) -> Self:
        """The natural logarithm; undefined for self <= 0."""

    @abstractmethod
    def sin(self) -> Self:
        """The sine."""

    @abstractmethod
    def cos(self) -> Self:
        """The cosine."""

    @abstractmethod
    def tan(self) -> Self:
        """The tangent; undefined at its poles."""

    @abstractmethod
    def asin(self) -> Self:
        """The arc sine; undefined outside [-1, 1]."""

    @abstractmethod
    def acos(self) -> Self:
        """The arc cosine; undefined outside [-1, 1]."""

    @abstractmethod
    def atan(self) -> Self:
        """The arc tangent."""

    @abstractmethod
    def atan2(self, other: Self, /) -> Self:
        """The angle of the point (other, self), in (-pi, pi]; undefined at the origin."""

    @abstractmethod
    def sinh(self) -> Self:
        """The hyperbolic sine."""

    @abstractmethod
    def cosh(self) -> Self:
        """The hyperbolic cosine."""

    @abstractmethod
    def tanh(self) -> Self:
        """The hyperbolic tangent."""

    @abstractmethod
    def abs(self) -> Self:
        """The absolute value."""

    @abstractmethod
    def sign(self) -> Self:
        """-1, 0 or 1."""

    @abstractmethod
    def floor(self) -> Self:
        """The largest integer at or below."""

    def ceil(self) -> Self:
        """The smallest integer at or above."""
        return self.neg().floor().neg()

    def mod(self, other: Self, /) -> Self:
        """``self - other * floor(self / other)``."""
        return self.sub(other.mul(self.div(other).floor()))

    @abstractmethod
    def max(self, other: Self, /) -> Self:
        """The larger of two."""

    def min(self, other: Self, /) -> Self:
        """The smaller of two."""
        return self.neg().max(other.neg()).neg()

    @abstractmethod
    def lt(self, other: Self, /) -> Condition[Self]:
        """Whether ``self < other``."""

    @abstractmethod
    def le(self, other: Self, /) -> Condition[Self]:
        """Whether ``self <= other``."""

    def watched(self) -> Self:
        """The same number, of which it is not known that all that is made of it stays below ``fmt.big``.

        Enclosing systems then look at each step whether something has passed it; others claim nothing anyway.
        """
        return self

    def literal(self, value: float) -> Self:
        """A constant beside this number; ``value`` is meant exactly."""
        return self.system.constant(value, value)

    def scaled(self, factor: float) -> Self:
        """``factor * self`` for an exact literal factor."""
        return self.mul(self.literal(factor))

    def _coerce(self, other: Any) -> Self:
        return self.literal(float(other)) if isinstance(other, (int, float)) else other

    def __add__(self, other: Self | float) -> Self:
        return self.add(self._coerce(other))

    def __radd__(self, other: float) -> Self:
        return self._coerce(other).add(self)

    def __sub__(self, other: Self | float) -> Self:
        return self.sub(self._coerce(other))

    def __rsub__(self, other: float) -> Self:
        return self._coerce(other).sub(self)

    def __mul__(self, other: Self | float) -> Self:
        return self.mul(self._coerce(other))

    def __rmul__(self, other: float) -> Self:
        return self._coerce(other).mul(self)

    def __truediv__(self, other: Self | float) -> Self:
        return self.div(self._coerce(other))

    def __rtruediv__(self, other: float) -> Self:
        return self._coerce(other).div(self)

    def __neg__(self) -> Self:
        return self.neg()

    def __abs__(self) -> Self:
        return self.abs()

    def __pow__(self, n: int) -> Self:
        return self.sqr() if n == 2 else self.powi(n)


N = TypeVar("N", bound=Number)


class Condition(ABC, Generic[N]):
    """A truth about numbers of one system; on enclosing systems it may be undecided."""

    __slots__ = ()

    @abstractmethod
    def and_(self, other: Self) -> Self:
        """Both."""

    @abstractmethod
    def or_(self, other: Self) -> Self:
        """Either."""

    @abstractmethod
    def not_(self) -> Self:
        """The opposite."""

    @abstractmethod
    def select(self, a: N, b: N) -> N:
        """``a`` where the condition holds, else ``b``; where it is undecided, something that holds both."""


class System(ABC, Generic[N]):
    """Makes numbers of one kind."""

    @property
    @abstractmethod
    def fmt(self) -> Format:
        """The floating-point format of the scalars."""

    @abstractmethod
    def constant(self, lo: float, hi: float) -> N:
        """The real number known to lie in ``[lo, hi]`` (float64); ``lo == hi`` means exactly that number."""

    @abstractmethod
    def enclose(self, value: Scalar, error: Scalar) -> N:
        """The real number within ``error >= 0`` of a run-time scalar."""

    def exact(self, value: Scalar) -> N:
        """The real number that a run-time scalar is; a subnormal may count as 0."""
        return self.enclose(value, 0.0)

    @abstractmethod
    def general(self, number: N) -> N:
        """The same number (or an enclosure of it) in the form that ``components`` flattens alike for all numbers."""

    @abstractmethod
    def components(self, number: N) -> list[Scalar]:
        """Scalars and masks of a general number, in a fixed order; what is known while tracing stays a literal."""

    @abstractmethod
    def rebuild(self, components: list[Scalar]) -> N:
        """The number that ``components`` flattened."""
