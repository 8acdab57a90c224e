"""The rounding account of an affine form, kept while tracing so that the kernel pays little for soundness.

A form c + sum u_i e_i with error bound e stands for reals x with |x - c - sum u_i e_i| <= E. Rounding must flow into
e; done after each operation that would double its cost. Instead e is kept larger than needed by a known amount, and
operations spend from that. The invariant, with M = |c| + sum |u_i| + E, eps the unit roundoff and q the smallest
normal number, is

    e * (1 - eps)**-depth  >=  E + credit * eps * M + slack * q.

``credit``, ``slack`` and ``depth`` are Python numbers. All of e's own arithmetic adds and multiplies non-negative
scalars, so each of its roundings loses at most a factor 1 - eps and costs one ``depth``, repaid by one literal factor
when the range is asked for. What each operation spends is derived where it is written; MARGIN covers the terms of
second order, which stay below credit**2 * eps since ``credit`` is capped. When credit runs out it is bought: e +
(price + STOCK) * eps * (|c| + sum |u_i|).
"""

from __future__ import annotations

from typing import NamedTuple

from zeroset.arith.format import Format
from zeroset.arith.scalar import Scalar, absolute, add, fma, mul

__all__ = ["MARGIN", "STOCK", "Budget", "bought", "funded", "magnitude", "repaid"]

STOCK = 3.0
"""Credit bought at once: a product of two forms with 2 or more each keeps its credit, a square with 3 gains."""
MARGIN = 1.001
"""What an operation's price is multiplied by, for terms of second order in eps."""
_CAP = 500.0
_DEEP = 1024
_PLENTY = 1000.0


class Budget(NamedTuple):
    """What is known about the error bound of a form; see the module's text.

    Attributes:
        credit: rounding paid for in advance, in units of eps * M.
        slack: underflow paid for in advance, in units of the smallest normal number.
        depth: roundings that the computed error bound has gone through.
    """

    credit: float = 0.0
    slack: float = 0.0
    depth: int = 0

    def spend(self, price: float) -> Budget:
        """The account after an operation that rounds by ``price * eps * M``; credit may come out negative."""
        return Budget(min(self.credit, _CAP) - MARGIN * price, self.slack, self.depth)

    def worst(self, other: Budget) -> Budget:
        """What holds for whichever of two forms."""
        return Budget(min(self.credit, other.credit), min(self.slack, other.slack), max(self.depth, other.depth))


def magnitude(centre: Scalar, terms: tuple[Scalar, ...]) -> Scalar:
    """|c| + sum |u_i|."""
    total = absolute(centre)
    for term in terms:
        total = add(total, absolute(term))
    return total


def quanta(fmt: Format) -> float:
    """How many smallest normal numbers make ``tiny``."""
    return fmt.tiny / fmt.quantum


def repaid(fmt: Format, error: Scalar, depth: int) -> Scalar:
    """The error bound with the roundings of its own arithmetic made good, this multiplication's included."""
    return error if depth == 0 else mul(error, fmt.up(1.0 + MARGIN * (depth + 1) * fmt.eps))


def bought(
    fmt: Format,
    centre: Scalar,
    terms: tuple[Scalar, ...],
    error: Scalar,
    budget: Budget,
    price: float = 0.0,
    stock: float = STOCK,
) -> tuple[Scalar, Budget]:
    """A larger error bound that pays ``price * eps * (|c| + sum |u_i|)`` and leaves ``stock`` more credit and full
    slack.

    The stock's share of E itself is not added but taken as depth: stock * eps * E is what as many roundings of e lose.
    """
    share = (MARGIN * price + stock) * MARGIN * fmt.eps
    plenty = budget.slack >= _PLENTY
    larger = fma(magnitude(centre, terms), share, error if plenty else add(error, fmt.tiny))
    slack = budget.slack if plenty else max(budget.slack, 0.0) + 0.9 * quanta(fmt)
    depth = budget.depth + len(terms) + 5 + int(stock + price)
    return larger, Budget(max(budget.credit, 0.0) + stock, slack, depth)


def funded(
    fmt: Format, centre: Scalar, terms: tuple[Scalar, ...], error: Scalar, budget: Budget, price: float = 0.0
) -> tuple[Scalar, Budget]:
    """The error bound and account after an operation that rounds its results by ``price`` each.

    Spends credit where there is enough, buys it where not, and repays a depth grown large.
    """
    after = budget.spend(price)
    if after.credit < 0 or after.slack < 0:
        error, after = bought(fmt, centre, terms, error, budget, price)
    if after.depth > _DEEP:
        error, after = repaid(fmt, error, after.depth), after._replace(depth=0)
    return error, after
