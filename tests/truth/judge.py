"""The judge: where a ray first meets f = 0, certified by Arb.

``Judge.first_root`` takes the exact real ray through a float32 origin and direction and the exact bounds, and lists
from the left what is on it: certain roots, and places where Arb could not exclude one; everything between them is
certainly free of roots. It stops at the first certain root well inside the bounds.

Polynomials over the rationals and one square root are treated exactly (``surds.py``): nothing stays open there.
Everything else is bisected on balls with a derivative: f excluded, mean value form excluded, monotone with signs at
the ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from typing import Any

import numpy as np
from flint import arb, fmpq

from zeroset import Ball, Surface

from .jets import ONE, ZERO, Jet, hull, precise
from .surds import Surd
from .tape import Tape, rational

EDGE = 4.0
"""A root within so many tolerances of the bounds, or of the ray's start, may be found or not."""
NARROW = 2.0**-36
"""Relative width at which the judge stops bisecting."""
WORK = 3000
"""Evaluations that the judge spends on one ray, unless told otherwise."""
FINE = 2.0**-14
"""The default tolerance, relative to the bounds' extent."""
FAR = 1e30


class Kind(Enum):
    """What is certain of a place on the ray."""

    CROSS = "a root where f changes sign"
    TOUCH = "a root where f keeps its sign"
    LINE = "roots everywhere: the ray lies in the surface"
    OPEN = "neither excluded nor certain"


@dataclass(frozen=True)
class Event:
    """A place [a, b] on the ray; ``edge``: close to where the bounds or the ray begin or end."""

    a: float
    b: float
    kind: Kind
    edge: bool


@dataclass(frozen=True)
class Verdict:
    """What is on a ray, in order; between events f certainly has no root.

    Attributes:
        events: from the left, up to the first certain root that is no edge.
        tolerance: the effective one in units of t: at least 2^-20 of the farthest t, below which f32 has no steps.
        stretch: where on the ray an answer may lie at all; None where the ray misses the bounds.
        work: evaluations spent; 0 for an exact answer.
    """

    events: tuple[Event, ...]
    tolerance: float
    stretch: tuple[float, float] | None
    work: int

    @property
    def root(self) -> Event | None:
        """The first certain root that must be found."""
        return next((e for e in self.events if e.kind is not Kind.OPEN and not e.edge), None)

    @property
    def settled(self) -> bool:
        """Whether Arb could tell everything."""
        return all(e.kind is not Kind.OPEN for e in self.events)


Interval = tuple[Any, Any]


class Line:
    """The exact ray, and the stretches of t inside the bounds widened and narrowed by a distance."""

    def __init__(self, surface: Surface, origin: Sequence[float], direction: Sequence[float]) -> None:
        precise()
        self.origin = [rational(float(np.float32(v))) for v in origin]
        self.direction = [rational(float(np.float32(v))) for v in direction]
        self.length = float(np.linalg.norm(np.asarray(direction, dtype=np.float64)))
        self._bounds = surface.fitted
        exact = self._inside(0.0)
        tolerance = FINE * self._bounds.extent / self.length
        self.tolerance = tolerance
        if exact is not None:
            self.tolerance = max(tolerance, 2.0**-20 * max(abs(float(exact[0].mid())), abs(float(exact[1].mid()))))

    def stretch(self, wider: float, t_min: float, t_max: float) -> Interval | None:
        """The stretch inside the bounds moved outwards by so many tolerances, and inside the ray's range likewise."""
        slack = wider * self.tolerance
        found = self._inside(slack * self.length)
        if found is None:
            return None
        a, b = found[0].max(arb(max(t_min, -FAR)) - slack), found[1].min(arb(min(t_max, FAR)) + slack)
        return (a.mid(), b.mid()) if a < b else None

    def _inside(self, wider: float) -> Interval | None:
        bounds = self._bounds
        if not isinstance(bounds, Ball):
            return self._in_box(bounds, wider)
        radius = arb(bounds.radius) + wider
        if radius < 0:
            return None
        to = [arb(rational(c) - o) for c, o in zip(bounds.center, self.origin, strict=True)]
        d = [arb(v) for v in self.direction]
        square = sum((v * v for v in d), ZERO)
        middle = sum((u * v for u, v in zip(to, d, strict=True)), ZERO) / square
        inside = radius * radius - sum(((u - middle * v) ** 2 for u, v in zip(to, d, strict=True)), ZERO)
        if not inside > 0:
            return None
        half = (inside / square).sqrt()
        return middle - half, middle + half

    def _in_box(self, bounds: Any, wider: float) -> Interval | None:
        a, b = arb(-FAR), arb(FAR)
        for o, d, least, most in zip(self.origin, self.direction, bounds.min, bounds.max, strict=True):
            ends = [rational(least) - rational(wider) - o, rational(most) + rational(wider) - o]
            if d == 0:
                if ends[0] > 0 or ends[1] < 0:
                    return None
                continue
            ends = sorted(end / d for end in ends)
            a, b = a.max(arb(ends[0])), b.min(arb(ends[1]))
        return (a, b) if a < b else None


class Judge:
    """Judges rays at one surface."""

    def __init__(self, surface: Surface, work: int = WORK) -> None:
        self.surface = surface
        self._work = work
        self._tape = Tape(surface)
        self._constants = self._tape.jets()

    def first_root(
        self,
        origin: Sequence[float],
        direction: Sequence[float],
        t_min: float = 0.0,
        t_max: float = math.inf,
    ) -> Verdict:
        """What the exact ray meets, at the default tolerance."""
        line = Line(self.surface, origin, direction)
        outer, inner = line.stretch(EDGE, t_min, t_max), line.stretch(-EDGE, t_min, t_max)
        if outer is None:
            return Verdict((), line.tolerance, None, 0)
        work = Work(self._work)
        polynomial = self._tape.polynomial(line.origin, line.direction)
        found = _exact(polynomial, outer) if polynomial is not None else _bisected(self._tape, line, outer, work)
        events: list[Event] = []
        for a, b, kind in found:
            inside = inner is not None and bool(a >= inner[0]) and bool(b <= inner[1])
            if kind is Kind.LINE and inner is not None:
                # To be found at once, wherever exactly the bounds begin.
                a, b, inside = outer[0], inner[0], True
            events.append(Event(float(a), float(b), kind, not inside))
            if inside and kind is not Kind.OPEN:
                break
        return Verdict(tuple(events), line.tolerance, (float(outer[0]), float(outer[1])), work.spent)

    def gradient(self, point: Sequence[float]) -> tuple[float, float, float]:
        """The gradient of f at a point; nan where there is none."""
        x, y, z = (self._slope(point, axis) for axis in range(3))
        return x, y, z

    def _slope(self, point: Sequence[float], axis: int) -> float:
        numbers = [Jet(arb(float(v)), ONE if k == axis else ZERO) for k, v in enumerate(point)]
        slope = self._tape.run(numbers, self._constants).d
        return float(slope.mid()) if slope is not None and slope.is_finite() else math.nan


Found = Iterator[tuple[Any, Any, Kind]]


def _exact(polynomial: Surd, outer: Interval) -> Found:
    """All roots on the stretch."""
    if polynomial.is_zero:
        yield outer[0], outer[1], Kind.LINE
        return
    for root, times in polynomial.roots():
        if not (root < outer[0] or root > outer[1]):
            yield root.lower(), root.upper(), Kind.CROSS if times % 2 else Kind.TOUCH


class _OutOfWork(Exception):  # noqa: N818 -- no error, an answer
    pass


@dataclass
class Work:
    """Evaluations that one ray may cost, and has cost."""

    limit: int
    spent: int = 0

    def spend(self) -> None:
        self.spent += 1
        if self.spent > self.limit:
            raise _OutOfWork


def _bisected(tape: Tape, line: Line, outer: Interval, work: Work) -> Found:
    """Events of any f, by balls; places that stay open and lie side by side are one."""
    cells = _Cells(tape, line, work)
    start: Any = None
    end: Any = None
    try:
        for a, b, kind in cells.search(*outer):
            if start is not None and (kind is not Kind.OPEN or a > end):
                yield start, end, Kind.OPEN
                start = None
            if kind is Kind.OPEN:
                start, end = a if start is None else start, b
            else:
                yield a, b, kind
    except _OutOfWork:
        start, end = cells.clear if start is None else start, outer[1]
    if start is not None:
        yield start, end, Kind.OPEN


class _Cells:
    """Bisection from the left. ``clear``: everything before it has been dealt with."""

    def __init__(self, tape: Tape, line: Line, work: Work) -> None:
        self._tape = tape
        self._constants = tape.jets()
        self._line = [(arb(o), arb(d)) for o, d in zip(line.origin, line.direction, strict=True)]
        self._work = work
        self.clear: Any = ZERO

    def _f(self, t: Any) -> Jet:
        self._work.spend()
        found = self._tape.run([Jet(o + t * d, d) for o, d in self._line], self._constants)
        assert isinstance(found, Jet)
        return found

    def _sign(self, t: Any) -> int:
        f = self._f(t)
        return 0 if f.empty or not f.whole else (f.v > 0) - (f.v < 0)

    def search(self, start: Any, end: Any) -> Found:
        # Not by halves: rays through symmetric places have their roots at simple fractions of the stretch.
        cuts = [start + (end - start) * fmpq(k * 1021 + 17, 8201) for k in range(1, 8)]
        ends = [start, *(cut.mid() for cut in cuts), end]
        stack = [(a, b) for a, b in pairwise(ends)][::-1]
        least = (end - start) * NARROW
        while stack:
            a, b = stack.pop()
            self.clear = a
            f = self._f(hull(a, b))
            if f.empty or f.v > 0 or f.v < 0:
                continue
            middle = (a + (b - a) * fmpq(4871, 10007)).mid()
            slope = f.d if f.whole and f.d is not None and f.d.is_finite() else None
            if slope is not None and (slope > 0 or slope < 0):
                yield from self._monotone(a, b, slope, least)
                continue
            if slope is not None:
                value = self._f(middle).v + slope * (hull(a, b) - middle)
                if value > 0 or value < 0:
                    continue
            if b - a > least:
                stack += [(middle, b), (a, middle)]
            else:
                crosses = f.whole and self._sign(a) * self._sign(b) < 0
                yield a, b, Kind.CROSS if crosses else Kind.OPEN

    def _monotone(self, a: Any, b: Any, slope: Any, least: Any) -> Found:
        """At most one root, told by the signs at the ends; a root on an end is found with a little more room."""
        up = 1 if slope > 0 else -1
        left, right = self._sign(a) * up, self._sign(b) * up
        if left > 0 or right < 0:
            return
        if left == 0 or right == 0:
            a, b = (a - least).mid() if left == 0 else a, (b + least).mid() if right == 0 else b
            if not (self._f(hull(a, b)).whole and self._sign(a) * up < 0 < self._sign(b) * up):
                yield a, b, Kind.OPEN
                return
        while b - a > least:
            middle = (a + (b - a) * fmpq(4871, 10007)).mid()
            newton = middle - self._f(middle).v / slope
            a = a.max(newton.lower()).mid() if newton.is_finite() else a
            b = b.min(newton.upper()).mid() if newton.is_finite() else b
            if b - a > least:
                cut = (a + (b - a) * fmpq(4871, 10007)).mid()
                side = self._sign(cut) * up
                if side == 0:
                    a, b = a.max(cut - least), b.min(cut + least)
                    break
                a, b = (cut, b) if side < 0 else (a, cut)
        yield a.mid(), b.mid(), Kind.CROSS
