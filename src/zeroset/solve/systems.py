"""Which enclosure is tight and cheap for a field."""

from __future__ import annotations

from typing import Protocol

from zeroset.arith import AffineSystem, Format

STEEP = 24
"""Whole powers from here on are enclosed better by an interval beside the form: x^500 over [0.9, 1.1] is no line."""


class Powered(Protocol):
    """What is asked of a field, a body or a shape here."""

    @property
    def highest_power(self) -> int:
        """The largest whole exponent in any of its formulas."""


def automatic_system(field: Powered, fmt: Format, symbols: int = 1) -> AffineSystem:
    """Affine, with the interval beside the form only where very high powers ask for it.

    Measured over the gallery at 512 squared: the interval saves no evaluations on other surfaces, and doubles the cost
    of each.
    """
    return AffineSystem(fmt, symbols=symbols, intersect=field.highest_power >= STEEP)
