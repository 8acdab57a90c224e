"""How large the terms of a polynomial are, all signs taken as plus, and how far rounding has moved them.

Evaluating a formula on these beside real coefficients (``PolySystem`` over ``RealSystem``) bounds what was rounded in
them all at once, for a fraction of what carrying an error with each coefficient costs. For a polynomial with true
coefficients c_k, computed as C_k, there are numbers M_k and E_k with

    |c_k|, |C_k| <= M_k,    |C_k - c_k| <= E_k,    sum M_k <= size,    sum E_k <= error.

Sums and products keep this, as the triangle inequality has it. Terms of second order, and the rounding of these numbers
themselves, are in the factor of ``bound``. Whatever is no polynomial, and whatever would need more than that to be
bounded, is refused.
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
"""Roundings up to which the margin covers what they do to one another and to the bounds, in either format."""


def _refuse(operation: str) -> NoReturn:
    raise NotPolynomialError(f"{operation} has no bound of its rounding here")


def _refused(name: str) -> Callable[..., Any]:
    return lambda *numbers: _refuse(name)


class Majorant(Number):
    """See the module's text.

    Attributes:
        size: a scalar.
        error: a scalar.
        degree: of the polynomial, at most.
        depth: roundings that coefficients, size and error have gone through, known while tracing.
    """

    __slots__ = ("_system", "degree", "depth", "error", "size")

    def __init__(self, system: MajorantSystem, size: Scalar, error: Scalar, degree: int, depth: int) -> None:
        if depth > _MOST:
            _refuse("a formula as long as this")
        self._system = system
        self.size = size
        self.error = error
        self.degree = degree
        self.depth = depth

    @property
    def system(self) -> MajorantSystem:
        """The system that made this number."""
        return self._system

    def bound(self, more: int = 0) -> Scalar:
        """Bound of the sum of all coefficients' errors, those of ``more`` further roundings of each included."""
        fmt = self._system.fmt
        return mul(fma(self.size, more * fmt.eps, self.error), fmt.up(MARGIN))

    def add(self, other: Majorant, /) -> Majorant:
        """One rounding."""
        size = add(self.size, other.size)
        error = fma(size, self._system.fmt.eps, add(self.error, other.error))
        depth = max(self.depth, other.depth) + 3
        return Majorant(self._system, size, error, max(self.degree, other.degree), depth)

    def neg(self) -> Majorant:
        """The same."""
        return self

    def mul(self, other: Majorant, /) -> Majorant:
        """One rounding for a product, and one for each term that is added to it."""
        return self._product(other, fma(self.size, other.error, mul(other.size, self.error)))

    def sqr(self) -> Majorant:
        """As a product; doubling is exact."""
        return self._product(self, mul(mul(self.size, 2.0), self.error))

    def _product(self, other: Majorant, moved: Scalar) -> Majorant:
        terms = min(self.degree, other.degree) + 1
        # What underflows in the products is less than a rounding of the summand.
        size = fma(self.size, other.size, self._system.lost)
        error = fma(size, terms * self._system.fmt.eps, moved)
        depth = self.depth + other.depth + terms + 4
        return Majorant(self._system, size, error, self.degree + other.degree, depth)

    def div(self, other: Majorant, /) -> Majorant:
        """By a number that is known while tracing."""
        known = is_literal(other.size, other.error) and is_zero(other.error) and other.size > self._system.lost
        if other.degree or not known:
            _refuse("a quotient")
        inverse = self._system.fmt.up(1.0 / other.size)
        size = add(mul(self.size, inverse), self._system.lost)
        error = fma(size, self._system.fmt.eps, mul(self.error, inverse))
        return Majorant(self._system, size, error, self.degree, self.depth + 4)

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
        lost: a size of which one rounding is more than what underflows in a product of polynomials; none is smaller.
    """

    def __init__(self, fmt: Format) -> None:
        self._fmt = fmt
        self.lost = fmt.quantum * 64.0 / fmt.eps

    @property
    def fmt(self) -> Format:
        """The floating-point format of the scalars."""
        return self._fmt

    def linear(self, size: Scalar, error: Scalar = 0.0) -> Majorant:
        """A coordinate along a ray: the sum of its two coefficients' magnitudes, and of their errors."""
        return Majorant(self, add(size, self.lost), add(error, self.lost * self._fmt.eps), 1, 8)

    def constant(self, lo: float, hi: float) -> Majorant:
        """A constant, which a real number holds rounded."""
        largest = max(abs(lo), abs(hi))
        size = max(self._fmt.up(largest), self.lost)
        if lo == hi and self._fmt.exact(lo):
            return Majorant(self, size, 0.0, 0, 0)
        if size >= self._fmt.big:
            _refuse("a constant as large as this")
        return Majorant(self, size, self._fmt.up(hi - lo + largest * self._fmt.eps + self._fmt.quantum), 0, 2)

    def enclose(self, value: Scalar, error: Scalar) -> Majorant:
        """A parameter, within its error."""
        return Majorant(self, add(add(absolute(value), error), self.lost), error, 0, 2)

    def general(self, number: Majorant) -> Majorant:
        """Sums over arrays round as often as there are elements, which nobody knows here."""
        _refuse("a sum over an array")

    def components(self, number: Majorant) -> list[Scalar]:
        """There is no flat form."""
        _refuse("a sum over an array")

    def rebuild(self, components: list[Scalar]) -> Majorant:
        """There is no flat form."""
        _refuse("a sum over an array")
