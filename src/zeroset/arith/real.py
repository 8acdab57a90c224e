"""The plain number: one scalar and where it is defined, for methods that only sample f."""

from __future__ import annotations

from collections.abc import Callable

from zeroset.arith import elementary
from zeroset.arith import scalar as s
from zeroset.arith.format import Format
from zeroset.arith.number import Condition, Number, System
from zeroset.arith.scalar import Mask, Scalar, and_, ge, gt, le, lt, not_, or_, select

__all__ = ["Real", "RealCondition", "RealSystem"]


def _unary(function: Callable[[Scalar], Scalar]) -> Callable[[Real], Real]:
    return lambda a: a.on(function(a.value))


def _binary(function: Callable[[Scalar, Scalar], Scalar]) -> Callable[[Real, Real], Real]:
    return lambda a, b: a.on(function(a.value, b.value), b.defined)


def _elementary(
    function: Callable[[Format, Scalar], Scalar], inside: Callable[[Scalar], Mask] = lambda x: True
) -> Callable[[Real], Real]:
    return lambda a: a.on(function(a.system.fmt, a.value), inside(a.value))


def _at_most_one(x: Scalar) -> Mask:
    return le(s.absolute(x), 1.0)


class Real(Number):
    """A number as the format computes it, without any claim about rounding.

    Attributes:
        value: the scalar; finite wherever f is defined, and some finite number where it is not.
        defined: mask, whether f is defined there.
    """

    __slots__ = ("_system", "defined", "value")

    def __init__(self, system: RealSystem, value: Scalar, defined: Mask = True) -> None:
        self._system = system
        self.value = value
        self.defined = defined

    def __repr__(self) -> str:
        return f"Real({self.value!r})"

    @property
    def system(self) -> RealSystem:
        """The system that made this number."""
        return self._system

    def on(self, value: Scalar, *masks: Mask) -> Real:
        """Another number defined where this one is and all the masks hold."""
        return Real(self._system, value, and_(self.defined, *masks))

    add = _binary(s.add)
    sub = _binary(s.sub)
    mul = _binary(s.mul)
    max = _binary(s.maximum)
    min = _binary(s.minimum)
    neg = _unary(s.neg)
    sqr = _unary(lambda x: s.mul(x, x))
    abs = _unary(s.absolute)
    sign = _unary(s.sign)
    floor = _unary(s.floor)
    ceil = _unary(s.ceil)
    exp = _elementary(elementary.exp)
    log = _elementary(elementary.log, lambda x: gt(x, 0.0))
    sin = _elementary(elementary.sin)
    cos = _elementary(elementary.cos)
    tan = _elementary(elementary.tan)
    asin = _elementary(elementary.asin, _at_most_one)
    acos = _elementary(elementary.acos, _at_most_one)
    atan = _elementary(elementary.atan)
    sinh = _elementary(elementary.sinh)
    cosh = _elementary(elementary.cosh)
    tanh = _elementary(elementary.tanh)
    cbrt = _elementary(elementary.cbrt)

    def sqrt(self) -> Real:
        """The square root, 0 below 0."""
        return self.on(s.sqrt(s.maximum(self.value, 0.0)), ge(self.value, 0.0))

    def div(self, other: Real, /) -> Real:
        """The quotient; where the divisor is 0, undefined and finite."""
        divides = s.ne(other.value, 0.0)
        divisor = select(divides, other.value, 1.0, like=self.value)
        return self.on(s.div(self.value, divisor), other.defined, divides)

    def atan2(self, other: Real, /) -> Real:
        """The angle; undefined at the origin."""
        somewhere = or_(s.ne(self.value, 0.0), s.ne(other.value, 0.0))
        return self.on(elementary.atan2(self._system.fmt, self.value, other.value), other.defined, somewhere)

    def pow(self, other: Real, /) -> Real:
        """The power; for a negative base, or 0 to a power that is not positive, undefined and 0."""
        base, exponent = self.value, other.value
        inside = or_(gt(base, 0.0), and_(s.eq(base, 0.0), gt(exponent, 0.0)))
        return self.on(elementary.pow(self._system.fmt, base, exponent), other.defined, inside)

    def powr(self, exponent: tuple[int, int], /) -> Real:
        """The power; of a negative number undefined."""
        inside = ge(self.value, 0.0) if exponent[0] > 0 else gt(self.value, 0.0)
        return self.on(elementary.powr(self._system.fmt, self.value, exponent), inside)

    def lt(self, other: Real, /) -> RealCondition:
        """The plain comparison."""
        return self._compared(other, lt(self.value, other.value))

    def le(self, other: Real, /) -> RealCondition:
        """The plain comparison."""
        return self._compared(other, le(self.value, other.value))

    def _compared(self, other: Real, holds: Mask) -> RealCondition:
        like = other.value if s.is_literal(self.value) else self.value
        return RealCondition(holds, and_(self.defined, other.defined), like)


class RealCondition(Condition[Real]):
    """A comparison of plain numbers.

    Attributes:
        holds: mask, the outcome.
        defined: mask, whether both sides are defined.
        like: a scalar of the run-time type.
    """

    __slots__ = ("defined", "holds", "like")

    def __init__(self, holds: Mask, defined: Mask, like: Scalar) -> None:
        self.holds = holds
        self.defined = defined
        self.like = like

    def _joined(self, other: RealCondition, holds: Mask) -> RealCondition:
        like = other.like if s.is_literal(self.like) else self.like
        return RealCondition(holds, and_(self.defined, other.defined), like)

    def and_(self, other: RealCondition) -> RealCondition:
        """Both."""
        return self._joined(other, and_(self.holds, other.holds))

    def or_(self, other: RealCondition) -> RealCondition:
        """Either."""
        return self._joined(other, or_(self.holds, other.holds))

    def not_(self) -> RealCondition:
        """The opposite."""
        return RealCondition(not_(self.holds), self.defined, self.like)

    def select(self, a: Real, b: Real) -> Real:
        """One of two."""
        either = or_(and_(self.holds, a.defined), and_(not_(self.holds), b.defined))
        defined = True if a.defined is True and b.defined is True else either
        value = select(self.holds, a.value, b.value, self.like)
        return Real(a.system, value, and_(defined, self.defined))


class RealSystem(System[Real]):
    """Makes plain numbers.

    Args:
        fmt: format of the scalars.
    """

    def __init__(self, fmt: Format) -> None:
        self._fmt = fmt

    @property
    def fmt(self) -> Format:
        """The floating-point format of the scalars."""
        return self._fmt

    def constant(self, lo: float, hi: float) -> Real:
        """The number of the format nearest to the middle."""
        return Real(self, self._fmt.round(0.5 * lo + 0.5 * hi))

    def enclose(self, value: Scalar, error: Scalar) -> Real:
        """The value; its error is forgotten."""
        return Real(self, value)

    def general(self, number: Real) -> Real:
        """The number itself."""
        return number

    def components(self, number: Real) -> list[Scalar]:
        """value, defined."""
        return [number.value, number.defined]

    def rebuild(self, components: list[Scalar]) -> Real:
        """The number of these two."""
        return Real(self, *components)
