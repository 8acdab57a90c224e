"""Zones of the search in which f jumps or has no value, or beside which it does: what is told of them.

There an enclosure proves nothing, however narrow the interval is. Who draws passes such a zone over if f has the same
sign on either side (``search``), and asks here first whether it is one, and whether a sign in it shows a root.
"""

from __future__ import annotations

from zeroset.arith import IntervalSystem
from zeroset.kernel import BOOL, U32, Value, constant, for_, if_, lift, while_
from zeroset.solve.look import Interval
from zeroset.solve.problem import Problem
from zeroset.solve.walk import State

NEAR = 16.0
"""Widths of a narrowest interval that are near such a place."""
CLOSER = 14
"""Looks at an interval in which f ends to have a value: three, and eleven halvings."""
POSITIVE, NEGATIVE = 1, 2
"""Signs as bits."""


def sees_signs(problem: Problem) -> bool:
    """Whether the signs that f has within a hazy zone are noted. At a pole they say nothing of a root."""
    return problem.hazy and problem.body is None and not problem.lowered.has_poles


def _bit(sign: Value) -> Value:
    """A sign as a bit; none where it is not known."""
    return (sign > 0.0).select(constant(POSITIVE, U32), (sign < 0.0).select(constant(NEGATIVE, U32), 0))


def mixed(signs: Value | None, before: Value, after: Value) -> Value:
    """Whether f has both signs in a zone, or on either side of it: a root, unless f jumps from one to the other."""
    if signs is None:
        return constant(False, BOOL)
    return (signs | _bit(before) | _bit(after)).eq(POSITIVE | NEGATIVE)


def look_around(problem: Problem, a: Value, b: Value, wanted: Value) -> tuple[Value, Value]:
    """What f is like beside a narrowest interval: ``beside_haze``, and the signs that it has in it, as bits.

    Where f has no value on a part of [a, b], that part's end is closed in on: a root may lie right beside it. All is
    the same code over one stretch or another: it is there once, for a formula is most of a kernel.
    """
    system, over = IntervalSystem(problem.fmt), Interval.between(a, b)

    def going(i: Value, *state: Value) -> Value:
        return i < CLOSER

    def one(i: Value, haze: Value, first: Value, lo: Value, hi: Value, signs: Value) -> State:
        wide, middle = i.eq(0), (lo + hi) * 0.5
        place = wide.select(over.middle, i.eq(1).select(a, i.eq(2).select(b, middle)))
        f = problem.lowered.along(system, problem.ray, system.enclose(place, wide.select(over.half * NEAR, 0.0)))
        up, down, defined = (lift(mask, BOOL) for mask in (*f.signs(), f.defined))
        known = up.select(constant(POSITIVE, U32), down.select(constant(NEGATIVE, U32), 0))
        first = i.eq(1).select(defined, first)
        same, inside = ~(defined ^ first), i > 2
        # Both ends with a value, or none: there is no end of the domain to be found.
        further = i.eq(2).select(same.select(constant(CLOSER, U32), i), i) + 1
        signs = (wide | ~defined).select(signs, signs | known)
        lo, hi = (inside & same).select(middle, lo), (inside & ~same).select(middle, hi)
        return further, wide.select(~defined, haze), first, lo, hi, signs

    no, none = constant(False, BOOL), constant(0, U32)

    def look() -> State:
        _, haze, _, _, _, signs = while_(going, one, none, no, no, a, b, none)
        return haze, signs

    haze, signs = if_(wanted, look, lambda: (no, none))
    return haze, signs


def beside_haze(problem: Problem, a: Value, b: Value, wanted: Value) -> Value:
    """Whether f jumps or has no value within a few widths of [a, b], which makes it enclosed too widely there."""
    system = IntervalSystem(problem.fmt)

    def near() -> tuple[Value]:
        over = Interval.between(a, b)
        t = system.enclose(over.middle, over.half * NEAR)
        if problem.body is None:
            return (~lift(problem.lowered.along(system, problem.ray, t).defined, BOOL),)
        along = [
            system.exact(o) + system.exact(d) * t
            for o, d in zip(problem.ray.origin, problem.ray.direction, strict=True)
        ]
        return (problem.body.jumps(system, along),)

    (found,) = if_(wanted, near, lambda: (False,))
    return found


def through_a_pole(problem: Problem, a: Value, b: Value, wanted: Value) -> Value:
    """Whether f has a zero between a and b although it has the same sign at both, for it has a pole there as well.

    Then its numerator changes its sign, as the denominator does.
    """
    if problem.body is not None or not problem.lowered.has_poles:
        return constant(False, BOOL)
    system = IntervalSystem(problem.fmt)

    def one(i: Value, product: Value) -> Value:
        place = system.exact(i.eq(0).select(a, b))
        top = problem.lowered.numerator(system, lambda other: other.along(system, problem.ray, place))
        above, below = (lift(sign, BOOL) for sign in top.signs())
        number = problem.number
        return product * above.select(number(1.0), below.select(number(-1.0), 0.0))

    (turns,) = if_(wanted, lambda: for_(2, one, problem.number(1.0)), lambda: (0.0,))
    return turns < 0.0
