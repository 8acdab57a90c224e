"""Choices between affine forms: absolute value, minimum, maximum, comparison and selection.

Where the range decides, the chosen form comes back unchanged; where it does not, the result is the best affine
mixture of both, not the hull of their ranges: for d = a - b in [lo, hi] with lo < 0 < hi,
max(a, b) = L a + (1-L) b + w with L = hi/(hi - lo) and 0 <= w <= max((1-L) hi, -L lo).
"""

from __future__ import annotations

from collections.abc import Callable

from zeroset.arith import scalar as s
from zeroset.arith.affine_arithmetic import stocked
from zeroset.arith.affine_form import F, Form
from zeroset.arith.budget import Budget, funded, quanta
from zeroset.arith.condition import Undecided
from zeroset.arith.interval import Interval, IntervalCondition
from zeroset.arith.interval_arithmetic import mod_and_steps
from zeroset.arith.linearise import narrower
from zeroset.arith.number import Number
from zeroset.arith.scalar import Mask, Scalar, fma, ge, gt, is_literal, is_zero, le, lt, select

__all__ = ["AffineCondition", "absolute", "floor", "larger", "less", "less_equal", "mod", "sign", "smaller"]

_MIXTURE = 4.0


def larger(a: F, b: F) -> F:
    """The larger of two forms."""
    bounds = a.interval().max(b.interval()) if a.system.intersect else None
    return _extreme(a, b, 1.0).within(bounds)


def smaller(a: F, b: F) -> F:
    """The smaller of two forms."""
    bounds = a.interval().min(b.interval()) if a.system.intersect else None
    return _extreme(a, b, -1.0).within(bounds)


def _extreme(a: F, b: F, sign: float) -> F:
    """max for sign 1; for -1 the same weights swapped and the remainder taken off.

    The weights add to 1 within eps times the second, each product and sum rounds once: price 4, of
    L M_a + (1-L) M_b, which the credit of both operands covers.
    """
    fmt = a.fmt
    difference = a.sub(b).interval()
    if is_literal(difference.lo, difference.hi) and difference.lo * difference.hi > 0:
        return a if (difference.lo > 0) == (sign > 0) else b
    a, b = stocked(a, 1.01 * _MIXTURE), stocked(b, 1.01 * _MIXTURE)
    high, low = s.maximum(difference.hi, 0.0), s.minimum(difference.lo, 0.0)
    weight = high / (high - low + fmt.tiny)
    other = 1.0 - weight
    remainder = s.maximum(other * high, -(weight * low))
    if sign < 0:
        weight, other = other, weight
    credit = min(a.budget.credit, b.budget.credit)
    shift = (0.5 * sign) * remainder
    centre = fma(weight, a.centre, fma(other, b.centre, shift))
    terms = tuple(fma(weight, u, s.mul(other, v)) for u, v in zip(a.terms, b.terms, strict=True))
    error = fma(remainder, fmt.up(0.5 + (credit + 10.0) * fmt.eps), fmt.tiny)
    error = fma(weight, a.error, fma(other, b.error, error))
    depth = max(a.budget.depth, b.budget.depth) + 8
    error, budget = funded(fmt, centre, terms, error, Budget(credit, 0.9 * quanta(fmt), depth), _MIXTURE)
    return a.make(centre, terms, error, budget, a.flags.meet(b.flags))


def absolute(a: F) -> F:
    """|a| = S a + w for S = (hi + lo)/(hi - lo) and 0 <= w <= max((1-S) hi, -(1+S) lo), lo <= 0 <= hi.

    The product and the sum round once each, relative to the result and to w: price 2.
    """
    fmt, form = a.fmt, a.interval()
    if form.nonnegative:
        return a
    high, low = s.maximum(form.hi, 0.0), s.minimum(form.lo, 0.0)
    slope = (high + low) / (high - low + fmt.tiny)
    remainder = s.maximum((1.0 - slope) * high, -((1.0 + slope) * low))
    centre = fma(slope, a.centre, 0.5 * remainder)
    terms = tuple(s.mul(slope, u) for u in a.terms)
    error = fma(remainder, fmt.up(0.5 + (a.budget.credit + 10.0) * fmt.eps), fmt.tiny)
    error = fma(s.absolute(slope), a.error, error)
    budget = Budget(0.0, 0.9 * quanta(fmt), a.budget.depth + 8)
    error, budget = funded(fmt, centre, terms, error, budget, 2.0)
    return a.make(centre, terms, error, budget).within(form.abs())


def sign(a: F) -> F:
    """-1, 0 or 1."""
    return a.system.from_interval(a.interval().sign())


def floor(a: F) -> F:
    """The largest integer at or below, a constant where the range decides."""
    return a.system.from_interval(a.interval().floor())


def mod(a: F, b: F) -> F:
    """a - b floor(a/b), with the slope of ``a`` where the floor is decided."""
    return narrower(Number.mod(a, b), *mod_and_steps(a.interval(), b.interval()))


def less(a: F, b: F) -> AffineCondition[F]:
    """a < b, decided by the range of the difference, in which common terms cancel."""
    if _alone(a) and _alone(b):
        return _by_ranges(a, b, lt, ge)
    difference = a.sub(b).interval()
    return AffineCondition(lt(difference.hi, 0.0), ge(difference.lo, 0.0), difference.flags, _shown(difference))


def less_equal(a: F, b: F) -> AffineCondition[F]:
    """a <= b, likewise."""
    if _alone(a) and _alone(b):
        return _by_ranges(a, b, le, gt)
    difference = a.sub(b).interval()
    return AffineCondition(le(difference.hi, 0.0), gt(difference.lo, 0.0), difference.flags, _shown(difference))


def _alone(a: Form) -> bool:
    """Whether there are no terms that could cancel: a number, which a difference would round."""
    return all(is_zero(u) for u in a.terms)


def _by_ranges(
    a: F, b: F, holds: Callable[[Scalar, Scalar], Mask], fails: Callable[[Scalar, Scalar], Mask]
) -> AffineCondition[F]:
    x, y = a.interval(), b.interval()
    like = _shown(y) if is_literal(x.lo, x.hi) else _shown(x)
    return AffineCondition(holds(x.hi, y.lo), fails(x.lo, y.hi), x.flags.meet(y.flags), like)


def _shown(x: Interval) -> Scalar:
    return x.hi if is_literal(x.lo) else x.lo


class AffineCondition(Undecided[F]):
    """A comparison of affine forms."""

    __slots__ = ()

    def select(self, a: F, b: F) -> F:
        """One of two forms; where undecided their mean, within half the range of their difference."""
        if is_literal(self.true, self.false) and (self.true or self.false):
            chosen = a if self.true else b
            return chosen.make(
                chosen.centre, chosen.terms, chosen.error, chosen.budget, chosen.flags.meet(self.flags), chosen.bounds
            )
        fmt = a.fmt
        a, b = stocked(a, 2.1), stocked(b, 2.1)
        # Not the clamped range: the branch not taken may be undefined, and its form beyond every bound.
        difference = a.sub(b)
        half = s.absolute(difference.centre) + difference.reach()
        credit = min(a.budget.credit, b.budget.credit)
        wide = fma(half, fmt.up(0.5 + (credit + 8.0) * fmt.eps), fmt.tiny)
        centre = self._pick(a.centre, b.centre)
        terms = tuple(self._pick(u, v) for u, v in zip(a.terms, b.terms, strict=True))
        error = self._pick(a.error, b.error, wide)
        budget = a.budget.worst(b.budget)
        budget = Budget(credit, budget.slack, budget.depth + 6)
        error, budget = funded(fmt, centre, terms, error, budget, 2.0)
        flags = a.flags.choose(b.flags, self.true, self.false).meet(self.flags)
        return a.make(centre, terms, error, budget, flags, self._between(a, b))

    def _pick(self, a: Scalar, b: Scalar, spread: Scalar = 0.0) -> Scalar:
        mean = s.add(s.mul(0.5, s.add(a, b)), spread)
        return select(self.true, a, select(self.false, b, mean, self.like), self.like)

    def _between(self, a: Form, b: Form) -> Interval | None:
        if not a.system.intersect:
            return None
        return IntervalCondition(self.true, self.false, self.flags, self.like).select(a.interval(), b.interval())
