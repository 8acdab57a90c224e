"""Where isovalues are looked for: ranges of their sliders, and places for new ones."""

from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.scene.fit import values_at
from zeroset.view.levels import Level, another, levels_of, value_span
from zeroset.view.spans import Span


@pytest.mark.parametrize(
    ("formula", "bounds"),
    [
        ("x^2 + y^2 + z^2", 2.0),
        ("1/x + y", 1.0),
        ("sqrt(x) + y", zs.Box((-1, -1, -1), (1, 1, 1))),
        ("log(x - 5)", 1.0),
        ("10^9 x", 1.0),
        ("1e-9 x y z", 1.0),
        ("max(x, 5)", 1.0),
        ("max(x, 5) - 5", 1.0),
    ],
)
def test_a_range_is_finite_and_holds_0_and_what_there_is(formula: str, bounds: object) -> None:
    surface = zs.surface(formula, bounds=bounds)
    span = value_span(surface)
    assert -1e12 < span.low < span.high < 1e12
    assert span.low <= 0.0 <= span.high
    wider = value_span(surface, [Level(1e12, (0, 0, 0))])
    assert wider.high >= 1e12


def test_new_isovalues_are_new_for_as_long_as_there_may_be_more() -> None:
    levels: tuple[Level, ...] = ()
    for _ in range(16):
        levels = (*levels, another(levels, Span(-0.3, 0.7)))
    assert len({level.value for level in levels}) == 16
    assert all(-0.3 < level.value < 0.7 for level in levels)
    assert len({level.color for level in levels[:8]}) == 8


def test_the_isovalues_of_a_surface() -> None:
    assert levels_of(zs.surface("x")) == ()
    shells = zs.surface("x").with_isovalues((1, 0), [(1, 0, 0), (0, 1, 0)])
    assert levels_of(shells) == (Level(0.0, (0, 1, 0)), Level(1.0, (1, 0, 0)))


def test_values_at_points_are_those_of_f() -> None:
    surface = zs.surface("a*x^2 + sin(y) - z/x + sum(i, r[i]*w)", {"a": 2.0, "r": [1.0, 2.0], "w": 0.5})
    x, y, z = np.random.default_rng(4).uniform(-1, 1, (3, 50))
    found = values_at(surface, np.stack([x, y, z], axis=-1))
    assert found == pytest.approx(2 * x**2 + np.sin(y) - z / x + 1.5)
    assert np.isnan(values_at(zs.surface("1/x"), np.zeros((1, 3)))).all()
