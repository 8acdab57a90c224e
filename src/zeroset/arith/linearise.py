"""The one way in which a function that is not affine becomes an affine form.

For x = p + d, |d| <= r: f(x) = f(p) + f'(p) d + w (h d)**2 with w between two bounds that each function knows on the
range (f''/2 by Taylor, often a closed form that is tighter). So the form keeps the slope f'(p), half of the
remainder's range goes to the centre and half to the error, with all that was rounded. Where the plain interval of f
is narrower, or the expansion is not valid (a pole, an edge of the domain), the lane takes that instead. K09 (section
5.4) left these functions to intervals for want of a regression robust to inaccurate division; here every inaccuracy
is in the bound.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from zeroset.arith.budget import Budget, quanta, repaid
from zeroset.arith.scalar import (
    Mask,
    Scalar,
    absolute,
    add,
    and_,
    fma,
    is_zero,
    lt,
    maximum,
    minimum,
    mul,
    not_,
    select,
)  # fmt: skip

if TYPE_CHECKING:
    from zeroset.arith.affine_form import F, Form
    from zeroset.arith.interval import Interval

__all__ = ["Expansion", "linearise", "narrower", "picked", "point", "span"]


class Expansion(NamedTuple):
    """f near a point p, with the errors of computing it.

    Attributes:
        value: f(p), within ``value_error * eps * |value| + absolute``.
        slope: f'(p), within ``slope_error * eps * |slope|``.
        low: bound of w from below, <= 0; computed within 100 eps, which is paid for here.
        high: bound of w from above, >= 0; likewise.
        value_error: see ``value``.
        slope_error: see ``slope``.
        absolute: see ``value``; a scalar.
        valid: mask, the bounds of w hold on the range.
        unit: the scale h of d in the remainder, chosen so that (h d)**2 neither overflows nor underflows unnoticed.
    """

    value: Scalar
    slope: Scalar
    low: Scalar
    high: Scalar
    value_error: float
    slope_error: float
    absolute: Scalar = 0.0
    valid: Mask = True
    unit: Scalar = 1.0


def point(a: Form) -> Scalar:
    """Where to expand: the centre, brought into the range where an interval goes along with the form."""
    if a.bounds is None:
        return a.centre
    return minimum(maximum(a.centre, a.bounds.lo), a.bounds.hi)


def span(a: Form) -> Scalar:
    """How far the argument may be from ``point(a)``."""
    if a.bounds is None:
        return a.reach()
    moved = point(a)
    return maximum(a.bounds.hi - moved, moved - a.bounds.lo)


def linearise(a: F, enclosure: Interval, at: Expansion) -> F:
    """The form of f(a).

    Args:
        a: the argument.
        enclosure: f on the range of ``a``.
        at: f expanded at ``point(a)``.
    """
    fallback = a.system.from_interval(enclosure)
    if all(is_zero(u) for u in a.terms):
        return fallback
    fmt, moved = a.fmt, point(a)
    reach = a.reach()
    relative = mul(at.unit, span(a))
    square = relative * relative
    high, low = mul(at.high, square), mul(at.low, square)
    spread, shift = 0.5 * (high - low), 0.5 * add(high, low)
    slope = absolute(at.slope)
    own = fma(reach, (at.slope_error + 4.0) * fmt.eps, repaid(fmt, a.error, a.budget.depth + 4))
    error = fma(
        spread,
        fmt.up(1.0 + (at.value_error + 140.0) * fmt.eps),
        add(fma(reach, 4 * fmt.quantum, fmt.tiny), at.absolute),
    )
    error = fma(slope, own, fma(absolute(at.value), (at.value_error + 4.0) * fmt.eps, error))
    centre = add(at.value, shift)
    if a.bounds is not None:
        step = a.centre - moved
        centre = fma(at.slope, step, centre)
        error = fma(slope * absolute(step), (at.slope_error + 8.0) * fmt.eps, error)
    terms = tuple(mul(at.slope, u) for u in a.terms)
    budget = Budget(0.0, 0.9 * quanta(fmt), 8)
    form = a.make(centre, terms, error, budget, enclosure.flags, fallback.bounds)
    return _narrower(form, fallback, at.valid)


def narrower(form: F, enclosure: Interval, valid: Mask = True) -> F:
    """Lane by lane the form, or the interval where that is much narrower or the form is not valid."""
    return _narrower(form, form.system.from_interval(enclosure), valid)


def _narrower(form: F, other: F, valid: Mask) -> F:
    # By the errors, not the radii: a form about as wide as the interval still knows its slope, which later operations
    # and the contraction live on. A comparison with NaN is false: what overflowed is dropped.
    use = and_(valid, lt(form.error, 0.5 * other.error))
    chosen = picked(use, form, other)
    return chosen.make(chosen.centre, chosen.terms, chosen.error, chosen.budget, other.flags, other.bounds)


def picked(mask: Mask, a: F, b: F, like: Scalar = None) -> F:
    """``a`` where the mask holds, else ``b``; ``like`` shows the run-time type where both are constants."""
    bounds = None
    if a.bounds is not None and b.bounds is not None:
        low, high = (select(mask, *pair, like) for pair in ((a.bounds.lo, b.bounds.lo), (a.bounds.hi, b.bounds.hi)))
        bounds = a.bounds.make(low, high)
    return a.make(
        select(mask, a.centre, b.centre, like),
        tuple(select(mask, u, v, like) for u, v in zip(a.terms, b.terms, strict=True)),
        select(mask, a.error, b.error, like),
        a.budget.worst(b.budget),
        a.flags.choose(b.flags, mask, not_(mask)),
        bounds,
    )
