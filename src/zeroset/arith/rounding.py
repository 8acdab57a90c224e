"""Outward rounding without directed rounding: bounds are moved by an explicit amount.

There is no rounding mode to set on SIMD code or on a GPU, so a computed bound x moves to ``x - (k*eps*|x| + tiny)``.
With k = 2 that covers one operation rounded to nearest, and its proof is monotonicity: k*eps*|x| is at least one unit
in the last place of x, so the exact difference is at or below the next number under x, and rounding keeps it there;
the true value is within half a unit of x. Every further relative error of ``eps`` adds 1 to k; ``tiny`` covers
underflow and flushed subnormals. The arguments hold for fused and for separate multiply-add.
"""

from __future__ import annotations

from zeroset.arith.format import Format
from zeroset.arith.scalar import Scalar, absolute, fma, is_literal, maximum, minimum

__all__ = ["ROUNDED", "clamp", "lower", "lower_nonnegative", "outward", "upper", "upper_nonnegative"]

ROUNDED = 2.0
"""The k of a single operation rounded to nearest."""


def _slack(fmt: Format, x: Scalar, k: float, absolute_error: Scalar) -> Scalar:
    return fma(absolute(x), k * fmt.eps, fmt.tiny + absolute_error)


def outward(fmt: Format, x: Scalar, direction: int) -> Scalar:
    """A literal moved to a number of the format, down (-1) or up (+1); run-time scalars are such numbers already."""
    if not is_literal(x) or fmt.digits == 53:
        return x
    return fmt.down(x) if direction < 0 else fmt.up(x)


def lower(fmt: Format, x: Scalar, k: float = ROUNDED, absolute_error: Scalar = 0.0) -> Scalar:
    """A bound below every real within ``(k-1)*eps*|x| + absolute_error`` of the computed ``x``; 3 operations."""
    return outward(fmt, x - _slack(fmt, x, k, absolute_error), -1)


def upper(fmt: Format, x: Scalar, k: float = ROUNDED, absolute_error: Scalar = 0.0) -> Scalar:
    """A bound above every real within ``(k-1)*eps*|x| + absolute_error`` of the computed ``x``; 3 operations."""
    return outward(fmt, x + _slack(fmt, x, k, absolute_error), 1)


def lower_nonnegative(fmt: Format, x: Scalar, k: float = ROUNDED, absolute_error: Scalar = 0.0) -> Scalar:
    """``lower`` for x >= 0 that stands for a real >= 0; 2 operations."""
    return outward(fmt, maximum(fma(x, fmt.down(1.0 - k * fmt.eps), -(fmt.tiny + absolute_error)), 0.0), -1)


def upper_nonnegative(fmt: Format, x: Scalar, k: float = ROUNDED, absolute_error: Scalar = 0.0) -> Scalar:
    """``upper`` for x >= 0; 1 operation."""
    return outward(fmt, fma(x, fmt.up(1.0 + k * fmt.eps), fmt.tiny + absolute_error), 1)


def clamp(fmt: Format, x: Scalar) -> Scalar:
    """``x`` brought back into ``[-big, big]``, where an overflow may have left it."""
    return minimum(maximum(x, -fmt.big), fmt.big)
