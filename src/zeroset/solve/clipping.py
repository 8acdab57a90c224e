"""How far along a ray a polynomial certainly has no root, seen on the polynomial that it is there.

Along a ray a polynomial surface is a polynomial in one unknown, and its Bernstein coefficients over a stretch of the
ray bound it there more tightly than any enclosure of the formula does: the bound is exact at the stretch's ends. A ray
that leaves a surface, from which an enclosure has to creep away, gets off it in one step, and one that meets nothing
more is mostly done with at once. The coefficients come from evaluating f on polynomials whose coefficients carry their
rounding (affine forms without symbols), taken around the start; from then on only splitting is needed, which is cheap.

References: Farouki and Rajan, On the numerical condition of polynomials in Bernstein form, CAGD 4 (1987),
doi:10.1016/0167-8396(87)90012-4; Sederberg and Nishita, Curve intersection using Bézier clipping, CAD 22 (1990),
doi:10.1016/0010-4485(90)90039-F.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import reduce
from itertools import pairwise

from zeroset.arith import AffineSystem, PolySystem
from zeroset.kernel import U32, Value, constant, while_
from zeroset.solve.problem import Problem

HIGHEST = 6
"""Degree up to which this pays: the coefficients' cost and rounding grow with it."""
LOOKS = 12
"""Splits after which a ray is left to the search."""
NEAR = 8.0
"""Tolerances that are not worth a split, and that a search begins before the first possible root, to learn the sign
that f has there."""
BEGIN = 0.25
"""Share of the stretch that is tried first."""


def can_clip(problem: Problem) -> bool:
    """Whether f is a polynomial of a degree that is treated, and f = 0 is all that is searched."""
    if problem.body is not None:
        return False
    degree = problem.lowered.field.degree
    return degree is not None and 1 <= degree <= HIGHEST


def clipped(problem: Problem) -> Problem:
    """The problem without a first part that certainly holds no root; with nothing left of it where none does."""
    if not can_clip(problem):
        return problem
    length = (problem.t1 - problem.t0).maximum(0.0) * (1.0 + 2.0**-20)
    near = problem.tolerance * NEAR / length.maximum(1e-30)
    share, none = _free_share(problem, _floor(problem, length), near)
    start = (share * (1.0 - 2.0**-20)).fma(length, problem.t0) - problem.tolerance * NEAR
    # Lanes without a stretch have nothing to be found on either.
    none = none | ~(problem.t1 > problem.t0)
    return replace(problem, t0=none.select(problem.t1, start.maximum(problem.t0)))


def _floor(problem: Problem, length: Value) -> list[Value]:
    """Control points of a polynomial that is nowhere above |f| from t0 to t0 + length, as far as f keeps its first
    sign; the first one is not positive where that sign is not known."""
    degree = problem.lowered.field.degree
    assert degree is not None
    inner = AffineSystem(problem.fmt, symbols=0)
    system = PolySystem(inner, degree)
    along = []
    for o, d in zip(problem.ray.origin, problem.ray.direction, strict=True):
        start = inner.exact(o) + inner.exact(d) * inner.exact(problem.t0)
        along.append(system.linear(start, inner.exact(d) * inner.exact(length)))
    f = problem.lowered.evaluate(system, *along)
    points = [f.coefficient(k) * inner.constant(*_reciprocal(math.comb(degree, k))) for k in range(degree + 1)]
    # The binomial transform: each round adds to every point the one before it.
    for first in range(1, degree + 1):
        for j in range(degree, first - 1, -1):
            points[j] = points[j] + points[j - 1]
    bounds = [point.interval() for point in points]
    lows, highs = ([problem.lift(v) for v in side] for side in ([b.lo for b in bounds], [b.hi for b in bounds]))
    negative = highs[0] < 0.0
    return [negative.select(-high, low) for low, high in zip(lows, highs, strict=True)]


def _reciprocal(n: int) -> tuple[float, float]:
    """Bounds of 1 / n, which a double mostly holds but roughly."""
    near = 1.0 / n
    return (near, near) if n & (n - 1) == 0 else (math.nextafter(near, 0.0), math.nextafter(near, 2.0))


def _largest(values: Sequence[Value]) -> Value:
    return reduce(lambda a, b: a.maximum(b), values)


def _free_share(problem: Problem, points: list[Value], near: Value) -> tuple[Value, Value]:
    """The share of the stretch on which a polynomial is certainly positive from the start, and whether that is all.

    Args:
        problem: for its type and format.
        points: control points over the stretch.
        near: the share that is not worth a split.
    """
    degree, size = len(points) - 1, _largest([abs(p) for p in points])
    # A split rounds each point by 3 eps of the largest that goes into it, once in each of as many rounds as the degree.
    unit = problem.fmt.eps * 4.0 * degree

    def running(active: Value, *state: Value) -> Value:
        return active

    def look(active: Value, count: Value, share: Value, step: Value, error: Value, *points: Value) -> tuple[Value, ...]:
        rest = 1.0 - share
        # It stays above the line from the first point that falls as steeply as any other asks.
        fall = _largest([(points[0] - p) * (degree / j) for j, p in enumerate(points) if j])
        line = (points[0] - error) / size.fma(unit, fall.maximum(0.0)).maximum(1e-30) * (1.0 - 2.0**-18)
        sure = line * rest >= step * 0.5
        at = sure.select(line, step / rest).minimum(0.5).maximum(0.0)
        left, right = _split(points, at)
        free = sure | _positive(left, points, error, unit)
        kept = [free.select(r, p) for r, p in zip(right, points, strict=True)]
        after = free.select(size.fma(unit, error), error)
        end = reduce(lambda a, b: a & b, [p > after for p in kept])
        passed = free.select(at.fma(rest, share), share)
        following = free.select(at * rest * 2.0, at * rest * 0.25)
        going = ~end & (following > near) & (count < LOOKS - 1)
        return going, count + 1, end.select(1.0, passed), following, after, *kept

    none = reduce(lambda a, b: a & b, [p > 0.0 for p in points])
    begins = (points[0] > 0.0) & ~none
    zero = problem.number(0.0)
    state = while_(running, look, begins, constant(0, U32), zero, problem.number(BEGIN), zero, *points)
    return state[2], none | (state[2] >= 1.0)


def _positive(left: Sequence[Value], points: Sequence[Value], error: Value, unit: float) -> Value:
    """Whether the first part of a split is certainly positive; each of its points comes of those up to it."""
    positive, largest = left[0] > error, abs(points[0])
    for own, point in zip(left[1:], points[1:], strict=True):
        largest = largest.maximum(abs(point))
        positive = positive & (own > largest.fma(unit, error))
    return positive


def _split(points: Sequence[Value], at: Value) -> tuple[list[Value], list[Value]]:
    """De Casteljau's scheme: the control points on either side of a place."""
    row, left = list(points), [points[0]]
    right = [points[-1]]
    while len(row) > 1:
        row = [at.fma(b - a, a) for a, b in pairwise(row)]
        left.append(row[0])
        right.append(row[-1])
    return left, right[::-1]
