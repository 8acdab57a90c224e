"""The derivative of every operator, written once over any number system.

On enclosing systems a kink (of an absolute value, say) gives the hull of the derivatives on both sides, and undefined
flags where the sides differ: the comparisons that pick a side do that by themselves. ``Dual`` adds what makes numbers
and compares them.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from typing import Generic, Self, TypeVar

from zeroset.arith.number import Condition, Number

__all__ = ["DualRules"]

N = TypeVar("N", bound=Number)


def _plus(g: N | None, h: N | None) -> N | None:
    return h if g is None else g if h is None else g.add(h)


def _minus(g: N | None, h: N | None) -> N | None:
    if h is None:
        return g
    return h.neg() if g is None else g.sub(h)


def _times(factor: N, g: N | None) -> N | None:
    return None if g is None else factor.mul(g)


def _constant(a: N, p: int, q: int) -> N:
    return a.literal(float(p)).div(a.literal(float(q)))


def _leg(x: N) -> N:
    """sqrt(1 - x**2)."""
    return x.literal(1.0).sub(x.sqr()).sqrt()


class DualRules(Number, Generic[N]):
    """A value with its derivatives, and what each operator makes of both; below, this is a and the other b.

    Attributes:
        value: a number of the inner system.
        gradient: the derivatives, numbers of the inner system; None for one that is identically 0.
    """

    __slots__ = ()

    value: N
    gradient: tuple[N | None, ...]

    @abstractmethod
    def make(self, value: N, gradient: tuple[N | None, ...]) -> Self:
        """A number of the same system."""

    def derivative(self, index: int) -> N:
        """One derivative, as a number."""
        known = self.gradient[index]
        return self.value.literal(0.0) if known is None else known

    def chain(self, value: N, slope: Callable[[], N]) -> Self:
        """A function of this number, from its value and, where it is needed at all, its derivative."""
        if all(g is None for g in self.gradient):
            return self.make(value, self.gradient)
        by = slope()
        return self.make(value, tuple(None if g is None else by.mul(g) for g in self.gradient))

    def _zip(self, other: Self, combine: Callable[[N | None, N | None], N | None]) -> tuple[N | None, ...]:
        return tuple(combine(g, h) for g, h in zip(self.gradient, other.gradient, strict=True))

    def add(self, other: Self, /) -> Self:
        """a + b."""
        return self.make(self.value.add(other.value), self._zip(other, _plus))

    def sub(self, other: Self, /) -> Self:
        """a - b."""
        return self.make(self.value.sub(other.value), self._zip(other, _minus))

    def neg(self) -> Self:
        """-a."""
        return self.make(self.value.neg(), tuple(None if g is None else g.neg() for g in self.gradient))

    def mul(self, other: Self, /) -> Self:
        """a b: a' b + a b'."""
        product = self.value.mul(other.value)
        return self.make(product, self._zip(other, lambda g, h: _plus(_times(other.value, g), _times(self.value, h))))

    def div(self, other: Self, /) -> Self:
        """a / b: (a' - q b')/b."""
        quotient = self.value.div(other.value)

        def rule(g: N | None, h: N | None) -> N | None:
            top = _minus(g, _times(quotient, h))
            return None if top is None else top.div(other.value)

        return self.make(quotient, self._zip(other, rule))

    def sqr(self) -> Self:
        """a**2: 2 a."""
        return self.chain(self.value.sqr(), lambda: self.value.scaled(2.0))

    def powi(self, n: int, /) -> Self:
        """a**n: n a**(n-1)."""
        return self.chain(self.value.powi(n), lambda: self.value.powi(n - 1).scaled(float(n)))

    def powr(self, exponent: tuple[int, int], /) -> Self:
        """a**r: r a**(r-1)."""
        x, (p, q) = self.value, exponent
        return self.chain(x.powr(exponent), lambda: x.powr((p - q, q)).mul(_constant(x, p, q)))

    def pow(self, other: Self, /) -> Self:
        """a**b: b a**(b-1) a' + a**b log(a) b'."""
        x, y = self.value, other.value
        value = x.pow(y)

        def rule(g: N | None, h: N | None) -> N | None:
            by_base = None if g is None else y.mul(x.pow(y.sub(y.literal(1.0)))).mul(g)
            by_exponent = None if h is None else value.mul(x.log()).mul(h)
            return _plus(by_base, by_exponent)

        return self.make(value, self._zip(other, rule))

    def cbrt(self) -> Self:
        """The cube root: 1/(3 cbrt(a)**2)."""
        value = self.value.cbrt()
        return self.chain(value, lambda: value.literal(1.0).div(value.sqr().scaled(3.0)))

    def sqrt(self) -> Self:
        """The square root: 1/(2 sqrt(a))."""
        value = self.value.sqrt()
        return self.chain(value, lambda: value.literal(1.0).div(value.scaled(2.0)))

    def exp(self) -> Self:
        """The exponential: itself."""
        value = self.value.exp()
        return self.chain(value, lambda: value)

    def log(self) -> Self:
        """The logarithm: 1/a, and undefined where the logarithm is."""
        value = self.value.log()
        return self.chain(value, lambda: self.value.literal(1.0).div(self.value))

    def sin(self) -> Self:
        """The sine: the cosine."""
        return self.chain(self.value.sin(), self.value.cos)

    def cos(self) -> Self:
        """The cosine: minus the sine."""
        return self.chain(self.value.cos(), lambda: self.value.sin().neg())

    def tan(self) -> Self:
        """The tangent: 1 + tan**2."""
        value = self.value.tan()
        return self.chain(value, lambda: value.sqr().add(value.literal(1.0)))

    def asin(self) -> Self:
        """The arc sine: 1/sqrt(1 - a**2)."""
        return self.chain(self.value.asin(), lambda: self.value.literal(1.0).div(_leg(self.value)))

    def acos(self) -> Self:
        """The arc cosine: -1/sqrt(1 - a**2)."""
        return self.chain(self.value.acos(), lambda: self.value.literal(-1.0).div(_leg(self.value)))

    def atan(self) -> Self:
        """The arc tangent: 1/(1 + a**2)."""
        one = self.value.literal(1.0)
        return self.chain(self.value.atan(), lambda: one.div(self.value.sqr().add(one)))

    def atan2(self, other: Self, /) -> Self:
        """The angle of (b, a): (b a' - a b')/(a**2 + b**2)."""
        y, x = self.value, other.value

        def rule(g: N | None, h: N | None) -> N | None:
            top = _minus(_times(x, g), _times(y, h))
            return None if top is None else top.div(y.sqr().add(x.sqr()))

        return self.make(y.atan2(x), self._zip(other, rule))

    def sinh(self) -> Self:
        """The hyperbolic sine: the hyperbolic cosine."""
        return self.chain(self.value.sinh(), self.value.cosh)

    def cosh(self) -> Self:
        """The hyperbolic cosine: the hyperbolic sine."""
        return self.chain(self.value.cosh(), self.value.sinh)

    def tanh(self) -> Self:
        """The hyperbolic tangent: 1 - tanh**2."""
        value = self.value.tanh()
        return self.chain(value, lambda: value.literal(1.0).sub(value.sqr()))

    def abs(self) -> Self:
        """|a|: a' or -a', by the sign of a."""
        negative = self.value.lt(self.value.literal(0.0))
        gradient = tuple(None if g is None else negative.select(g.neg(), g) for g in self.gradient)
        return self.make(self.value.abs(), gradient)

    def _flat(self, value: N) -> Self:
        """A step: no slope where it is continuous, and flags of the value for where it is not."""
        return self.make(value, tuple(None if g is None else value.sub(value).scaled(0.0) for g in self.gradient))

    def sign(self) -> Self:
        """The sign."""
        return self._flat(self.value.sign())

    def floor(self) -> Self:
        """The floor."""
        return self._flat(self.value.floor())

    def ceil(self) -> Self:
        """The ceiling."""
        return self._flat(self.value.ceil())

    def mod(self, other: Self, /) -> Self:
        """a - b floor(a/b): a' - floor(a/b) b'."""
        steps = self.value.div(other.value).floor()
        return self.make(self.value.mod(other.value), self._zip(other, lambda g, h: _minus(g, _times(steps, h))))

    def _picked(self, other: Self, value: N, first: Condition[N]) -> Self:
        gradient = tuple(
            None if g is None and h is None else first.select(self.derivative(i), other.derivative(i))
            for i, (g, h) in enumerate(zip(self.gradient, other.gradient, strict=True))
        )
        return self.make(value, gradient)

    def max(self, other: Self, /) -> Self:
        """The larger of two with its gradient."""
        return self._picked(other, self.value.max(other.value), other.value.lt(self.value))

    def min(self, other: Self, /) -> Self:
        """The smaller of two with its gradient."""
        return self._picked(other, self.value.min(other.value), self.value.lt(other.value))
