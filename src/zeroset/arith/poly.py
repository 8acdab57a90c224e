"""Polynomials in one unknown with numbers as coefficients: f along a ray, coefficient by coefficient.

Evaluating a formula on ``origin + t * direction`` with these gives the coefficients in t that analytic roots and exact
extensions need (Singh & Narayanan 2010, section 4). What is not a polynomial is refused.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, NoReturn, TypeVar

from zeroset.arith.format import Format
from zeroset.arith.number import Condition, Number, System
from zeroset.arith.scalar import Scalar
from zeroset.errors import MethodError

__all__ = ["NotPolynomialError", "Poly", "PolyCondition", "PolySystem"]

N = TypeVar("N", bound=Number)


class NotPolynomialError(MethodError):
    """The function is no polynomial of the degree that a method can treat."""


def _refuse(operation: str) -> NoReturn:
    raise NotPolynomialError(
        f"{operation} of something that varies along the ray makes no polynomial",
        hint="choose a method that takes any formula, such as method='auto'",
    )


def _unary(name: str) -> Callable[[Poly[Any]], Poly[Any]]:
    return lambda a: a.of_constants(name, lambda c: getattr(c, name)())


def _binary(name: str) -> Callable[[Poly[Any], Poly[Any]], Poly[Any]]:
    return lambda a, b: a.of_constants(name, getattr(type(a.coefficient(0)), name), b)


def _plus(a: N | None, b: N | None) -> N | None:
    return b if a is None else a if b is None else a.add(b)


class Poly(Number, Generic[N]):
    """A polynomial in t.

    Attributes:
        coefficients: numbers of the inner system, constant first; None for one that is identically 0.

    Example:
        >>> from zeroset.arith import F64, PolySystem, RealSystem
        >>> system = PolySystem(RealSystem(F64), 4)
        >>> p = (system.unknown() + 1.0).sqr()
        >>> [p.coefficient(i).value for i in range(3)]
        [1.0, 2.0, 1.0]
    """

    __slots__ = ("_system", "coefficients")

    def __init__(self, system: PolySystem[N], coefficients: tuple[N | None, ...]) -> None:
        degree = max((i for i, c in enumerate(coefficients) if c is not None), default=0)
        if degree > system.degree:
            raise NotPolynomialError(f"the function has degree {degree} along a ray, more than {system.degree}")
        self._system = system
        self.coefficients = coefficients[: degree + 1]

    def __repr__(self) -> str:
        return f"Poly({self.coefficients!r})"

    @property
    def system(self) -> PolySystem[N]:
        """The system that made this number."""
        return self._system

    @property
    def degree(self) -> int:
        """The highest power with a coefficient."""
        return len(self.coefficients) - 1

    def coefficient(self, power: int) -> N:
        """One coefficient, as a number."""
        known = self.coefficients[power] if power <= self.degree else None
        return self._system.inner.constant(0.0, 0.0) if known is None else known

    def watched(self) -> Poly[N]:
        """All coefficients watched."""
        return Poly(self._system, tuple(None if c is None else c.watched() for c in self.coefficients))

    def _with(self, coefficients: list[N | None]) -> Poly[N]:
        return Poly(self._system, tuple(coefficients))

    def add(self, other: Poly[N], /) -> Poly[N]:
        """Coefficient by coefficient."""
        return self._with([_plus(self._known(i), other._known(i)) for i in range(self._length(other))])

    def sub(self, other: Poly[N], /) -> Poly[N]:
        """Coefficient by coefficient."""
        return self.add(other.neg())

    def neg(self) -> Poly[N]:
        """Coefficient by coefficient."""
        return self._with([None if c is None else c.neg() for c in self.coefficients])

    def _length(self, other: Poly[N]) -> int:
        return max(self.degree, other.degree) + 1

    def _known(self, power: int) -> N | None:
        return self.coefficients[power] if power <= self.degree else None

    def mul(self, other: Poly[N], /) -> Poly[N]:
        """The product of both sums."""
        result: list[N | None] = [None] * (self.degree + other.degree + 1)
        for i, a in enumerate(self.coefficients):
            for j, b in enumerate(other.coefficients):
                if a is not None and b is not None:
                    result[i + j] = _plus(result[i + j], a.mul(b))
        return self._with(result)

    def sqr(self) -> Poly[N]:
        """The square: squares of coefficients, and each mixed product once, doubled."""
        result: list[N | None] = [None] * (2 * self.degree + 1)
        for i, a in enumerate(self.coefficients):
            for j in range(i):
                b = self.coefficients[j]
                if a is not None and b is not None:
                    result[i + j] = _plus(result[i + j], a.mul(b))
        result = [None if c is None else c.scaled(2.0) for c in result]
        for i, a in enumerate(self.coefficients):
            if a is not None:
                result[2 * i] = _plus(result[2 * i], a.sqr())
        return self._with(result)

    def powi(self, n: int, /) -> Poly[N]:
        """By repeated squares; of a constant also with n < 0."""
        if n < 0 or self.degree == 0:
            return self.of_constants("a negative power", lambda c: c.powi(n))
        return super().powi(n)

    def div(self, other: Poly[N], /) -> Poly[N]:
        """By a constant."""
        if other.degree > 0:
            _refuse("the reciprocal")
        divisor = other.coefficient(0)
        return self._with([None if c is None else c.div(divisor) for c in self.coefficients])

    def of_constants(self, operation: str, function: Callable[..., N], *others: Poly[N]) -> Poly[N]:
        """A function of polynomials that do not vary; others are refused."""
        numbers = (self, *others)
        if any(number.degree > 0 for number in numbers):
            _refuse(operation)
        return self._with([function(*(number.coefficient(0) for number in numbers))])

    def powr(self, exponent: tuple[int, int], /) -> Poly[N]:
        """Of a constant."""
        return self.of_constants("a broken power", lambda c: c.powr(exponent))

    pow = _binary("pow")
    atan2 = _binary("atan2")
    mod = _binary("mod")
    max = _binary("max")
    min = _binary("min")
    cbrt = _unary("cbrt")
    sqrt = _unary("sqrt")
    exp = _unary("exp")
    log = _unary("log")
    sin = _unary("sin")
    cos = _unary("cos")
    tan = _unary("tan")
    asin = _unary("asin")
    acos = _unary("acos")
    atan = _unary("atan")
    sinh = _unary("sinh")
    cosh = _unary("cosh")
    tanh = _unary("tanh")
    abs = _unary("abs")
    sign = _unary("sign")
    floor = _unary("floor")
    ceil = _unary("ceil")

    def lt(self, other: Poly[N], /) -> PolyCondition[N]:
        """Of constants."""
        return self._compared(other, "lt")

    def le(self, other: Poly[N], /) -> PolyCondition[N]:
        """Of constants."""
        return self._compared(other, "le")

    def _compared(self, other: Poly[N], name: str) -> PolyCondition[N]:
        if self.degree > 0 or other.degree > 0:
            _refuse("a comparison")
        return PolyCondition(getattr(self.coefficient(0), name)(other.coefficient(0)))


class PolyCondition(Condition[Poly[N]], Generic[N]):
    """A comparison of constants, which picks whole polynomials.

    Attributes:
        inner: the condition of the inner system.
    """

    __slots__ = ("inner",)

    def __init__(self, inner: Condition[N]) -> None:
        self.inner = inner

    def and_(self, other: PolyCondition[N]) -> PolyCondition[N]:
        """Both."""
        return PolyCondition(self.inner.and_(other.inner))

    def or_(self, other: PolyCondition[N]) -> PolyCondition[N]:
        """Either."""
        return PolyCondition(self.inner.or_(other.inner))

    def not_(self) -> PolyCondition[N]:
        """The opposite."""
        return PolyCondition(self.inner.not_())

    def select(self, a: Poly[N], b: Poly[N]) -> Poly[N]:
        """One of two polynomials, coefficient by coefficient."""
        length = max(a.degree, b.degree) + 1
        return Poly(a.system, tuple(self.inner.select(a.coefficient(i), b.coefficient(i)) for i in range(length)))


class PolySystem(System[Poly[N]], Generic[N]):
    """Makes polynomials.

    Args:
        inner: the system of the coefficients.
        degree: the highest degree that is not refused.

    Attributes:
        inner: as given.
        degree: as given.
    """

    def __init__(self, inner: System[N], degree: int) -> None:
        self.inner = inner
        self.degree = degree

    @property
    def fmt(self) -> Format:
        """The floating-point format of the scalars."""
        return self.inner.fmt

    def lift(self, coefficient: N) -> Poly[N]:
        """A polynomial that does not vary."""
        return Poly(self, (coefficient,))

    def unknown(self) -> Poly[N]:
        """The polynomial t."""
        return Poly(self, (None, self.inner.constant(1.0, 1.0)))

    def linear(self, constant: N, slope: N) -> Poly[N]:
        """constant + slope t: a coordinate along a ray."""
        return Poly(self, (constant, slope))

    def constant(self, lo: float, hi: float) -> Poly[N]:
        """A constant of the inner system."""
        return Poly(self, (None,)) if lo == hi == 0.0 else self.lift(self.inner.constant(lo, hi))

    def enclose(self, value: Scalar, error: Scalar) -> Poly[N]:
        """A run-time scalar that does not vary."""
        return self.lift(self.inner.enclose(value, error))

    def general(self, number: Poly[N]) -> Poly[N]:
        """The polynomial with all coefficients up to the system's degree, in general form."""
        return Poly(self, tuple(self.inner.general(number.coefficient(i)) for i in range(self.degree + 1)))

    def components(self, number: Poly[N]) -> list[Scalar]:
        """Those of each coefficient, constant first."""
        parts = (number.coefficient(i) for i in range(self.degree + 1))
        return [scalar for part in parts for scalar in self.inner.components(part)]

    def rebuild(self, components: list[Scalar]) -> Poly[N]:
        """The polynomial of these components."""
        size = len(components) // (self.degree + 1)
        parts = (components[i : i + size] for i in range(0, len(components), size))
        return Poly(self, tuple(self.inner.rebuild(part) for part in parts))
