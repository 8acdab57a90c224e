"""Powers for shading, where a few bits suffice and soundness is no question."""

from __future__ import annotations

from zeroset.arith import F32 as FORMAT
from zeroset.arith import elementary
from zeroset.kernel import Value


def shine(cosine: Value, exponent: Value) -> Value:
    """cosine**exponent for a cosine clamped to (0, 1]; 0 below."""
    lit = cosine > 1e-4
    base = lit.select(cosine, 1.0).minimum(1.0)
    return lit.select(elementary.exp(FORMAT, elementary.log(FORMAT, base) * exponent), 0.0)
