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
    is_zero,
    le,
    maximum,
    minimum,
    not_,
    select,
    sub,
)  # fmt: skip

if TYPE_CHECKING:
    from zeroset.arith.affine_form import Form
    from zeroset.arith.format import Format

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


def contract(form: Form, symbol: int = 0) -> Contraction:
    """The zeros of a form along one symbol; the other symbols count as error."""
    fmt, u, c = form.fmt, form.terms[symbol], form.centre
    curved = form.system.curved and symbol == len(form.terms) - 2
    bend = form.terms[-1] if curved else 0.0
    others = form.error
    for index, term in enumerate(form.terms[:-1] if curved else form.terms):
        others = others if index == symbol else add(absolute(term), others)
    reach = repaid(fmt, others, form.budget.depth + len(form.terms) + 3)
    slope = absolute(u)
    excluded = not_(form.contains_zero())
    # The differences below are rounded by eps*|u| + eps*reach, which is in the depth repaid above, and eps*|c + bend|.
    margin = sub(slope, fma(slope, 2 * fmt.eps, reach))
    ends = c if is_zero(bend) else fma(absolute(c) + absolute(bend), 2 * fmt.eps, absolute(c + bend))
    crosses = and_(gt(margin, absolute(ends)), form.defined)
    if is_zero(bend):
        low, high = _strip(fmt, c, u, reach)
    else:
        low, high = _bent_strip(fmt, c, u, bend, reach)
    return Contraction(low, high, excluded, crosses, gt(u, 0.0))


def _bent_strip(fmt: Format, c: Scalar, u: Scalar, bend: Scalar, reach: Scalar) -> tuple[Scalar, Scalar]:
    """The strip around the line, and within that, expanded about its middle, the one around the tangent there.

    With e = m + w s, T2(e) is 2 m**2 - 1 + w**2 + 4 m w s + w**2 (2 s**2 - 1), the last within w**2.
    """
    size = absolute(bend)
    low, high = _strip(fmt, c, u, fma(size + reach, 4 * fmt.eps, size + reach))
    middle, half = 0.5 * (low + high), fma(high - low, 0.5 * (1 + 8 * fmt.eps), 4 * fmt.eps)
    square, around = half * half, middle * middle
    shift = fma(around, 2.0, square - 1.0)
    centre = fma(bend, shift, fma(u, middle, c))
    slope = fma(bend, 4.0 * middle, u)
    # |shift| <= 2 and |4 m| <= 4: what is above and slope * half are rounded by less than this, underflow included.
    rounded = fma(size, 32.0 * fmt.eps, fma(absolute(c) + absolute(u), 8.0 * fmt.eps, fmt.tiny))
    inner_low, inner_high = _strip(fmt, centre, slope * half, fma(size, square, reach + rounded) * (1 + 16 * fmt.eps))
    # Where the tangent falls as the line rises, or nothing is left, which the range has not seen, the line has to do.
    usable = and_(gt(slope * u, 0.0), le(inner_low, inner_high))
    inner_low = maximum(fma(inner_low, half, middle) - 4 * fmt.eps, low)
    inner_high = minimum(fma(inner_high, half, middle) + 4 * fmt.eps, high)
    return select(usable, inner_low, low), select(usable, inner_high, high)


def _strip(fmt: Format, c: Scalar, u: Scalar, reach: Scalar) -> tuple[Scalar, Scalar]:
    """[-1, 1] cut to (-c +- reach)/u, rounded outward."""
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
