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
from functools import partial
from typing import Any, NamedTuple

from zeroset.arith import Dual, DualSystem, IntervalSystem
from zeroset.kernel import BOOL, U32, Value, constant, for_, if_, lift, while_
from zeroset.solve.field import Lowered
from zeroset.solve.shape import Body
from zeroset.solve.subject import LoweredBody, Subject


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


PATIENCE = 200
"""Evaluations that a beam may cost."""
EARLY = 64.0
"""Finest steps from which on a stretch is asked whether the surface there is an ordinary one."""


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


def trace_beam(patch: Patch, near: Value, far: Value, step: Value, finest: Value, aiming: Value, unsure: Value) -> Beam:
    """Stride along a beam until a step of ``finest`` cannot be excluded, or holds a thin part.

    Who aims stops there. Who looks for thin parts asks the derivatives of f across the patch: near an ordinary
    silhouette one of them keeps its sign, mostly over a long stretch, and the patch is left to its rays there; where
    both may vanish, down to a step of ``finest``, f has an extremum near zero inside, which is what a thin part is.

    Args:
        patch: the beam's rays.
        near: start of the search.
        far: its end.
        step: its first step.
        finest: the shortest step worth trying.
        aiming: whether the beam is to say where rays may start.
        unsure: lanes that have found something when their patience ends, wherever they are.
    """

    def running(a: Value, h: Value, found: Value, count: Value) -> Value:
        return ~found & (a < far) & (count < PATIENCE)

    def turn(a: Value, h: Value, found: Value, count: Value) -> tuple[Value, ...]:
        b = a + h
        point, t = patch.over(a, b)
        excluded = patch.excludes(point)
        asked = ~excluded & ~aiming & (h <= finest * EARLY)
        (flat,) = if_(asked, lambda: (_flat_across(patch, point, t),), lambda: (True,))
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
        b = a + h
        excluded = patch.excludes_well(patch.over(a, b)[0])
        left = ~excluded & (h <= finest)
        return excluded.select(b, a), excluded.select(h * 2.0, (h * 0.5).maximum(finest)), left, count + 1

    a, h, found, count = while_(running, turn, near, step.maximum(finest), constant(False, BOOL), constant(0, U32))
    return Beam(found, a, h, a + h * 0.5, count)


def _flat_across(patch: Patch, point: Sequence[Any], t: Any) -> Value:
    """Whether both derivatives of f across the pixel may vanish at this t, for any f that may have a root there.

    They are the same code for u and for v, so it is there once and runs twice: a formula's derivative is most of the
    kernel, and the time to compile grows with the text.
    """
    fields = list(patch.subject.fields())

    def narrow(symbol: Value, *so_far: Value) -> tuple[Value, ...]:
        return tuple(
            if_(flat, partial(_may_vanish, patch, lowered, t, symbol), lambda: (False,))[0]
            for flat, (_, _, lowered) in zip(so_far, fields, strict=True)
        )

    if patch.subject.shape.plain:
        (flat,) = for_(2, narrow, constant(True, BOOL))
        return flat
    open_ = [~(patch.clears(body, point) | body.free(leaf, patch.system, point)) for body, leaf, _ in fields]
    flat, *others = for_(2, narrow, *open_)
    for other in others:
        flat = flat | other
    return flat


def _may_vanish(patch: Patch, lowered: Lowered, t: Any, symbol: Value) -> tuple[Value]:
    """Whether the derivative of f along one symbol of the patch, 0 or 1, may vanish at this t."""
    dual = DualSystem(patch.system, 1)

    def across(base: Any) -> Any:
        # Affine in u and v: the form's own terms are its derivatives, scaled to the pixel.
        along_u, along_v = base.terms[:2]
        if isinstance(along_u, float) and isinstance(along_v, float):
            return Dual(dual, base, (None,))
        return Dual(dual, base, (patch.system.exact(symbol.eq(0).select(along_u, along_v)),))

    moved = [across(o) + across(d) * dual.lift(t) for o, d in zip(patch.origin, patch.direction, strict=True)]
    # Where f is constant piece by piece, its derivative is a literal.
    return (lift(lowered.evaluate(dual, *moved).derivative(0).contains_zero(), BOOL),)
