"""Intervals: lower and upper bounds that hold in the arithmetic that runs.

After Knoll et al. 2009, section 3.2 (doi:10.1111/j.1467-8659.2008.01189.x), with tight squares and even powers,
division by intervals that hold 0, and explicit outward rounding (``rounding``). The contract: an interval holds f at
every point of the box where f is defined and no intermediate value exceeds ``fmt.big`` (5e33 in f32), or where what may
do so comes of functions that watch over it or of numbers that are ``watched``. Bounds are always finite; one at or
beyond +-big claims nothing on its side.
"""

from __future__ import annotations

from zeroset.arith import interval_arithmetic as arithmetic
from zeroset.arith import interval_functions as functions
from zeroset.arith.condition import Undecided
from zeroset.arith.flags import Flags
from zeroset.arith.format import Format
from zeroset.arith.interval_bounds import Bounds
from zeroset.arith.number import System
from zeroset.arith.rounding import lower, upper
from zeroset.arith.scalar import (
    Scalar,
    ge,
    gt,
    is_literal,
    is_zero,
    le,
    lt,
    maximum,
    minimum,
    select,
)  # fmt: skip

__all__ = ["Interval", "IntervalCondition", "IntervalSystem"]


class Interval(Bounds):
    """All the reals between two bounds; ``Bounds`` tells of its attributes.

    Example:
        >>> from zeroset.arith import F64, IntervalSystem
        >>> x = IntervalSystem(F64).constant(-1.0, 2.0)
        >>> x.sqr().lo, x.sqr().hi > 4
        (0.0, True)
    """

    __slots__ = ()

    _system: IntervalSystem

    def __repr__(self) -> str:
        return f"Interval({self.lo!r}, {self.hi!r})"

    @property
    def system(self) -> IntervalSystem:
        """The system that made this number."""
        return self._system

    def interval(self) -> Interval:
        """This interval: the range of a number, on every enclosing system."""
        return self

    add = arithmetic.add
    sub = arithmetic.sub
    neg = arithmetic.neg
    mul = arithmetic.mul
    div = arithmetic.divide
    sqr = arithmetic.sqr
    powi = arithmetic.powi
    abs = arithmetic.absolute
    sign = arithmetic.sign
    floor = arithmetic.floor
    mod = arithmetic.mod
    max = arithmetic.larger
    min = arithmetic.smaller
    pow = functions.power
    powr = functions.rational_power
    cbrt = functions.cbrt
    sqrt = functions.sqrt
    exp = functions.exp
    log = functions.log
    sin = functions.sin
    cos = functions.cos
    tan = functions.tan
    asin = functions.asin
    acos = functions.acos
    atan = functions.atan
    atan2 = functions.atan2
    sinh = functions.sinh
    cosh = functions.cosh
    tanh = functions.tanh

    def lt(self, other: Interval) -> IntervalCondition:
        """Certain where the intervals do not overlap."""
        return IntervalCondition(lt(self.hi, other.lo), ge(self.lo, other.hi), *_both(self, other))

    def le(self, other: Interval) -> IntervalCondition:
        """Certain where the intervals do not overlap."""
        return IntervalCondition(le(self.hi, other.lo), gt(self.lo, other.hi), *_both(self, other))


def _both(a: Interval, b: Interval) -> tuple[Flags, Scalar]:
    """The flags of a comparison, and a scalar that shows the run-time type if there is one."""
    bounds = (a.lo, a.hi, b.lo, b.hi)
    return a.flags.meet(b.flags), next((bound for bound in bounds if not is_literal(bound)), bounds[0])


class IntervalCondition(Undecided[Interval]):
    """A comparison of intervals."""

    __slots__ = ()

    def select(self, a: Interval, b: Interval) -> Interval:
        """One of two intervals, or their hull where the condition is undecided."""
        lo = select(self.true, a.lo, select(self.false, b.lo, minimum(a.lo, b.lo), self.like), self.like)
        hi = select(self.true, a.hi, select(self.false, b.hi, maximum(a.hi, b.hi), self.like), self.like)
        flags = a.flags.choose(b.flags, self.true, self.false).meet(self.flags)
        return a.make(lo, hi, flags, a.nonnegative and b.nonnegative)


class IntervalSystem(System[Interval]):
    """Makes intervals.

    Args:
        fmt: format of the scalars.
    """

    def __init__(self, fmt: Format) -> None:
        self._fmt = fmt

    @property
    def fmt(self) -> Format:
        """The floating-point format of the bounds."""
        return self._fmt

    def constant(self, lo: float, hi: float) -> Interval:
        """The tightest interval of the format around [lo, hi]."""
        # Beyond the middle of the range rounding may tell whether it claims anything.
        number = Interval(self, self._fmt.down(lo), self._fmt.up(hi))
        return number.watched() if max(-lo, hi) > 0.5 * self._fmt.big else number

    def bounds(self, lo: Scalar, hi: Scalar) -> Interval:
        """The interval between two run-time scalars, taken as exact."""
        return Interval(self, lo, hi)

    def enclose(self, value: Scalar, error: Scalar) -> Interval:
        """value +- error, rounded outward; just the value where the error is 0, for it may be the end of a domain."""
        if is_zero(error):
            return Interval(self, value, value)
        inexact, low, high = gt(error, 0.0), lower(self._fmt, value - error), upper(self._fmt, value + error)
        return Interval(self, select(inexact, low, value), select(inexact, high, value))

    def general(self, number: Interval) -> Interval:
        """The interval without what is known while tracing."""
        return Interval(self, number.lo, number.hi, number.flags)

    def components(self, number: Interval) -> list[Scalar]:
        """lo, hi, defined, empty."""
        return [number.lo, number.hi, number.defined, number.empty]

    def rebuild(self, components: list[Scalar]) -> Interval:
        """The interval of these four."""
        lo, hi, defined, empty = components
        return Interval(self, lo, hi, Flags(defined, empty, large=True))
