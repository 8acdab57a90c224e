"""Rewriting of sums, differences, and signs.

Signs move outward, constants together, equal terms become one with a factor; otherwise a sum stays in the
order in which it was written, which matters to nobody but the reader.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from zeroset.expr.dag import Expr, constant, node, rational
from zeroset.expr.limits import small
from zeroset.expr.rules import ZERO, build, folded, rule

if TYPE_CHECKING:
    from zeroset.expr.dag import Data

__all__ = ["add", "neg", "scaled", "sub"]


@rule("add")
def _add(args: tuple[Expr, ...], data: Data) -> Expr:
    return add(*args)


@rule("sub")
def _sub(args: tuple[Expr, ...], data: Data) -> Expr:
    return sub(*args)


@rule("neg")
def _neg(args: tuple[Expr, ...], data: Data) -> Expr:
    return neg(*args)


def add(a: Expr, b: Expr) -> Expr:
    """a + b."""
    if a is ZERO or b is ZERO:
        return b if a is ZERO else a
    if b.op == "neg":
        return sub(a, b.args[0])
    if a.op == "neg":
        return sub(b, a.args[0])
    joined = _collected(a, b)
    return _with_positive_factor("add", a, b) if joined is None else joined


def sub(a: Expr, b: Expr) -> Expr:
    """a - b."""
    if b is ZERO:
        return a
    if a is ZERO:
        return neg(b)
    if b.op == "neg":
        return add(a, b.args[0])
    if a.op == "neg":
        return neg(add(a.args[0], b))
    value = rational(b)
    if value is not None:
        shifted = _shifted(a, -value) if rational(a) is None else folded("sub", (a, b))
        return _with_positive_factor("sub", a, b) if shifted is None else shifted
    like = _like_terms(a, b, -1)
    return _with_positive_factor("sub", a, b) if like is None else like


def neg(a: Expr) -> Expr:
    """-a."""
    value = rational(a)
    if value is not None:
        return constant(-value)
    if a.op == "neg":
        return a.args[0]
    if a.op == "sub":
        return sub(a.args[1], a.args[0])
    if a.op == "mul" and rational(a.args[0]) is not None:
        return build("mul", (neg(a.args[0]), a.args[1]))
    if a.op == "div" and rational(a.args[0]) is not None:
        return build("div", (neg(a.args[0]), a.args[1]))
    return node("neg", (a,))


def scaled(a: Expr) -> tuple[Fraction, Expr]:
    """A node as (c, y) with a = c*y, c rational and y without a constant factor."""
    if a.op == "mul":
        value = rational(a.args[0])
        if value is not None:
            return value, a.args[1]
    return Fraction(1), a


def _collected(a: Expr, b: Expr) -> Expr | None:
    """a + b with constants brought together or equal terms joined, where there are any."""
    low, high = rational(a), rational(b)
    if low is not None and high is not None:
        return folded("add", (a, b))
    if high is not None:
        return _shifted(a, high)
    if low is not None:
        return _shifted(b, low)
    return _like_terms(a, b, 1)


def _like_terms(a: Expr, b: Expr, sign: int) -> Expr | None:
    """a + sign*b if both are multiples of one term."""
    (factor, term), (other_factor, other_term) = scaled(a), scaled(b)
    if term is not other_term:
        return None
    total = factor + sign * other_factor
    return build("mul", (constant(total), term)) if small(total) else None


def _shifted(a: Expr, shift: Fraction) -> Expr | None:
    """a + shift where a already is a sum or difference with a constant in it."""
    if a.op not in {"add", "sub"}:
        return None
    first, last = a.args
    low, high = rational(first), rational(last)
    if high is not None:
        total = high + shift if a.op == "add" else shift - high
        return add(first, constant(total)) if small(total) else None
    if low is None or not small(low + shift):
        return None
    return build(a.op, (constant(low + shift), last))


def _with_positive_factor(op: str, a: Expr, b: Expr) -> Expr:
    """a + b or a - b, the sign of b's constant factor taken into the operator."""
    value = rational(b) if b.op == "const" else scaled(b)[0] if b.op == "mul" else None
    if b.op == "div":
        value = rational(b.args[0])
    if value is not None and value < 0:
        return sub(a, neg(b)) if op == "add" else add(a, neg(b))
    return node(op, (a, b))
