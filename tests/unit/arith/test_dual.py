"""Derivatives: exact ones on reals against differences of balls, ranges of them on intervals and affine forms."""

import flint
import numpy as np
import pytest

from zeroset.arith import F32, F64, AffineSystem, Dual, DualSystem, IntervalSystem, RealSystem

from .truth import cases, outside

CASES = cases()
DOMAIN = {
    "log": (0.1, 3), "sqrt": (0.1, 3), "asin": (-0.9, 0.9), "acos": (-0.9, 0.9), "tan": (-1.4, 1.4), "pow": (0.2, 2),
    "div": (0.3, 3), "mod": (0.3, 3), "atan2": (0.2, 3), "cbrt": (0.1, 3), "abs": (0.1, 3), "sign": (0.1, 3),
    "floor": (1.05, 1.95), "ceil": (1.05, 1.95),
    **{name: (0.2, 3) for name in CASES if name.startswith("powr") or name.startswith("powi-")},
}  # fmt: skip


def true_slope(truth, point, direction):
    """Central difference with a step far below what is asked of the result."""
    with flint.ctx.workprec(600):
        h = flint.arb(2) ** -150
        ends = [
            truth(*(flint.arb(float(p)) + sign * h * d for p, d in zip(point, direction, strict=True)))
            for sign in (1, -1)
        ]
        return (ends[0] - ends[1]) / (2 * h)


def along(name, system, numbers, directions):
    inner = system.inner
    gradients = [inner.constant(d, d) for d in directions]
    return CASES[name][1](*(Dual(system, x, (g,)) for x, g in zip(numbers, gradients, strict=True)))


@pytest.mark.parametrize("name", CASES)
def test_exact_derivatives(name):
    arity, _, truth = CASES[name]
    generator = np.random.default_rng(9)
    system = DualSystem(RealSystem(F64), 1)
    for _ in range(12):
        point = generator.uniform(*DOMAIN.get(name, (-2, 2)), arity).tolist()
        directions = generator.uniform(-2, 2, arity).tolist()
        result = along(name, system, [system.inner.exact(p) for p in point], directions)
        expected = true_slope(truth, point, directions)
        assert result.derivative(0).value == pytest.approx(float(expected.mid()), rel=1e-11, abs=1e-11)


@pytest.mark.parametrize(
    "enclosing",
    [IntervalSystem(F32), AffineSystem(F32), AffineSystem(F32, intersect=True)],
    ids=["intervals", "forms", "forms-with-interval"],
)
@pytest.mark.parametrize("name", CASES)
def test_ranges_of_derivatives(name, enclosing):
    arity, _, truth = CASES[name]
    generator = np.random.default_rng(10)
    system = DualSystem(enclosing, 1)
    directions = [1.0, 0.5][:arity]
    for width in (0.0, 2.0**-6, 0.25):
        centres = [F32.round(c) for c in generator.uniform(*DOMAIN.get(name, (-2, 2)), arity)]
        if isinstance(enclosing, IntervalSystem):
            numbers = [enclosing.bounds(c - width, c + width) for c in centres]
        else:
            numbers = [enclosing.symbol(0, c, width) for c in centres]
        with np.errstate(all="ignore"):
            result = along(name, system, numbers, directions)
            box = result.derivative(0).interval()
        for e in np.linspace(-1, 1, 7).tolist():
            point = [c + width * e for c in centres]
            if truth(*(flint.arb(p) for p in point)) is None:
                continue
            slope = true_slope(truth, point, directions)
            if slope.is_finite() and abs(slope) < 1e20:
                assert not outside(slope, box.lo, box.hi), (name, point)


def test_a_kink_gives_both_slopes_and_no_continuity():
    inner = IntervalSystem(F64)
    system = DualSystem(inner, 1)
    x = system.variable(inner.bounds(-1.0, 2.0), 0)
    size = abs(x)
    slope = size.derivative(0)
    assert (slope.lo, slope.hi) == (-1.0, 1.0)
    assert slope.defined is False
    assert size.value.defined is True
    larger = x.max(system.constant(1.0, 1.0)).derivative(0)
    assert (larger.lo, larger.hi) == (0.0, 1.0)


def test_monotone_pieces_are_recognised():
    inner = IntervalSystem(F64)
    x = DualSystem(inner, 1).variable(inner.bounds(1.0, 2.0), 0)
    assert (x.powi(3) - x * 2.0).derivative(0).lo > 0


def test_what_does_not_vary_costs_nothing():
    system = DualSystem(RealSystem(F64), 3)
    x = system.variable(system.inner.exact(2.0), 1)
    value = (system.constant(3.0, 3.0).sqrt() * x + 1.0).exp()
    assert value.gradient[0] is None
    assert value.gradient[2] is None
    assert value.gradient[1] is not None
    assert value.derivative(0).value == 0.0


def test_second_derivatives():
    first = DualSystem(RealSystem(F64), 1)
    second = DualSystem(first, 1)
    x = second.variable(first.variable(RealSystem(F64).exact(0.7), 0), 0)
    curve = x.sin() * x
    assert curve.derivative(0).derivative(0).value == pytest.approx(2 * np.cos(0.7) - 0.7 * np.sin(0.7))


def test_selection_follows_the_values():
    system = DualSystem(RealSystem(F64), 1)
    x = system.variable(system.inner.exact(np.array([-1.0, 1.0])), 0)
    picked = x.lt(system.constant(0.0, 0.0)).select(x.sqr(), x * 3.0)
    assert picked.value.value.tolist() == [1.0, 3.0]
    assert picked.derivative(0).value.tolist() == [-2.0, 3.0]
    both = x.lt(system.constant(0.0, 0.0)).not_().and_(x.le(x)).or_(x.lt(x))
    assert both.select(x, x * 0.0).value.value.tolist() == [0.0, 1.0]
