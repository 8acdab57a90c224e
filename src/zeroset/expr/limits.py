"""The limits of formulas, stated in one place and enforced everywhere in bounded time.

They are far beyond what people write and what a compiler digests at interactive speed; they exist so
that a slip (`x^(10^9)`, a pasted file) gets an answer at once rather than a hang.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.errors import FormulaLimitError

if TYPE_CHECKING:
    from fractions import Fraction

TEXT = 100_000
"""Characters in the text of one formula."""

NODES = 100_000
"""Distinct operations in one formula, after equal parts have been shared.

While a text is read those that rewriting takes away again count too, to bound the time.
"""

NESTING = 1_000
"""Depth of parentheses, absolute values, and function calls in the text of a formula."""

POWER = 4_096
"""Largest whole exponent, by magnitude: x^4096 is the highest power."""

CHEBYSHEV = 512
"""Largest order n of `T(n, x)`."""

SUMS = 8
"""Depth of sums within sums."""

LITERAL_DIGITS = 400
"""Digits of a number in the text, and the largest power of ten in its exponent."""

RATIONAL_BITS = 2_048
"""Bits of numerator or denominator up to which constants are folded exactly."""

POLYNOMIAL_WORK = 300_000
"""Products of two terms that the expansion of a polynomial may cost."""


def check_power(exponent: int) -> None:
    """Raise `FormulaLimitError` for a whole exponent past `POWER`."""
    if abs(exponent) > POWER:
        shown = str(exponent) if abs(exponent) < 10**15 else "of more than 15 digits"
        raise FormulaLimitError(
            f"the exponent {shown} is too large: whole exponents go up to {POWER}",
            hint="for growth that steep write exp(n*log(x))",
        )


def check_nodes(count: int) -> None:
    """Raise `FormulaLimitError` for a formula of more than `NODES` distinct operations."""
    if count > NODES:
        raise FormulaLimitError(
            f"the formula has more than {NODES:,} distinct operations",
            hints=(
                "put repeated data (such as sphere centres) into an array parameter: sum(i, ... c[i] ...)",
                "draw parts of it as surfaces of their own",
            ),
        )


def small(value: Fraction) -> bool:
    """Whether a rational is short enough to be worth folding exactly."""
    return value.numerator.bit_length() <= RATIONAL_BITS and value.denominator.bit_length() <= RATIONAL_BITS
