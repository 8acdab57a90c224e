"""The ray methods by class, for their options: ``zs.methods.AdaptiveMarchingPoints(steps=100, test="taylor")``."""

from __future__ import annotations

from zeroset.solve.analytic import Analytic
from zeroset.solve.auto import Auto
from zeroset.solve.bisection import Affine, Interval
from zeroset.solve.exact import MitchellExact
from zeroset.solve.method import METHODS, Method
from zeroset.solve.mitchell import Mitchell
from zeroset.solve.sampling import AdaptiveMarchingPoints, MarchingPoints

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
