"""Numbers of the judge: Arb balls with a derivative along the ray, and what is known of the domain.

A ``Jet`` encloses f and f' over a stretch of t. ``whole`` promises that f is defined and continuous on all of the
stretch, ``empty`` that it is defined nowhere on it. A derivative of None is unknown or unbounded; one at a kink is the
hull of both sides, which is all that the mean value theorem needs. Nothing here shares code with ``zeroset.arith``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from flint import arb, ctx, fmpq

PRECISION = 256
"""Bits of every ball: so many that rounding never decides; what stays open is a matter of the stretch's width."""

Ball = Any


def precise() -> None:
    """Make this process's balls wide enough for the judge."""
    ctx.prec = PRECISION


precise()
LINE = arb(0, arb("inf"))
ZERO, ONE = arb(0), arb(1)


def hull(low: Ball, high: Ball) -> Ball:
    """The least ball over two balls."""
    return low.union(high)


def low(v: Ball) -> Ball:
    """Lower end, an exact ball."""
    return v.lower()


def high(v: Ball) -> Ball:
    """Upper end, an exact ball."""
    return v.upper()


def finite(v: Ball) -> Ball:
    """The ball, or the whole line for what is no finite ball."""
    return v if v.is_finite() else LINE


def square(v: Ball) -> Ball:
    """v^2, which reaches no lower than a rounding below 0."""
    if v.contains(0) and not v.is_zero():
        top = v.abs_upper()
        return hull(ZERO, top * top)
    return v * v


def power(v: Ball, n: int) -> Ball:
    """v^n for whole n > 0."""
    if n == 1:
        return v
    return power(square(v), n // 2) if n % 2 == 0 else v * power(v, n - 1)


def ranged(f: Callable[[Ball], Ball], v: Ball) -> Ball:
    """Range of a rising or falling f."""
    return f(v) if v.is_exact() else hull(f(low(v)), f(high(v)))


@dataclass(slots=True)
class Truth:
    """A condition on a stretch: certain, certainly not, or open. ``whole``: both sides are defined and continuous."""

    true: bool
    false: bool
    whole: bool
    empty: bool

    def and_(self, o: Truth) -> Truth:
        return Truth(self.true and o.true, self.false or o.false, self.whole and o.whole, self.empty or o.empty)

    def or_(self, o: Truth) -> Truth:
        return Truth(self.true or o.true, self.false and o.false, self.whole and o.whole, self.empty or o.empty)

    def not_(self) -> Truth:
        return Truth(self.false, self.true, self.whole, self.empty)

    def select(self, a: Jet, b: Jet) -> Jet:
        if self.true or self.false:
            chosen = a if self.true else b
            return Jet(chosen.v, chosen.d, chosen.whole and self.whole, chosen.empty or self.empty, chosen.positive)
        if a.empty and b.empty:
            return a
        value = b.v if a.empty else a.v if b.empty else hull(a.v, b.v)
        return Jet(value, None, False, self.empty, a.positive and b.positive)


class Jet:
    """f and f' over a stretch: ``v``, ``d`` (or None), ``whole``, ``empty``; ``positive`` promises f >= 0."""

    __slots__ = ("d", "empty", "positive", "v", "whole")

    def __init__(
        self, v: Ball, d: Ball | None, whole: bool = True, empty: bool = False, positive: bool = False
    ) -> None:
        self.v = v
        self.d = d
        self.whole = whole
        self.empty = empty
        self.positive = positive

    def _with(self, other: Jet, v: Ball, d: Ball | None, positive: bool = False) -> Jet:
        return Jet(v, d, self.whole and other.whole, self.empty or other.empty, positive)

    def _of(self, v: Ball, slope: Ball | None, whole: bool = True, positive: bool = False) -> Jet:
        """g(self), from its range and the range of g'."""
        d = None if slope is None or self.d is None or not slope.is_finite() else self.d * slope
        return Jet(finite(v), d, self.whole and whole, self.empty, positive)

    def _nowhere(self) -> Jet:
        return Jet(LINE, None, False, True)

    def _least(self) -> Ball:
        """Lower end; never below 0 where f is known to be above."""
        return low(self.v).max(ZERO) if self.positive else low(self.v)

    def add(self, o: Jet) -> Jet:
        d = None if self.d is None or o.d is None else self.d + o.d
        return self._with(o, self.v + o.v, d, self.positive and o.positive)

    def sub(self, o: Jet) -> Jet:
        return self._with(o, self.v - o.v, None if self.d is None or o.d is None else self.d - o.d)

    def neg(self) -> Jet:
        return self._of(-self.v, -ONE)

    def mul(self, o: Jet) -> Jet:
        d = None if self.d is None or o.d is None else self.d * o.v + self.v * o.d
        return self._with(o, self.v * o.v, d, self.positive and o.positive)

    def div(self, o: Jet) -> Jet:
        if o.v.is_zero():
            return self._nowhere()
        if o.v.contains(0):
            return Jet(LINE, None, False, self.empty or o.empty)
        return self.mul(o._of(ONE / o.v, -ONE / square(o.v), positive=o.positive))

    def sqr(self) -> Jet:
        return self._of(square(self.v), 2 * self.v, positive=True)

    def powi(self, n: int) -> Jet:
        if n <= 0:
            one = Jet(ONE, ZERO, self.whole, self.empty, True)
            return one if n == 0 else one.div(self.powi(-n))
        if n == 1:
            return self
        return self._of(power(self.v, n), n * power(self.v, n - 1), positive=n % 2 == 0 or self.positive)

    def powr(self, exponent: tuple[int, int]) -> Jet:
        p, q = exponent
        return self._real_power(fmpq(p, q))

    def _real_power(self, e: Ball | fmpq) -> Jet:
        """self^e for a constant e > 0, 0 for 0; undefined below 0."""
        least, top = self._least(), high(self.v)
        if top < 0:
            return self._nowhere()

        def at(x: Ball, e: Ball) -> Ball:
            return ZERO if x <= 0 else (arb(e) * x.log()).exp()

        slope = None
        if least > 0 or arb(e) > 1:
            slope = arb(e) * hull(at(least, arb(e) - 1), at(top, arb(e) - 1))
        return self._of(hull(at(least, e), at(top, e)), slope, self.positive or bool(least >= 0), True)

    def pow(self, o: Jet) -> Jet:
        if o.d is not None and o.d.is_zero() and o.v > 0:
            exponent = self._real_power(o.v)
            return exponent._with(o, exponent.v, exponent.d, True)
        if self._least() > 0:
            made = o.mul(self.log()).exp()
            return Jet(made.v, made.d, made.whole, made.empty, True)
        if high(self.v) < 0:
            return self._nowhere()
        return Jet(LINE, None, False, self.empty or o.empty, True)

    def cbrt(self) -> Jet:
        def root(x: Ball) -> Ball:
            return ZERO if x.is_zero() else x.root(3) if x > 0 else -(-x).root(3)

        value = ranged(root, self.v)
        slope = None if self.v.contains(0) else ONE / (3 * square(value))
        return self._of(value, slope, positive=self.positive)

    def sqrt(self) -> Jet:
        least, top = self._least(), high(self.v)
        if top < 0:
            return self._nowhere()
        inside = bool(least >= 0)
        value = hull(least.max(ZERO).sqrt(), top.max(ZERO).sqrt())
        slope = ONE / (2 * value) if least > 0 else None
        return self._of(value, slope, inside, True)

    def exp(self) -> Jet:
        value = self.v.exp()
        return self._of(value, value, positive=True)

    def log(self) -> Jet:
        if high(self.v) <= 0:
            return self._nowhere()
        if not self._least() > 0:
            return self._of(LINE, None, False)
        return self._of(self.v.log(), ONE / self.v)

    def sin(self) -> Jet:
        return self._of(self.v.sin(), self.v.cos())

    def cos(self) -> Jet:
        return self._of(self.v.cos(), -self.v.sin())

    def tan(self) -> Jet:
        cosine = self.v.cos()
        if cosine.contains(0):
            return self._of(LINE, None, False)
        return self._of(self.v.tan(), ONE / square(cosine))

    def _inverse_circular(self, f: Callable[[Ball], Ball], sign: int, positive: bool) -> Jet:
        least, top = low(self.v), high(self.v)
        if top < -1 or least > 1:
            return self._nowhere()
        inside = bool(least >= -1 and top <= 1)
        slope = sign / (1 - square(self.v)).sqrt() if least > -1 and top < 1 else None
        return self._of(hull(f(least.max(-ONE)), f(top.min(ONE))), slope, inside, positive)

    def asin(self) -> Jet:
        return self._inverse_circular(arb.asin, 1, False)

    def acos(self) -> Jet:
        return self._inverse_circular(arb.acos, -1, True)

    def atan(self) -> Jet:
        return self._of(self.v.atan(), ONE / (1 + square(self.v)))

    def atan2(self, o: Jet) -> Jet:
        if self.v.is_zero() and o.v.is_zero():
            return self._nowhere()
        if self.v.contains(0) and not o.v > 0:
            return self._with(o, arb(0, 4), None)._of(arb(0, 4), None, False)
        d = None
        if self.d is not None and o.d is not None:
            d = (o.v * self.d - self.v * o.d) / (square(o.v) + square(self.v))
            d = d if d.is_finite() else None
        return self._with(o, finite(arb.atan2(self.v, o.v)), d)

    def sinh(self) -> Jet:
        return self._of(self.v.sinh(), self.v.cosh())

    def cosh(self) -> Jet:
        return self._of(self.v.cosh(), self.v.sinh(), positive=True)

    def tanh(self) -> Jet:
        value = self.v.tanh()
        return self._of(value, 1 - square(value))

    def abs(self) -> Jet:
        if self.v >= 0 or self.positive:
            return Jet(self.v, self.d, self.whole, self.empty, True)
        if self.v <= 0:
            return self._of(-self.v, -ONE, positive=True)
        return self._of(hull(ZERO, self.v.abs_upper()), arb(0, 1), positive=True)

    def sign(self) -> Jet:
        if self.v > 0 or self.v < 0:
            return Jet(ONE if self.v > 0 else -ONE, ZERO, self.whole, self.empty, bool(self.v > 0))
        if self.v.is_zero():
            return Jet(ZERO, ZERO, self.whole, self.empty, True)
        return Jet(arb(0, 1), None, False, self.empty)

    def floor(self) -> Jet:
        least, top = low(self.v).floor(), high(self.v).floor()
        if (least - top).is_zero():
            return Jet(least, ZERO, self.whole, self.empty)
        return Jet(finite(hull(least, top)), None, False, self.empty)

    def ceil(self) -> Jet:
        return self.neg().floor().neg()

    def mod(self, o: Jet) -> Jet:
        return self.sub(o.mul(self.div(o).floor()))

    def max(self, o: Jet) -> Jet:
        slope = None
        if self.v >= o.v or self.v <= o.v:
            slope = self.d if self.v >= o.v else o.d
        elif self.d is not None and o.d is not None:
            slope = hull(self.d, o.d)
        return self._with(o, self.v.max(o.v), slope, self.positive or o.positive)

    def min(self, o: Jet) -> Jet:
        made = self.neg().max(o.neg()).neg()
        return Jet(made.v, made.d, made.whole, made.empty, self.positive and o.positive)

    def lt(self, o: Jet) -> Truth:
        return Truth(bool(self.v < o.v), bool(self.v >= o.v), self.whole and o.whole, self.empty or o.empty)

    def le(self, o: Jet) -> Truth:
        return Truth(bool(self.v <= o.v), bool(self.v > o.v), self.whole and o.whole, self.empty or o.empty)
