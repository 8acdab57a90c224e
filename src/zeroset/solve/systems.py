"""Which enclosure is tight and cheap for a field."""

from __future__ import annotations

from typing import Protocol

from zeroset.arith import AffineSystem, Format

STEEP = 24
"""Whole powers from here on are enclosed better by an interval beside the form: x^500 over [0.9, 1.1] is no line."""
BENT = 5
"""Degree of polynomials from which on a form along a ray keeps its bend: their terms are large and cancel."""
STRAIGHT = 16
"""Whole powers from which on it does not: x^20 has more than one bend, and nothing that cancels it."""


class Powered(Protocol):
    """What is asked of a field, a body or a shape here."""

    @property
    def highest_power(self) -> int:
        """The largest whole exponent in any of its formulas."""

    @property
    def degree(self) -> int | None:
        """An upper bound of the degree of its formulas; None where one is no polynomial."""

    @property
    def continuous(self) -> bool:
        """Whether all of its formulas are likely to be defined and continuous everywhere."""


def automatic_system(field: Powered, fmt: Format, symbols: int = 1) -> AffineSystem:
    """Affine, with the interval beside the form where very high powers or ends of domains ask for it; bends along rays.

    Measured over the gallery at 512 squared: the interval saves no evaluations on other surfaces, and doubles the cost
    of each. Where f jumps or has no value nearby, forms know little and intervals much: without them 887 of 2000 rays
    leave log(x) - y open, with them none does, after a fifth of the evaluations. The bend makes one cost about half as
    much again and halves their number away from the surface: Sarti's rays take 0.45 of the time, the decic's 0.8, the
    sextic's 0.85, others' of degree 5 and more 0.85 to 1. For beams it gains nothing, as they are as wide as their
    steps are long.
    """
    degree, power = field.degree, field.highest_power
    curved = symbols == 1 and degree is not None and degree >= BENT and power < STRAIGHT
    beside = power >= STEEP or (degree is None and not field.continuous)
    return AffineSystem(fmt, symbols=symbols, intersect=beside, curved=curved)
