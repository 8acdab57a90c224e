"""The ray methods by class, for their options: ``zs.methods.AdaptiveMarchingPoints(steps=100, test="taylor")``."""

from __future__ import annotations

from zeroset.solve import (
    METHODS,
    AdaptiveMarchingPoints,
    Affine,
    Analytic,
    Auto,
    Interval,
    MarchingPoints,
    Method,
    Mitchell,
    MitchellExact,
)

__all__ = [
    "METHODS",
    "AdaptiveMarchingPoints",
    "Affine",
    "Analytic",
    "Auto",
    "Interval",
    "MarchingPoints",
    "Method",
    "Mitchell",
    "MitchellExact",
]
