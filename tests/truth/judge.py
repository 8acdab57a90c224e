"""The judge: where a ray first meets f = 0, certified by Arb.

``judge`` takes the exact real ray through a float32 origin and direction and the exact bounds, and lists from the
left what is on it: certain roots, and places where Arb could not exclude one; everything between them is certainly
free of roots. It stops at the first certain root well inside the bounds.

Polynomials with rational coefficients are treated exactly: f along the ray has rational coefficients too, its roots are
isolated by FLINT with their multiplicities, and nothing stays open. Everything else is bisected on balls with a derivative:
f excluded, mean value form excluded, monotone with signs at the ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import lru_cache
from typing import Any

import numpy as np
from flint import arb, fmpq

from zeroset import Ball, Surface
from zeroset.render.render import default_tolerance

from .jets import ONE, ZERO, Jet, hull, precise
from .tape import Tape, rational

EDGE = 4.0
"""A root within so many tolerances of the bounds, or of the ray's start, may be found or not."""
NARROW = 2.0**-36
"""Relative width at which the judge stops bisecting."""
WORK = 6000
"""Evaluations that the judge spends on one ray."""
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
        tolerance: the effective one in units of t: at least 2^-20 of the farthest t, as `Problem` says.
        work: evaluations spent; 0 for an exact answer.
    """

    events: tuple[Event, ...]
    tolerance: float
    work: int

    @property
    def root(self) -> Event | None:
        """The first certain root that must be found."""
        return next((e for e in self.events if e.kind is not Kind.OPEN and not e.edge), None)

    @property
    def settled(self) -> bool:
        """Whether Arb could tell everything."""
        return all(e.kind is not Kind.OPEN for e in self.events)


@lru_cache(maxsize=256)
def _tape(surface: Surface) -> Tape:
    return Tape(surface)


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
        tolerance = default_tolerance(self._bounds) / self.length
        self.tolerance = tolerance
        if exact is not None:
            self.tolerance = max(tolerance, 2.0**-20 * max(abs(float(exact[0].mid())), abs(float(exact[1].mid()))))

    def stretch(self, wider: float, t_min: float, t_max: float) -> Interval | None:
        """The stretch inside the bounds moved outwards by so many tolerances, clipped to the ray's own range likewise."""
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


def judge(
    surface: Surface,
    origin: Sequence[float],
    direction: Sequence[float],
    t_min: float = 0.0,
    t_max: float = math.inf,
) -> Verdict:
    """What the exact ray meets, at the default tolerance."""
    line = Line(surface, origin, direction)
    outer, inner = line.stretch(EDGE, t_min, t_max), line.stretch(-EDGE, t_min, t_max)
    if outer is None:
        return Verdict((), line.tolerance, 0)
    tape = _tape(surface)
    work = [0]
    polynomial = tape.polynomial(line.origin, line.direction)
    found = _exact(polynomial, outer) if polynomial is not None else _bisected(tape, line, outer, work)
    events: list[Event] = []
    for a, b, kind in found:
        inside = inner is not None and bool(a >= inner[0]) and bool(b <= inner[1])
        if kind is Kind.LINE and inner is not None:
            a, b, inside = inner[0], inner[0], True
        events.append(Event(float(a), float(b), kind, not inside))
        if inside and kind is not Kind.OPEN:
            break
    return Verdict(tuple(events), line.tolerance, work[0])


Found = Iterator[tuple[Any, Any, Kind]]


def _exact(polynomial: Any, outer: Interval) -> Found:
    """All real roots of a polynomial with rational coefficients, with multiplicity."""
    if polynomial.degree() < 1:
        if polynomial.degree() < 0:
            yield outer[0], outer[1], Kind.LINE
        return
    roots = [(root.real, times) for root, times in polynomial.numer().complex_roots() if root.imag == 0]
    for root, times in sorted(roots, key=lambda item: float(item[0].mid())):
        if not (root < outer[0] or root > outer[1]):
            yield root.lower(), root.upper(), Kind.CROSS if times % 2 else Kind.TOUCH


class _OutOfWork(Exception):
    pass


def _bisected(tape: Tape, line: Line, outer: Interval, work: list[int]) -> Found:
    """Events of any f, by balls; places that stay open and lie side by side are one."""
    cells = _Cells(tape, line, work)
    open_: list[Any] = []
    try:
        for a, b, kind in cells.search(*outer):
            if kind is Kind.OPEN:
                open_ = [open_[0] if open_ and a <= open_[1] else a, b] if not open_ or a <= open_[1] else open_ + [a, b]
                if len(open_) == 4:
                    yield open_[0], open_[1], Kind.OPEN
                    open_ = open_[2:]
                continue
            if open_:
                yield open_[0], open_[1], Kind.OPEN
                open_ = []
            yield a, b, kind
    except _OutOfWork:
        yield open_[0] if open_ else cells.clear, outer[1], Kind.OPEN
        return
    if open_:
        yield open_[0], open_[1], Kind.OPEN


class _Cells:
    """Bisection from the left. ``clear``: everything before it has been dealt with."""

    def __init__(self, tape: Tape, line: Line, work: list[int]) -> None:
        self._tape = tape
        self._constants = tape.jets()
        self._line = [(arb(o), arb(d)) for o, d in zip(line.origin, line.direction, strict=True)]
        self._work = work
        self.clear: Any = ZERO

    def _f(self, t: Any) -> Jet:
        self._work[0] += 1
        if self._work[0] > WORK:
            raise _OutOfWork
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
        stack = [(a, b) for a, b in zip(ends, ends[1:], strict=False)][::-1]
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


__all__ = ["EDGE", "ONE", "Event", "Kind", "Line", "Verdict", "judge"]
