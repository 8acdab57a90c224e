"""Polynomials in t over the rationals and one square root, p + q sqrt(m), and all their real roots with multiplicity.

Most algebraic surfaces of the gallery have rational coefficients; Barth's, Endrass' and Sarti's have sqrt(5) or
sqrt(2). f along a ray is then such a polynomial exactly, and whether a root is double is decided, not guessed: f times
its conjugate p - q sqrt(m) has rational coefficients, FLINT isolates its roots, and balls tell which are f's.
What leads out of these numbers raises ``Beyond``, or has no method: then the judge takes balls.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from flint import arb, fmpq, fmpq_poly, fmpz

Root = tuple[Any, int]
"""A ball around one real root, and its multiplicity."""

NOTHING = fmpq_poly([])


class Beyond(Exception):  # noqa: N818 -- no error, an answer
    """f along this ray is none of these polynomials."""


class Surd:
    """p + q sqrt(m), with p and q in Q[t] and m a squarefree whole number (1 where q = 0)."""

    __slots__ = ("m", "p", "q")

    def __init__(self, p: fmpq_poly, q: fmpq_poly = NOTHING, m: int = 1) -> None:
        self.p = p
        self.q = q
        self.m = m if q.degree() >= 0 else 1

    def _common(self, o: Surd) -> int:
        if self.m != o.m and 1 not in (self.m, o.m):
            raise Beyond("two different square roots")
        return max(self.m, o.m)

    def add(self, o: Surd) -> Surd:
        return Surd(self.p + o.p, self.q + o.q, self._common(o))

    def sub(self, o: Surd) -> Surd:
        return self.add(o.neg())

    def neg(self) -> Surd:
        return Surd(-self.p, -self.q, self.m)

    def mul(self, o: Surd) -> Surd:
        m = self._common(o)
        return Surd(self.p * o.p + m * (self.q * o.q), self.p * o.q + self.q * o.p, m)

    def sqr(self) -> Surd:
        return self.mul(self)

    def powi(self, n: int) -> Surd:
        if n < 0:
            return Surd(fmpq_poly([1])).div(self.powi(-n))
        if self.m == 1:
            return Surd(self.p**n)
        if n <= 1:
            return self if n else Surd(fmpq_poly([1]))
        half = self.powi(n // 2).sqr()
        return half.mul(self) if n % 2 else half

    def div(self, o: Surd) -> Surd:
        if max(o.p.degree(), o.q.degree()) != 0:
            raise Beyond("the quotient is no polynomial")
        inverse = 1 / (o.p[0] ** 2 - o.m * o.q[0] ** 2)
        return self.mul(Surd(o.p * inverse, -o.q * inverse, o.m))

    def sqrt(self) -> Surd:
        if self.m != 1 or self.p.degree() > 0 or self.p[0] < 0:
            raise Beyond("no square root of a rational number")
        # sqrt(a / b) = sqrt(a b) / b, and a square factor comes out.
        a, b = self.p[0].p, self.p[0].q
        factors = (a * b).factor() if a else []
        outside, inside = fmpz(1 if a else 0), fmpz(1)
        for prime, times in factors:
            outside *= prime ** (times // 2)
            inside *= prime ** (times % 2)
        root = fmpq_poly([fmpq(outside, b)])
        return Surd(root) if inside == 1 else Surd(NOTHING, root, int(inside))

    @property
    def is_zero(self) -> bool:
        """Whether f vanishes on the whole line."""
        return self.p.degree() < 0 and self.q.degree() < 0

    def roots(self) -> list[Root]:
        """All real roots, from the left, with multiplicity; f must not vanish identically."""
        if self.m == 1:
            return _sorted(_real_roots(self.p))
        shared = self.p.gcd(self.q)
        p, q = self.p // shared, self.q // shared
        found = _sorted([*_real_roots(shared), *self._own_roots(p, q)])
        return list(_merged(found))

    def _own_roots(self, p: fmpq_poly, q: fmpq_poly) -> Iterator[Root]:
        """Roots of the part that shares none with its conjugate: there one of the two is certainly not 0."""
        root_m = arb(self.m).sqrt()
        for ball, times in _real_roots(p * p - self.m * (q * q)):
            here, conjugate = _at(p, ball) + root_m * _at(q, ball), _at(p, ball) - root_m * _at(q, ball)
            if conjugate > 0 or conjugate < 0:
                yield ball, times
            elif not (here > 0 or here < 0):
                raise Beyond("the precision does not tell a root from its conjugate's")


def _at(p: fmpq_poly, x: Any) -> Any:
    value = arb(0)
    for c in reversed(p.coeffs()):
        value = value * x + arb(c)
    return value


def _real_roots(p: fmpq_poly) -> list[Root]:
    if p.degree() < 1:
        return []
    return [(root.real, times) for root, times in p.numer().complex_roots() if root.imag == 0]


def _sorted(roots: list[Root]) -> list[Root]:
    return sorted(roots, key=lambda root: float(root[0].mid()))


def _merged(roots: list[Root]) -> Iterator[Root]:
    """One root for those that the two parts have in common; balls that touch are taken for the same."""
    last: Root | None = None
    for ball, times in roots:
        if last is not None and last[0].overlaps(ball):
            last = (last[0].union(ball), last[1] + times)
            continue
        if last is not None:
            yield last
        last = (ball, times)
    if last is not None:
        yield last
