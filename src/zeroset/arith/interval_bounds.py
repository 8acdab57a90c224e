"""What an interval is: two bounds and where they hold, without the operators.

Those are functions (``interval_arithmetic``, ``interval_functions``) that take such numbers and give one of the same
kind, ``B``; ``interval`` makes them its methods.
"""

from __future__ import annotations

from typing import Any, Self, TypeVar

from zeroset.arith.flags import TOTAL, Flags
from zeroset.arith.format import Format
from zeroset.arith.number import Number, System
from zeroset.arith.scalar import Mask, Scalar, ge, gt, is_literal, le, lt, maximum, minimum, not_, or_, select

__all__ = ["B", "Bounds"]


class Bounds(Number):
    """All the reals between two bounds.

    Attributes:
        lo: lower bound, a scalar.
        hi: upper bound, a scalar, not below ``lo``.
        flags: where f is defined on the box that these are bounds for.
        nonnegative: whether ``lo >= 0`` is known while tracing; saves operations.
    """

    __slots__ = ("_system", "flags", "hi", "lo", "nonnegative")

    def __init__(
        self, system: System[Any], lo: Scalar, hi: Scalar, flags: Flags = TOTAL, nonnegative: bool = False
    ) -> None:
        self._system = system
        self.lo = lo
        self.hi = hi
        self.flags = flags
        self.nonnegative = nonnegative or (is_literal(lo) and lo >= 0)

    @property
    def system(self) -> System[Self]:
        """The system that made this number."""
        return self._system

    @property
    def fmt(self) -> Format:
        """The floating-point format of the bounds."""
        return self._system.fmt

    @property
    def defined(self) -> Mask:
        """Whether f is certainly defined and continuous on the whole box."""
        return self.flags.defined

    @property
    def empty(self) -> Mask:
        """Whether f is certainly defined nowhere on the box."""
        return self.flags.empty

    def make(self, lo: Scalar, hi: Scalar, flags: Flags | None = None, nonnegative: bool = False) -> Self:
        """Bounds of the same system, by default with the same flags."""
        return type(self)(self._system, lo, hi, self.flags if flags is None else flags, nonnegative)

    def endless(self) -> tuple[Mask, Mask]:
        """Whether the lower bound, and whether the upper one, stands at ``big``, or so near that rounding may tell."""
        half = 0.5 * self.fmt.big
        return False if self.nonnegative else le(self.lo, -half), ge(self.hi, half)

    def endless_as(self, below: Mask, above: Mask) -> Self:
        """These bounds, without a lower one or an upper one where the masks say so."""
        big, like = self.fmt.big, self.hi if is_literal(self.lo) else self.lo
        lo = self.lo if below is False else select(below, -big, self.lo, like)
        return self.make(lo, select(above, big, self.hi, like), nonnegative=self.nonnegative)

    def watched(self) -> Self:
        """These bounds, of which sums and products see to it that none claims more than it may."""
        return self.make(self.lo, self.hi, self.flags.growing(), self.nonnegative)

    def is_point(self, value: float) -> bool:
        """Whether this is literally the number ``value``, everywhere defined."""
        return is_literal(self.lo, self.hi) and self.lo == self.hi == value and self.flags.is_total

    def contains_zero(self) -> Mask:
        """False only where f certainly has no zero; true for bounds that are NaN."""
        return not_(or_(*self.signs(), self.empty))

    def signs(self) -> tuple[Mask, Mask]:
        """Whether f is certainly above 0, and whether it is certainly below."""
        return gt(self.lo, 0.0), lt(self.hi, 0.0)

    def meet(self, other: Self) -> Self:
        """The intersection of two enclosures of the same function."""
        lo, hi = maximum(self.lo, other.lo), minimum(self.hi, other.hi)
        return self.make(lo, hi, self.flags.meet(other.flags), self.nonnegative or other.nonnegative)


B = TypeVar("B", bound=Bounds)
"""The kind of number that an operator is given, and gives."""
