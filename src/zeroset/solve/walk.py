"""Ways of walking along a ray: which interval of t is examined next.

The certified search (``search.py``) looks at one interval at a time and says: nothing here, or narrow it, or it is as
narrow as it gets. A walk turns that into the next interval. ``Striding`` doubles its step after an empty interval and
narrows to what the affine form leaves; ``Bisecting`` walks the dyadic tree without a stack (K09 section 5.5);
``AxisBisecting`` does so along the dominant axis, so that lanes of a packet share slabs (K09 section 4.2).
"""

from __future__ import annotations

from typing import Protocol

from zeroset.kernel import BOOL, F32, I32, U32, Value, constant
from zeroset.solve.problem import Problem

State = tuple[Value, ...]
DEEPEST = 22
"""Depth of the dyadic trees: places k < 2^23 are exact in f32."""


class Walk(Protocol):
    """The next interval of t, from what was learnt about the last."""

    def start(self, problem: Problem) -> State:
        """State before the first interval."""

    def interval(self, problem: Problem, state: State) -> tuple[Value, Value]:
        """The interval [a, b] to examine; empty (b <= a) where nothing of it is on the ray's stretch."""

    def leave(self, problem: Problem, state: State, b: Value, leaf: Value) -> State:
        """After an interval is done with, up to ``b``; ``leaf`` where it was not excluded but as narrow as it gets."""

    def narrow(self, problem: Problem, state: State, left: Value, right: Value) -> State:
        """After an interval whose only candidates are in [left, right]."""

    def narrowest(self, problem: Problem, state: State, width: Value) -> Value:
        """Whether an interval of this width, in this state, is not to be narrowed further."""

    def deepest(self, state: State) -> Value:
        """Whether the walk cannot narrow any further, whatever is asked for."""

    def ended(self, problem: Problem, state: State) -> Value:
        """Whether the stretch is used up."""


class Striding:
    """Steps of free length: doubled after an empty interval, cut to the candidates otherwise.

    State: a and h, the next interval; edge and far: nothing is between them. What a cut has shown to be free behind the
    candidates is remembered, and passed over at once when they turn out to be none.
    """

    def start(self, problem: Problem) -> State:
        """The whole stretch, or its first step."""
        first = problem.step.minimum(problem.t1 - problem.t0).maximum(problem.tolerance)
        return problem.t0, first, problem.t1, problem.t1

    def interval(self, problem: Problem, state: State) -> tuple[Value, Value]:
        """Where to look next."""
        a, h, edge, _ = state
        return a, (a + h).minimum(edge)

    def leave(self, problem: Problem, state: State, b: Value, leaf: Value) -> State:
        """Go on behind the interval, and behind what is known to be free after it."""
        _, h, edge, far = state
        spent = b >= edge
        # A leaf may hold a root: what follows it must be looked at, for its sign.
        jump = spent & ~leaf
        step = leaf.select(problem.tolerance, jump.select((h * 2.0).maximum(far - edge), h * 2.0))
        return jump.select(far.maximum(b), b), step, spent.select(problem.t1, edge), spent.select(problem.t1, far)

    def narrow(self, problem: Problem, state: State, left: Value, right: Value) -> State:
        """Go into the interval."""
        width = right - left
        # A cut to less than half is worth trusting: examine just the candidates. Otherwise bisect.
        good = width < state[1] * 0.5
        _, b = self.interval(problem, state)
        # Only where all of the candidates were looked at does what was free behind them follow on.
        free = (b >= state[2]).select(state[3], b)
        return left, good.select(width, width * 0.5).maximum(problem.tolerance), right, free

    def narrowest(self, problem: Problem, state: State, width: Value) -> Value:
        """Whether it is as narrow as the tolerance asks."""
        # b = a + h is rounded, so the narrowest step may come out a little wider than the tolerance.
        return width <= problem.tolerance * 1.25

    def deepest(self, state: State) -> Value:
        """Whether the tree has no deeper level."""
        # A stride never falls below the tolerance.
        return constant(True, BOOL)

    def ended(self, problem: Problem, state: State) -> Value:
        """Whether nothing is left."""
        return state[0] >= problem.t1


def _place(problem: Problem, k: Value, d: Value) -> Value:
    """k 2**-d, exactly: k has at most 23 bits, and the power is made by bits."""
    power = ((constant(127, I32) - d) << 23).bitcast(F32)
    return (k.convert(F32) * power).convert(problem.type)


def _depth(length: Value, tolerance: Value) -> Value:
    """K09 eq. 16: how many bisections bring ``length`` under the tolerance, at most DEEPEST."""
    bits = (length / tolerance).maximum(1.0).minimum(2.0**DEEPEST).convert(F32).bitcast(I32)
    return ((bits + 0x007FFFFF) >> 23) - 127


def _next(k: Value, d: Value) -> tuple[Value, Value]:
    """The dyadic interval after (k, d): go up while this was a second child (K09: by floating-point remainders)."""
    k = k + 1
    low = (k & (constant(0, I32) - k)).convert(F32).bitcast(I32)
    twos = ((low >> 23) - 127).minimum(d)
    return k >> twos, d - twos


class Bisecting:
    """The dyadic tree over [t0, t1]. State: place k and depth d (i32): [t0 + k 2^-d L, t0 + (k+1) 2^-d L]."""

    def start(self, problem: Problem) -> State:
        """The whole stretch, or its first step."""
        return constant(0, I32), constant(0, I32)

    def _at(self, problem: Problem, k: Value, d: Value) -> Value:
        # The place is exact, so neighbours share their ends exactly.
        return _place(problem, k, d).fma(problem.t1 - problem.t0, problem.t0)

    def interval(self, problem: Problem, state: State) -> tuple[Value, Value]:
        """Where to look next."""
        k, d = state
        return self._at(problem, k, d), self._at(problem, k + 1, d)

    def leave(self, problem: Problem, state: State, b: Value, leaf: Value) -> State:
        """Go on behind the interval."""
        return _next(*state)

    def narrow(self, problem: Problem, state: State, left: Value, right: Value) -> State:
        """Go into the interval."""
        k, d = state
        return k << 1, d + 1

    def narrowest(self, problem: Problem, state: State, width: Value) -> Value:
        """Whether it is as narrow as the tolerance asks."""
        return state[1] >= _depth(problem.t1 - problem.t0, problem.tolerance)

    def deepest(self, state: State) -> Value:
        """Whether the tree has no deeper level."""
        return state[1] >= DEEPEST

    def ended(self, problem: Problem, state: State) -> Value:
        """Whether nothing is left."""
        return state[1].eq(0) & (state[0] > 0)


class AxisBisecting:
    """The dyadic tree over slabs of the dominant axis K, shared by the lanes of a packet. State: k, d (i32).

    The slabs tile the range of the lane's own coordinate along K, widened to a power-of-two grid that neighbouring
    rays share; what lies outside the lane's stretch of t is left at once.
    """

    def _axis(self, problem: Problem) -> tuple[Value, Value]:
        """Origin and direction along the dominant axis, the largest component of the direction."""
        (ox, oy, oz), (dx, dy, dz) = problem.ray.origin, problem.ray.direction
        y_over_x = abs(dy) > abs(dx)
        o, d = y_over_x.select(oy, ox), y_over_x.select(dy, dx)
        z_over = abs(dz) > abs(d)
        return z_over.select(oz, o), z_over.select(dz, d)

    def _grid(self, problem: Problem) -> tuple[Value, Value, Value]:
        """Start and signed length of the slab tree, and the inverse direction: t = (s - o) / d."""
        o, d = self._axis(problem)
        first, last = o + problem.t0 * d, o + problem.t1 * d
        # A power of two not below the length, and a start that is a multiple of a quarter of it: lanes agree on both
        # wherever their stretches are alike. Twice the length leaves room for the rounded start.
        bits = (abs(last - first) * 2.0).convert(F32).bitcast(U32)
        size = ((bits + 0x007FFFFF) & 0x7F800000).bitcast(F32).maximum(1e-30).convert(problem.type)
        quarter = size * 0.25
        steps = first / quarter
        start = (d > 0.0).select(steps.floor(), steps.ceil()) * quarter
        return start, (d > 0.0).select(size, -size), problem.number(1.0) / d

    def start(self, problem: Problem) -> State:
        """The whole stretch, or its first step."""
        return constant(0, I32), constant(0, I32)

    def _at(self, problem: Problem, k: Value, d: Value) -> Value:
        start, size, inverse = self._grid(problem)
        slab = _place(problem, k, d).fma(size, start)
        o, _ = self._axis(problem)
        return ((slab - o) * inverse).maximum(problem.t0).minimum(problem.t1)

    def interval(self, problem: Problem, state: State) -> tuple[Value, Value]:
        """Where to look next."""
        k, d = state
        # The tree's own ends are the stretch's ends: rounding in the grid must not cut the ray short.
        a = k.eq(0).select(problem.t0, self._at(problem, k, d))
        last = (k + 1).eq(constant(1, I32) << d)
        return a, last.select(problem.t1, self._at(problem, k + 1, d))

    def leave(self, problem: Problem, state: State, b: Value, leaf: Value) -> State:
        """Go on behind the interval."""
        return _next(*state)

    def narrow(self, problem: Problem, state: State, left: Value, right: Value) -> State:
        """Go into the interval."""
        k, d = state
        return k << 1, d + 1

    def narrowest(self, problem: Problem, state: State, width: Value) -> Value:
        """Whether it is as narrow as the tolerance asks."""
        return (width <= problem.tolerance) | (state[1] >= DEEPEST)

    def deepest(self, state: State) -> Value:
        """Whether the tree has no deeper level."""
        return state[1] >= DEEPEST

    def ended(self, problem: Problem, state: State) -> Value:
        """Whether nothing is left."""
        return state[1].eq(0) & (state[0] > 0)
