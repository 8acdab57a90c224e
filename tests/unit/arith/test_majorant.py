"""What a majorant says was rounded, against exact polynomials."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from flint import fmpq, fmpq_poly

from zeroset.arith import F32, AffineSystem, MajorantSystem, NotPolynomialError, PolySystem, RealSystem

FORMULAS: dict[str, Any] = {
    "quartic": lambda x, y, c: (x * x * c - y).sqr() + (x + y).powi(3) * 0.1 - 5.0 * y + 11.8,
    "cancelling": lambda x, y, c: (x - y).powi(4) - x.powi(4) + c * (x + y - 2.0 * x),
    "divided": lambda x, y, c: (x.powi(3) - c) / 3.0 + y.sqr() / 0.25 - x.scaled(2.0),
}


def exact(value: float) -> fmpq:
    fraction = Fraction(float(value))
    return fmpq(fraction.numerator, fraction.denominator)


class Exact:
    """An exact polynomial that answers to the numbers' methods."""

    def __init__(self, p: Any) -> None:
        self.p = p

    def of(self, other: Any) -> Any:
        return other.p if isinstance(other, Exact) else exact(other)

    def __add__(self, other: Any) -> Exact:
        return Exact(self.p + self.of(other))

    def __sub__(self, other: Any) -> Exact:
        return Exact(self.p - self.of(other))

    def __mul__(self, other: Any) -> Exact:
        return Exact(self.p * self.of(other))

    def __truediv__(self, other: Any) -> Exact:
        return Exact(self.p * (1 / self.of(other)))

    def __rmul__(self, other: Any) -> Exact:
        return self * other

    def powi(self, n: int) -> Exact:
        return Exact(self.p**n)

    def sqr(self) -> Exact:
        return self.powi(2)

    def scaled(self, factor: float) -> Exact:
        return self * factor


@pytest.mark.parametrize("name", FORMULAS)
@pytest.mark.parametrize("scale", [1e-15, 1e-3, 1.0, 1e4])
def test_what_was_rounded_is_within_the_bound(name: str, scale: float) -> None:
    rng = np.random.default_rng(7)
    reals, sizes = RealSystem(F32), MajorantSystem(F32)
    system = PolySystem(reals, 4)
    for _ in range(50):
        line = (rng.normal(size=(2, 2)) * scale).astype(np.float32)
        c, error = np.float32(rng.normal()), np.float32(2.0**-26)
        true = exact(c) + exact(error) * exact(rng.uniform(-1, 1))
        p = FORMULAS[name](*(system.linear(reals.exact(a), reals.exact(b)) for a, b in line), system.enclose(c, error))
        m = FORMULAS[name](*(sizes.linear(abs(a) + abs(b)) for a, b in line), sizes.enclose(c, error))
        q = FORMULAS[name](*(Exact(fmpq_poly([exact(a), exact(b)])) for a, b in line), Exact(fmpq_poly([true]))).p
        off = sum(abs(exact(p.coefficient(k).value) - q[k]) for k in range(5))
        assert off <= exact(m.bound())
        # And it is no bound of everything: a few hundred roundings of the largest coefficient.
        largest = max(abs(q[k]) for k in range(5))
        assert m.bound() <= 1e3 * F32.eps * (float(largest.p) / float(largest.q) + 20 * max(scale, 1.0) ** 4)


def test_constants_that_no_float_holds_count_as_rounded() -> None:
    sizes = MajorantSystem(F32)
    assert sizes.constant(0.5, 0.5).bound() == 0.0
    assert sizes.constant(0.5, 0.5).bound(1) >= 0.5 * F32.eps
    assert sizes.constant(0.1, 0.1).bound() >= abs(float(np.float32(0.1)) - 0.1)
    third = sizes.constant(np.nextafter(1 / 3, 0), np.nextafter(1 / 3, 1))
    assert third.bound() >= 0.5 * F32.eps / 3


@pytest.mark.parametrize(
    "operation",
    [
        lambda t: t.sin(), lambda t: 1.0 / t, lambda t: t.powi(-1), lambda t: t.powr((1, 2)), lambda t: t.sqrt(), abs,
        lambda t: t.lt(t), lambda t: t.max(t), lambda t: t.mod(t), lambda t: t.pow(t), lambda t: t / (t.literal(0.1)),
        lambda t: t.system.constant(1e38, 1e39), lambda t: t.system.general(t), lambda t: t.powi(3000),
    ],
)  # fmt: skip
def test_what_it_cannot_bound_is_refused(operation: Any) -> None:
    with pytest.raises(NotPolynomialError):
        operation(MajorantSystem(F32).linear(1.5))


def test_affine_forms_without_symbols_agree() -> None:
    """Both bound the same coefficients, so their enclosures meet."""
    rng = np.random.default_rng(3)
    inner, reals, sizes = AffineSystem(F32, symbols=0), RealSystem(F32), MajorantSystem(F32)
    for _ in range(50):
        line = rng.normal(size=(2, 2)).astype(np.float32)
        systems = PolySystem(inner, 4), PolySystem(reals, 4)
        c = np.float32(rng.normal())
        a, p = (
            FORMULAS["quartic"](
                *(s.linear(s.inner.exact(v), s.inner.exact(w)) for v, w in line), s.lift(s.inner.exact(c))
            )
            for s in systems
        )
        m = FORMULAS["quartic"](*(sizes.linear(abs(v) + abs(w)) for v, w in line), sizes.exact(c))
        for k in range(5):
            bounds, value = a.coefficient(k).interval(), p.coefficient(k).value
            assert bounds.lo - m.bound() <= value <= bounds.hi + m.bound()
