"""Mitchell's isolation with the exact interval extension from critical points, degree <= 5 (SN10 4.2, Algorithm 4).

Over [a, b] a polynomial ranges exactly over the hull of its values at a, at b and at its critical points between; those
are the roots of its derivative, in closed form. The closed forms carry rounding: if the derivative differs from the
product of its factors by at most D, the range is at most 2 D (b - a) wider, and that is added. The derivative's own
range comes from its critical points in the same way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from zeroset.errors import MethodError
from zeroset.kernel import F32, Value, constant
from zeroset.solve.field import Field
from zeroset.solve.method import Method, register
from zeroset.solve.mitchell import Mitchell, isolate, sign_of
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.raypoly import SYSTEM, TINY, Factored, as_value, factor, horner, largest, ray_polynomial

Interval = Any


@register
@dataclass(frozen=True)
class MitchellExact(Method):
    """Mitchell's method on the exact extension, degree <= 5."""

    name: ClassVar[str] = "mitchell-exact"
    certified: ClassVar[bool] = True
    summary: ClassVar[str] = "exact extension from critical points, degree <= 5 (SN10 4.2)"

    def check(self, field: Field) -> None:
        """Refuse what is no polynomial of low degree."""
        if field.degree is None or not 1 <= field.degree <= 5:
            what = "no polynomial" if field.degree is None else f"of degree {field.degree}"
            raise MethodError(
                f"mitchell-exact needs a polynomial of degree 1 to 5; this surface is {what}",
                hint="method='mitchell' and method='auto' treat any",
            )

    def trace(self, problem: Problem) -> Answer:
        """Emit the search for the first root."""
        degree = problem.lowered.field.degree
        assert degree is not None
        if problem.lowered.field.large:
            # The closed forms would meet numbers that are none.
            return Mitchell(offset=self.offset).trace(problem)
        polynomial = ray_polynomial(problem, degree)
        pieces = _ExactPieces(problem, polynomial.coefficients, polynomial.derivative())
        one = constant(1.0, F32)
        empty = ~(problem.t1 > problem.t0)
        inner = problem._replace(
            t0=-one,
            t1=empty.select(-one, one),
            tolerance=(problem.tolerance / polynomial.half).maximum(2.0**-20),
            step=one,
        )
        answer = isolate(inner, pieces)
        t, clear, end = (e.fma(polynomial.half, polynomial.middle) for e in (answer.t, answer.clear, answer.end))
        # Back from e to t rounds: a hair earlier, or later, is certainly clear.
        return Answer(t, answer.status, answer.steps, clear - problem.tolerance, answer.side, end + problem.tolerance)


class _Extension:
    """The range of one polynomial over [a, b], from its values at its critical points."""

    def __init__(self, problem: Problem, coefficients: Sequence[Interval]) -> None:
        self._problem = problem
        self._coefficients = coefficients
        derivative = [c * SYSTEM.constant(k, k) for k, c in enumerate(coefficients) if k]
        self._critical: list[tuple[Interval, Value, Interval]] = []
        self._slack: Value | None = None
        self._usable: Value | None = None
        if len(derivative) > 1:
            factored: Factored = factor(derivative)
            self._critical = [(root, real, horner(coefficients, root)) for root, real in factored.roots()]
            self._slack = factored.residual * 2.0
            # A residual as large as the coefficients, or NaN, comes from factors that mean nothing.
            self._usable = factored.residual < largest(derivative).maximum(TINY)

    def over(self, a: Value, b: Value) -> Interval:
        ends = (horner(self._coefficients, SYSTEM.exact(a)), horner(self._coefficients, SYSTEM.exact(b)))
        low = as_value(ends[0].lo).minimum(as_value(ends[1].lo))
        high = as_value(ends[0].hi).maximum(as_value(ends[1].hi))
        for root, real, value in self._critical:
            inside = real & (as_value(root.hi) >= a) & (as_value(root.lo) <= b)
            low = inside.select(low.minimum(as_value(value.lo)), low)
            high = inside.select(high.maximum(as_value(value.hi)), high)
        hull = SYSTEM.bounds(low, high)
        if self._slack is None or self._usable is None:
            return hull
        wider = SYSTEM.exact(self._slack) * (SYSTEM.exact(b) - SYSTEM.exact(a))
        hull = hull + SYSTEM.bounds(-as_value(wider.hi), as_value(wider.hi))
        plain = horner(self._coefficients, SYSTEM.bounds(a, b))
        return SYSTEM.bounds(self._usable.select(hull.lo, plain.lo), self._usable.select(hull.hi, plain.hi))

    def point(self, t: Value) -> Value:
        """The certain sign at one point, or 0."""
        return sign_of(self._problem, horner(self._coefficients, SYSTEM.exact(t)))


class _ExactPieces:
    """What ``isolate`` asks for, from the exact extensions of f and of its derivative."""

    def __init__(self, problem: Problem, coefficients: Sequence[Interval], derivative: Sequence[Interval]) -> None:
        self._problem = problem
        self._value = _Extension(problem, coefficients)
        self._slope = _Extension(problem, derivative)

    def point(self, t: Value) -> Value:
        return self._value.point(t)

    def piece(self, a: Value, b: Value) -> tuple[Value, Value, bool]:
        f = self._value.over(a, b)
        return ~f.contains_zero(), sign_of(self._problem, self._slope.over(a, b)), True
