"""Products and squares of forms that keep one curvature: T2 of their last symbol, the one that runs along a ray.

A product of c + u e and d + v e holds u v e**2, which an affine form can only put into its error. That is why a sum of
large terms that cancel is enclosed badly: the lines in it cancel, the parabolas do not. With e**2 = (1 + T2(e))/2 for
Chebyshev's T2(e) = 2 e**2 - 1 in [-1, 1] the parabola is one more coefficient, an ordinary term for everything that is
linear; only what follows here knows better: T1 T1 = (1 + T2)/2, T1 T2 = (T1 + T3)/2 and T2 T2 = (1 + T4)/2, of which T3
and T4 are error. The error then shrinks with the third power of a step. These are Chebyshev models of degree two:
Brisebarre and Joldes, Chebyshev interpolation polynomial-based tools for rigorous computing, ISSAC 2010,
doi:10.1145/1837934.1837966.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from zeroset.arith import scalar as s
from zeroset.arith.budget import MARGIN, Budget, funded, quanta
from zeroset.arith.scalar import Scalar, absolute, add, fma, mul

if TYPE_CHECKING:
    from zeroset.arith.affine_form import Form
    from zeroset.arith.format import Format

__all__ = ["ENOUGH", "PRICE", "product", "square"]

Coefficients = tuple[Scalar, tuple[Scalar, ...], Scalar, Budget]
"""Centre, terms, error and account of a form."""
PRICE = 3.0
"""Roundings that each of a product's products of coefficients goes through at most, its sums included."""
ENOUGH = MARGIN * PRICE / 1.9
"""Credit with which a square pays for itself."""
_RADIUS_SHARE = 16.0
_DEPTH = 10


class _Parts(NamedTuple):
    """What a form is made of: the line and the bend of the curved symbol, and how far everything else reaches."""

    line: Scalar
    bend: Scalar
    rest: Scalar

    @classmethod
    def of(cls, a: Form) -> _Parts:
        rest = a.error
        for term in a.terms[:-2]:
            rest = add(absolute(term), rest)
        return cls(a.terms[-2], a.terms[-1], rest)

    def known(self) -> Scalar:
        """How far line and bend reach."""
        return add(_size(self.line), _size(self.bend))


def _size(term: Scalar) -> Scalar:
    return term if s.is_zero(term) else absolute(term)


def product(a: Form, b: Form) -> Coefficients:
    """The product of two forms with credit for it.

    All products of coefficients together are at most M_a M_b, and each is rounded PRICE times at most, those of T3 and
    T4 included. With k and r for the reach of line and bend and of the rest, and A, B for |c_a|, |c_b|, the error
    r_a (k_b + r_b) + k_a r_b + B error_a + A error_b grows by M_b for each unit of error_a beyond the true one and by
    M_a for each of error_b: the credits add up, as in the plain product.
    """
    x, y = _Parts.of(a), _Parts.of(b)
    lines, bends = mul(x.line, y.line), mul(x.bend, y.bend)
    mixed = fma(x.line, y.bend, mul(x.bend, y.line))
    known_a, known_b = x.known(), y.known()
    error = fma(x.rest, add(known_b, y.rest), fma(known_a, y.rest, a.fmt.tiny))
    error = fma(absolute(b.centre), a.error, fma(absolute(a.centre), b.error, error))
    depth = a.budget.depth + b.budget.depth + 2 * len(a.terms) + _DEPTH
    budget = Budget(a.budget.credit + b.budget.credit, 0.9 * quanta(a.fmt), depth)
    terms = [fma(a.centre, v, mul(b.centre, u)) for u, v in zip(a.terms, b.terms, strict=True)]
    return _form(a.fmt, mul(a.centre, b.centre), terms, error, budget, lines, bends, mixed)


def square(a: Form) -> Coefficients:
    """The square of a form with credit ``ENOUGH``; that of the rest is in [0, r**2], and its half goes to the centre.

    With X = |c| + k, k and r as for a product, the error 2 |c| error + 2 k r + r**2/2 + 16 q eps r**2 of a form with
    credit q exceeds the true one by 2 q eps X (X + r) + 16 q eps r**2, at least 1.9 q eps (X + r)**2. What the rest
    as computed lacks of its depth's share enters twice, which the last summand of ``share`` makes up for.
    """
    fmt, budget, x = a.fmt, a.budget, _Parts.of(a)
    twice = a.centre + a.centre
    rest = mul(x.rest, x.rest)
    share = (_RADIUS_SHARE * budget.credit + budget.depth + len(a.terms) + 4) * MARGIN * fmt.eps
    error = fma(rest, fmt.up(0.5 + share), fmt.tiny)
    known = x.known()
    error = fma(absolute(twice), a.error, fma(add(known, known), x.rest, error))
    after = Budget(1.9 * budget.credit, 0.9 * quanta(fmt), 2 * budget.depth + 2 * len(a.terms) + _DEPTH)
    terms = [mul(twice, u) for u in a.terms]
    both = mul(x.line, x.bend)
    centre = fma(rest, 0.5, mul(a.centre, a.centre))
    return _form(fmt, centre, terms, error, after, mul(x.line, x.line), mul(x.bend, x.bend), add(both, both))


def _form(
    fmt: Format,
    centre: Scalar,
    terms: list[Scalar],
    error: Scalar,
    budget: Budget,
    lines: Scalar,
    bends: Scalar,
    mixed: Scalar,
) -> Coefficients:
    """With the products of lines and bends put where they belong: halves of them to 1, T1 and T2, and to the error."""
    centre = fma(add(lines, bends), 0.5, centre)
    terms[-2] = fma(mixed, 0.5, terms[-2])
    terms[-1] = fma(lines, 0.5, terms[-1])
    error = fma(add(_size(mixed), _size(bends)), 0.5, error)
    error, after = funded(fmt, centre, tuple(terms), error, budget, PRICE)
    return centre, tuple(terms), error, after
