"""How the coefficients of ``zeroset.arith.elementary.tables`` are made, in ball arithmetic.

Each function is interpolated at the Chebyshev nodes of its interval, which comes within a small factor of the best
polynomial, and the coefficients are rounded to the format. Run as a script to print the tables.
"""

from __future__ import annotations

from collections.abc import Callable

import flint
import numpy as np
from flint import arb, arb_mat

Function = Callable[[arb], arb]
PRECISION = 500


def chebyshev_fit(g: Function, lo: arb, hi: arb, degree: int) -> list[arb]:
    """Coefficients, constant first, of the polynomial that meets g at the Chebyshev nodes of [lo, hi]."""
    n = degree + 1
    nodes = [(lo + hi) / 2 + (hi - lo) / 2 * (arb.pi() * (2 * i + 1) / (2 * n)).cos() for i in range(n)]
    powers = arb_mat(n, n, [x**j for x in nodes for j in range(n)])
    values = arb_mat(n, 1, [g(x) for x in nodes])
    solved = powers.solve(values)
    return [solved[j, 0] for j in range(n)]


def _odd(f: Function) -> Function:
    """(f(x) - x)/x**3 as a function of u = x**2."""
    return lambda u: (f(u.sqrt()) - u.sqrt()) / (u * u.sqrt())


def _exp(r: arb) -> arb:
    return arb(1) / 2 if r.contains(0) else (r.exp() - 1 - r) / r**2


def _half_ln2() -> arb:
    return arb(2).log() / 2 * arb("1.001")


def _quarter_pi_squared() -> arb:
    return (arb.pi() / 4) ** 2 * arb("1.001")


def fits() -> dict[str, tuple[Function, arb, arb, int, int]]:
    """Name to (function, interval, degree in f32, degree in f64)."""
    zero, one = arb(0), arb(1)
    eighth = (arb(2).sqrt() - 1) ** 2 * arb("1.001")
    ratio = ((arb(2).sqrt() - 1) / (arb(2).sqrt() + 1)) ** 2 * arb("1.001")
    return {
        "EXP": (_exp, -_half_ln2(), _half_ln2(), 4, 9),
        "LOG": (lambda u: (2 * u.sqrt().atanh() - 2 * u.sqrt()) / (u * u.sqrt()), zero, ratio, 2, 6),
        "SIN": (_odd(arb.sin), zero, _quarter_pi_squared(), 2, 5),
        "COS": (lambda u: (u.sqrt().cos() - 1 + u / 2) / u**2, zero, _quarter_pi_squared(), 2, 5),
        "ATAN": (_odd(arb.atan), zero, eighth, 4, 10),
        "ASIN": (_odd(arb.asin), zero, one / 4, 4, 11),
        "SINH": (_odd(arb.sinh), zero, one, 3, 6),
        "TANH": (_odd(arb.tanh), zero, arb("0.625") ** 2, 4, 10),
        "CBRT": (lambda m: m.root(3), one, arb(2), 2, 5),
    }


def rounded(coefficients: list[arb], dtype: str) -> tuple[float, ...]:
    """The coefficients as numbers of a format."""
    return tuple(float(np.dtype(dtype).type(float(c.mid()))) for c in coefficients)


def fitted(name: str, dtype: str) -> tuple[float, ...]:
    """One row of the tables."""
    with flint.ctx.workprec(PRECISION):
        g, lo, hi, single, double = fits()[name]
        return rounded(chebyshev_fit(g, lo, hi, single if dtype == "float32" else double), dtype)


if __name__ == "__main__":
    for dtype in ("float32", "float64"):
        for name in fits():
            print(dtype, name, fitted(name, dtype))
