"""From linear light to the bytes of a picture: clamp, encode as sRGB, pack.

The sRGB curve (IEC 61966-2-1) is 12.92 x up to 0.0031308 and 1.055 x^(1/2.4) - 0.055 above. The power is taken as a
polynomial in the fourth root of x, fitted to a hundredth of a byte's step.
"""

from __future__ import annotations

from collections.abc import Sequence

from zeroset.kernel import F32, U32, Value, constant

CURVE = (-0.0646094, 0.1961224, 1.1227116, -0.3355310, 0.0813410)
"""Coefficients of 1.055 x^(1/2.4) - 0.055 in r = x^(1/4), least maximum error on [0.0031308, 1]."""


def encode(x: Value) -> Value:
    """sRGB encoding of one channel, clamped to [0, 1]."""
    x = x.maximum(0.0).minimum(1.0)
    r = x.sqrt().sqrt()
    curve: Value = constant(CURVE[-1], F32)
    for c in reversed(CURVE[:-1]):
        curve = curve.fma(r, c)
    return (x <= 0.0031308).select(x * 12.92, curve)


def pack(color: Sequence[Value]) -> Value:
    """Three encoded channels as one u32: red in the lowest byte, opaque."""
    r, g, b = (((c.maximum(0.0).minimum(1.0)) * 255.0 + 0.5).floor().convert(U32) for c in color)
    return r | (g << 8) | (b << 16) | 0xFF000000
