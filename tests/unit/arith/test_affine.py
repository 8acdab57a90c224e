"""Affine forms hold the truth at every point of their symbols, and shrink as they should."""

import flint
import numpy as np
import pytest

from zeroset.arith import F32, F64, AffineSystem
from zeroset.arith.budget import repaid

from .scalars import Flushed, Fused, plain
from .truth import PRECISION, boxes, cases, outside, within

CASES = cases()
COUNT = 100


def spread(scalar, count):
    return np.broadcast_to(plain(scalar), count).astype(np.float64)


def argument(system, index, lo, hi, kind):
    centre = (0.5 * lo + 0.5 * hi).astype(lo.dtype)
    return system.symbol(index, kind(centre), kind(np.maximum(hi - centre, centre - lo)))


MODES = {"form": {}, "with-interval": {"intersect": True}, "curved": {"curved": True}}


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("kind", [np.asarray, Fused, Flushed], ids=["plain", "fused", "flushed"])
@pytest.mark.parametrize("name", CASES)
def test_holds_the_truth_f32(name, kind, mode):
    holds(name, F32, kind, mode)


@pytest.mark.parametrize("mode", ["form", "curved"])
@pytest.mark.parametrize("name", CASES)
def test_holds_the_truth_f64(name, mode):
    holds(name, F64, np.asarray, mode)


def holds(name, fmt, kind, mode):
    arity, call, truth = CASES[name]
    # A curved form's last symbol is one of the argument's.
    several = 2 if mode == "curved" else 3
    system = AffineSystem(fmt, symbols=several if arity == 2 else 1, **MODES[mode])
    ends = [boxes(fmt.dtype, COUNT, seed=i + 20 * arity) for i in range(arity)]
    with np.errstate(all="ignore"):
        numbers = [argument(system, i, *pair, kind) for i, pair in enumerate(ends)]
        result = call(*numbers)
        reach = spread(repaid(fmt, result.error, result.budget.depth), COUNT)
        box = result.interval()
    low, high, centre = spread(box.lo, COUNT), spread(box.hi, COUNT), spread(result.centre, COUNT)
    terms = [spread(u, COUNT) for u in result.terms]
    defined, empty = spread(result.defined, COUNT), spread(result.empty, COUNT)
    middles = [spread(x.centre, COUNT) for x in numbers]
    radii = [spread(x.terms[i], COUNT) for i, x in enumerate(numbers)]
    checked = 0
    for symbols in positions(arity):
        with flint.ctx.workprec(PRECISION):
            for i in range(COUNT):
                point = [flint.arb(c[i]) + flint.arb(r[i]) * e for c, r, e in zip(middles, radii, symbols, strict=True)]
                value = truth(*point)
                if value is None or not value.is_finite():
                    assert not defined[i] or value is not None, (name, middles, radii)
                    continue
                assert not empty[i]
                if not within(value, fmt.big) or not all(within(p, fmt.big) for p in point):
                    continue
                where = (name, [(c[i], r[i], e) for c, r, e in zip(middles, radii, symbols, strict=True)], float(value))
                assert not outside(value, low[i], high[i]), where
                line = flint.arb(centre[i])
                bend = [2 * flint.arb(symbols[-1]) ** 2 - 1] if mode == "curved" else []
                for u, e in zip(terms, [*symbols, *bend], strict=mode == "curved"):
                    line += flint.arb(u[i]) * e
                assert not abs(value - line) > flint.arb(reach[i]), where
                checked += 1
    assert checked > COUNT


def positions(arity):
    generator = np.random.default_rng(arity)
    corners = [(-1.0,), (1.0,), (0.0,)] if arity == 1 else [(-1.0, 1.0), (1.0, 1.0)]
    return [*corners, *(tuple(generator.uniform(-1, 1, arity).tolist()) for _ in range(2))]


CURVED = {
    "sqr": (0.3, 2.0), "sqrt": (0.7, 0.25), "exp": (0.4, 1.0), "log": (0.6, 1.0), "sin": (0.9, 1.0), "cos": (0.9, 1.0),
    "tan": (0.7, 2.0), "asin": (0.4, 1.0), "acos": (0.4, 1.0), "atan": (0.8, 1.0), "sinh": (0.8, 1.0),
    "cosh": (0.5, 1.0), "tanh": (0.6, 1.0), "cbrt": (0.7, 1.0), "powi-1": (0.8, 2.0), "powr3/2": (0.6, 1.0),
}  # fmt: skip


def curvature(name, at):
    """f'' at a point, by ball arithmetic."""
    truth = CASES[name][2]
    with flint.ctx.workprec(400):
        h = flint.arb(2) ** -60
        x = flint.arb(at)
        return abs(float((truth(x + h) - 2 * truth(x) + truth(x - h)) / h**2))


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
@pytest.mark.parametrize("name", CURVED)
def test_error_is_the_least_a_line_of_that_slope_can_have(name, fmt):
    at, call = fmt.round(CURVED[name][0]), CASES[name][1]
    for radius in (2.0**-10, 2.0**-6, 2.0**-4):
        result = call(AffineSystem(fmt).symbol(0, at, radius))
        error = repaid(fmt, result.error, result.budget.depth)
        # A quadratic leaves the line by f'' r**2/2 on one side, half of it on either side of a shifted one.
        ideal = curvature(name, at) * radius**2 / 4
        assert 0.9 * ideal < error < 1.35 * ideal + 16 * fmt.eps * abs(result.centre)


@pytest.mark.parametrize("intersect", [False, True])
@pytest.mark.parametrize("name", ["sqrt", "log", "asin", "tan", "exp", "sin", "cbrt", "powi-1", "powr3/2"])
def test_wide_arguments_are_as_good_as_intervals(name, intersect):
    system = AffineSystem(F64, intersect=intersect)
    for lo, hi in ((0.001, 0.9), (-0.5, 0.9), (0.25, 30.0), (-4.0, 9.0)):
        x = system.symbol(0, (lo + hi) / 2, (hi - lo) / 2)
        with np.errstate(all="ignore"):
            form = CASES[name][1](x).interval()
            plain_range = CASES[name][1](x.interval())
        width, ideal = form.hi - form.lo, plain_range.hi - plain_range.lo
        assert width <= (1.0001 if intersect else 2.1) * ideal + 1e-9


def test_a_square_around_zero_keeps_its_rounding():
    """Where |c| is far below the radius the credit of the error buys next to nothing."""
    generator = np.random.default_rng(12)
    count = 3000
    radius = generator.uniform(0.5, 2.0, count).astype(np.float32)
    centre = (radius * 10.0 ** generator.uniform(-9, -1, count)).astype(np.float32)
    square = AffineSystem(F32).symbol(0, centre, radius).sqr()
    reach = repaid(F32, square.error, square.budget.depth)
    with flint.ctx.workprec(PRECISION):
        for i in range(count):
            for e in (-1, 0, 1):
                value = (flint.arb(float(centre[i])) + flint.arb(float(radius[i])) * e) ** 2
                line = flint.arb(float(square.centre[i])) + flint.arb(float(square.terms[0][i])) * e
                assert abs(value - line) <= flint.arb(float(reach[i]))


def test_linear_dependence_cancels():
    system = AffineSystem(F64)
    x = system.symbol(0, 1.0, 0.5)
    assert (x - x).interval().hi < 1e-13
    assert (2.0 * x - x - x).interval().lo > -1e-13
    square = (x.sqr() - x).interval()
    assert (square.lo, square.hi) == pytest.approx((-0.25, 0.75), abs=0.26)
    assert (x * x).error == pytest.approx(2 * x.sqr().error)


def test_three_symbols_stay_apart():
    system = AffineSystem(F64, symbols=3)
    x, y, z = (system.symbol(i, 1.0, 0.25) for i in range(3))
    total = x + 2.0 * y - z
    assert total.terms == (0.25, 0.5, -0.25)
    assert total.interval().hi == pytest.approx(3.0)
    assert (x * y).terms == (0.25, 0.25, 0.0)


def knotty(x, y, z):
    """Many cancelling products; on numbers and on balls alike."""
    inner = ((x * y - z) ** 2 * (x + y * z) - (x**2 + y**2 + z**2) ** 2) * (z - x * x * x) + x**2 * y**2
    return inner * 0.25 + (x - y) * 3.0 - z * z * 1.5


@pytest.mark.parametrize("kind", [np.asarray, Fused, Flushed], ids=["plain", "fused", "flushed"])
@pytest.mark.parametrize("symbols", [1, 3])
@pytest.mark.parametrize("intersect", [False, True])
def test_rounding_is_never_forgotten(kind, symbols, intersect):
    """Without any width, all that is left is rounding: the exact value must still be inside."""
    system = AffineSystem(F32, symbols, intersect)
    generator = np.random.default_rng(2)
    values = [generator.uniform(-2, 2, 400).astype(np.float32) for _ in range(3)]
    box = knotty(*(system.exact(kind(v)) for v in values)).interval()
    low, high = plain(box.lo), plain(box.hi)
    with flint.ctx.workprec(PRECISION):
        for i, point in enumerate(zip(*values, strict=True)):
            assert not outside(knotty(*(flint.arb(float(v)) for v in point)), low[i], high[i])
    # The sizes that cancel are about 20.
    assert np.median(high - low) < 2 * 20 * 20 * F32.eps


def test_a_missing_rounding_term_would_be_seen():
    """The same without its error really does miss values, so the test above can fail."""
    system = AffineSystem(F32)
    values = [np.random.default_rng(2).uniform(-2, 2, 400).astype(np.float32) for _ in range(3)]
    result = knotty(*(system.exact(v) for v in values))
    with flint.ctx.workprec(PRECISION):
        missed = sum(
            not knotty(*(flint.arb(float(v)) for v in point)).contains(flint.arb(float(result.centre[i])))
            for i, point in enumerate(zip(*values, strict=True))
        )
    assert missed > 300


@pytest.mark.parametrize("intersect", [False, True])
def test_a_parameter_carries_its_storage_error(intersect):
    system = AffineSystem(F32, intersect=intersect)
    third = system.enclose(np.float32([1 / 3]), np.float32([2.0**-26]))
    box = (third * 3.0 - 1.0).interval()
    assert box.lo[0] < 0 < box.hi[0]
    assert box.hi[0] - box.lo[0] < 2 * 3 * 2.0**-26 + 14 * F32.eps
    assert (system.enclose(np.float32([2.0]), 0.0) - 2.0).interval().hi[0] < 4 * F32.eps * 4


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
@pytest.mark.parametrize("operation", ["max", "min"])
def test_choices_are_exact_where_decided_and_a_mixture_elsewhere(fmt, operation):
    system = AffineSystem(fmt)
    x = system.symbol(0, np.array([0.5, -3.0, 3.0], fmt.dtype), np.array([1.0, 1.0, 1.0], fmt.dtype))
    zero = system.constant(0.0, 0.0)
    chosen = getattr(x, operation)(zero)
    expected = [3 / 4 if operation == "max" else 1 / 4, 0.0 if operation == "max" else 1.0, 1.0]
    expected[2] = 1.0 if operation == "max" else 0.0
    assert chosen.terms[0].tolist() == pytest.approx(expected, abs=1e-5)
    # max(x, 0) on [-1/2, 3/2] leaves its chord by at most 3/8.
    assert chosen.error.tolist() == pytest.approx([3 / 16, 0.0, 0.0], abs=1e-5)


def test_absolute_value_is_the_chord():
    system = AffineSystem(F64)
    size = abs(system.symbol(0, np.array([0.0, 0.5, 2.0, -2.0]), np.array([1.0, 1.0, 1.0, 1.0])))
    assert size.terms[0].tolist() == pytest.approx([0.0, 0.5, 1.0, -1.0])
    assert size.error.tolist() == pytest.approx([0.5, 0.375, 0.0, 0.0])
    # The chord's form alone would reach down to -1/4; what it stands for is known not to.
    box = size.interval()
    assert box.lo.tolist() == pytest.approx([0.0, 0.0, 1.0, 1.0])
    assert size.form_range()[0].tolist() == pytest.approx([0.0, -0.25, 1.0, 1.0])


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
def test_roots_of_what_is_not_negative_are_defined_down_to_zero(fmt):
    system = AffineSystem(fmt)
    x = system.symbol(0, np.array([0.0, 0.3, -1.0], fmt.dtype), np.array([1.0, 0.5, 2.0], fmt.dtype))
    y, zero = system.exact(np.zeros(3, fmt.dtype)), system.constant(0.0, 0.0)
    with np.errstate(all="ignore"):
        for f in ((x.sqr() + y.sqr()).sqrt(), abs(x).powr((3, 2)), (x.sqr() * abs(x)).sqrt(), x.max(zero).powr((1, 3))):
            assert np.all(f.defined)
            assert not np.any(f.empty)
        assert not np.any(x.sqrt().defined)


def test_undecided_selection_is_the_mean():
    system = AffineSystem(F64)
    x = system.symbol(0, np.array([0.0, -2.0, 2.0]), np.array([1.0, 1.0, 1.0]))
    chosen = x.lt(system.constant(0.0, 0.0)).select(x * 2.0, x + 1.0)
    box = chosen.interval()
    assert chosen.terms[0].tolist() == pytest.approx([1.5, 2.0, 1.0])
    assert (box.lo[1], box.hi[1], box.lo[2], box.hi[2]) == pytest.approx((-6.0, -2.0, 2.0, 4.0))
    assert box.lo[0] <= -2
    assert box.hi[0] >= 2
    assert chosen.defined.tolist() == [False, True, True]


def test_comparisons_see_what_is_common():
    system = AffineSystem(F64)
    x = system.symbol(0, 0.0, 10.0)
    condition = x.lt(x + 1.0)
    assert condition.true is True
    assert x.le(x - 1.0).false is True
    assert x.lt(system.constant(1.0, 1.0)).true is False


def test_modulus_keeps_its_slope_inside_a_step():
    system = AffineSystem(F64)
    x = system.symbol(0, np.array([2.5, 3.0]), np.array([0.25, 0.25]))
    rest = x.mod(system.constant(1.0, 1.0))
    assert rest.terms[0].tolist() == pytest.approx([0.25, 0.0])
    assert rest.defined.tolist() == [True, False]
    box = rest.interval()
    assert box.lo.tolist() == pytest.approx([0.25, 0.0], abs=1e-9)
    assert box.hi.tolist() == pytest.approx([0.75, 1.0], abs=1e-9)


def test_overflow_excludes_nothing():
    system = AffineSystem(F32)
    x = system.symbol(0, np.float32([1e20, -1e20]), np.float32([1e19, 1e19]))
    with np.errstate(all="ignore"):
        huge = x.powi(3) - x.powi(3) * 0.5
        assert huge.contains_zero().all()
        wide = huge.interval()
        assert not huge.contract().excluded.any()
        assert not huge.contract().crosses.any()
    assert np.isfinite(wide.lo).all()
    assert np.isfinite(wide.hi).all()


def test_a_pole_is_the_whole_line():
    system = AffineSystem(F32)
    x = system.symbol(0, np.float32([0.0, 2.0]), np.float32([1.0, 1.0]))
    with np.errstate(all="ignore"):
        quotient = (x + 5.0) * 1e-9 / x
    assert quotient.contains_zero()[0]
    assert quotient.interval().hi[0] == F32.big
    assert quotient.defined.tolist() == [False, True]
    assert not quotient.contains_zero()[1]
