"""Evaluation of a row of the tables."""

from __future__ import annotations

from zeroset.arith.elementary.tables import coefficients
from zeroset.arith.format import Format
from zeroset.arith.scalar import Scalar, fma

__all__ = ["polynomial", "with_linear_term"]


def polynomial(name: str, fmt: Format, x: Scalar) -> Scalar:
    """The tabulated polynomial at x."""
    row = coefficients(name, fmt)
    value: Scalar = row[-1]
    for coefficient in reversed(row[:-1]):
        value = fma(value, x, coefficient)
    return value


def with_linear_term(name: str, fmt: Format, z: Scalar, square: Scalar) -> Scalar:
    """z + z**3 P(z**2)."""
    return fma(z * square, polynomial(name, fmt, square), z)
