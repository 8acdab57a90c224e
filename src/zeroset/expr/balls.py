"""Interval arithmetic on decimals: sums, products, comparisons, and choices between constants.

Python's decimals round sums, products and quotients in a stated direction, so each bound is rounded outward as it
is computed. `decimals.py` adds the elementary functions.
"""

from __future__ import annotations

import decimal
from decimal import Decimal
from fractions import Fraction
from typing import NamedTuple

from zeroset.errors import FormulaError, FormulaLimitError
from zeroset.expr.series import SLACK, pi

__all__ = ["Ball", "Balls"]

_ZERO, _ONE = Decimal(0), Decimal(1)


class Ball(NamedTuple):
    """The real numbers from lo to hi."""

    lo: Decimal
    hi: Decimal


class Balls:
    """Arithmetic on balls at a number of digits, rounded outward; one method an operator."""

    def __init__(self, digits: int) -> None:
        self.digits = digits
        self.down, self.up = (
            decimal.Context(digits, mode, Emin=-99999, Emax=99999, traps=[])
            for mode in (decimal.ROUND_FLOOR, decimal.ROUND_CEILING)
        )

    def const(self, value: Fraction | int | str) -> Ball:
        """The constant leaf of a value."""
        if isinstance(value, str):
            return self.fixed(pi(self.digits))
        value = Fraction(value)
        top, bottom = Decimal(value.numerator), Decimal(value.denominator)
        return self.checked(Ball(self.down.divide(top, bottom), self.up.divide(top, bottom)))

    def add(self, a: Ball, b: Ball) -> Ball:
        """a + b."""
        return self.checked(Ball(self.down.add(a.lo, b.lo), self.up.add(a.hi, b.hi)))

    def sub(self, a: Ball, b: Ball) -> Ball:
        """a - b."""
        return self.add(a, self.neg(b))

    def neg(self, a: Ball) -> Ball:
        """-a."""
        return Ball(a.hi.copy_negate(), a.lo.copy_negate())

    def mul(self, a: Ball, b: Ball) -> Ball:
        """a * b."""
        pairs = [(x, y) for x in a for y in b]
        low = min(self.down.multiply(x, y) for x, y in pairs)
        return self.checked(Ball(low, max(self.up.multiply(x, y) for x, y in pairs)))

    def div(self, a: Ball, b: Ball) -> Ball:
        """a / b."""
        if b.lo <= 0 <= b.hi:
            raise FormulaError("a constant is divided by zero", hints=("nothing can be divided by zero",))
        pairs = [(x, y) for x in a for y in b]
        low = min(self.down.divide(x, y) for x, y in pairs)
        return self.checked(Ball(low, max(self.up.divide(x, y) for x, y in pairs)))

    def sqr(self, a: Ball) -> Ball:
        """a squared."""
        a = self.abs(a)
        return self.mul(a, a)

    def powi(self, a: Ball, n: int) -> Ball:
        """a to a whole power n >= 2."""
        if n % 2 == 0:
            a = self.abs(a)
        elif a.lo < 0:
            return self.neg(self.powi(self.neg(a), n)) if a.hi <= 0 else self._through_zero(a, n)
        result, base = Ball(_ONE, _ONE), a
        while n:
            if n % 2:
                result = self.mul(result, base)
            base = self.mul(base, base) if n > 1 else base
            n //= 2
        return result

    def _through_zero(self, a: Ball, n: int) -> Ball:
        below = self.powi(Ball(_ZERO, -a.lo), n)
        return Ball(-below.hi, self.powi(Ball(_ZERO, a.hi), n).hi)

    def abs(self, a: Ball) -> Ball:
        """The magnitude."""
        if a.lo >= 0:
            return a
        return self.neg(a) if a.hi <= 0 else Ball(_ZERO, max(-a.lo, a.hi))

    def sign(self, a: Ball) -> Ball:
        """-1, 0 or 1."""
        return Ball(*(Decimal((x > 0) - (x < 0)) for x in a))

    def floor(self, a: Ball) -> Ball:
        """Rounded down."""
        return Ball(*(x.to_integral_value(decimal.ROUND_FLOOR) for x in a))

    def ceil(self, a: Ball) -> Ball:
        """Rounded up."""
        return Ball(*(x.to_integral_value(decimal.ROUND_CEILING) for x in a))

    def mod(self, a: Ball, b: Ball) -> Ball:
        """a - b*floor(a/b)."""
        return self.sub(a, self.mul(b, self.floor(self.div(a, b))))

    def min(self, a: Ball, b: Ball) -> Ball:
        """The smaller."""
        return Ball(min(a.lo, b.lo), min(a.hi, b.hi))

    def max(self, a: Ball, b: Ball) -> Ball:
        """The larger."""
        return Ball(max(a.lo, b.lo), max(a.hi, b.hi))

    def lt(self, a: Ball, b: Ball) -> bool | None:
        """Whether a < b; None where the bounds leave it open."""
        return True if a.hi < b.lo else False if a.lo >= b.hi else None

    def le(self, a: Ball, b: Ball) -> bool | None:
        """Whether a <= b; None where the bounds leave it open."""
        return True if a.hi <= b.lo else False if a.lo > b.hi else None

    def and_(self, a: bool | None, b: bool | None) -> bool | None:
        """Both."""
        return False if a is False or b is False else None if a is None or b is None else True

    def or_(self, a: bool | None, b: bool | None) -> bool | None:
        """Either."""
        return True if a or b else None if a is None or b is None else False

    def not_(self, a: bool | None) -> bool | None:
        """The contrary."""
        return None if a is None else not a

    def select(self, condition: bool | None, a: Ball, b: Ball) -> Ball:
        """a where the condition holds, else b; the hull of both where that is open."""
        if condition is None:
            return Ball(min(a.lo, b.lo), max(a.hi, b.hi))
        return a if condition else b

    def checked(self, ball: Ball) -> Ball:
        """The ball, unless it has left the range of the decimals."""
        if not (ball.lo.is_finite() and ball.hi.is_finite()):
            raise FormulaLimitError(
                "a constant in the formula is too large to compute",
                hints=("numbers go up to 1e308",),
            )
        return ball

    def fixed(self, value: int) -> Ball:
        """A fixed-point result of `series`, widened by its slack."""
        down, up = (context.create_decimal(value + slack) for context, slack in ((self.down, -SLACK), (self.up, SLACK)))
        return Ball(down.scaleb(-self.digits, self.down), up.scaleb(-self.digits, self.up))
