"""Marching points and adaptive marching points (SN10 sections 3.3 and 3.4): sampling methods, fast and not certified.

A root is looked for between neighbouring samples, by a change of sign or by the Taylor test (SN10 eq. 2), and refined
by ten bisections. What lies between samples can be missed; SN10 figure 6 shows where, and so do this project's tests.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from zeroset.arith import DualSystem, RealSystem
from zeroset.errors import MethodError
from zeroset.kernel import BOOL, U32, Value, constant, for_, while_
from zeroset.solve.field import Field
from zeroset.solve.method import Method, register, uniform
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.status import HIT, MISS

REFINEMENTS = 10
"""SN10 section 3.1: "we perform 10 bisections after root isolation"."""


class _Samples:
    """f and its derivative along the ray."""

    def __init__(self, problem: Problem, derivative: bool) -> None:
        self._problem = problem
        self._derivative = derivative
        self._real = RealSystem(problem.fmt)

    def value(self, t: Value) -> Value:
        f = self._problem.lowered.along(self._real, self._problem.ray, self._real.exact(t))
        return self._problem.lift(f.value)

    def __call__(self, t: Value) -> tuple[Value, Value]:
        """F(t) and F'(t); the derivative is 0 where the test needs none."""
        if not self._derivative:
            return self.value(t), self._problem.number(0.0)
        dual = DualSystem(self._real, 1)
        f = self._problem.lowered.along(dual, self._problem.ray, dual.variable(self._real.exact(t), 0))
        return self._problem.lift(f.value.value), self._problem.lift(f.derivative(0).value)


def opposite(a: Value, b: Value) -> Value:
    """Whether two numbers have opposite signs; their product might underflow and not tell."""
    return ((a < 0.0) & (b > 0.0)) | ((a > 0.0) & (b < 0.0))


def contains_root(test: str, f0: Value, d0: Value, f1: Value, d1: Value, width: Value) -> Value:
    """The root-containment test between two samples: SN10 section 3.3."""
    if test == "sign":
        return opposite(f0, f1) | f0.eq(0.0)
    q, r = (width * 0.5).fma(d0, f0), f1 - width * 0.5 * d1
    low = f0.minimum(f1).minimum(q.minimum(r))
    high = f0.maximum(f1).maximum(q.maximum(r))
    return (low <= 0.0) & (high >= 0.0)


def refine(value: Callable[[Value], Value], a: Value, b: Value, fa: Value) -> Value:
    """Ten bisections of [a, b], keeping the half whose ends differ in sign; the first half where neither does."""

    def halve(_: Value, a: Value, b: Value, fa: Value) -> tuple[Value, ...]:
        middle = (a + b) * 0.5
        fm = value(middle)
        right = ((fa > 0.0) & (fm > 0.0)) | ((fa < 0.0) & (fm < 0.0))
        return right.select(middle, a), right.select(b, middle), right.select(fm, fa)

    a, b, _ = for_(REFINEMENTS, halve, a, b, fa)
    return (a + b) * 0.5


@dataclass(frozen=True)
class _Marching(Method):
    """Options shared by the two sampling methods.

    Attributes:
        steps: samples along the stretch, by hand; 0 takes SN10's formula max(100, 15 + 2 k^2) for degree k.
        test: ``"sign"`` or ``"taylor"``.
    """

    steps: float = uniform(0)
    test: str = "sign"

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.test not in ("sign", "taylor"):
            raise MethodError(f"{self.name}: test must be 'sign' or 'taylor', not {self.test!r}")
        if not 0 <= self.steps <= 100_000 or self.steps != int(self.steps):
            raise MethodError(f"{self.name}: steps must be a whole number up to 100000, not {self.steps!r}")

    def step_count(self, problem: Problem) -> Value:
        """How many basic steps the stretch is divided into."""
        by_hand = self.option(problem, "steps")
        return (by_hand > 0.0).select(by_hand, formula_steps(problem.lowered.field))

    def answer(self, samples: _Samples, t: Value, width: Value, f0: Value, found: Value, count: Value) -> Answer:
        """Refine where an interval was found."""
        end = found.select(t + width, t)
        root = refine(samples.value, t, end, f0)
        spent = count + found.select(constant(REFINEMENTS, U32), 0)
        return Answer(root, found.select(constant(HIT, U32), MISS), spent, t, constant(0.0, t.type), end)


def formula_steps(field: Field) -> float:
    """SN10 section 5.6: max(100, 15 + 2 k^2) steps for an algebraic surface of order k; 100 for any other."""
    k = field.degree or 0
    return float(max(100, 15 + 2 * k * k))


@register
@dataclass(frozen=True)
class MarchingPoints(_Marching):
    """SN10 Algorithm 2: equal steps."""

    name: ClassVar[str] = "marching-points"
    summary: ClassVar[str] = "equal steps, sign or Taylor test (SN10 3.3)"

    def trace(self, problem: Problem) -> Answer:
        """Emit the search for the first root."""
        samples = _Samples(problem, self.test == "taylor")
        length = problem.t1 - problem.t0
        width = length / self.step_count(problem)
        total = self.step_count(problem)

        def running(i: Value, t: Value, f: Value, d: Value, found: Value) -> Value:
            return (i < total) & ~found & (length > 0.0)

        def step(i: Value, t: Value, f: Value, d: Value, found: Value) -> tuple[Value, ...]:
            after = (i + 1.0).fma(width, problem.t0)
            f1, d1 = samples(after)
            here = contains_root(self.test, f, d, f1, d1, width)
            return i + 1.0, here.select(t, after), here.select(f, f1), here.select(d, d1), here

        start = samples(problem.t0)
        false = constant(False, BOOL)
        i, t, f, _, found = while_(running, step, problem.number(0.0), problem.t0, *start, false)
        return self.answer(samples, t, width, f, found, i.convert(U32) + 1)


@register
@dataclass(frozen=True)
class AdaptiveMarchingPoints(_Marching):
    """SN10 Algorithm 3: steps by proximity |f| and, near silhouettes, by the horizon measure |F'|.

    Attributes:
        tau1: |f| up to which the step is halved.
        tau2: |f| above which it is doubled.
        epsilon: |F'| up to which it is halved once more close to the surface.
        silhouettes: whether the horizon measure is used at all.
    """

    name: ClassVar[str] = "adaptive-marching-points"
    summary: ClassVar[str] = "steps by |f| and silhouettes, sign or Taylor test (SN10 3.4)"

    tau1: float = uniform(0.1)
    tau2: float = uniform(1.0)
    epsilon: float = uniform(0.1)
    silhouettes: bool = True

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("tau1", "tau2", "epsilon"):
            if getattr(self, name) < 0.0:
                raise MethodError(f"{self.name}: {name} must not be negative: it is compared with a size")

    def trace(self, problem: Problem) -> Answer:
        """Emit the search for the first root."""
        samples = _Samples(problem, self.test == "taylor" or self.silhouettes)
        tau1, tau2, epsilon = (self.option(problem, name) for name in ("tau1", "tau2", "epsilon"))
        basic = (problem.t1 - problem.t0) / self.step_count(problem)

        def width(f: Value, d: Value, t: Value) -> Value:
            near = abs(f) <= tau1
            size = near.select(basic * 0.5, (abs(f) > tau2).select(basic * 2.0, basic))
            if self.silhouettes:
                size = (near & (abs(d) <= epsilon)).select(basic * 0.25, size)
            # A step below t's own resolution would never end.
            return size.maximum(problem.tolerance * 0.0625)

        def running(t: Value, f: Value, d: Value, found: Value, count: Value) -> Value:
            return (t < problem.t1) & ~found

        def step(t: Value, f: Value, d: Value, found: Value, count: Value) -> tuple[Value, ...]:
            size = width(f, d, t)
            after = (t + size).minimum(problem.t1)
            f1, d1 = samples(after)
            here = contains_root(self.test, f, d, f1, d1, after - t)
            return here.select(t, after), here.select(f, f1), here.select(d, d1), here, count + 1

        start = samples(problem.t0)
        false = constant(False, BOOL)
        t, f, d, found, count = while_(running, step, problem.t0, *start, false, constant(1, U32))
        last = (t + width(f, d, t)).minimum(problem.t1) - t
        return self.answer(samples, t, last, f, found, count)
