"""Functions that a formula may call but that are combinations of operators: no number system knows them.

Also the constants by name. Each function here is one entry of `DERIVED`: its number of arguments and what it
stands for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from zeroset.errors import FormulaError, FormulaLimitError
from zeroset.expr.build import ONE, build
from zeroset.expr.dag import PI, Expr, constant, rational
from zeroset.expr.limits import CHEBYSHEV

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["CONSTANTS", "DERIVED", "PHI", "Derived", "E", "chebyshev"]


class Derived(NamedTuple):
    """A function that is a combination of operators.

    Attributes:
        arity: Number of its arguments.
        make: What it stands for.
    """

    arity: int
    make: Callable[..., Expr]


E = build("exp", (ONE,))
"""Euler's number, exp(1)."""

PHI = (1 + build("sqrt", (constant(5),))) / 2
"""The golden ratio, (1 + sqrt(5))/2."""

CONSTANTS: dict[str, Expr] = {"pi": PI, "e": E, "phi": PHI}
"""The constants that a formula knows by name; a parameter of that name wins over them."""


def _call(op: str, *args: Expr) -> Expr:
    return build(op, args)


def _atanh(x: Expr) -> Expr:
    return _call("log", (1 + x) / (1 - x)) / 2


def chebyshev(order: Expr, x: Expr) -> Expr:
    """The Chebyshev polynomial of the first kind T_n(x), in a form that encloses tightly.

    T_ab is T_a(T_b), the twos innermost: an even order starts from the tight square 2x^2 - 1, and a
    composition overestimates no more than its parts. A prime p >= 7 is split as 2 T_k T_(k+1) - x with
    k = (p-1)/2, whose values stay of the size of T itself, where the monomial form would cancel 2^(p-1)-fold.
    T_3 and T_5 are x(4x^2 - 3) and x((4x^2 - 5/2)^2 - 5/4).

    Args:
        order: A constant whole number n, 0 <= n <= 512.
        x: The argument.

    Raises:
        FormulaError: The order is no whole number >= 0.
        FormulaLimitError: The order is past the limit.
    """
    n = rational(order)
    if n is None or n.denominator != 1 or n < 0:
        raise FormulaError(
            "the order of the Chebyshev polynomial T(n, x) must be a whole number, 0 or more",
            hints=("the order comes first: T(4, x)",),
        )
    if n > CHEBYSHEV:
        raise FormulaLimitError(
            f"the order of T(n, x) is too large: it goes up to {CHEBYSHEV}",
            hint="T(a b, x) is T(a, T(b, x))",
        )
    return _chebyshev(int(n), x, {})


def _chebyshev(n: int, x: Expr, known: dict[tuple[int, Expr], Expr]) -> Expr:
    """T_n(x); the recursion halves n at least, so it is at most ten deep. `known` are those already made."""
    if (n, x) not in known:
        known[n, x] = _new_chebyshev(n, x, known)
    return known[n, x]


def _new_chebyshev(n: int, x: Expr, known: dict[tuple[int, Expr], Expr]) -> Expr:
    """T_n(x) from lower orders."""
    match n:
        case 0:
            return x**0
        case 1:
            return x
        case 2:
            return 2 * x**2 - 1
        case 3:
            return x * (4 * x**2 - 3)
        case 5:
            return x * ((4 * x**2 - constant(5) / 2) ** 2 - constant(5) / 4)
    factor = next((d for d in range(2, n) if n % d == 0), None)
    if factor is not None:
        return _chebyshev(n // factor, _chebyshev(factor, x, known), known)
    return 2 * _chebyshev(n // 2, x, known) * _chebyshev(n // 2 + 1, x, known) - x


def _asinh(x: Expr) -> Expr:
    """log(x + sqrt(x^2 + 1)) of what x is above 0, less the same of what it is below: there the sum would cancel."""
    above, below = (build("max", (side, constant(0))) for side in (x, -x))
    one, other = (_call("log", side + _call("sqrt", side**2 + 1)) for side in (above, below))
    return one - other


DERIVED: dict[str, Derived] = {
    "sec": Derived(1, lambda x: 1 / _call("cos", x)),
    "csc": Derived(1, lambda x: 1 / _call("sin", x)),
    "cot": Derived(1, lambda x: _call("cos", x) / _call("sin", x)),
    "hypot": Derived(2, lambda x, y: _call("sqrt", x**2 + y**2)),
    "log2": Derived(1, lambda x: _call("log", x) * (1 / _call("log", constant(2)))),
    "log10": Derived(1, lambda x: _call("log", x) * (1 / _call("log", constant(10)))),
    "exp2": Derived(1, lambda x: constant(2) ** x),
    "asinh": Derived(1, _asinh),
    "acosh": Derived(1, lambda x: _call("log", x + _call("sqrt", x**2 - 1))),
    "atanh": Derived(1, _atanh),
    "T": Derived(2, chebyshev),
}
"""The functions by name."""
