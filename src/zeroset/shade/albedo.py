"""The albedo at a hit: the colour that a point has before any light falls on it.

Everything that shades asks for it in one place (``reflectance.face``), so that a surface may be coloured by its side,
by a value (``colormap``) or by its part without anything else knowing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from zeroset.kernel import Value

Albedo = Callable[[Value], Sequence[Value]]
"""Gives the linear RGB of a point; is told whether its back is seen."""


def two_sided(uniform: Callable[[str], Value]) -> Albedo:
    """One colour for each side: the uniforms ``front_r``, ..., ``back_b``."""
    return lambda back: [back.select(uniform(f"back_{c}"), uniform(f"front_{c}")) for c in "rgb"]
