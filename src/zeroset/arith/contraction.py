"""Contracting a symbol with the form itself: c + u e + error = 0 bounds e.

One affine evaluation gives more than "perhaps a zero": the strip between the two lines c + u e +- error meets 0 on a
part of [-1, 1] only, and where both lines go from one sign to the other a zero is proven (the intermediate value
theorem).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from zeroset.arith.budget import repaid
from zeroset.arith.scalar import (
    Mask,
    Scalar,
    absolute,
    add,
    and_,
    fma,
    gt,
    is_literal,
    maximum,
    minimum,
    not_,
    select,
    sub,
)  # fmt: skip

if TYPE_CHECKING:
    from zeroset.arith.affine import Affine

__all__ = ["Contraction", "contract"]


class Contraction(NamedTuple):
    """What one affine form says about the zeros of f over its symbol e in [-1, 1].

    Attributes:
        low: every zero has e >= low; in [-1, 1].
        high: every zero has e <= high; in [-1, 1].
        excluded: mask, f has certainly no zero.
        crosses: mask, f certainly takes both signs, opposite ones at e = -1 and e = 1, and is continuous between.
        rising: mask, where ``crosses``: whether f is negative at e = -1.
    """

    low: Scalar
    high: Scalar
    excluded: Mask
    crosses: Mask
    rising: Mask


def contract(form: Affine, symbol: int = 0) -> Contraction:
    """The zeros of a form along one symbol; the other symbols count as error."""
    fmt, u, c = form.fmt, form.terms[symbol], form.centre
    others = form.error
    for index, term in enumerate(form.terms):
        others = others if index == symbol else add(absolute(term), others)
    reach = repaid(fmt, others, form.budget.depth + len(form.terms) + 3)
    slope = absolute(u)
    excluded = not_(form.contains_zero())
    # The difference below is rounded by eps*|u| + eps*reach; the latter is in the depth repaid above.
    crosses = and_(gt(sub(slope, fma(slope, 2 * fmt.eps, reach)), absolute(c)), form.defined)
    low, high = _strip(form, u, reach)
    return Contraction(low, high, excluded, crosses, gt(u, 0.0))


def _strip(form: Affine, u: Scalar, reach: Scalar) -> tuple[Scalar, Scalar]:
    """[-1, 1] cut to (-c +- reach)/u, rounded outward."""
    fmt, c = form.fmt, form.centre
    if is_literal(u) and u == 0:
        return -1.0, 1.0
    # Slopes within rounding and underflow of nothing tell nothing: there the quotients would overflow.
    steep = gt(absolute(u), fmt.tiny)
    slope = select(steep, u, 1.0)
    root, half = -(c / slope), reach / absolute(slope)
    # Three roundings of root, three of half, and tiny for what underflowed.
    half = fma(absolute(root), 4 * fmt.eps, fma(half, fmt.up(1.0 + 4 * fmt.eps), fmt.tiny))
    low, high = maximum(root - half, -1.0), minimum(root + half, 1.0)
    return select(steep, low, -1.0), select(steep, high, 1.0)
