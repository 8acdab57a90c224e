"""f along one ray as a polynomial, and its closed-form factors (SN10 section 4.1).

Evaluating f on polynomials in one symbol gives its coefficients along the ray, as intervals, so that their rounding is
known. The ray's stretch is mapped to e in [-1, 1] first: coefficients then share one scale. ``factor`` writes a
polynomial of degree <= 4 as a product of real quadratics (Herbison-Evans and Ferrari for the quartic, Blinn's cases
for the cubic). The factors are plain numbers with rounding in them; ``residual`` bounds what the product misses of the
polynomial, and with that every conclusion drawn from the factors is made certain or withheld. All of it runs in f32:
rays that it cannot settle are looked at again by other means.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import Any, NamedTuple

from zeroset.arith import F32 as FORMAT
from zeroset.arith import IntervalSystem, PolySystem, elementary
from zeroset.kernel import F32, Value, lift
from zeroset.solve.problem import Problem

SYSTEM = IntervalSystem(FORMAT)
Interval = Any
TINY = 1e-30
NEGLIGIBLE = 2.0**-24
"""A leading coefficient below this share of the largest is taken for this share."""


def as_value(x: Value | float) -> Value:
    """A Value as it is; a bound that came out as a plain number as a constant."""
    return lift(x, F32)


class RayPolynomial(NamedTuple):
    """f(o + t d) = sum of coefficients[k] e^k with t = middle + e * half.

    Attributes:
        coefficients: intervals, constant first.
        middle: centre of the stretch.
        half: half its length, a hair more, so that e in [-1, 1] covers it.
    """

    coefficients: tuple[Interval, ...]
    middle: Value
    half: Value

    def at(self, e: Interval) -> Interval:
        """The polynomial on an interval of e, by Horner's rule."""
        return horner(self.coefficients, e)

    def derivative(self) -> tuple[Interval, ...]:
        """Coefficients of the derivative by e."""
        return tuple(c * SYSTEM.constant(k, k) for k, c in enumerate(self.coefficients) if k)


def horner(coefficients: Sequence[Interval], e: Interval) -> Interval:
    """Value of a polynomial with interval coefficients on an interval."""
    value = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        value = value * e + c
    return value


def ray_polynomial(problem: Problem, degree: int) -> RayPolynomial:
    """Coefficients of f along the ray's stretch."""
    system = PolySystem(SYSTEM, degree)
    middle = (problem.t0 + problem.t1) * 0.5
    half = (problem.t1 - middle).maximum(middle - problem.t0).maximum(TINY) * (1.0 + 2.0**-20)
    points = []
    for o, d in zip(problem.ray.origin, problem.ray.direction, strict=True):
        through = SYSTEM.exact(o) + SYSTEM.exact(d) * SYSTEM.exact(middle)
        points.append(system.linear(through, SYSTEM.exact(d) * SYSTEM.exact(half)))
    f = problem.lowered.evaluate(system, *points)
    known = [c if c is not None else SYSTEM.constant(0.0, 0.0) for c in f.coefficients]
    known += [SYSTEM.constant(0.0, 0.0)] * (degree + 1 - len(known))
    return RayPolynomial(tuple(known), middle, half)


class Quadratic(NamedTuple):
    """The monic factor e^2 + b e + c, coefficients taken as exact."""

    b: Value
    c: Value

    def over(self, e: Interval) -> Interval:
        """Its range over an interval of e: exact up to rounding, by completing the square."""
        return (e + self._shift()).sqr() - self.discriminant()

    def _shift(self) -> Interval:
        return SYSTEM.exact(self.b) * SYSTEM.constant(0.5, 0.5)

    def discriminant(self) -> Interval:
        """b^2/4 - c: positive where the factor has two real roots."""
        return self._shift().sqr() - SYSTEM.exact(self.c)

    def roots(self) -> tuple[tuple[Interval, Value], ...]:
        """Both roots as intervals, with whether they can be real."""
        discriminant = self.discriminant()
        real = as_value(discriminant.hi) >= 0.0
        low = as_value(discriminant.lo).maximum(0.0)
        high = as_value(discriminant.hi).maximum(0.0)
        wide = SYSTEM.bounds(low, high).sqrt()
        # The root of larger magnitude adds up without cancelling; the other is c over it, unless both may be 0.
        flipped = self.b < 0.0
        size = SYSTEM.exact(abs(self.b)) * SYSTEM.constant(0.5, 0.5) + wide
        sure = as_value(size.lo) > TINY
        small = SYSTEM.exact(self.c) / SYSTEM.bounds(sure.select(size.lo, 1.0), sure.select(size.hi, 1.0))
        plain = SYSTEM.exact(abs(self.b)) * SYSTEM.constant(0.5, 0.5) - wide
        near_low, near_high = sure.select(small.lo, plain.lo), sure.select(small.hi, plain.hi)
        larger = _signed(flipped, as_value(size.lo), as_value(size.hi))
        smaller = _signed(flipped, near_low, near_high)
        return (larger, real), (smaller, real)


def _signed(flipped: Value, low: Value, high: Value) -> Interval:
    """The interval, negated unless ``flipped``."""
    return SYSTEM.bounds(flipped.select(low, -high), flipped.select(high, -low))


class Linear(NamedTuple):
    """The monic factor e - r, its root taken as exact."""

    r: Value

    def over(self, e: Interval) -> Interval:
        """Its range over an interval of e."""
        return e - SYSTEM.exact(self.r)

    def roots(self) -> tuple[tuple[Interval, Value], ...]:
        """Its one root, always real."""
        return ((SYSTEM.exact(self.r), self.r.eq(self.r)),)


Factor = Quadratic | Linear


class Factored(NamedTuple):
    """leading * product of monic factors = the polynomial within ``residual``, for e in [-1, 1]."""

    leading: Value
    factors: tuple[Factor, ...]
    residual: Value

    def over(self, e: Interval) -> Interval:
        """Range of the product over an interval of e."""
        value = SYSTEM.exact(self.leading)
        for factor in self.factors:
            value = value * factor.over(e)
        return value

    def roots(self) -> tuple[tuple[Interval, Value], ...]:
        """All candidates for real roots."""
        return tuple(root for factor in self.factors for root in factor.roots())


def middle_of(x: Interval) -> Value:
    """Some number inside an interval."""
    return (as_value(x.lo) + as_value(x.hi)) * 0.5


def largest(coefficients: Sequence[Interval]) -> Value:
    """The largest magnitude among the coefficients' middles."""
    sizes = [abs(middle_of(x)) for x in coefficients]
    return reduce(lambda a, b: a.maximum(b), sizes)


def factor(coefficients: Sequence[Interval]) -> Factored:
    """Factor a polynomial of degree 1 to 4 in e; a leading coefficient far below the others shows in the residual."""
    c = [middle_of(x) for x in coefficients]
    lead = c[-1]
    # Factors with roots beyond 2^24 would leave the range in which f32 can square and cube them.
    least = (largest(coefficients) * NEGLIGIBLE).maximum(TINY)
    safe = (abs(lead) > least).select(lead, least)
    monic = [x / safe for x in c[:-1]]
    factors = _FACTORINGS[len(monic)](monic)
    return Factored(safe, factors, _residual(coefficients, safe, factors))


def _residual(coefficients: Sequence[Interval], lead: Value, factors: tuple[Factor, ...]) -> Value:
    """Bound of |polynomial - product| on [-1, 1]: the sum of the coefficients' differences."""
    product = [SYSTEM.exact(lead)]
    for item in factors:
        if isinstance(item, Linear):
            monic = [-SYSTEM.exact(item.r), None]
        else:
            monic = [SYSTEM.exact(item.c), SYSTEM.exact(item.b), None]
        longer: list[Interval] = [SYSTEM.constant(0.0, 0.0)] * (len(product) + len(monic) - 1)
        for i, x in enumerate(product):
            for j, y in enumerate(monic):
                longer[i + j] = longer[i + j] + (x if y is None else x * y)
        product = longer
    total = SYSTEM.constant(0.0, 0.0)
    for x, y in zip(coefficients, product, strict=True):
        total = total + (x - y).abs()
    return as_value(total.hi)


def _linear(m: list[Value]) -> tuple[Factor, ...]:
    return (Linear(-m[0]),)


def _quadratic(m: list[Value]) -> tuple[Factor, ...]:
    return (Quadratic(m[1], m[0]),)


def _cubic(m: list[Value]) -> tuple[Factor, ...]:
    """One real root by Blinn's cases, polished, then the quadratic that is left."""
    c0, c1, c2 = m
    third = c2 * (1.0 / 3.0)
    p = c1 - c2 * third
    q = c0 + third * (2.0 * third * third - c1)
    r = largest_real_root(p, q) - third
    for _ in range(2):
        value = ((r + c2) * r + c1) * r + c0
        slope = (3.0 * r + 2.0 * c2) * r + c1
        r = r - (abs(slope) > TINY).select(value / (abs(slope) > TINY).select(slope, 1.0), 0.0)
    b = c2 + r
    return Linear(r), Quadratic(b, c1 + r * b)


def largest_real_root(p: Value, q: Value) -> Value:
    """The largest real root of y^3 + p y + q: trigonometric where three are real, Cardano's otherwise."""
    half, scaled = q * 0.5, p * (1.0 / 3.0)
    discriminant = half * half + scaled * scaled * scaled
    single = discriminant > 0.0
    big = abs(half) + discriminant.maximum(0.0).sqrt()
    a = elementary.cbrt(FORMAT, big)
    a = (half > 0.0).select(-a, a)
    cardano = a - (abs(a) > TINY).select(scaled / (abs(a) > TINY).select(a, 1.0), 0.0)
    root = (-scaled).maximum(0.0).sqrt()
    cosine = -half / (root * root * root).maximum(TINY)
    angle = elementary.acos(FORMAT, cosine.maximum(-1.0).minimum(1.0)) * (1.0 / 3.0)
    return single.select(cardano, root * 2.0 * elementary.cos(FORMAT, angle))


def _quartic(m: list[Value]) -> tuple[Factor, ...]:
    """Ferrari: depress, take the resolvent cubic's largest root, split into two quadratics."""
    c0, c1, c2, c3 = m
    shift = c3 * 0.25
    square = shift * shift
    p = c2 - 6.0 * square
    q = c1 - 2.0 * shift * c2 + 8.0 * shift * square
    r = c0 - shift * c1 + square * c2 - 3.0 * square * square
    # 2m = s^2 with 8 m^3 + 8 p m^2 + (2 p^2 - 8 r) m - q^2 = 0; with u = 2m: u^3 + 2p u^2 + (p^2 - 4r) u - q^2 = 0.
    third = p * (2.0 / 3.0)
    a1 = p * p - 4.0 * r
    depressed_p = a1 - 2.0 * p * third
    depressed_q = -q * q + third * (2.0 * third * third - a1)
    u = (largest_real_root(depressed_p, depressed_q) - third).maximum(0.0)
    s = u.sqrt()
    # q/s loses its digits for small s; there the constants differ by the root of the biquadratic's discriminant.
    biquadratic = (p * p * 0.25 - r).maximum(0.0).sqrt()
    skew = (u > 1e-6).select(q / (s > 1e-10).select(s, 1.0) * 0.5, biquadratic)
    centre = (p + u) * 0.5
    return (
        _shifted(s, centre - skew, shift),
        _shifted(-s, centre + skew, shift),
    )


def _shifted(b: Value, c: Value, shift: Value) -> Quadratic:
    """y^2 + b y + c with y = e + shift."""
    return Quadratic(b + 2.0 * shift, shift * shift + b * shift + c)


_FACTORINGS = {1: _linear, 2: _quadratic, 3: _cubic, 4: _quartic}
