"""Mitchell's method: the interval gradient isolates monotone pieces, then a root is refined (K09 6.1.3, SN10 alg. 4).

On each interval the enclosures of f and of its derivative along the ray are evaluated together. Without a zero of f it
is left; without a zero of the derivative f is monotone there and holds at most one root, found by bisection with
enclosures at single points; otherwise it is halved. A monotone piece whose ends have certain, opposite signs is a HIT;
certain and equal signs leave it; ends whose signs cannot be told are UNRESOLVED.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from zeroset.arith import DualSystem, IntervalSystem
from zeroset.kernel import BOOL, U32, Value, constant, if_, lift, while_
from zeroset.solve.method import Method, register
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.status import HIT, MISS, UNRESOLVED


def sign_of(problem: Problem, interval: Any) -> Value:
    """+1 or -1 where an enclosure has one certain sign, else 0."""
    low, high = problem.lift(interval.lo), problem.lift(interval.hi)
    return (low > 0.0).select(problem.number(1.0), (high < 0.0).select(problem.number(-1.0), 0.0))


@register
@dataclass(frozen=True)
class Mitchell(Method):
    """Interval gradient, monotone pieces, bisection."""

    name: ClassVar[str] = "mitchell"
    certified: ClassVar[bool] = True
    summary: ClassVar[str] = "interval gradient isolates monotone pieces, then refines (K09 6.1.3)"

    def trace(self, problem: Problem) -> Answer:
        """Emit the search for the first root."""
        return isolate(problem, _IntervalPieces(problem))


class _IntervalPieces:
    """Enclosures of f and F' by interval arithmetic."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._plain = IntervalSystem(problem.fmt)
        self._dual = DualSystem(self._plain, 1)

    def point(self, t: Value) -> Value:
        """The certain sign of f at one t, or 0."""
        return sign_of(self._problem, self._problem.lowered.along(self._plain, self._problem.ray, self._plain.exact(t)))

    def piece(self, a: Value, b: Value) -> tuple[Value, Value, Value]:
        """Over [a, b]: whether f excludes 0, the certain sign of F' or 0, whether f is continuous there."""
        middle = (a + b) * 0.5
        half = (b - middle).maximum(middle - a) * (1.0 + 2.0**-20)
        t = self._dual.variable(self._plain.enclose(middle, half), 0)
        f = self._problem.lowered.along(self._dual, self._problem.ray, t)
        whole = f.value.defined & f.derivative(0).defined
        slope = sign_of(self._problem, f.derivative(0))
        slope = lift(whole, BOOL).select(slope, 0.0)
        return ~lift(f.value.contains_zero(), BOOL), slope, lift(whole, BOOL)


def isolate(problem: Problem, pieces: Any) -> Answer:
    """SN10 algorithm 4 without recursion: from the left, halving what is neither excluded nor monotone.

    The state keeps a stretch [a, a + h]; an empty or spent one is left with a doubled step. A monotone stretch turns
    the lane to refining: [a, b] is bisected towards the side where f would cross, then its ends are judged.
    """
    tolerance = problem.tolerance

    def running(
        a: Value, h: Value, b: Value, slope: Value, status: Value, t: Value, done: Value, steps: Value
    ) -> Value:
        return ~done

    def search(a: Value, h: Value) -> tuple[Value, ...]:
        end = (a + h).minimum(problem.t1)
        excluded, slope, _ = pieces.piece(a, end)
        monotone = ~excluded & slope.ne(0.0)
        stuck = ~excluded & ~monotone & (end - a <= tolerance * 1.25)
        # Halved where it is neither, left behind where it is excluded.
        return (
            excluded.select(end, a),
            excluded.select(h * 2.0, (h * 0.5).maximum(tolerance)),
            end,
            monotone.select(slope, 0.0),
            stuck.select(constant(UNRESOLVED, U32), MISS),
        )

    def turn(
        a: Value, h: Value, b: Value, slope: Value, status: Value, t: Value, done: Value, steps: Value
    ) -> tuple[Value, ...]:
        a2, h2, b2, slope2, status2 = search(a, h)
        wanted = slope2.ne(0.0)

        def refine() -> tuple[Value, ...]:
            def wide(left: Value, right: Value, known: Value, count: Value) -> Value:
                return (right - left > tolerance) & known

            def halve(left: Value, right: Value, known: Value, count: Value) -> tuple[Value, ...]:
                middle = (left + right) * 0.5
                side = pieces.point(middle) * slope2
                # An uncertain middle: close in on it, since f is monotone and so nearly zero there.
                return (
                    (side < 0.0).select(middle, left),
                    (side > 0.0).select(middle, right),
                    side.ne(0.0),
                    count + 1,
                )

            left, right, known, count = while_(wide, halve, a2, b2, constant(True, done.type), constant(0, U32))
            # Where the middle's sign is uncertain, a tolerance around it holds whatever root there is.
            centre = (left + right) * 0.5
            left = known.select(left, (centre - tolerance).maximum(left))
            right = known.select(right, (centre + tolerance).minimum(right))
            before, after = pieces.point(left) * slope2, pieces.point(right) * slope2
            hit = (before < 0.0) & (after > 0.0)
            # Only the piece's own ends can tell that there is nothing; ends drawn around an uncertain middle cannot.
            nothing = known & ((before > 0.0) | (after < 0.0))
            verdict = hit.select(constant(HIT, U32), nothing.select(constant(MISS, U32), UNRESOLVED))
            return verdict, (left + right) * 0.5, count + 2

        verdict, root, spent = if_(wanted, refine, lambda: (constant(MISS, U32), a2, constant(0, U32)))
        passed = wanted & verdict.eq(MISS)
        a3, h3 = passed.select(b2, a2), passed.select(h2 * 4.0, h2)
        found = wanted.select(verdict, status2)
        over = found.ne(MISS) | (a3 >= problem.t1)
        where = wanted.select(root, (a2 + b2) * 0.5)
        return a3, h3, b2, slope2, found, where, over, steps + spent + 1

    zero, none = problem.number(0.0), constant(0, U32)
    outside = ~(problem.t1 > problem.t0)
    step = problem.step.minimum(problem.t1 - problem.t0).maximum(tolerance)
    state = while_(running, turn, problem.t0, step, problem.t0, zero, none, problem.t0, outside, none)
    # f runs through a root the way it slopes.
    return Answer(state[5], state[4], state[7], state[0], -state[3], state[5] + tolerance)
