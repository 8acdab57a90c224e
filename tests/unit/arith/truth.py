"""What is true, by ball arithmetic, and where it is asked."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import flint
import numpy as np
from flint import arb

PRECISION = 200


def _sqrt(x: arb) -> arb | None:
    return x.sqrt() if x >= 0 else None


def _within_one(f: Callable[[arb], arb]) -> Callable[[arb], arb | None]:
    return lambda x: f(x) if -1 <= x <= 1 else None


def _cbrt(x: arb) -> arb:
    return x.root(3) if x > 0 else -((-x).root(3)) if x < 0 else arb(0)


def _sign(x: arb) -> arb:
    return arb(int(x > 0) - int(x < 0))


def _power(x: arb, y: arb) -> arb | None:
    if x > 0:
        return (y * x.log()).exp()
    return arb(0) if x == 0 and y > 0 else None


def _rational(p: int, q: int) -> Callable[[arb], arb | None]:
    return lambda x: _power(x, arb(p) / q)


UNARY: dict[str, Callable[[arb], arb | None]] = {
    "neg": lambda x: -x,
    "sqr": lambda x: x * x,
    "sqrt": _sqrt,
    "exp": arb.exp,
    "log": lambda x: x.log() if x > 0 else None,
    "sin": arb.sin,
    "cos": arb.cos,
    "tan": arb.tan,
    "asin": _within_one(arb.asin),
    "acos": _within_one(arb.acos),
    "atan": arb.atan,
    "sinh": arb.sinh,
    "cosh": arb.cosh,
    "tanh": arb.tanh,
    "cbrt": _cbrt,
    "abs": lambda x: abs(x),
    "sign": _sign,
    "floor": arb.floor,
    "ceil": arb.ceil,
}
POWERS: dict[str, tuple[str, Any, Callable[[arb], arb | None]]] = {
    **{f"powi{n}": ("powi", n, lambda x, n=n: x**n if n > 0 or x != 0 else None) for n in (2, 3, 4, 7, 12, -1, -2, -3)},
    **{
        f"powr{p}/{q}": ("powr", (p, q), _rational(p, q))
        for p, q in ((1, 2), (3, 2), (5, 4), (2, 3), (7, 5), (-1, 2), (-3, 5))
    },
}
BINARY: dict[str, Callable[[arb, arb], arb | None]] = {
    "add": lambda x, y: x + y,
    "sub": lambda x, y: x - y,
    "mul": lambda x, y: x * y,
    "div": lambda x, y: x / y if y != 0 else None,
    "max": lambda x, y: x if x > y else y,
    "min": lambda x, y: x if x < y else y,
    "mod": lambda x, y: x - y * (x / y).floor() if y != 0 else None,
    "pow": _power,
    "atan2": lambda y, x: arb.atan2(y, x) if x != 0 or y != 0 else None,
}


def cases() -> dict[str, tuple[int, Callable[..., Any], Callable[..., arb | None]]]:
    """Operator name to its arity, its call on numbers, and its truth."""
    table: dict[str, tuple[int, Callable[..., Any], Callable[..., arb | None]]] = {}
    for name, truth in UNARY.items():
        table[name] = (1, lambda x, name=name: getattr(x, name)(), truth)
    for name, (method, data, truth) in POWERS.items():
        table[name] = (1, lambda x, method=method, data=data: getattr(x, method)(data), truth)
    for name, truth in BINARY.items():
        table[name] = (2, lambda x, y, name=name: getattr(x, name)(y), truth)
    return table


def within(value: arb | None, big: float) -> bool:
    """Whether the truth is defined and certainly inside what a contract speaks of."""
    return value is not None and bool(abs(value) <= big)


def true_values(function: Callable[..., arb | None], *points: np.ndarray) -> list[arb | None]:
    """The function at each row of float64 points, None where it is undefined or no finite ball holds it."""
    values = []
    with flint.ctx.workprec(PRECISION):
        for row in zip(*points, strict=True):
            value = function(*(arb(float(x)) for x in row))
            values.append(value if value is not None and value.is_finite() else None)
    return values


def outside(value: arb, lo: float, hi: float) -> bool:
    """Whether a true value certainly lies outside two bounds."""
    return bool(value < arb(float(lo)) or value > arb(float(hi)))


AWKWARD = [
    0.0, -0.0, 1e-45, -1e-45, 1.1754942e-38, 1e-38, 2.0**-112, -(2.0**-112), 1e-30, 1e-20, 1e-10, 2.0**-24, 0.1,
    0.3, 0.5, -0.5, 0.70710677, 1.0, -1.0, 1.0000001, 0.99999994, 1.5, 2.0, -2.0, 2.5, 3.0, 1.5707964, 1.5707963,
    3.1415927, -3.1415925, 6.2831855, 22.0, 355.0, 710.0, 1000.0, -1000.0, 8191.0, 8193.0, 87.3, 88.8, -87.4,
    -103.0, 1e5, -1e5, 1e10, 1e18, -1e19, 1e30, 5e33, -5e33,
]  # fmt: skip


def awkward(dtype: str) -> np.ndarray:
    """Awkward numbers and random ones of all sizes, in a dtype."""
    generator = np.random.default_rng(7)
    sizes = 2.0 ** generator.uniform(-30, 12, 150) * generator.choice([-1, 1], 150)
    units = generator.uniform(-3, 3, 100)
    quarters = np.arange(-8, 9) * (np.pi / 2)
    return np.concatenate([AWKWARD, sizes, units, quarters]).astype(dtype)


def boxes(dtype: str, count: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper ends of intervals: points, narrow and wide ones, around awkward numbers."""
    generator = np.random.default_rng(seed)
    ends = awkward(dtype)
    lo = generator.choice(ends, count)
    width = (2.0 ** generator.uniform(-26, 4, count)).astype(dtype)
    hi = np.where(generator.random(count) < 0.3, generator.choice(ends, count), lo + width * np.maximum(abs(lo), 1e-3))
    hi = np.where(generator.random(count) < 0.15, lo, hi).astype(dtype)
    return np.minimum(lo, hi), np.maximum(lo, hi)


def inner(lo: np.ndarray, hi: np.ndarray, parts: int, seed: int = 1) -> list[np.ndarray]:
    """Float64 points of intervals: both ends and random ones between."""
    generator = np.random.default_rng(seed)
    low, high = lo.astype(np.float64), hi.astype(np.float64)
    between = [np.clip(low + (high - low) * generator.random(len(low)), low, high) for _ in range(parts)]
    return [low, high, *between]
