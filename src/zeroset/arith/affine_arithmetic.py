"""Sums, products and squares of affine forms, with the proof of what each spends from its rounding account.

Written for few operations: between forms with credit an addition costs 3 for one symbol, a product 6 and the radii. A
product by an exact scalar costs 3. See ``budget`` for the invariant; "price" is rounding in units of eps * M.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from zeroset.arith import affine_curved as curved
from zeroset.arith import scalar as s
from zeroset.arith.budget import MARGIN, STOCK, Budget, bought, funded, quanta
from zeroset.arith.number import Number
from zeroset.arith.scalar import Scalar, absolute, fma, is_literal, is_zero, or_

if TYPE_CHECKING:
    from zeroset.arith.affine_form import F, Form
    from zeroset.arith.flags import Flags
    from zeroset.arith.interval import Interval

__all__ = ["add", "mul", "neg", "powi", "sqr", "stocked", "sub"]

_PRODUCT = 2.0
_SQUARE = 2.0
_RADIUS_SHARE = 16.0
_FLUSHED = 16.0
_AFTER_CONSTANT = 2.1


def neg(a: F) -> F:
    """-a, exactly."""
    bounds = None if a.bounds is None else a.bounds.neg()
    return a.make(s.neg(a.centre), tuple(s.neg(u) for u in a.terms), a.error, a.budget, bounds=bounds)


def add(a: F, b: F) -> F:
    """a + b.

    Each coefficient is rounded once, by eps times itself: price 1. The operands' credits k_a, k_b are worth at least
    min(k_a, k_b) * eps * (M_a + M_b), and M_a + M_b bounds M of the sum.
    """
    return _sum(a, b, s.add, "add")


def sub(a: F, b: F) -> F:
    """a - b, as ``add``."""
    return _sum(a, b, s.sub, "sub")


def _sum(a: F, b: F, combine: Callable[[Scalar, Scalar], Scalar], name: str) -> F:
    if b.is_scalar and is_zero(b.centre):
        return _with_flags_of(a, b)
    if a.is_scalar and is_zero(a.centre):
        return _with_flags_of(b if name == "add" else neg(b), a)
    a, b = _matched(a, b), _matched(b, a)
    centre = combine(a.centre, b.centre)
    terms = tuple(combine(u, v) for u, v in zip(a.terms, b.terms, strict=True))
    flushed = 3.0 * (len(terms) + 2)
    budget = Budget(
        min(a.budget.credit, b.budget.credit),
        a.budget.slack + b.budget.slack - flushed,
        max(a.budget.depth, b.budget.depth) + 1,
    )
    error, budget = funded(a.fmt, centre, terms, s.add(a.error, b.error), budget, price=1.0)
    total = a.make(centre, terms, error, budget, a.flags.meet(b.flags), _beside(a, b, name))
    # What is large less what is large may be anything.
    return total.endless_where(or_(a.endless(), b.endless())) if a.flags.large and b.flags.large else total


def _with_flags_of(kept: F, dropped: F) -> F:
    """A number with the flags of another one too."""
    return kept.make(kept.centre, kept.terms, kept.error, kept.budget, kept.flags.meet(dropped.flags), kept.bounds)


def _matched(a: F, b: F) -> F:
    """A constant with credit for this sum and for a square or product after it, which costs nothing while tracing."""
    wanted = min(b.budget.credit, _AFTER_CONSTANT)
    if not a.is_constant or a.budget.credit >= wanted:
        return a
    error, budget = bought(a.fmt, a.centre, a.terms, a.error, a.budget, stock=wanted)
    return a.make(a.centre, a.terms, error, budget, bounds=a.bounds)


def mul(a: F, b: F) -> F:
    """a * b, K09 eq. 15 with rounding."""
    for number, other in ((b, a), (a, b)):
        if number.is_scalar or _exact_but_for_rounding(number):
            return _scaled(other, number)
    product, large = _product(a, b), [each for each in (a, b) if each.flags.large]
    return product.endless_where(or_(*(each.endless() for each in large))) if large else product


def _exact_but_for_rounding(number: F) -> bool:
    """Whether this is a literal within two units of rounding, and not one that has overflowed."""
    if not number.is_constant:
        return False
    return bool(number.error <= abs(number.centre) * 2 * number.fmt.eps and abs(number.centre) < number.fmt.big)


def _scaled(a: F, factor: F) -> F:
    """a times a scalar k: price 1, and one more for a literal within eps of its real value.

    |k| * error keeps the credit: it is worth credit * eps * |k| M_a. The literal's own error |k| eps M_a is price 1.
    """
    k, fmt = factor.centre, a.fmt
    flags, bounds = a.flags.meet(factor.flags), _beside(a, factor, "mul")
    if is_literal(k) and k in (0, 1, -1) and factor.is_scalar:
        return _trivially_scaled(a, k, flags, bounds)
    centre, terms = s.mul(a.centre, k), tuple(s.mul(u, k) for u in a.terms)
    power_of_two = is_literal(k) and abs(math.frexp(k)[0]) == 0.5
    price = 0.0 if power_of_two else 1.0
    if not factor.is_scalar:
        price += 1.01 * factor.error / (abs(k) * fmt.eps)
    if is_zero(a.error) and not (power_of_two and abs(k) < 1):
        error, slack = 0.0, 0.0
    else:
        error, slack = fma(a.error, absolute(k), fmt.tiny), 0.9 * quanta(fmt)
    if price == 0.0 and is_zero(error):
        return a.make(centre, terms, error, Budget(), flags, bounds)
    budget = Budget(a.budget.credit, slack, a.budget.depth + 2)
    error, budget = funded(fmt, centre, terms, error, budget, price)
    share = a.make(centre, terms, error, budget, flags, bounds)
    return share.endless_where(a.endless()) if a.flags.large else share


def _trivially_scaled(a: F, k: float, flags: Flags, bounds: Interval | None) -> F:
    if k == 0:
        zero = a.literal(0.0)
        return zero.make(0.0, zero.terms, 0.0, Budget(), flags, bounds)
    scaled = neg(a) if k < 0 else a
    return scaled.make(scaled.centre, scaled.terms, scaled.error, scaled.budget, flags, bounds)


def stocked(a: F, credit: float) -> F:
    """The same number with at least so much credit; and with slack, unless it is exact."""
    if a.budget.credit >= credit and (is_zero(a.error) or a.budget.slack >= _FLUSHED):
        return a
    error, budget = bought(a.fmt, a.centre, a.terms, a.error, a.budget, stock=max(STOCK, credit))
    return a.make(a.centre, a.terms, error, budget, bounds=a.bounds)


def _product(a: F, b: F) -> F:
    """The general product.

    With A = |c_a|, U = sum |u_a|, and B, V alike: c is rounded by eps A B, each term by at most 2 eps (|c_a v| + |c_b
    u|), together under 2 eps M_a M_b: price 2. A error_b + B error_a + radius_a radius_b exceeds the same with the
    true errors by k_a eps M_a (B + radius_b) + k_b eps M_b (A + U) and more, that is by (k_a + k_b) eps M_a M_b: the
    credits add up.
    """
    price = curved.PRICE if a.system.curved else _PRODUCT
    enough = a.budget.credit + b.budget.credit >= MARGIN * price
    each = 0.0 if enough else MARGIN * price / 2
    a, b = stocked(a, each), stocked(b, each)
    if a.system.curved:
        return a.make(*curved.product(a, b), a.flags.meet(b.flags), _beside(a, b, "mul"))
    centre = s.mul(a.centre, b.centre)
    terms = tuple(fma(a.centre, v, s.mul(b.centre, u)) for u, v in zip(a.terms, b.terms, strict=True))
    error = fma(a.radius(), b.radius(), a.fmt.tiny)
    error = fma(absolute(b.centre), a.error, error)
    error = fma(absolute(a.centre), b.error, error)
    budget = Budget(
        a.budget.credit + b.budget.credit,
        0.9 * quanta(a.fmt),
        a.budget.depth + b.budget.depth + 2 * len(terms) + 6,
    )
    error, budget = funded(a.fmt, centre, terms, error, budget, _PRODUCT)
    return a.make(centre, terms, error, budget, a.flags.meet(b.flags), _beside(a, b, "mul"))


def sqr(a: F) -> F:
    """a**2 with the quadratic part in [0, r**2], r the radius: its half goes to the centre.

    Rounding costs c**2 + r**2/2 two roundings and each term one: price 2 of M**2 <= (|c| + r)**2. The error
    2|c| error + r**2/2 + 16 k eps r**2 exceeds the true one by 2 k eps |c| (|c| + r) + 16 k eps r**2, which is at least
    1.9 k eps (|c| + r)**2: (2-q)(16-q) >= (q-1)**2 holds for q = 1.9. The radius as computed lacks its depth's share,
    which enters r**2 - r**2/2 twice; the last summand of ``share`` makes up for it.
    """
    if a.is_scalar:
        return _scaled(a, a)
    bounds = None if a.bounds is None else a.interval().sqr()
    a = stocked(a, curved.ENOUGH if a.system.curved else MARGIN * _SQUARE / 1.9)
    if a.system.curved:
        return a.make(*curved.square(a), bounds=bounds)
    fmt, budget, twice = a.fmt, a.budget, a.centre + a.centre
    radius = a.radius()
    square = radius * radius
    share = (_RADIUS_SHARE * budget.credit + budget.depth + len(a.terms) + 4) * MARGIN * fmt.eps
    centre = fma(square, 0.5, a.centre * a.centre)
    error = fma(absolute(twice), a.error, fma(square, fmt.up(0.5 + share), fmt.tiny))
    after = Budget(1.9 * budget.credit, 0.9 * quanta(fmt), 2 * budget.depth + 2 * len(a.terms) + 6)
    terms = tuple(s.mul(twice, u) for u in a.terms)
    error, after = funded(fmt, centre, terms, error, after, _SQUARE)
    return a.make(centre, terms, error, after, bounds=bounds)


def powi(a: F, n: int) -> F:
    """a**n by repeated squares."""
    form = Number.powi(a, n)
    return form if n < 2 or not a.system.intersect else form.within(a.interval().powi(n))


def _beside(a: Form, b: Form, operation: str) -> Interval | None:
    """The same operation on the ranges, where the system keeps intervals."""
    if not a.system.intersect:
        return None
    result: Interval = getattr(a.interval(), operation)(b.interval())
    return result
