"""Beams: one conservative search for all rays through a patch of the frame, affine in u, v and t.

A tile's rays are o + t d with o and d affine in the frame coordinates u and v. On numbers with three symbols f is
enclosed over the whole beam between two values of t, and what is excluded there is excluded for each of its rays. The
beam strides from the near end; once its step comes down to about its own width it stops, and the tile's rays start
there. A tile whose beam reaches the far end has no hit at all.

A beam of one pixel finds what a ray through the pixel's middle cannot: parts of the surface thinner than a pixel, down
to Steiner's axes, which have no thickness at all (SN10 figure 6, K09 figure 6). There a step that cannot be excluded
is not yet the end: beside an ordinary silhouette it is passed over.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial, reduce
from typing import Any, NamedTuple

from zeroset.arith import Dual, DualSystem, IntervalSystem
from zeroset.kernel import BOOL, U32, Value, constant, for_, if_, lift, while_
from zeroset.solve.body import LoweredBody
from zeroset.solve.field import Lowered
from zeroset.solve.shape import Body
from zeroset.solve.subject import Subject


class Patch(NamedTuple):
    """The rays through a patch of the frame.

    Attributes:
        subject: what is searched, in this kernel.
        system: a three-symbol affine system; symbols 0 and 1 are u and v, symbol 2 is t.
        origin: origins of the rays, as numbers in u and v.
        direction: their directions.
        outside: says where a region lies outside a body's bounds.
    """

    subject: Subject
    system: Any
    origin: Sequence[Any]
    direction: Sequence[Any]
    outside: Callable[[Body, Sequence[Any]], Value]

    def over(self, a: Value, b: Value) -> tuple[Sequence[Any], Any]:
        """All points of the patch's rays with t in [a, b], and that t."""
        middle = (a + b) * 0.5
        half = (b - middle).maximum(middle - a) * (1.0 + 2.0**-20)
        t = self.system.symbol(2, middle, half)
        return [o + d * t for o, d in zip(self.origin, self.direction, strict=True)], t

    def excludes(self, point: Sequence[Any]) -> Value:
        """Whether there is certainly nothing inside the bounds at these points."""
        excluded = self.clears(self.subject.bodies[0], point)
        for body in self.subject.bodies[1:]:
            excluded = excluded & self.clears(body, point)
        return excluded

    def hazy(self, point: Sequence[Any], wanted: Value) -> Value:
        """Whether f jumps or has no value near these points, where enclosures are too wide to tell of thin parts."""
        bodies = [body for body in self.subject.bodies if not body.body.continuous]
        if not bodies:
            return constant(False, BOOL)
        system, box = IntervalSystem(self.system.fmt), [_around(p.interval()) for p in point]

        def near() -> tuple[Value]:
            # Jumps of a part that has no say there are none; then intervals know that there is nothing.
            free = reduce(lambda a, b: a & b, [body.excludes(system, box) for body in self.subject.bodies])
            return (reduce(lambda a, b: a | b, [body.jumps(system, box) for body in bodies], free),)

        (found,) = if_(wanted, near, lambda: (False,))
        return found

    def endless(self, point: Sequence[Any]) -> Value:
        """Whether something on the way to f has passed the largest number, so that nothing is claimed of it."""
        forms = [lowered.evaluate(self.system, *point) for _, _, lowered in self.subject.fields()]
        masks = [lift(form.endless(), BOOL) for form in forms if form.flags.large]
        return reduce(lambda a, b: a | b, masks, constant(False, BOOL))

    def excludes_well(self, point: Sequence[Any]) -> Value:
        """``excludes``, by intervals too.

        Where f is a sum of powers that are small together, such as at a cusp, a form does not know that an even one is
        not below 0, and intervals do; elsewhere they are too wide to say anything.
        """
        intervals, box = IntervalSystem(self.system.fmt), [p.interval() for p in point]

        def by_intervals() -> tuple[Value]:
            excluded = self.subject.bodies[0].excludes(intervals, box)
            for body in self.subject.bodies[1:]:
                excluded = excluded & body.excludes(intervals, box)
            return (excluded,)

        (excluded,) = if_(~self.excludes(point), by_intervals, lambda: (True,))
        return excluded

    def clears(self, body: LoweredBody, point: Sequence[Any]) -> Value:
        """Whether there is certainly nothing of one body inside its bounds at these points."""
        return body.excludes(self.system, point) | self.outside(body.body, point)


NEAR = 12.0
"""Widths of a part of a pixel, some three pixels, that are near a place where f has no value: there a quotient such as
sin(x)/x is enclosed too widely, however narrow the part is."""
PATIENCE = 200
"""Evaluations that a beam may cost."""
EARLY = 64.0
"""Finest steps from which on a stretch is asked whether the surface there is an ordinary one."""
STEEPEST = 1e30
"""Size of a derivative that is not known yet."""


def _around(interval: Any) -> Any:
    """An interval so much wider that what is next to it is in it, too."""
    middle, half = (interval.lo + interval.hi) * 0.5, (interval.hi - interval.lo) * (0.5 * NEAR)
    return interval.make(middle - half, middle + half)


class Ordinary(NamedTuple):
    """What f's derivatives across a patch are like beside an ordinary silhouette: one of them keeps its sign.

    In a neck that widens, f grows along it, and one keeps its sign, too. But it is small beside the other one, and the
    pixels in whose direction f changes most have met nothing.

    Attributes:
        steadiness: the share of the other one that it is never below.
        across: whether a ray beside the patch, in the direction of u, has met something: then it may be smaller.
        down: the same in the direction of v.
        last: whether nobody looks closer: then what is near a place where f jumps or has no value is left to the rays.
        closely: whether directions in between are asked for, too, where these do not tell.
    """

    steadiness: Value
    across: Value
    down: Value
    last: Value
    closely: Value


class Beam(NamedTuple):
    """Where a beam has ended.

    Attributes:
        found: whether there may be something, and not only the far end.
        start: all before is clear.
        step: the last step that was tried from there.
        t: where what there may be is.
        steps: the evaluations spent.
    """

    found: Value
    start: Value
    step: Value
    t: Value
    steps: Value


def trace_beam(
    patch: Patch, near: Value, far: Value, step: Value, finest: Value, aiming: Value, unsure: Value, ordinary: Ordinary
) -> Beam:
    """Stride along a beam until a step of ``finest`` cannot be excluded, or holds a thin part.

    Who aims stops there. Who looks for thin parts asks the derivatives of f across the patch: near an ordinary
    silhouette one of them keeps its sign, mostly over a long stretch, and the patch is left to its rays there; where
    both may vanish, down to a step of ``finest``, f has an extremum near zero inside, which is what a thin part is. In
    a neck that widens f grows along it, and one keeps its sign too; but there it is small beside the other one.

    Args:
        patch: the beam's rays.
        near: start of the search.
        far: its end.
        step: its first step.
        finest: the shortest step worth trying.
        aiming: whether the beam is to say where rays may start.
        unsure: lanes that have found something when their patience ends, wherever they are.
        ordinary: what the derivatives are like beside an ordinary silhouette.
    """

    def running(a: Value, h: Value, found: Value, count: Value) -> Value:
        return ~found & (a < far) & (count < PATIENCE)

    def turn(a: Value, h: Value, found: Value, count: Value) -> tuple[Value, ...]:
        b = (a + h).minimum(far)
        point, t = patch.over(a, b)
        excluded = patch.excludes(point)
        excluded = excluded | patch.hazy(point, ~excluded & ordinary.last & (h <= finest))
        near = ~aiming & (h <= finest * EARLY)
        # Of thin parts that says nothing either: the rays, in f64, are enough.
        excluded = excluded | (near & patch.endless(point))
        asked = ~excluded & near
        closely = ordinary.closely & (h <= finest)
        (flat,) = if_(asked, lambda: (_flat_across(patch, point, t, ordinary, closely),), lambda: (True,))
        passed = excluded | ~flat
        end = ~passed & (h <= finest)
        return passed.select(b, a), passed.select(h * 2.0, (h * 0.5).maximum(finest)), end, count + 1

    a, h, found, count = while_(running, turn, near, step.maximum(finest), constant(False, BOOL), constant(0, U32))
    ended = unsure & (a < far) & (count >= PATIENCE)
    return Beam(found | ended, a, h, ended.select(a, a + h * 0.5), count)


def find_anything(patch: Patch, near: Value, far: Value, step: Value, finest: Value) -> Beam:
    """Look along a narrow beam for whatever cannot be excluded by all means, down to a step of ``finest``."""

    def running(a: Value, h: Value, found: Value, count: Value) -> Value:
        return ~found & (a < far) & (count < PATIENCE)

    def turn(a: Value, h: Value, found: Value, count: Value) -> tuple[Value, ...]:
        b = (a + h).minimum(far)
        point = patch.over(a, b)[0]
        excluded = patch.excludes_well(point)
        excluded = excluded | patch.hazy(point, ~excluded & (h <= finest))
        left = ~excluded & (h <= finest)
        return excluded.select(b, a), excluded.select(h * 2.0, (h * 0.5).maximum(finest)), left, count + 1

    a, h, found, count = while_(running, turn, near, step.maximum(finest), constant(False, BOOL), constant(0, U32))
    return Beam(found, a, h, a + h * 0.5, count)


def _flat_across(patch: Patch, point: Sequence[Any], t: Any, ordinary: Ordinary, closely: Value) -> Value:
    """Whether f may be flat across the patch at this t, for any f that may have a root there.

    It is not where the two derivatives are as beside an ordinary silhouette: those along u and v, or, in single
    pixels, those along the diagonals, for at the corner of a solid whose faces have gradients of their own
    only one direction in between may leave them all behind. They are the same code, so it is there once and runs up to
    four times: a formula's derivative is most of the kernel, and the time to compile grows with the text.
    """
    fields, kind = list(patch.subject.fields()), patch.subject.type

    def narrow(symbol: Value, *so_far: Value) -> tuple[Value, ...]:
        states = [_Across(*so_far[i : i + 3]) for i in range(0, len(so_far), 3)]
        looks = [partial(_narrowed, patch, lowered, t, symbol, ordinary) for _, _, lowered in fields]
        ends = [if_(s.flat, partial(look, s), partial(tuple, s)) for s, look in zip(states, looks, strict=True)]
        return tuple(value for end in ends for value in end)

    if patch.subject.shape.plain:
        open_ = [constant(True, BOOL)]
    else:
        open_ = [~(patch.clears(body, point) | body.free(leaf, patch.system, point)) for body, leaf, _ in fields]
    start = [value for flat in open_ for value in (flat, constant(0.0, kind), constant(STEEPEST, kind))]
    ends = for_(closely.select(constant(4, U32), 2), narrow, *start)
    return reduce(lambda a, b: a | b, ends[::3])


class _Across(NamedTuple):
    """What is known of f's derivatives across a patch.

    Attributes:
        flat: whether f may be flat.
        least: the least size of the derivative that was looked at last.
        most: its largest size.
    """

    flat: Value
    least: Value
    most: Value


def _narrowed(
    patch: Patch, lowered: Lowered, t: Any, symbol: Value, ordinary: Ordinary, state: _Across
) -> tuple[Value, Value, Value]:
    """What is known once the derivative of f along u, v, u + v or u - v, by number, has been looked at as well."""
    dual, second, diagonal = DualSystem(patch.system, 1), (symbol & 1).ne(0), symbol >= 2
    none = constant(0.0, lowered.type)

    def across(base: Any) -> Any:
        # Affine in u and v: the form's own terms are its derivatives, scaled to the pixel.
        along_u, along_v = base.terms[:2]
        if isinstance(along_u, float) and isinstance(along_v, float):
            return Dual(dual, base, (None,))
        u, v = (lift(along, lowered.type) for along in (along_u, along_v))
        straight = second.select(v, u)
        return Dual(dual, base, (patch.system.exact(diagonal.select(u + second.select(-v, v), straight)),))

    moved = [across(o) + across(d) * dual.lift(t) for o, d in zip(patch.origin, patch.direction, strict=True)]
    slope = lowered.evaluate(dual, *moved).derivative(0).interval()
    # Where f is constant piece by piece, its derivative is a literal.
    low, high = (lift(end, lowered.type) for end in (slope.lo, slope.hi))
    least, most = low.maximum(-high).maximum(0.0), high.maximum(-low)
    # Each pair of directions is looked at by itself.
    other, largest = second.select(state.least, none), second.select(state.most, STEEPEST)
    steady = (least > 0.0) & (least >= ordinary.steadiness * largest)
    before = (other > 0.0) & (other >= ordinary.steadiness * most)
    beside = (most > largest).select(ordinary.down, ordinary.across)
    beside = diagonal.select(ordinary.across & ordinary.down, beside)
    met = second & beside & ((least > 0.0) | (other > 0.0))
    return ~(steady | before | met), least, most
