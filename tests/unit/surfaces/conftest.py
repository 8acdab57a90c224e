"""Evaluates gallery formulas, parsed by the real parser, on complex NumPy arrays.

Complex because f(p + ih e)/h then gives the gradient to the last digit (the complex step), so that a node, where
f and its gradient vanish, can be told from a point that is merely near one.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

from zeroset.expr import parse
from zeroset.surfaces import entry

Array = np.ndarray[Any, np.dtype[Any]]
STEP = 1e-40


def _magnitude(a: Any) -> Any:
    return np.where(np.real(a) < 0, -a, a)


OPERATIONS: dict[str, Callable[..., Any]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a: -a,
    "sqr": lambda a: a * a,
    "powi": lambda a, n: a ** int(n),
    "powr": lambda a, p, q: a ** (int(p) / int(q)),
    "pow": lambda a, b: a**b,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "sin": np.sin,
    "cos": np.cos,
    "abs": _magnitude,
}


class Formula:
    """f of one gallery entry."""

    def __init__(self, name: str) -> None:
        self.entry = entry(name)
        self.expr = parse(self.entry.formula, params=self.entry.params, arrays=self.entry.arrays)

    def __call__(self, points: Any, w: float = 0.0) -> Array:
        """f at points (N, 3), real or complex; shape (N,)."""
        p = np.asarray(points)
        variables = {"x": p[:, 0], "y": p[:, 1], "z": p[:, 2], "w": w}
        return np.broadcast_to(np.asarray(self._value(self.expr, variables, {}, {})), p.shape[:1])

    def gradient(self, points: Any) -> Array:
        """Shape (N, 3)."""
        p = np.asarray(points, dtype=complex)
        with np.errstate(under="ignore"):
            return np.stack([self(p + 1j * STEP * axis).imag / STEP for axis in np.eye(3)], axis=1)

    def scale(self, points: Any) -> Array:
        """How large f is around each point (N, 3), to compare a rounding error with; shape (N,)."""
        p = np.asarray(points, dtype=float)
        rng = np.random.default_rng(1)
        around = p[:, None, :] * (1 + 0.2 * rng.normal(size=(len(p), 50, 3))) + 0.05 * rng.normal(size=(len(p), 50, 3))
        largest: Array = np.abs(self(around.reshape(-1, 3))).reshape(len(p), 50).max(axis=1)
        return largest

    def _value(self, expr: Any, variables: dict[str, Any], index: dict[str, int], memo: dict[Any, Any]) -> Any:
        if expr not in memo:
            memo[expr] = self._fresh(expr, variables, index, memo)
        return memo[expr]

    def _fresh(self, expr: Any, variables: dict[str, Any], index: dict[str, int], memo: dict[Any, Any]) -> Any:
        if expr.op == "const":
            return np.pi if expr.data[0] == "pi" else float(expr.data[0])
        if expr.op == "variable":
            return variables[expr.data[0]]
        if expr.op == "parameter":
            return self.entry.params[expr.data[0]]
        if expr.op == "element":
            array, which = expr.data
            return self.entry.arrays[array][index[which]]
        if expr.op == "sum":
            return self._sum(expr, variables, index)
        return OPERATIONS[expr.op](*(self._value(arg, variables, index, memo) for arg in expr.args), *expr.data)

    def _sum(self, expr: Any, variables: dict[str, Any], index: dict[str, int]) -> Any:
        (count,) = {len(self.entry.arrays[name]) for name in expr.args[0].arrays}
        terms = (self._value(expr.args[0], variables, {**index, expr.data[0]: k}, {}) for k in range(count))
        return sum(terms, start=0.0)


@pytest.fixture(scope="session")
def formula() -> Callable[[str], Formula]:
    """The formula of an entry, by name."""
    return cache(Formula)
