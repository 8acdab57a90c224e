"""How far along a ray a polynomial certainly has no root, seen on the polynomial that it is there.

Along a ray a polynomial surface is a polynomial in one unknown, and its Bernstein coefficients over a stretch of the
ray bound it there more tightly than any enclosure of the formula does: the bound is exact at the stretch's ends. A ray
that leaves a surface, from which an enclosure has to creep away, gets off it in one step, and one that meets nothing
more is mostly done with at once. The coefficients are computed as they are, around the start, with one bound for all
that is rounded in them (``arith.majorant``); f at the start itself, which decides whether a ray gets off a surface, is
enclosed on its own. From then on only splitting is needed, which is cheap.

References: Farouki and Rajan, On the numerical condition of polynomials in Bernstein form, CAGD 4 (1987),
doi:10.1016/0167-8396(87)90012-4; Sederberg and Nishita, Curve intersection using Bézier clipping, CAD 22 (1990),
doi:10.1016/0010-4485(90)90039-F.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce
from itertools import pairwise
from typing import Any, NamedTuple

from zeroset.arith import AffineSystem, MajorantSystem, NotPolynomialError, PolySystem, RealSystem
from zeroset.kernel import BOOL, U32, Value, constant, while_
from zeroset.solve.problem import Problem

HIGHEST = 6
"""Degree up to which this pays: the coefficients' cost and rounding grow with it."""
LOW = 4
"""Degree up to which it pays even for rays that a beam has brought close to what they meet."""
LOOKS = 12
"""Splits after which a ray is left to the search."""
NEAR = 8.0
"""Tolerances that are not worth a split, and that a search begins before the first possible root, to learn the sign
that f has there."""
BEGIN = 0.5
"""Share of the stretch that is tried first."""


def can_clip(problem: Problem, highest: int = HIGHEST) -> bool:
    """Whether f is a polynomial of a degree that is treated, and f = 0 is all that is searched."""
    if problem.body is not None or problem.lowered.field.large:
        return False
    degree = problem.lowered.field.degree
    return degree is not None and 1 <= degree <= highest


def clipped(problem: Problem) -> Problem:
    """The problem without a first part that certainly holds no root; with nothing left of it where none does."""
    if not can_clip(problem):
        return problem
    length = _length(problem)
    free = _free(problem, _floor(problem, length), length)
    return _rest(problem, length, free)


def looked_over(problem: Problem, wanted: Value) -> tuple[Problem, Value]:
    """The problem clipped, and where there certainly is a root, wherever it lies.

    Args:
        problem: one that can be clipped.
        wanted: lanes that ask.
    """
    length = _length(problem)
    free = _free(problem, _floor(problem, length), length, wanted)
    return _rest(problem, length, free), free.crossed


def _length(problem: Problem) -> Value:
    """How long the stretch is, or a hair more."""
    return (problem.t1 - problem.t0).maximum(0.0) * (1.0 + 2.0**-20)


def _rest(problem: Problem, length: Value, free: _Free) -> Problem:
    """What is left to be searched, with a first step that goes as far behind the first root as its tangent tells."""
    start = (free.share * (1.0 - 2.0**-20)).fma(length, problem.t0) - problem.tolerance * NEAR
    # Lanes without a stretch have nothing to be found on either.
    none = free.none | ~(problem.t1 > problem.t0)
    start = none.select(problem.t1, start.maximum(problem.t0))
    step = free.aim * length * 2.0 + problem.tolerance * (NEAR * 2.0)
    return problem._replace(t0=start, step=step.minimum((problem.t1 - start) * 0.125))


class _Floor(NamedTuple):
    """A polynomial below f or -f along a stretch, whichever is positive where that starts.

    Attributes:
        points: its control points; the first one is not positive where the sign at the start is not known.
        gap: how far at most f or -f is above it.
    """

    points: list[Value]
    gap: Value


def _floor(problem: Problem, length: Value) -> _Floor:
    """The polynomial from t0 to t0 + length, as far as f keeps its first sign."""
    try:
        return _quick_floor(problem, length)
    except NotPolynomialError:
        # Formulas with functions of their parameters, or with sums: the rounding of each coefficient is followed.
        return _careful_floor(problem, length)


def _quick_floor(problem: Problem, length: Value) -> _Floor:
    """From real coefficients: their rounding is bounded all at once, but for the first one, which is to be exact."""
    degree, fmt = _degree(problem), problem.fmt
    reals, sizes, inner = RealSystem(fmt), MajorantSystem(fmt), AffineSystem(fmt, symbols=0)
    system = PolySystem(reals, degree)
    begin, along, majorants = [], [], []
    for o, d in zip(problem.ray.origin, problem.ray.direction, strict=True):
        begin.append(inner.exact(o) + inner.exact(d) * inner.exact(problem.t0))
        slope = d * length
        along.append(system.linear(reals.exact(begin[-1].centre), reals.exact(slope)))
        moved = d * problem.t0
        size, error = abs(begin[-1].centre) + abs(slope), (abs(moved) + abs(o) + abs(slope)) * (4.0 * fmt.eps)
        majorants.append(sizes.linear(size, error))
    start = problem.lowered.evaluate(inner, *begin).interval()
    f = problem.lowered.evaluate(system, *along)
    # Beside those of the coefficients: of the reciprocal and the product with it, of each sum, and three below.
    error = problem.lift(problem.lowered.evaluate(sizes, *majorants).bound(degree + 5))
    low, high = problem.lift(start.lo), problem.lift(start.hi)
    negative = high < 0.0
    first = negative.select(-high, low)
    points = [problem.number(0.0)] + [problem.lift(f.coefficient(k).value) for k in range(1, degree + 1)]
    points = _controls([p * (1.0 / math.comb(degree, k)) for k, p in enumerate(points)])
    # A control point is a mean of coefficients: the j-th of n holds no more than j/n of any but the first.
    below = [negative.select(-p, p) - error * (j / degree) for j, p in enumerate(points)]
    gap = (high - low + error * 2.0 + abs(first) * (16.0 * fmt.eps)) * (1.0 + 2.0**-20)
    return _Floor([first, *(first * (1.0 - 4.0 * fmt.eps) + p for p in below[1:])], gap)


def _careful_floor(problem: Problem, length: Value) -> _Floor:
    """From coefficients that carry their rounding: affine forms without symbols."""
    degree = _degree(problem)
    inner = AffineSystem(problem.fmt, symbols=0)
    system = PolySystem(inner, degree)
    along = []
    for o, d in zip(problem.ray.origin, problem.ray.direction, strict=True):
        start = inner.exact(o) + inner.exact(d) * inner.exact(problem.t0)
        along.append(system.linear(start, inner.exact(d) * inner.exact(length)))
    f = problem.lowered.evaluate(system, *along)
    points = [f.coefficient(k) * inner.constant(*_reciprocal(math.comb(degree, k))) for k in range(degree + 1)]
    bounds = [point.interval() for point in _controls(points)]
    lows, highs = ([problem.lift(v) for v in side] for side in ([b.lo for b in bounds], [b.hi for b in bounds]))
    negative = highs[0] < 0.0
    points = [negative.select(-high, low) for low, high in zip(lows, highs, strict=True)]
    gap = _largest([high - low for low, high in zip(lows, highs, strict=True)]) * (1.0 + 2.0**-20)
    return _Floor(points, gap)


def _degree(problem: Problem) -> int:
    degree = problem.lowered.field.degree
    assert degree is not None
    return degree


def _controls(points: list[Any]) -> list[Any]:
    """The binomial transform: each round adds to every point the one before it."""
    points = list(points)
    for first in range(1, len(points)):
        for j in range(len(points) - 1, first - 1, -1):
            points[j] = points[j] + points[j - 1]
    return points


def _reciprocal(n: int) -> tuple[float, float]:
    """Bounds of 1 / n, which a double mostly holds but roughly."""
    near = 1.0 / n
    return (near, near) if n & (n - 1) == 0 else (math.nextafter(near, 0.0), math.nextafter(near, 2.0))


def _largest(values: Sequence[Value]) -> Value:
    return reduce(lambda a, b: a.maximum(b), values)


class _Free(NamedTuple):
    """Where a polynomial is certainly positive, in shares of the stretch that it is given over.

    Attributes:
        share: from the start up to here.
        none: on all of it.
        aim: how far behind ``share`` its tangent meets zero; no promise.
        crossed: whether it certainly is negative somewhere; only lanes that ask for it are looked at.
    """

    share: Value
    none: Value
    aim: Value
    crossed: Value


AFAR = 4.0
"""Where a tangent meets zero that does not."""


def _free(problem: Problem, floor: _Floor, length: Value, asked: Value | None = None) -> _Free:
    """Where a polynomial is certainly positive.

    Args:
        problem: for its type and tolerance.
        floor: the polynomial.
        length: of the stretch.
        asked: lanes that want to know no more than whether it is positive on all of it; None for where it is.
    """
    near = problem.tolerance * NEAR / length.maximum(1e-30)
    points = floor.points
    degree, size = len(points) - 1, _largest([abs(p) for p in points])
    # A split rounds each point by 3 eps of the largest that goes into it, once in each of as many rounds as the degree.
    unit = problem.fmt.eps * 4.0 * degree
    # Who asks for a change of sign alone looks where the polynomial may be negative already.
    beyond = 1.0 if asked is None else 2.0

    def running(active: Value, *state: Value) -> Value:
        return active

    def look(
        active: Value, crossed: Value, count: Value, share: Value, step: Value, error: Value, aim: Value, *now: Value
    ) -> tuple[Value, ...]:
        rest = 1.0 - share
        # It stays above the line from the first point that falls as steeply as any other asks.
        fall = _largest([(now[0] - p) * (degree / j) for j, p in enumerate(now) if j])
        line = (now[0] - error) / size.fma(unit, fall.maximum(0.0)).maximum(1e-30) * (1.0 - 2.0**-18)
        sure = line * rest >= step * 0.5
        at = sure.select(line, step / rest).minimum(0.5).maximum(0.0)
        left, right = _split(now, at)
        free = sure | _positive(left, now, error, unit)
        kept = [free.select(r, p) for r, p in zip(right, now, strict=True)]
        after = size.fma(unit, error)
        if asked is not None:
            crossed = right[0] + (floor.gap + after) < 0.0
        error = free.select(after, error)
        end = reduce(lambda a, b: a & b, [p > error for p in kept])
        walked = at * rest
        share = free.select(at.fma(rest, share), share)
        falls = kept[0] > kept[1]
        slope = falls.select((kept[0] - kept[1]) * degree, 1.0)
        aim = falls.select(kept[0] / slope * (1.0 - share), AFAR)
        following = free.select((walked * 2.0).minimum(aim * beyond), walked * 0.25)
        going = ~end & ~crossed & (following > near) & (count < LOOKS - 1)
        return going, crossed, count + 1, end.select(1.0, share), following, error, aim, *kept

    none = reduce(lambda a, b: a & b, [p > 0.0 for p in points])
    crossed = constant(False, BOOL) if asked is None else (points[0] > 0.0) & (points[-1] + floor.gap < 0.0)
    begins = (points[0] > 0.0) & ~none & ~crossed
    if asked is not None:
        begins = begins & asked
    zero = problem.number(0.0)
    start = (constant(0, U32), zero, problem.number(BEGIN), zero, problem.number(AFAR))
    _, crossed, _, share, _, _, aim, *_ = while_(running, look, begins, crossed, *start, *points)
    return _Free(share, none | (share >= 1.0), aim, crossed)


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
