"""The stated errors of the elementary functions: data that enclosures are widened by, and that tests check.

For every x in the stated domain the computed value v of f(x) satisfies, whether multiply-adds are fused or not,

    |v - f(x)| <= relative * eps * |v| + absolute + slope * |x| + 2 quantum.

``relative`` bounds the roundings of the code as written plus the error of the polynomial; ``absolute`` is what clamping
an argument can cost; ``slope`` what the reduction by multiples of pi/2 lost; the smallest normal number, ``quantum``,
stands for flushed subnormals.
"""

from __future__ import annotations

from typing import NamedTuple

from zeroset.arith.format import Format

__all__ = ["ErrorBound", "by_roots", "error_bound", "power_error", "trigonometric_limit"]


class ErrorBound(NamedTuple):
    """See the module's text; ``relative`` is in units of eps, the others are absolute numbers."""

    relative: float
    absolute: float = 0.0
    slope: float = 0.0


# Each is 1.3 times or more the largest error found: over all f32 numbers of the binades that matter, and by sampling
# with fused operations and in f64.
_RELATIVE = {
    "exp": 3.0,
    "log": 4.5,
    "sin": 4.0,
    "cos": 4.0,
    "tan": 6.5,
    "asin": 6.5,
    "acos": 4.0,
    "atan": 4.5,
    "atan2": 5.0,
    "sinh": 4.5,
    "cosh": 4.0,
    "tanh": 4.5,
    "cbrt": 6.75,
}


def error_bound(name: str, fmt: Format) -> ErrorBound:
    """What one function of this package guarantees in a format.

    ``sin``, ``cos`` and ``tan`` do so for |x| <= ``trigonometric_limit(fmt)``; ``tan`` in units of the larger of |v|
    and v**2 for the slope part, as its own slope is 1 + v**2; ``log`` for x >= the smallest normal number; ``exp``,
    ``sinh`` and ``cosh`` up to the value ``big``, at which they stop; all others everywhere in their domain.
    """
    slope = 0.0
    if name in ("sin", "cos", "tan"):
        # k*(pi/2) leaves k*2**-47.2 in f32 (the third part, near 2**-24, is rounded, and so is its product),
        # k*2**-121.3 in f64.
        slope = 2.0**-47 if fmt.digits == 24 else 2.0**-121
    absolute = 0.0
    if name == "cbrt":
        absolute = 2.0**-42 if fmt.digits == 24 else 2.0**-340
    elif name in ("exp", "sinh", "cosh"):
        absolute = fmt.tiny
    return ErrorBound(_RELATIVE[name], absolute, slope)


def trigonometric_limit(fmt: Format) -> float:
    """Largest |x| for which sin, cos and tan are computed; they return their value there beyond it."""
    return 2.0**13 if fmt.digits == 24 else 2.0**20


def by_roots(exponent: tuple[int, int]) -> bool:
    """Whether ``powr`` takes roots for this exponent p/q, which is accurate, and not a logarithm."""
    return 12 % exponent[1] == 0 and abs(exponent[0]) <= 64


def power_error(exponent: tuple[int, int]) -> float:
    """The relative error of ``powr`` in units of eps, where it goes by roots."""
    p, q = exponent
    root = _RELATIVE["cbrt"] + 1.0 if q % 3 == 0 else 2.0
    return 1.01 * abs(p) * (root + 1.0) + 2.0
