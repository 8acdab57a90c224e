"""What one evaluation of f over an interval says: whether it holds a root, where in it, and which sign f has around."""

from __future__ import annotations

from typing import Any, NamedTuple

from zeroset.arith import Affine as AffineForm
from zeroset.arith import AffineSystem
from zeroset.kernel import BOOL, Value, lift
from zeroset.solve.problem import Problem


class Look(NamedTuple):
    """What one evaluation says of an interval [a, b].

    Where there are several isovalues, a *label* stands in a sign's place: one more than how many of them are below f.

    Attributes:
        excluded: mask, f has no root there.
        crosses: mask, f certainly changes sign there, continuously.
        defined: mask, f is defined and continuous there.
        left: every root is at or after it.
        right: every root is at or before it.
        before: sign of f on [a, left), or on [a, b] where that is excluded.
        after: sign of f on (right, b].
        width: how wide the enclosure of f is.
        mark: the parts that a root there can be of, as bits; None where there is no choice.
    """

    excluded: Value
    crosses: Value | bool
    defined: Value | bool
    left: Value
    right: Value
    before: Value
    after: Value
    width: Value
    mark: Value | None = None

    def without(self, pole: Value) -> Look:
        """This look where something else has shown that there is but a pole: no root, and an unknown sign behind it."""
        before, after = (pole.select(0.0, sign) for sign in (self.before, self.after))
        return self._replace(excluded=self.excluded | pole, before=before, after=after)


class Interval(NamedTuple):
    """The interval [a, b] as middle and half width; these cover a and b whatever was rounded."""

    a: Value
    b: Value
    middle: Value
    half: Value

    @classmethod
    def between(cls, a: Value, b: Value) -> Interval:
        """The interval between two values of t."""
        middle = (a + b) * 0.5
        # The rounded middle is not exactly in the middle, and the subtraction rounds too: a hair wider covers both.
        half = (b - middle).maximum(middle - a) * (1.0 + 2.0**-20)
        return cls(a, b, middle, half)


def read(problem: Problem, f: Any, over: Interval) -> Look:
    """Read off f over an interval what it proves."""
    excluded = ~lift(f.contains_zero(), BOOL)
    one = problem.number(1.0)
    bounds = f.interval()
    width = problem.lift(bounds.hi) - problem.lift(bounds.lo)
    # Whatever has excluded 0 tells the sign: the ends of the range are rounded apart from that. Where f has no value
    # there is nothing of a solid, and a surface has no sign to be compared with.
    above, empty = lift(f.signs()[0], BOOL), lift(f.empty, BOOL)
    sign = empty.select(problem.number(0.0 if problem.hazy and problem.body is None else 1.0), above.select(one, -one))
    if not isinstance(f, AffineForm):
        return Look(excluded, False, f.defined, over.a, over.b, sign, sign, width)
    cut = f.contract()
    low, high = (problem.lift(end).fma(over.half, over.middle) for end in (cut.low, cut.high))
    left, right = low.maximum(over.a), high.minimum(over.b)
    # What was looked at is a hair wider than [a, b]: a root in the hair is not one of this interval.
    crosses = lift(cut.crosses, BOOL) & (low >= over.a) & (high <= over.b)
    # Where an operation leaves no slope at all, such as floor, contraction answers with literals.
    after = lift(cut.rising, BOOL).select(one, -one)
    return Look(excluded, crosses, f.defined, left, right, excluded.select(sign, -after), after, width)


def stretch(system: Any, middle: Value, half: Value) -> Any:
    """The numbers middle - half ... middle + half of an enclosing system; t is symbol 0 of an affine one."""
    return system.symbol(0, middle, half) if isinstance(system, AffineSystem) else system.enclose(middle, half)
