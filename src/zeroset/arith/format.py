"""Floating-point formats: the numbers that every error bound of ``arith`` is written in.

A number knows its format explicitly, because a Python float may stand for a constant of either one. ``tiny`` and
``big`` replace what hardware may not have: gradual underflow and infinity.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import NamedTuple

__all__ = ["F32", "F64", "Format"]


class Format(NamedTuple):
    """A binary floating-point format.

    Attributes:
        name: ``f32`` or ``f64``, the name of the kernel type.
        dtype: NumPy's name of the type.
        digits: bits of the significand.
        eps: unit roundoff, 2**-digits: the relative error of one rounding to nearest.
        quantum: smallest normal number: the most that flushing a subnormal to zero can lose.
        tiny: absolute slack that covers thousands of flushed or underflowing results.
        big: finite stand-in for infinity. A bound at or beyond it claims nothing on its side; 1/big <= tiny.
    """

    name: str
    dtype: str
    digits: int
    eps: float
    quantum: float
    tiny: float
    big: float

    def round(self, value: float) -> float:
        """The number of this format nearest to ``value``, clamped to ``[-big, big]``; zero for subnormals."""
        value = max(-self.big, min(self.big, float(value)))
        if abs(value) < self.quantum:
            return 0.0
        if self.digits == 53:
            return value
        mantissa, exponent = math.frexp(value)
        # round() takes halves to even, as the hardware does.
        return math.ldexp(round(math.ldexp(mantissa, self.digits)), exponent - self.digits)

    def exact(self, value: float) -> bool:
        """Whether ``value`` is a number of this format (normal or zero, within ``[-big, big]``)."""
        return self.round(value) == value

    def down(self, value: float) -> float:
        """A number of this format at or below ``value``, within an ulp; ``big`` for anything above it."""
        rounded = self.round(value)
        return rounded if rounded <= value else self.step(rounded, -1)

    def up(self, value: float) -> float:
        """A number of this format at or above ``value``, within an ulp."""
        return -self.down(-value)

    def step(self, value: float, direction: int) -> float:
        """The neighbour of a number of this format; next to zero lies the smallest normal."""
        if value == 0.0:
            return direction * self.quantum
        mantissa, exponent = math.frexp(value)
        scaled = math.ldexp(mantissa, self.digits)
        # Towards zero from a power of two the spacing halves.
        unit = 0.5 if abs(mantissa) == 0.5 and direction * value < 0 else 1.0
        moved = math.ldexp(scaled + direction * unit, exponent - self.digits)
        return 0.0 if abs(moved) < self.quantum else moved

    def ceiling(self, value: Fraction) -> float:
        """A number of this format at or above a rational, within two ulps."""
        nearest = float(value)
        return self.up(nearest if Fraction(nearest) >= value else math.nextafter(nearest, math.inf))


F32 = Format("f32", "float32", 24, 2.0**-24, 2.0**-126, 2.0**-112, 2.0**112)
F64 = Format("f64", "float64", 53, 2.0**-53, 2.0**-1022, 2.0**-1000, 2.0**1000)
