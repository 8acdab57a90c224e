"""Conditions of enclosing systems: certainly true, certainly false, or undecided on the box."""

from __future__ import annotations

from typing import Self, TypeVar

from zeroset.arith.flags import Flags
from zeroset.arith.number import Condition, Number
from zeroset.arith.scalar import Mask, Scalar, and_, is_literal, or_

__all__ = ["Undecided"]

N = TypeVar("N", bound=Number)


class Undecided(Condition[N]):
    """A comparison with three outcomes; systems add ``select``.

    Attributes:
        true: mask, certainly true on the whole box.
        false: mask, certainly false on the whole box.
        flags: where both sides are defined.
        like: a scalar of the run-time type.
    """

    __slots__ = ("false", "flags", "like", "true")

    def __init__(self, true: Mask, false: Mask, flags: Flags, like: Scalar) -> None:
        self.true = true
        self.false = false
        self.flags = flags
        self.like = like

    def and_(self, other: Self) -> Self:
        """Both: certain if both are."""
        return self._joined(other, and_(self.true, other.true), or_(self.false, other.false))

    def or_(self, other: Self) -> Self:
        """Either: certainly false if both are."""
        return self._joined(other, or_(self.true, other.true), and_(self.false, other.false))

    def not_(self) -> Self:
        """The opposite."""
        return type(self)(self.false, self.true, self.flags, self.like)

    def _joined(self, other: Self, true: Mask, false: Mask) -> Self:
        like = other.like if is_literal(self.like) else self.like
        return type(self)(true, false, self.flags.meet(other.flags), like)
