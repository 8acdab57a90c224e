"""The derivative of every operator, written once over any number system.

On enclosing systems a kink (of an absolute value, say) gives the hull of the derivatives on both sides, and undefined
flags where the sides differ: the comparisons that pick a side do that by themselves.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from zeroset.arith.number import Condition, Number

if TYPE_CHECKING:
    from zeroset.arith.dual import Dual

N = TypeVar("N", bound=Number)


def _zip(a: Dual[N], b: Dual[N], combine: Callable[[N | None, N | None], N | None]) -> tuple[N | None, ...]:
    return tuple(combine(g, h) for g, h in zip(a.gradient, b.gradient, strict=True))


def _plus(g: N | None, h: N | None) -> N | None:
    return h if g is None else g if h is None else g.add(h)


def _minus(g: N | None, h: N | None) -> N | None:
    if h is None:
        return g
    return h.neg() if g is None else g.sub(h)


def _times(factor: N, g: N | None) -> N | None:
    return None if g is None else factor.mul(g)


def add(a: Dual[N], b: Dual[N], /) -> Dual[N]:
    """a + b."""
    return a.make(a.value.add(b.value), _zip(a, b, _plus))


def sub(a: Dual[N], b: Dual[N], /) -> Dual[N]:
    """a - b."""
    return a.make(a.value.sub(b.value), _zip(a, b, _minus))


def neg(a: Dual[N], /) -> Dual[N]:
    """-a."""
    return a.make(a.value.neg(), tuple(None if g is None else g.neg() for g in a.gradient))


def mul(a: Dual[N], b: Dual[N], /) -> Dual[N]:
    """a b: a' b + a b'."""
    product = a.value.mul(b.value)
    return a.make(product, _zip(a, b, lambda g, h: _plus(_times(b.value, g), _times(a.value, h))))


def div(a: Dual[N], b: Dual[N], /) -> Dual[N]:
    """a / b: (a' - q b')/b."""
    quotient = a.value.div(b.value)

    def rule(g: N | None, h: N | None) -> N | None:
        top = _minus(g, _times(quotient, h))
        return None if top is None else top.div(b.value)

    return a.make(quotient, _zip(a, b, rule))


def sqr(a: Dual[N], /) -> Dual[N]:
    """a**2: 2 a."""
    return a.chain(a.value.sqr(), lambda: a.value.scaled(2.0))


def powi(a: Dual[N], n: int, /) -> Dual[N]:
    """a**n: n a**(n-1)."""
    return a.chain(a.value.powi(n), lambda: a.value.powi(n - 1).scaled(float(n)))


def _constant(a: N, p: int, q: int) -> N:
    return a.literal(float(p)).div(a.literal(float(q)))


def rational_power(a: Dual[N], exponent: tuple[int, int], /) -> Dual[N]:
    """a**r: r a**(r-1)."""
    p, q = exponent
    return a.chain(a.value.powr(exponent), lambda: a.value.powr((p - q, q)).mul(_constant(a.value, p, q)))


def power(a: Dual[N], b: Dual[N], /) -> Dual[N]:
    """a**b: b a**(b-1) a' + a**b log(a) b'."""
    x, y = a.value, b.value
    value = x.pow(y)

    def rule(g: N | None, h: N | None) -> N | None:
        by_base = None if g is None else y.mul(x.pow(y.sub(y.literal(1.0)))).mul(g)
        by_exponent = None if h is None else value.mul(x.log()).mul(h)
        return _plus(by_base, by_exponent)

    return a.make(value, _zip(a, b, rule))


def cbrt(a: Dual[N], /) -> Dual[N]:
    """The cube root: 1/(3 cbrt(a)**2)."""
    value = a.value.cbrt()
    return a.chain(value, lambda: value.literal(1.0).div(value.sqr().scaled(3.0)))


def sqrt(a: Dual[N], /) -> Dual[N]:
    """The square root: 1/(2 sqrt(a))."""
    value = a.value.sqrt()
    return a.chain(value, lambda: value.literal(1.0).div(value.scaled(2.0)))


def exp(a: Dual[N], /) -> Dual[N]:
    """The exponential: itself."""
    value = a.value.exp()
    return a.chain(value, lambda: value)


def log(a: Dual[N], /) -> Dual[N]:
    """The logarithm: 1/a, and undefined where the logarithm is."""
    value = a.value.log()
    return a.chain(value, lambda: a.value.literal(1.0).div(a.value))


def sin(a: Dual[N], /) -> Dual[N]:
    """The sine: the cosine."""
    return a.chain(a.value.sin(), a.value.cos)


def cos(a: Dual[N], /) -> Dual[N]:
    """The cosine: minus the sine."""
    return a.chain(a.value.cos(), lambda: a.value.sin().neg())


def tan(a: Dual[N], /) -> Dual[N]:
    """The tangent: 1 + tan**2."""
    value = a.value.tan()
    return a.chain(value, lambda: value.sqr().add(value.literal(1.0)))


def _leg(x: N) -> N:
    """sqrt(1 - x**2)."""
    return x.literal(1.0).sub(x.sqr()).sqrt()


def asin(a: Dual[N], /) -> Dual[N]:
    """The arc sine: 1/sqrt(1 - a**2)."""
    return a.chain(a.value.asin(), lambda: a.value.literal(1.0).div(_leg(a.value)))


def acos(a: Dual[N], /) -> Dual[N]:
    """The arc cosine: -1/sqrt(1 - a**2)."""
    return a.chain(a.value.acos(), lambda: a.value.literal(-1.0).div(_leg(a.value)))


def atan(a: Dual[N], /) -> Dual[N]:
    """The arc tangent: 1/(1 + a**2)."""
    one = a.value.literal(1.0)
    return a.chain(a.value.atan(), lambda: one.div(a.value.sqr().add(one)))


def atan2(a: Dual[N], b: Dual[N], /) -> Dual[N]:
    """The angle of (b, a): (b a' - a b')/(a**2 + b**2)."""
    y, x = a.value, b.value

    def rule(g: N | None, h: N | None) -> N | None:
        top = _minus(_times(x, g), _times(y, h))
        return None if top is None else top.div(y.sqr().add(x.sqr()))

    return a.make(y.atan2(x), _zip(a, b, rule))


def sinh(a: Dual[N], /) -> Dual[N]:
    """The hyperbolic sine: the hyperbolic cosine."""
    return a.chain(a.value.sinh(), a.value.cosh)


def cosh(a: Dual[N], /) -> Dual[N]:
    """The hyperbolic cosine: the hyperbolic sine."""
    return a.chain(a.value.cosh(), a.value.sinh)


def tanh(a: Dual[N], /) -> Dual[N]:
    """The hyperbolic tangent: 1 - tanh**2."""
    value = a.value.tanh()
    return a.chain(value, lambda: value.literal(1.0).sub(value.sqr()))


def absolute(a: Dual[N], /) -> Dual[N]:
    """|a|: a' or -a', by the sign of a."""
    negative = a.value.lt(a.value.literal(0.0))
    gradient = tuple(None if g is None else negative.select(g.neg(), g) for g in a.gradient)
    return a.make(a.value.abs(), gradient)


def _flat(a: Dual[N], value: N) -> Dual[N]:
    """A step: no slope where it is continuous, and flags of the value for where it is not."""
    return a.make(value, tuple(None if g is None else value.sub(value).scaled(0.0) for g in a.gradient))


def sign(a: Dual[N], /) -> Dual[N]:
    """The sign."""
    return _flat(a, a.value.sign())


def floor(a: Dual[N], /) -> Dual[N]:
    """The floor."""
    return _flat(a, a.value.floor())


def ceil(a: Dual[N], /) -> Dual[N]:
    """The ceiling."""
    return _flat(a, a.value.ceil())


def mod(a: Dual[N], b: Dual[N], /) -> Dual[N]:
    """a - b floor(a/b): a' - floor(a/b) b'."""
    steps = a.value.div(b.value).floor()
    return a.make(a.value.mod(b.value), _zip(a, b, lambda g, h: _minus(g, _times(steps, h))))


def _picked(value: N, first: Condition[N], a: Dual[N], b: Dual[N]) -> Dual[N]:
    gradient = tuple(
        None if g is None and h is None else first.select(a.derivative(i), b.derivative(i))
        for i, (g, h) in enumerate(zip(a.gradient, b.gradient, strict=True))
    )
    return a.make(value, gradient)


def larger(a: Dual[N], b: Dual[N], /) -> Dual[N]:
    """The larger of two with its gradient."""
    return _picked(a.value.max(b.value), b.value.lt(a.value), a, b)


def smaller(a: Dual[N], b: Dual[N], /) -> Dual[N]:
    """The smaller of two with its gradient."""
    return _picked(a.value.min(b.value), a.value.lt(b.value), a, b)
