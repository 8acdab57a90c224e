"""Formulas as polynomials in x, y, z: degree, and exact coefficients.

w and the parameters belong to the coefficients, so a moved parameter changes numbers, not the shape. The degree
is read off the DAG without expanding and is an upper bound (terms may cancel); the expansion is exact, on demand, and
bounded in work, for a product of many sums can have more terms than anyone can use.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from zeroset.errors import FormulaLimitError
from zeroset.expr import limits
from zeroset.expr.build import ONE, ZERO, build
from zeroset.expr.dag import Expr, constant, postorder, rational

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

__all__ = ["Exponents", "PolynomialView", "degree", "polynomial"]

Exponents = tuple[int, int, int]
_Terms = dict[Exponents, Expr]

_SPACE = ("x", "y", "z")
_LARGE = 10**9


class PolynomialView(NamedTuple):
    """A polynomial in x, y, z.

    Attributes:
        coefficients: By exponents (i, j, k) of x^i y^j z^k: nodes without x, y, z, none of them the constant 0.
    """

    coefficients: Mapping[Exponents, Expr]

    @property
    def degree(self) -> int:
        """The total degree; 0 for the zero polynomial."""
        return max((sum(exponents) for exponents in self.coefficients), default=0)

    @property
    def degrees(self) -> Exponents:
        """The degrees in x, in y, and in z."""
        columns = list(zip(*self.coefficients, strict=True)) or [(0,)] * 3
        return max(columns[0]), max(columns[1]), max(columns[2])

    def coefficient(self, i: int, j: int, k: int) -> Expr:
        """The coefficient of x^i y^j z^k."""
        return self.coefficients.get((i, j, k), ZERO)


def degree(expr: Expr) -> int | None:
    """An upper bound on the total degree in x, y, z; None where f is no polynomial in them.

    Takes time linear in the size of the DAG.

    Example:
        >>> from zeroset.expr import parse
        >>> degree(parse("(x^2 + y*z)^3 - sin(w)"))
        6
    """
    known: dict[Expr, int | None] = {}
    for part in postorder(expr, lambda item: item.args if _in_space(item) else ()):
        known[part] = _degree(part, [known.get(arg) for arg in part.args]) if _in_space(part) else 0
    found = known[expr]
    return None if found is None or found >= _LARGE else found


def polynomial(expr: Expr) -> PolynomialView | None:
    """The exact coefficients; None where f is no polynomial or its expansion passes the limit of work.

    Example:
        >>> from zeroset.expr import parse
        >>> view = polynomial(parse("(x + a)^2", params=["a"]))
        >>> {exponents: str(node) for exponents, node in view.coefficients.items()}
        {(2, 0, 0): '1', (1, 0, 0): '2*a', (0, 0, 0): 'a^2'}
    """
    if degree(expr) is None:
        return None
    expansion = _Expansion()
    terms: dict[Expr, _Terms] = {}
    for part in postorder(expr, lambda item: item.args if _in_space(item) else ()):
        try:
            expanded = expansion.of(part, terms)
        except FormulaLimitError:
            return None
        if expanded is None:
            return None
        terms[part] = expanded
    return PolynomialView(terms[expr])


def _in_space(expr: Expr) -> bool:
    """Whether a node depends on x, y, or z."""
    return any(("variable", name) in expr.symbols for name in _SPACE)


def _degree(part: Expr, args: list[int | None]) -> int | None:
    """The degree of a node that depends on x, y, z, from those of its arguments."""
    if part.op == "variable":
        return 1
    degrees = [value for value in args if value is not None]
    if len(degrees) < len(args):
        return None
    match part.op:
        case "add" | "sub":
            return max(degrees)
        case "mul":
            return min(_LARGE, sum(degrees))
        case "neg" | "sum":
            return degrees[0]
        case "sqr":
            return min(_LARGE, 2 * degrees[0])
        case "powi":
            return min(_LARGE, int(part.data[0]) * degrees[0])
        case "div" if not _in_space(part.args[1]):
            return degrees[0]
    return None


class _Expansion:
    """The expansion of one formula, and the work it may still cost."""

    def __init__(self) -> None:
        self.work = limits.POLYNOMIAL_WORK

    def of(self, part: Expr, terms: Mapping[Expr, _Terms]) -> _Terms | None:
        """The terms of a node from those of its arguments; None past the limit."""
        if not _in_space(part):
            return _cleaned({(0, 0, 0): part})
        if part.op == "variable":
            i, j, k = (int(part.data[0] == name) for name in _SPACE)
            return {(i, j, k): ONE}
        first = terms[part.args[0]]
        match part.op:
            case "add" | "sub":
                return self._sum(part.op, first, terms[part.args[1]])
            case "mul":
                return self._product(first, terms[part.args[1]])
            case "sqr":
                return self._product(first, first)
            case "powi":
                return self._power(first, int(part.data[0]))
            case "neg":
                return self._each(first, lambda term: build("neg", (term,)))
            case "div":
                return self._each(first, lambda term: build("div", (term, part.args[1])))
        return self._each(first, lambda term: build("sum", (term,), part.data))

    def _each(self, terms: _Terms, function: Callable[[Expr], Expr]) -> _Terms | None:
        self.work -= len(terms)
        return _cleaned({exponents: function(term) for exponents, term in terms.items()}) if self.work >= 0 else None

    def _sum(self, op: str, left: _Terms, right: _Terms) -> _Terms | None:
        self.work -= len(left) + len(right)
        if self.work < 0:
            return None
        result = dict(left)
        for exponents, term in right.items():
            result[exponents] = build(op, (result.get(exponents, ZERO), term))
        return _cleaned(result)

    def _product(self, left: _Terms, right: _Terms) -> _Terms | None:
        """Exact products; rationals are gathered apart, for they are most of the work."""
        self.work -= len(left) * len(right)
        if self.work < 0:
            return None
        exact: dict[Exponents, Fraction] = {}
        symbolic: _Terms = {}
        numbers = [(exponents, term, rational(term)) for exponents, term in right.items()]
        for (i, j, k), term in left.items():
            value = rational(term)
            for (u, v, w), other, other_value in numbers:
                at = (i + u, j + v, k + w)
                if value is not None and other_value is not None:
                    exact[at] = exact.get(at, Fraction(0)) + value * other_value
                else:
                    symbolic[at] = build("add", (symbolic.get(at, ZERO), build("mul", (term, other))))
        if any(not limits.small(value) for value in exact.values()):
            return None
        result = {at: constant(value) for at, value in exact.items()}
        for at, term in symbolic.items():
            result[at] = build("add", (result.get(at, ZERO), term))
        return _cleaned(result)

    def _power(self, base: _Terms, exponent: int) -> _Terms | None:
        """Repeated squares."""
        result: _Terms | None = None
        square: _Terms | None = base
        while True:
            if exponent % 2:
                result = square if result is None or square is None else self._product(result, square)
                if result is None:
                    return None
            exponent //= 2
            if not exponent or square is None:
                return result
            square = self._product(square, square)
            if square is None:
                return None


def _cleaned(terms: _Terms) -> _Terms:
    """The terms without those that are zero."""
    return {exponents: term for exponents, term in terms.items() if term is not ZERO}
