"""How large the terms of a polynomial are, all signs taken as plus, and how often computing one may have rounded.

Evaluating a formula on these beside real coefficients (``PolySystem`` over ``RealSystem``) bounds what was rounded in
them all at once, for a fraction of what carrying an error with each coefficient costs. For a polynomial with true
coefficients c_k, computed as C_k, there are numbers M_k >= |c_k| with

    |C_k - c_k| <= roundings * eps * M_k,    sum M_k <= size.

Products and sums of polynomials keep this, with ``size`` multiplied and added; terms of second order, and the rounding
of ``size`` itself, are in the factor of ``error``. Whatever is no polynomial, and whatever would need more than that to
be bounded, is refused.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NoReturn

from zeroset.arith.format import Format
from zeroset.arith.number import Number, System
from zeroset.arith.poly import NotPolynomialError
from zeroset.arith.scalar import Scalar, absolute, add, fma, is_literal, is_zero, mul

__all__ = ["Majorant", "MajorantSystem"]

MARGIN = 1.02
_MOST = 10_000
"""Roundings up to which the margin covers what they do to one another, in either format."""


def _refuse(operation: str) -> NoReturn:
    raise NotPolynomialError(f"{operation} has no bound of its rounding here")


def _refused(name: str) -> Callable[..., Any]:
    return lambda *numbers: _refuse(name)


class Majorant(Number):
    """See the module's text.

    Attributes:
        size: a scalar.
        degree: of the polynomial, at most.
        roundings: known while tracing.
    """

    __slots__ = ("_system", "degree", "roundings", "size")

    def __init__(self, system: MajorantSystem, size: Scalar, degree: int, roundings: int) -> None:
        if roundings > _MOST:
            _refuse("a formula as long as this")
        self._system = system
        self.size = size
        self.degree = degree
        self.roundings = roundings

    @property
    def system(self) -> MajorantSystem:
        """The system that made this number."""
        return self._system

    def error(self, more: int = 0) -> Scalar:
        """Bound of the sum of all coefficients' errors, those of ``more`` further roundings of each included."""
        fmt = self._system.fmt
        return mul(self.size, fmt.up((self.roundings + more) * MARGIN * fmt.eps))

    def add(self, other: Majorant, /) -> Majorant:
        """One rounding."""
        degree, roundings = max(self.degree, other.degree), max(self.roundings, other.roundings)
        return Majorant(self._system, add(self.size, other.size), degree, roundings + 1)

    def neg(self) -> Majorant:
        """The same."""
        return self

    def mul(self, other: Majorant, /) -> Majorant:
        """One rounding for a product, and one for each term that is added to it."""
        terms = min(self.degree, other.degree) + 1
        # What underflows in the products is less than the summand.
        size = fma(self.size, other.size, self._system.lost)
        return Majorant(self._system, size, self.degree + other.degree, self.roundings + other.roundings + terms)

    def sqr(self) -> Majorant:
        """As a product; doubling is exact."""
        return self.mul(self)

    def div(self, other: Majorant, /) -> Majorant:
        """By a number that is known while tracing."""
        if other.degree or not is_literal(other.size) or is_zero(other.size) or other.roundings:
            _refuse("a quotient")
        inverse = self._system.fmt.up(1.0 / other.size)
        return Majorant(self._system, mul(self.size, inverse), self.degree, self.roundings + 1)

    def powi(self, n: int, /) -> Majorant:
        """By repeated squares, as polynomials do it."""
        if n < 0:
            _refuse("a negative power")
        return super().powi(n)

    pow = _refused("a power")
    powr = _refused("a broken power")
    cbrt = _refused("a root")
    sqrt = _refused("a root")
    exp = _refused("exp")
    log = _refused("log")
    sin = _refused("sin")
    cos = _refused("cos")
    tan = _refused("tan")
    asin = _refused("asin")
    acos = _refused("acos")
    atan = _refused("atan")
    atan2 = _refused("atan2")
    sinh = _refused("sinh")
    cosh = _refused("cosh")
    tanh = _refused("tanh")
    abs = _refused("abs")
    sign = _refused("sign")
    floor = _refused("floor")
    max = _refused("max")
    lt = _refused("a comparison")
    le = _refused("a comparison")


class MajorantSystem(System[Majorant]):
    """Makes them.

    Args:
        fmt: format of the scalars.

    Attributes:
        lost: a size of which one rounding is more than what underflows in a product of polynomials.
    """

    def __init__(self, fmt: Format) -> None:
        self._fmt = fmt
        self.lost = fmt.quantum * 64.0 / fmt.eps

    @property
    def fmt(self) -> Format:
        """The floating-point format of the scalars."""
        return self._fmt

    def linear(self, size: Scalar, roundings: int) -> Majorant:
        """A coordinate along a ray, whose two coefficients are together no larger than ``size``."""
        return Majorant(self, add(size, self.lost), 1, roundings)

    def constant(self, lo: float, hi: float) -> Majorant:
        """A constant, which a real number holds rounded once."""
        largest = max(abs(lo), abs(hi))
        size = self._fmt.up(largest)
        exact = lo == hi and self._fmt.exact(lo)
        if not exact and (hi - lo > largest * self._fmt.eps or size >= self._fmt.big):
            _refuse("a constant that is hardly known")
        # The middle of the bounds is rounded once more than their own distance from it.
        return Majorant(self, size if exact else max(size, self._fmt.quantum / self._fmt.eps), 0, 0 if exact else 2)

    def enclose(self, value: Scalar, error: Scalar) -> Majorant:
        """A parameter: what is not known of it counts as one rounding."""
        if is_zero(error):
            return Majorant(self, absolute(value), 0, 0)
        return Majorant(self, fma(error, 1.01 / self._fmt.eps, absolute(value)), 0, 1)

    def general(self, number: Majorant) -> Majorant:
        """Sums over arrays round as often as there are elements, which nobody knows here."""
        _refuse("a sum over an array")

    def components(self, number: Majorant) -> list[Scalar]:
        """There is no flat form."""
        _refuse("a sum over an array")

    def rebuild(self, components: list[Scalar]) -> Majorant:
        """There is no flat form."""
        _refuse("a sum over an array")
