"""Powers for shading, where a few bits suffice and soundness is no question."""

from __future__ import annotations

from zeroset.arith import F32 as FORMAT
from zeroset.arith import elementary
from zeroset.kernel import Value


def shine(base: Value, exponent: Value) -> Value:
    """base**exponent for a base clamped to (0, 1]; 0 for next to nothing and below."""
    lit = base > 1e-8
    base = lit.select(base, 1.0).minimum(1.0)
    return lit.select(elementary.exp(FORMAT, elementary.log(FORMAT, base) * exponent), 0.0)
