"""Round numbers along a range, and how numbers are written."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import pairwise


def ticks(low: float, high: float, most: int) -> list[float]:
    """Round numbers from low to high, evenly spaced, at most so many.

    Example:
        >>> ticks(-2.0, 2.0, 5)
        [-2.0, -1.0, 0.0, 1.0, 2.0]
        >>> ticks(0.0, 0.87, 4)
        [0.0, 0.5]
    """
    rough = (high - low) / max(most, 1)
    unit = 10.0 ** math.floor(math.log10(rough))
    for step in (s * unit for s in (1.0, 2.0, 5.0, 10.0, 20.0)):
        # A hair beyond the ends is rounding.
        first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
        if last - first + 1 <= most:
            return [i * step + 0.0 for i in range(first, last + 1)]
    return []


def labels(values: list[float]) -> list[str]:
    """The numbers as text, all in one form: decimals where those are short, else powers of ten.

    Example:
        >>> labels([-0.5, 0.0, 0.5])
        ['-0.5', '0.0', '0.5']
        >>> labels([0.0, 20000000.0])
        ['0', '2e7']
    """
    largest = max(map(abs, values), default=0.0)
    step = min((b - a for a, b in pairwise(values)), default=largest) or 1.0
    if largest >= 1e5 or (0 < largest < 1e-3):
        return [_scientific(v, step) for v in values]
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    return [f"{v:.{decimals}f}" for v in values]


def exact_labels(values: Sequence[float]) -> list[str]:
    """Numbers that somebody has chosen as text: each as short as it can be told from the others.

    Example:
        >>> exact_labels([-1.5, 0.0, 6.0, 1e-7])
        ['-1.5', '0', '6', '1e-7']
        >>> exact_labels([1.00001, 1.00002])
        ['1.00001', '1.00002']
    """
    for digits in (4, 6, 9, 17):
        texts = [f"{v + 0.0:.{digits}g}" for v in values]
        if len(set(texts)) == len(set(values)):
            break
    return [re.sub(r"e([+-])0*", lambda sign: "e-" if sign[1] == "-" else "e", text) for text in texts]


def _scientific(value: float, step: float) -> str:
    if value == 0.0:
        return "0"
    digits = max(0, math.floor(math.log10(abs(value)) + 1e-9) - math.floor(math.log10(step) + 1e-9))
    mantissa, exponent = f"{value:.{digits}e}".split("e")
    return f"{mantissa}e{int(exponent)}"
