"""The plain number: one scalar and where it is defined, for methods that only sample f."""

from __future__ import annotations

from typing import Any

from zeroset.arith import elementary
from zeroset.arith import scalar as s
from zeroset.arith.format import Format
from zeroset.arith.number import Condition, Number, System
from zeroset.arith.scalar import Mask, Scalar, and_, ge, gt, le, lt, not_, or_, select

__all__ = ["Real", "RealCondition", "RealSystem"]


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

    def _with(self, value: Scalar, *masks: Mask) -> Real:
        return Real(self._system, value, and_(self.defined, *masks))

    def _elementary(self, name: str, *masks: Mask) -> Real:
        return self._with(getattr(elementary, name)(self._system.fmt, self.value), *masks)

    def add(self, other: Real) -> Real:
        return self._with(s.add(self.value, other.value), other.defined)

    def sub(self, other: Real) -> Real:
        return self._with(s.sub(self.value, other.value), other.defined)

    def neg(self) -> Real:
        return self._with(s.neg(self.value))

    def mul(self, other: Real) -> Real:
        return self._with(s.mul(self.value, other.value), other.defined)

    def div(self, other: Real) -> Real:
        divides = s.ne(other.value, 0.0)
        divisor = select(divides, other.value, 1.0)
        return self._with(s.div(self.value, divisor), other.defined, divides)

    def sqr(self) -> Real:
        return self._with(s.mul(self.value, self.value))

    def sqrt(self) -> Real:
        return self._with(s.sqrt(s.maximum(self.value, 0.0)), ge(self.value, 0.0))

    def exp(self) -> Real:
        return self._elementary("exp")

    def log(self) -> Real:
        return self._elementary("log", gt(self.value, 0.0))

    def sin(self) -> Real:
        return self._elementary("sin")

    def cos(self) -> Real:
        return self._elementary("cos")

    def tan(self) -> Real:
        return self._elementary("tan")

    def asin(self) -> Real:
        return self._elementary("asin", le(s.absolute(self.value), 1.0))

    def acos(self) -> Real:
        return self._elementary("acos", le(s.absolute(self.value), 1.0))

    def atan(self) -> Real:
        return self._elementary("atan")

    def atan2(self, other: Real) -> Real:
        somewhere = or_(s.ne(self.value, 0.0), s.ne(other.value, 0.0))
        return self._with(elementary.atan2(self._system.fmt, self.value, other.value), other.defined, somewhere)

    def sinh(self) -> Real:
        return self._elementary("sinh")

    def cosh(self) -> Real:
        return self._elementary("cosh")

    def tanh(self) -> Real:
        return self._elementary("tanh")

    def cbrt(self) -> Real:
        return self._elementary("cbrt")

    def pow(self, other: Real) -> Real:
        base, exponent = self.value, other.value
        power = elementary.pow(self._system.fmt, base, exponent)
        inside = or_(gt(base, 0.0), and_(s.eq(base, 0.0), gt(exponent, 0.0)))
        return self._with(power, other.defined, inside)

    def powr(self, exponent: tuple[int, int]) -> Real:
        inside = ge(self.value, 0.0) if exponent[0] > 0 else gt(self.value, 0.0)
        return self._with(elementary.powr(self._system.fmt, self.value, exponent), inside)

    def abs(self) -> Real:
        return self._with(s.absolute(self.value))

    def sign(self) -> Real:
        return self._with(s.sign(self.value))

    def floor(self) -> Real:
        return self._with(s.floor(self.value))

    def ceil(self) -> Real:
        return self._with(s.ceil(self.value))

    def max(self, other: Real) -> Real:
        return self._with(s.maximum(self.value, other.value), other.defined)

    def min(self, other: Real) -> Real:
        return self._with(s.minimum(self.value, other.value), other.defined)

    def lt(self, other: Real) -> RealCondition:
        return RealCondition(lt(self.value, other.value), and_(self.defined, other.defined), self.value)

    def le(self, other: Real) -> RealCondition:
        return RealCondition(le(self.value, other.value), and_(self.defined, other.defined), self.value)


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
        return self._joined(other, and_(self.holds, other.holds))

    def or_(self, other: RealCondition) -> RealCondition:
        return self._joined(other, or_(self.holds, other.holds))

    def not_(self) -> RealCondition:
        return RealCondition(not_(self.holds), self.defined, self.like)

    def select(self, a: Real, b: Real) -> Real:
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
        return Real(self, self._fmt.round(0.5 * lo + 0.5 * hi))

    def enclose(self, value: Scalar, error: Scalar) -> Real:
        return Real(self, value)

    def general(self, number: Real) -> Real:
        return number

    def components(self, number: Real) -> list[Any]:
        return [number.value, number.defined]

    def rebuild(self, components: list[Any]) -> Real:
        return Real(self, *components)
