"""Random formulas for the truth of anything that is a formula, and a surface of each that has something to hit.

A formula f is shifted by its value at a random point, so that the surface passes through that point wherever f
is continuous there; rays are aimed at it and around it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from hypothesis import strategies as st

import zeroset as zs

from .jets import ZERO, Jet, arb
from .tape import Tape

LEAVES = ("x", "y", "z", "2x", "3y", "z/2", "0.5", "2", "1/3", "pi", "1.7", "(x + y)", "(y - z)", "(x - 0.3)")
UNARY = (
    "sin({})", "cos(2({}))", "exp({}/2)", "({})^2", "({})^3", "({})^4", "-({})", "|{}|", "sqrt({})", "sqrt(1 + ({})^2)",
    "log({})", "atan({})", "tanh({})", "cbrt({})", "1/({})", "1/(1 + ({})^2)", "floor({})", "ceil({})", "sign({})",
    "asin({}/2)", "acos({}/3)", "tan({})", "sinh({}/2)", "cosh({}/2)", "({})^1.5", "|{}|^0.7", "({})^(-2)",
)  # fmt: skip
BINARY = (
    "{} + {}", "{} - ({})", "({})*({})", "min({}, {})", "max({}, {})", "({})/({})", "mod({}, 1 + |{}|)",
    "atan2({}, {})", "if({} < {}, x, y)", "if({} <= {}, x^2, 1 - z)", "|{}|^(1 + |{}|)", "({})^2 + ({})^2",
)  # fmt: skip


def formulas() -> st.SearchStrategy[str]:
    """Formula texts of up to some twenty operators."""

    def grow(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
        one = st.builds(str.format, st.sampled_from(UNARY), inner)
        two = st.builds(str.format, st.sampled_from(BINARY), inner, inner)
        return one | two | two

    return st.recursive(st.sampled_from(LEAVES), grow, max_leaves=8)


@dataclass(frozen=True)
class Aimed:
    """A surface and rays at it."""

    surface: zs.Surface
    origins: npt.NDArray[np.float32]
    directions: npt.NDArray[np.float32]


def aimed(formula: str, seed: int, rays: int = 12) -> Aimed | None:
    """The formula shifted through a random point of a ball of radius 2, with rays; None where it is undefined there."""
    rng = np.random.default_rng(seed)
    point = np.round(rng.uniform(-1.0, 1.0, 3), 3)
    try:
        value = _value(zs.surface(formula, bounds=2.0), point)
        if value is None or not abs(value) < 1e6:
            return None
        surface = zs.surface(f"({formula}) - ({value!r})", bounds=2.0)
    except zs.ZerosetError:
        return None
    origins = rng.normal(size=(rays, 3)) * rng.choice([1.0, 4.0], (rays, 1))
    targets = point + rng.normal(size=(rays, 3)) * rng.choice([0.0, 0.3], (rays, 1))
    axes = np.eye(3)[rng.integers(0, 3, 2)]
    origins[:2], targets[:2] = point - 3.0 * axes, point
    return Aimed(surface, origins.astype(np.float32), (targets - origins).astype(np.float32))


def _value(surface: zs.Surface, point: npt.NDArray[np.float64]) -> float | None:
    tape = Tape(surface)
    f = tape.run([Jet(arb(float(v)), ZERO) for v in point], tape.jets())
    return float(f.v.mid()) if f.whole and not f.empty and f.v.is_finite() else None
