"""The elementary functions on balls of decimals.

Python's decimals round sqrt, exp and ln to nearest, so one unit outward holds the real value; sine, cosine and
arctangent come from `series.py`. `Decimals(digits)` has one method for each operator that a constant may contain.
"""

from __future__ import annotations

import decimal
from decimal import Decimal
from fractions import Fraction

from zeroset.errors import FormulaError
from zeroset.expr.balls import Ball, Balls
from zeroset.expr.series import arctangent, sine_cosine

__all__ = ["Decimals"]

_HUGE = Decimal("1e1000")
_WIDE = decimal.Context(3_000)
_ZERO, _ONE = Decimal(0), Decimal(1)


class Decimals(Balls):
    """Arithmetic and elementary functions on balls."""

    def pow(self, a: Ball, b: Ball) -> Ball:
        """The real power a ** b."""
        if a.lo > 0:
            return self.exp(self.mul(b, self.log(a)))
        if a.lo == a.hi == 0 and b.lo > 0:
            return a
        raise _undefined("a real power of a number that is not positive")

    def powr(self, a: Ball, p: int, q: int) -> Ball:
        """The real power a ** (p/q)."""
        if a.hi < 0:
            raise _undefined("a real power of a negative number")
        exponent = self.const(Fraction(p, q))
        low = self.pow(Ball(a.lo, a.lo), exponent).lo if a.lo > 0 else _ZERO
        high = self.pow(Ball(a.hi, a.hi), exponent).hi if a.hi > 0 else _ZERO
        return Ball(low, high)

    def cbrt(self, a: Ball) -> Ball:
        """The odd cube root."""
        low, high = (self.powr(self.abs(Ball(x, x)), 1, 3) for x in a)
        return Ball(-low.hi if a.lo < 0 else low.lo, -high.lo if a.hi < 0 else high.hi)

    def sqrt(self, a: Ball) -> Ball:
        """The square root of the part of a that is not negative."""
        if a.hi < 0:
            raise _undefined("the square root of a negative number")
        low = self.down.sqrt(max(a.lo, _ZERO))
        return Ball(max(_ZERO, low.next_minus(self.down)), self.up.sqrt(a.hi).next_plus(self.up))

    def exp(self, a: Ball) -> Ball:
        """e to the a."""
        low, high = self.down.exp(a.lo), self.up.exp(a.hi)
        return self.checked(Ball(max(_ZERO, low.next_minus(self.down)), high.next_plus(self.up)))

    def log(self, a: Ball) -> Ball:
        """The natural logarithm."""
        if a.lo <= 0:
            raise _undefined("the logarithm of a number that is not positive")
        return Ball(self.down.ln(a.lo).next_minus(self.down), self.up.ln(a.hi).next_plus(self.up))

    def sin(self, a: Ball) -> Ball:
        """The sine."""
        return self._wave(a, 0)

    def cos(self, a: Ball) -> Ball:
        """The cosine."""
        return self._wave(a, 1)

    def tan(self, a: Ball) -> Ball:
        """The tangent."""
        return self.div(self.sin(a), self.cos(a))

    def asin(self, a: Ball) -> Ball:
        """The arcsine."""
        if a.hi < -1 or a.lo > 1:
            raise _undefined("the arcsine or arccosine of a number outside [-1, 1]")
        return Ball(self._asin(max(a.lo, -_ONE)).lo, self._asin(min(a.hi, _ONE)).hi)

    def acos(self, a: Ball) -> Ball:
        """The arccosine."""
        return self.sub(self._half_pi(), self.asin(a))

    def atan(self, a: Ball) -> Ball:
        """The arctangent."""
        return Ball(self._atan(a.lo).lo, self._atan(a.hi).hi)

    def atan2(self, y: Ball, x: Ball) -> Ball:
        """The angle of the point (x, y)."""
        if x.lo > 0:
            return self.atan(self.div(y, x))
        if y.lo > 0:
            return self.sub(self._half_pi(), self.atan(self.div(x, y)))
        if y.hi < 0:
            return self.sub(self.neg(self._half_pi()), self.atan(self.div(x, y)))
        if x.hi < 0:
            half_turn = self.const("pi")
            if y.lo == y.hi == 0:
                return half_turn
            return self.neg(half_turn)._replace(hi=half_turn.hi)
        raise _undefined("the angle of a point at the origin")

    def sinh(self, a: Ball) -> Ball:
        """The hyperbolic sine."""
        return Ball(self._sinh(a.lo).lo, self._sinh(a.hi).hi)

    def cosh(self, a: Ball) -> Ball:
        """The hyperbolic cosine."""
        a = self.abs(a)
        return Ball(max(_ONE, self._cosh(a.lo).lo), self._cosh(a.hi).hi)

    def tanh(self, a: Ball) -> Ball:
        """The hyperbolic tangent."""
        low, high = (self._tanh(x) for x in a)
        return Ball(max(low.lo, -_ONE), min(high.hi, _ONE))

    def _half_pi(self) -> Ball:
        return self.div(self.const("pi"), self.const(2))

    def _wave(self, a: Ball, which: int) -> Ball:
        """sin or cos: the value at the lower bound, widened by the width (no slope exceeds one)."""
        width = self.up.subtract(a.hi, a.lo)
        if max(abs(a.lo), abs(a.hi)) > _HUGE or width > 1:
            return Ball(-_ONE, _ONE)
        value = int(a.lo.scaleb(self.digits, _WIDE))
        centre = self.fixed(sine_cosine(value, self.digits)[which])
        slack = self.up.add(width, _ONE.scaleb(-self.digits))
        low, high = self.down.subtract(centre.lo, slack), self.up.add(centre.hi, slack)
        return Ball(max(low, -_ONE), min(high, _ONE))

    def _atan(self, x: Decimal) -> Ball:
        if abs(x) > _HUGE:
            return self._half_pi() if x > 0 else self.neg(self._half_pi())
        return self.fixed(arctangent(int(x.scaleb(self.digits, _WIDE)), self.digits))

    def _asin(self, x: Decimal) -> Ball:
        """asin(x) = 2 atan(x / (1 + sqrt(1 - x^2)))."""
        ball, one = Ball(x, x), Ball(_ONE, _ONE)
        root = self.sqrt(self.max(self.sub(one, self.sqr(ball)), Ball(_ZERO, _ZERO)))
        half = self.atan(self.div(ball, self.add(one, root)))
        return self.add(half, half)

    def _sinh(self, x: Decimal) -> Ball:
        grow, decay = self.exp(Ball(x, x)), self.exp(Ball(-x, -x))
        return self.div(self.sub(grow, decay), self.const(2))

    def _cosh(self, x: Decimal) -> Ball:
        grow, decay = self.exp(Ball(x, x)), self.exp(Ball(-x, -x))
        return self.div(self.add(grow, decay), self.const(2))

    def _tanh(self, x: Decimal) -> Ball:
        """1 - 2/(exp(2x) + 1), which never overflows once exp(2x) is huge."""
        if abs(x) > 10 * self.digits:
            return Ball(_ONE.next_minus(self.down), _ONE) if x > 0 else Ball(-_ONE, (-_ONE).next_plus(self.up))
        grow = self.exp(self.mul(Ball(x, x), self.const(2)))
        return self.sub(self.const(1), self.div(self.const(2), self.add(grow, self.const(1))))


def _undefined(what: str) -> FormulaError:
    return FormulaError(f"a constant in the formula is undefined: {what}", hints=("check that constant's sign",))
