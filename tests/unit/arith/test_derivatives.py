"""Second derivatives by dual numbers over dual numbers, held to SymPy's on random formulas."""

import random

import numpy as np
import pytest
import sympy

from zeroset.arith import F32, F64, DualSystem, IntervalSystem, RealSystem
from zeroset.arith.derivatives import PAIRS, first_derivatives, second_derivatives
from zeroset.expr import evaluate, from_sympy

# Real, or SymPy looks for periods that complex arguments might hide, for seconds.
X = sympy.symbols("x y z", real=True)
SMOOTH = (
    sympy.sin,
    sympy.cos,
    sympy.exp,
    sympy.tanh,
    sympy.atan,
    lambda a: sympy.sqrt(a**2 + 2),
    lambda a: 1 / (a**2 + 1),
)


class Leaves:
    """The variables of a formula without parameters."""

    def __init__(self, **numbers):
        self.numbers = numbers

    def variable(self, name):
        return self.numbers[name]


def grown(dice, depth):
    if depth == 0:
        return dice.choice((*X, *X, sympy.Integer(dice.randint(1, 4))))
    a, b = grown(dice, depth - 1), grown(dice, depth - 1)
    return dice.choice(
        (
            lambda: a + b,
            lambda: a * b,
            lambda: a - 2 * b,
            lambda: a ** dice.randint(2, 4),
            lambda: dice.choice(SMOOTH)(a / 3),
            lambda: a / (b**2 + 1),
        )
    )()


def by_duals(formula, point):
    expr = from_sympy(formula)
    real = RealSystem(F64)
    found = second_derivatives(
        real,
        lambda system, x, y, z: evaluate(expr, system, Leaves(x=x, y=y, z=z)),
        [real.exact(p) for p in point],
    )
    return found[0].value, [g.value for g in found[1]], [h.value for h in found[2]]


@pytest.mark.parametrize("seed", range(40))
def test_random_formulas(seed):
    dice = random.Random(seed)
    formula = X[0] * X[1] + grown(dice, 4)
    point = [dice.uniform(-1.2, 1.2) for _ in X]
    at = dict(zip(X, point, strict=True))
    value, gradient, second = by_duals(formula, point)
    slopes = [sympy.diff(formula, v) for v in X]
    expected = [float(sympy.diff(slopes[i], X[j]).evalf(30, subs=at)) for i, j in PAIRS]
    assert value == pytest.approx(float(formula.evalf(30, subs=at)), rel=1e-11, abs=1e-11)
    assert gradient == pytest.approx([float(s.evalf(30, subs=at)) for s in slopes], rel=1e-10, abs=1e-10)
    size = max(map(abs, expected))
    assert second == pytest.approx(expected, rel=1e-9, abs=1e-9 * max(size, 1.0))


def test_all_mixed_derivatives_are_there_in_either_order():
    real = RealSystem(F64)
    inner = DualSystem(real, 3)
    outer = DualSystem(inner, 3)
    x, y, z = (outer.variable(inner.variable(real.exact(v), i), i) for i, v in enumerate((0.3, 0.7, 1.1)))
    f = (x * y).sin() * z.exp() + x.powi(3) * z / y
    both = np.array([[f.derivative(i).derivative(j).value for j in range(3)] for i in range(3)])
    assert np.allclose(both, both.T, rtol=1e-14)


def test_enclosures_of_second_derivatives():
    system = IntervalSystem(F32)
    at = [system.bounds(0.9, 1.1), system.bounds(-0.1, 0.1), system.bounds(2.0, 2.0)]
    _, first, second = second_derivatives(system, lambda _, x, y, z: x.powi(3) * z + x * y, at)
    assert first[0].lo <= 6.0 * 0.81 - 0.1
    assert first[0].hi >= 6.0 * 1.21 + 0.1
    assert second[0].lo <= 12 * 0.9
    assert second[0].hi >= 12 * 1.1
    assert second[1].lo <= 1.0 <= second[1].hi


def test_what_does_not_depend_on_a_variable():
    real = RealSystem(F64)
    value, gradient = first_derivatives(real, lambda system, x, y: system.constant(2.0, 2.0), [real.exact(1.0)] * 2)
    assert (value.value, [g.value for g in gradient]) == (2.0, [0.0, 0.0])
