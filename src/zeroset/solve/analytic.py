"""Closed-form roots for surfaces of degree <= 4 (SN10 section 4.1), proven or handed on.

The factors of f along the ray give candidate roots. A candidate is a HIT where the product of the factors is larger
than the residual, with opposite signs, at both ends of a tolerance around it, and larger than the residual everywhere
before: both are exact range computations on quadratics. A ray without candidates is a MISS where the product exceeds
the residual on the whole stretch. Rays near a double root, where no closed form can tell, go to the affine search.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from zeroset.arith import AffineSystem
from zeroset.errors import MethodError
from zeroset.kernel import U32, Value, constant
from zeroset.solve.field import Field
from zeroset.solve.method import Method, register
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.raypoly import SYSTEM, Factored, as_value, factor, ray_polynomial
from zeroset.solve.search import search
from zeroset.solve.status import HIT, MISS
from zeroset.solve.walk import Striding


@register
@dataclass(frozen=True)
class Analytic(Method):
    """Closed-form roots, degree <= 4."""

    name: ClassVar[str] = "analytic"
    certified: ClassVar[bool] = True
    summary: ClassVar[str] = "closed-form roots for degree <= 4, proven or handed to the affine search (SN10 4.1)"

    def check(self, field: Field) -> None:
        """Refuse what is no polynomial of low degree."""
        if field.degree is None or not 1 <= field.degree <= 4:
            what = "no polynomial" if field.degree is None else f"of degree {field.degree}"
            raise MethodError(
                f"analytic needs a polynomial of degree 1 to 4; this surface is {what}", hint="method='auto' treats any"
            )

    def trace(self, problem: Problem) -> Answer:
        """Emit the search for the first root."""
        degree = problem.lowered.field.degree
        assert degree is not None
        if problem.lowered.field.large:
            # The closed forms would meet numbers that are none.
            return search(problem, AffineSystem(problem.fmt, symbols=1), Striding())
        closed = closed_form(problem, degree)
        system = AffineSystem(problem.fmt, symbols=1)
        rest = search(problem, system, Striding(), ~closed.proven)
        status = closed.proven.select(closed.status, rest.status)
        pairs = (closed.t, rest.t), (closed.side, rest.side), (closed.t + problem.tolerance, rest.end)
        t, side, end = (closed.proven.select(a, b) for a, b in pairs)
        return Answer(t, status, rest.steps + 1, rest.clear, side, end)


class _Closed(NamedTuple):
    proven: Value
    status: Value
    t: Value
    side: Value


def closed_form(problem: Problem, degree: int) -> _Closed:
    """The first root by formula, and whether that is proven."""
    polynomial = ray_polynomial(problem, degree)
    factored = factor(polynomial.coefficients)
    first = _first_candidate(factored)
    none = first > 1.0
    width = problem.tolerance / polynomial.half
    # At most a tolerance wide in all, and never narrower than e's own resolution.
    reach = (width * 0.5).maximum(2.0**-21)
    before = none.select(1.0, (first - reach).minimum(1.0))
    after = (first + reach).minimum(1.0)
    clear = _magnitude(factored, before) > factored.residual
    left, right = factored.over(SYSTEM.exact(before)), factored.over(SYSTEM.exact(after))
    side = _side(left, right, factored.residual)
    crosses = side.ne(0.0)
    inside = before > -1.0
    hit = ~none & inside & clear & crosses & (first + reach <= 1.0)
    miss = none & clear
    t = first.fma(polynomial.half, polynomial.middle)
    empty = ~(problem.t1 > problem.t0)
    status = hit.select(constant(HIT, U32), MISS)
    return _Closed(hit | miss | empty, (~empty).select(status, MISS), t, side)


def _first_candidate(factored: Factored) -> Value:
    """The least candidate root in [-1, 1]; 2 where there is none."""
    least: Value | None = None
    for root, real in factored.roots():
        middle = (as_value(root.lo) + as_value(root.hi)) * 0.5
        here = (real & (as_value(root.hi) >= -1.0) & (as_value(root.lo) <= 1.0)).select(middle, 2.0)
        least = here if least is None else least.minimum(here)
    assert least is not None
    return least


def _magnitude(factored: Factored, end: Value) -> Value:
    """A lower bound of |product| on [-1, end]; 0 where it may vanish."""
    stretch = SYSTEM.bounds(constant(-1.0, end.type), end.maximum(-1.0))
    over = factored.over(stretch)
    low, high = as_value(over.lo), as_value(over.hi)
    return low.maximum(-high).maximum(0.0)


def _side(left: object, right: object, residual: Value) -> Value:
    """The polynomial's sign on the left where it certainly has the other one on the right, given the product's ranges;
    else 0."""
    l0, l1 = as_value(left.lo), as_value(left.hi)  # type: ignore[attr-defined]
    r0, r1 = as_value(right.lo), as_value(right.hi)  # type: ignore[attr-defined]
    up = (l1 < -residual) & (r0 > residual)
    down = (l0 > residual) & (r1 < -residual)
    return down.select(1.0, up.select(constant(-1.0, residual.type), 0.0))
