"""Which enclosure is tight and cheap for a field."""

from __future__ import annotations

from zeroset.arith import AffineSystem, Format
from zeroset.solve.field import Field


def automatic_system(field: Field, fmt: Format, symbols: int = 1) -> AffineSystem:
    """Affine; with the interval beside the form where f is no polynomial of moderate degree.

    Powers of high order, kinks and roots are where plain intervals are tighter than any linear form.
    """
    degree = field.degree
    return AffineSystem(fmt, symbols=symbols, intersect=degree is None or degree > 18)
