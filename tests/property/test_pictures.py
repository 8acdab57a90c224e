"""Random formulas: whatever can be written down is drawn, and every device draws the same."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

import zeroset as zs
from zeroset.methods import METHODS

FEW = settings(deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
LEAVES = st.one_of(
    st.sampled_from(["x", "y", "z", "x", "y", "z", "pi", "a"]),
    st.integers(-4, 4).map(lambda n: f"({n})"),
    st.floats(0.01, 9, allow_nan=False).map(lambda v: f"{v:.3g}"),
)


def _larger(parts: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    one = ["sin", "cos", "exp", "log", "sqrt", "abs", "atan", "tanh", "tan", "floor", "asin", "cbrt", "sign"]
    return st.one_of(
        st.tuples(parts, st.sampled_from("+-*/"), parts).map(lambda t: f"({t[0]} {t[1]} {t[2]})"),
        st.tuples(parts, st.sampled_from(["2", "3", "4", "7", "(-1)", "(1/2)", "a", "x"])).map(
            lambda t: f"({t[0]})^{t[1]}"
        ),
        st.tuples(st.sampled_from(one), parts).map(lambda t: f"{t[0]}({t[1]})"),
        st.tuples(st.sampled_from(["min", "max", "mod", "atan2"]), parts, parts).map(
            lambda t: f"{t[0]}({t[1]}, {t[2]})"
        ),
        st.tuples(parts, parts, parts, parts).map(lambda t: f"if({t[0]} < {t[1]}, {t[2]}, {t[3]})"),
    )


FORMULAS = st.recursive(LEAVES, _larger, max_leaves=8).map(lambda text: f"{text} + 0.3x + 0.1y^2 - 0.2z")


def surface_of(formula: str, bounds: zs.Ball | zs.Box | None) -> zs.Surface | None:
    """The surface, unless the formula comes to nothing: an honest error is an answer too."""
    try:
        return zs.surface(formula, {"a": 1.5} if re.search(r"\ba\b", formula) else {}, bounds)
    except zs.ZerosetError:
        return None


@settings(FEW, max_examples=10)
@given(FORMULAS, st.sampled_from([zs.Ball(2.0), zs.Box((-1, -2, -1), (2, 1, 1.5))]))
@example("1/x + tan(y)*mod(z, 0.5)", zs.Ball(3.0))
@example("if(x < y, 1/0, log(z))", zs.Ball(2.0))
@example("x^y + (-z)^(1/2)", zs.Ball(2.0))
def test_whatever_can_be_written_is_drawn(formula: str, bounds: zs.Ball | zs.Box) -> None:
    surface = surface_of(formula, bounds)
    if surface is None:
        return
    image = zs.render(surface, (16, 12))
    status, t, normal = (image.aov(name) for name in ("status", "t", "normal"))
    assert set(np.unique(status)) <= {zs.MISS, zs.HIT, zs.UNRESOLVED}
    found = status != zs.MISS
    assert np.all(np.isfinite(t[found]))
    lengths = np.linalg.norm(normal, axis=-1)
    assert np.all(np.isclose(lengths, 1, atol=1e-4) | (lengths == 0))
    assert np.all(lengths[~found] == 0)
    assert np.all(image.aov("steps") < 100_000)


@settings(FEW, max_examples=10)
@given(FORMULAS)
def test_hits_lie_inside_the_bounds(formula: str) -> None:
    surface = surface_of(formula, zs.Box((-1, -2, -1), (2, 1, 1.5)))
    if surface is None:
        return
    random = np.random.default_rng(len(formula))
    origins = random.normal(size=(64, 3)) * 4
    directions = random.uniform(-1, 1, size=(64, 3)) - origins
    hits = zs.cast(surface, origins, directions, 0.0, 0.9)
    found = hits.status != zs.MISS
    points = (origins + hits.t[:, None] * directions)[found]
    slack = 2 * surface.fitted.extent * 2.0**-14
    assert np.all(points >= np.array([-1, -2, -1]) - slack)
    assert np.all(points <= np.array([2, 1, 1.5]) + slack)
    assert np.all((hits.t[found] >= 0) & (hits.t[found] <= 0.9))


@pytest.mark.parametrize("method", sorted(METHODS))
def test_the_interpreter_and_the_cpu_agree(method: str) -> None:
    surface = zs.surface("x^3 + y^2*z - a*x + 0.25", {"a": 0.7}, bounds=1.5)
    random = np.random.default_rng(3)
    origins = random.normal(size=(48, 3)) * 3
    directions = random.uniform(-0.7, 0.7, size=(48, 3)) - origins
    slow, fast = (zs.cast(surface, origins, directions, method=method, device=d) for d in ("interp", "cpu"))
    # The CPU fuses multiply-adds, so a ray at the edge of being decided may be decided otherwise.
    assert np.mean(slow.status == fast.status) >= 0.95
    both = (slow.status == zs.HIT) & (fast.status == zs.HIT)
    assert both.sum() >= 20
    tolerance = 4 * surface.fitted.extent * 2.0**-14 / np.linalg.norm(directions, axis=1)
    assert np.all(np.abs(slow.t - fast.t)[both] <= tolerance[both])
    assert np.all(np.abs(slow.normal - fast.normal)[both] < 1e-2)


def test_frames_of_the_interpreter_and_the_cpu_agree() -> None:
    surface = zs.surface("sin(2x) + y^2 + z^2 = 0.8", bounds=1.6)
    slow, fast = (zs.render(surface, (20, 13), device=d) for d in ("interp", "cpu"))
    assert np.mean(slow.aov("status") == fast.aov("status")) > 0.97
    assert np.mean(np.abs(slow.pixels.astype(int) - fast.pixels)) < 1.5
