"""Rewriting of products and quotients.

Signs and rational factors move to the front; equal factors become one power, so that a variable occurs once
(`x*y*x` is `x^2*y`) and even powers stay visible; x/y/z becomes x/(y*z). Powers never cancel against a quotient:
x^2/x is not x, for it is undefined at zero. A factor 0 swallows only what is defined everywhere.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.errors import FormulaError
from zeroset.expr.dag import Expr, constant, node, rational
from zeroset.expr.limits import small
from zeroset.expr.powers import power_int
from zeroset.expr.rules import ONE, ZERO, folded, rule
from zeroset.expr.sums import neg, scaled

if TYPE_CHECKING:
    from fractions import Fraction

    from zeroset.expr.dag import Data

__all__ = ["div", "mul"]

_FACTORS = 32
"""Products of more factors than this are not searched for equal ones, to keep building linear."""


@rule("mul")
def _mul(args: tuple[Expr, ...], data: Data) -> Expr:
    return mul(*args)


@rule("div")
def _div(args: tuple[Expr, ...], data: Data) -> Expr:
    return div(*args)


def mul(a: Expr, b: Expr) -> Expr:
    """a * b."""
    value = folded("mul", (a, b))
    if value is not None:
        return value
    if a.op == "neg":
        return neg(mul(a.args[0], b))
    if b.op == "neg":
        return neg(mul(a, b.args[0]))
    if b.is_constant and (not a.is_constant or rational(b) is not None):
        a, b = b, a
    factor = rational(a)
    if factor is not None:
        return _scale(factor, b)
    if a.is_constant and not b.is_constant:
        return _constant_times(a, b)
    for one, other in ((a, b), (b, a)):
        if one.op == "mul" and one.args[0].is_constant and not (a.is_constant and rational(one.args[0]) is None):
            return mul(one.args[0], mul(one.args[1], other) if one is a else mul(other, one.args[1]))
    quotient = _with_reciprocal(a, b)
    return _product(a, b) if quotient is None else quotient


def div(a: Expr, b: Expr) -> Expr:
    """a / b.

    Raises:
        FormulaError: b is the constant zero.
    """
    if a.op == "neg":
        return neg(div(a.args[0], b))
    if b.op == "neg":
        return neg(div(a, b.args[0]))
    divisor = rational(b)
    if divisor is not None:
        if divisor == 0:
            raise FormulaError("division by zero", hints=("nothing can be divided by zero",))
        return mul(constant(1 / divisor), a)
    if a.op == "div":
        return div(a.args[0], mul(a.args[1], b))
    value = rational(a)
    if value == 0:
        return ZERO if b.is_total and b.is_positive else _scale(value, div(ONE, b))
    if a is b and b.is_total and b.is_positive:
        return ONE
    if a.op == "mul" and a.args[0].is_constant and not a.is_constant:
        return mul(a.args[0], div(a.args[1], b))
    (over, top), (under, bottom) = scaled(a), scaled(b)
    if value is not None:
        over, top = value, ONE
    factor = over / under if under else None
    if factor is None or not small(factor):
        return node("div", (a, b))
    if top is ONE:
        return _signed_quotient(factor, bottom)
    quotient = node("div", (top, bottom)) if under != 1 or over != 1 else node("div", (a, b))
    return _scale(factor, quotient)


def _constant_times(a: Expr, b: Expr) -> Expr:
    """a * b for an irrational constant a: the sign goes out, constant factors of b join it."""
    if scaled(a)[0] < 0:
        return neg(mul(neg(a), b))
    if b.op == "mul" and b.args[0].is_constant:
        return mul(mul(a, b.args[0]), b.args[1])
    if b.op == "div" and b.args[0].is_constant:
        return div(mul(a, b.args[0]), b.args[1])
    return node("mul", (a, b))


def _signed_quotient(factor: Fraction, bottom: Expr) -> Expr:
    """factor / bottom."""
    return node("div", (constant(factor), bottom))


def _scale(factor: Fraction, b: Expr) -> Expr:
    """factor * b."""
    if factor == 1:
        return b
    if factor == 0 and b.is_total:
        return ZERO
    if factor == -1:
        return neg(b)
    if b.op == "neg":
        return _scale(-factor, b.args[0])
    value = rational(b)
    inner, term = scaled(b)
    if value is not None and small(factor * value):
        return constant(factor * value)
    if term is not b and small(factor * inner):
        return _scale(factor * inner, term)
    if b.op == "mul" and b.args[0].is_constant and not b.is_constant:
        return mul(_scale(factor, b.args[0]), b.args[1])
    top = rational(b.args[0]) if b.op == "div" else None
    if top is not None and factor != 0 and small(factor * top):
        return _signed_quotient(factor * top, b.args[1])
    return node("mul", (constant(factor), b))


def _with_reciprocal(a: Expr, b: Expr) -> Expr | None:
    """a * (c/q) as c * (a/q), where one factor is such a quotient."""
    for one, other in ((b, a), (a, b)):
        if one.op == "div":
            top = rational(one.args[0])
            if top is not None:
                return mul(constant(top), div(other, one.args[1]))
    return None


def _product(a: Expr, b: Expr) -> Expr:
    """a * b with equal factors joined into powers."""
    if a is b:
        return power_int(a, 2)
    ours, theirs = _factors(a), _factors(b)
    joined = dict(ours)
    for base, exponent in theirs.items():
        joined[base] = joined.get(base, 0) + exponent
    if len(joined) == len(ours) + len(theirs):
        return node("mul", (a, b))
    product: Expr | None = None
    for base, exponent in joined.items():
        factor = power_int(base, exponent)
        product = factor if product is None else mul(product, factor)
    return ONE if product is None else product


def _factors(expr: Expr) -> dict[Expr, int]:
    """The factors of a product with their exponents, in order; the product itself if there are too many."""
    factors: dict[Expr, int] = {}
    stack = [expr]
    while stack:
        part = stack.pop()
        if part.op == "mul":
            stack.extend(reversed(part.args))
            if len(stack) + len(factors) > _FACTORS:
                return {expr: 1}
            continue
        base, exponent = part, 1
        if part.op == "sqr":
            base, exponent = part.args[0], 2
        elif part.op == "powi":
            base, exponent = part.args[0], int(part.data[0])
        factors[base] = factors.get(base, 0) + exponent
    return factors
