"""Elementary functions over any scalar, as polynomials with stated error bounds.

WGSL promises 2**-11 for its sine, and LLVM has none for vectors, so zeroset has its own: every function takes a
format and a scalar (see ``scalar``) and uses nothing but + - * /, fma, sqrt, rounding to integers, exponents and
select. No finite argument gives NaN or infinity; arguments outside a domain are clamped to it. ``error_bound`` is
what each guarantees.
"""

from zeroset.arith.elementary.bounds import ErrorBound, by_roots, error_bound, power_error, trigonometric_limit
from zeroset.arith.elementary.circular import cos, sin, sincos, tan
from zeroset.arith.elementary.exponential import cosh, exp, sinh, tanh
from zeroset.arith.elementary.inverse import acos, asin, atan, atan2
from zeroset.arith.elementary.logarithm import cbrt, log, pow, powr

__all__ = [
    "ErrorBound",
    "acos",
    "asin",
    "atan",
    "atan2",
    "by_roots",
    "cbrt",
    "cos",
    "cosh",
    "error_bound",
    "exp",
    "log",
    "pow",
    "power_error",
    "powr",
    "sin",
    "sincos",
    "sinh",
    "tan",
    "tanh",
    "trigonometric_limit",
]
