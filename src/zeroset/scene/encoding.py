"""The sRGB curve for single numbers: what people write is encoded, what light is calculated in is linear."""

from __future__ import annotations


def srgb(linear: float) -> float:
    """The sRGB encoding of one linear channel in [0, 1]."""
    x = min(max(linear, 0.0), 1.0)
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


def linear(encoded: float) -> float:
    """The linear light of an sRGB channel in [0, 1].

    Example:
        >>> round(linear(srgb(0.25)), 9)
        0.25
    """
    x = min(max(encoded, 0.0), 1.0)
    return x / 12.92 if x <= 0.04045 else float(((x + 0.055) / 1.055) ** 2.4)
