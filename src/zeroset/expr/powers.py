"""Rewriting of powers and roots.

A whole power stays one node, `sqr` or `powi` with its exponent n >= 3, because number systems bound even
powers tightly when they see them: x*x and (-x)^2 and |x|^2 are all `sqr(x)`, sqr(sqr(x)) is x^4. Negative
exponents become quotients. A rational exponent p/q in lowest terms is the real power of x >= 0 (`powr`;
`sqrt` for 1/2), any other exponent `pow`; where the base is a positive constant that is exp(y*log(c)).
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from zeroset.errors import FormulaError
from zeroset.expr.dag import Expr, constant, node, rational
from zeroset.expr.limits import POWER, check_power, small
from zeroset.expr.ops import rational_root
from zeroset.expr.rules import ONE, ZERO, build, folded, rule

if TYPE_CHECKING:
    from zeroset.expr.dag import Data

__all__ = ["power", "power_int", "power_rational"]


@rule("pow")
def _pow(args: tuple[Expr, ...], data: Data) -> Expr:
    return power(*args)


@rule("sqr")
def _sqr(args: tuple[Expr, ...], data: Data) -> Expr:
    return power_int(args[0], 2)


@rule("powi")
def _powi(args: tuple[Expr, ...], data: Data) -> Expr:
    return power_int(args[0], int(data[0]))


@rule("powr")
def _powr(args: tuple[Expr, ...], data: Data) -> Expr:
    return power_rational(args[0], Fraction(int(data[0]), int(data[1])))


@rule("sqrt")
def _sqrt(args: tuple[Expr, ...], data: Data) -> Expr:
    return power_rational(args[0], Fraction(1, 2))


def power(x: Expr, y: Expr) -> Expr:
    """x ** y for any exponent.

    Raises:
        FormulaError: A negative constant to a power that is not a whole number.
        FormulaLimitError: A whole exponent past the limit.
    """
    exponent = rational(y)
    if exponent is not None:
        return power_rational(x, exponent)
    if x.op == "exp":
        return build("exp", (build("mul", (x.args[0], y)),))
    base = rational(x)
    if base is not None and base < 0:
        raise FormulaError(
            f"the negative constant {base} cannot be raised to a power that varies",
            hints=("a power with a varying exponent is exp(y*log(x)) and needs x > 0",),
        )
    if x.is_constant and x.is_positive:
        return build("exp", (build("mul", (build("log", (x,)), y)),))
    return node("pow", (x, y))


def power_int(x: Expr, n: int) -> Expr:
    """x ** n for a whole exponent; x^0 is 1 wherever x is defined."""
    check_power(n)
    if n == 1:
        return x
    if n == 0:
        return ONE if x.is_total else build("add", (build("mul", (ZERO, x)), ONE))
    if n < 0:
        return build("div", (ONE, power_int(x, -n)))
    value = rational(x)
    if value is not None:
        return _constant_power(x, value, n)
    peeled = _peeled(x, n)
    return _whole(x, n) if peeled is None else peeled


def power_rational(x: Expr, r: Fraction) -> Expr:
    """x ** r for a rational exponent; not a whole number: the real power of x >= 0."""
    if r.denominator == 1:
        return power_int(x, r.numerator)
    if r < 0:
        return build("div", (ONE, power_rational(x, -r)))
    value = rational(x)
    if value is not None:
        folded("sqrt" if r == Fraction(1, 2) else "powr", (x,))
        root = rational_root(value, r.denominator) if r.denominator <= POWER else None
        if root is not None and r.numerator <= POWER:
            return power_int(constant(root), r.numerator)
    if x.op == "exp":
        return build("exp", (build("mul", (constant(r), x.args[0])),))
    if x.op in {"sqr", "powi"} and (even := _exponent(x)) % 2 == 0:
        return power_rational(build("abs", x.args), r * even)
    if x.op in {"sqrt", "powr"}:
        inner = Fraction(1, 2) if x.op == "sqrt" else Fraction(int(x.data[0]), int(x.data[1]))
        if (inner * r).denominator != 1:
            return power_rational(x.args[0], inner * r)
    if r == Fraction(1, 2):
        return node("sqrt", (x,))
    if max(r.numerator, r.denominator) > POWER:
        return node("pow", (x, constant(r)))
    return node("powr", (x,), (r.numerator, r.denominator))


def _constant_power(x: Expr, value: Fraction, n: int) -> Expr:
    """value ** n, kept as a node where the exact result would be too long."""
    bits = n * max(value.numerator.bit_length(), value.denominator.bit_length())
    if value in {-1, 0, 1} or (bits < 1 << 20 and small(value**n)):
        return constant(value**n)
    if value < 0:
        even = power_int(constant(-value), n)
        return even if n % 2 == 0 else build("neg", (even,))
    return _whole(x, n)


def _peeled(x: Expr, n: int) -> Expr | None:
    """x ** n for n >= 2 where x itself is a power, a sign, a magnitude or a reciprocal."""
    even = n % 2 == 0
    inner = x.args[0] if x.args else x
    match x.op:
        case "neg":
            power = power_int(inner, n)
            return power if even else build("neg", (power,))
        case "abs" if even:
            return power_int(inner, n)
        case "sqr" | "powi":
            return power_int(inner, _exponent(x) * n)
        case "sqrt" if even and inner.is_nonnegative:
            return power_int(inner, n // 2)
        case "cbrt" if n % 3 == 0:
            return power_int(inner, n // 3)
        case "exp":
            return build("exp", (build("mul", (constant(n), inner)),))
        case "div" if inner is ONE:
            return build("div", (ONE, power_int(x.args[1], n)))
        case "mul" if (factor := rational(inner)) is not None and factor < 0:
            power = power_int(build("neg", (x,)), n)
            return power if even else build("neg", (power,))
    return None


def _whole(x: Expr, n: int) -> Expr:
    return node("sqr", (x,)) if n == 2 else node("powi", (x,), (n,))


def _exponent(x: Expr) -> int:
    """The exponent of a `sqr` or `powi` node."""
    return 2 if x.op == "sqr" else int(x.data[0])
