"""Intervals hold the truth, in every kind of arithmetic, and are no wider than they need to be."""

import flint
import numpy as np
import pytest

from zeroset.arith import F32, F64, IntervalSystem
from zeroset.arith.flags import Flags

from .scalars import Flushed, Fused, plain
from .truth import boxes, cases, inner, outside, true_values, within

CASES = cases()
COUNT = 120


def system(fmt):
    return IntervalSystem(fmt)


def evaluated(call, fmt, ends, kind=np.asarray):
    with np.errstate(all="ignore"):
        return call(*(system(fmt).bounds(kind(lo), kind(hi)) for lo, hi in ends))


def spread(scalar, count):
    return np.broadcast_to(plain(scalar), count)


@pytest.mark.parametrize("kind", [np.asarray, Fused, Flushed], ids=["plain", "fused", "flushed"])
@pytest.mark.parametrize("name", CASES)
def test_contains_the_truth_f32(name, kind):
    holds(name, F32, kind)


@pytest.mark.parametrize("name", CASES)
def test_contains_the_truth_f64(name):
    holds(name, F64, np.asarray)


def holds(name, fmt, kind):
    arity, call, truth = CASES[name]
    ends = [boxes(fmt.dtype, COUNT, seed=i + 10 * arity) for i in range(arity)]
    if kind is Flushed:
        ends = [tuple(plain(Flushed(end)) for end in pair) for pair in ends]
    result = evaluated(call, fmt, ends, kind)
    low, high = spread(result.lo, COUNT), spread(result.hi, COUNT)
    defined, empty = spread(result.defined, COUNT), spread(result.empty, COUNT)
    assert np.isfinite(low).all()
    assert np.isfinite(high).all()
    assert (low <= high).all()
    columns = [inner(*pair, parts=1, seed=i) for i, pair in enumerate(ends)]
    points = [(p,) for p in columns[0]] if arity == 1 else [(p, q) for p in columns[0] for q in columns[1]]
    checked = 0
    for point in points:
        for i, value in enumerate(true_values(truth, *point)):
            where = [p[i] for p in point]
            if value is None:
                assert not defined[i], where
                continue
            assert not empty[i], where
            if within(value, fmt.big):
                assert not outside(value, low[i], high[i]), (where, float(value), low[i], high[i])
                checked += 1
    assert checked > COUNT / 2


MODERATE = {
    "log": (0.2, 3), "sqrt": (0.1, 3), "asin": (-0.9, 0.9), "acos": (-0.9, 0.9), "tan": (-1.4, 1.4), "cosh": (0.1, 2),
    "powi-1": (0.2, 3), "powi-2": (0.2, 3), "powi-3": (0.2, 3),
    "powr1/2": (0.1, 3), "powr3/2": (0.1, 3), "powr5/4": (0.1, 3), "powr2/3": (0.1, 3), "powr7/5": (0.1, 3),
    "powr-1/2": (0.1, 3), "powr-3/5": (0.1, 3),
}  # fmt: skip
STEPS = {"sign", "floor", "ceil"}


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
@pytest.mark.parametrize("name", [n for n, (arity, *_) in CASES.items() if arity == 1 and n not in STEPS])
def test_unary_bounds_are_tight(name, fmt):
    _, call, truth = CASES[name]
    generator = np.random.default_rng(4)
    lo = generator.uniform(*MODERATE.get(name, (-2, 2)), 40)
    hi = lo + 2.0 ** generator.uniform(-12, -1, 40)
    lo, hi = (np.clip(x, *MODERATE.get(name, (-9, 9))).astype(fmt.dtype) for x in (lo, hi))
    result = evaluated(call, fmt, [(lo, hi)])
    for i in range(40):
        grid = np.linspace(float(lo[i]), float(hi[i]), 65)
        values = [float(v.mid()) for v in true_values(truth, grid)]
        least, most = min(values), max(values)
        # 65 points miss an extremum by a small part of the range, a kink by more; the rest is rounding.
        slack = (
            (2e-2 if name == "abs" else 2e-3) * (most - least)
            + 60 * fmt.eps * max(abs(least), abs(most))
            + 60 * fmt.eps * 2.0**-10
        )
        assert result.lo[i] >= least - slack
        assert result.hi[i] <= most + slack


def test_products_and_squares_are_tight():
    x = system(F64).bounds(np.array([-1.0, 2.0]), np.array([3.0, 4.0]))
    assert x.sqr().lo.tolist() == pytest.approx([0.0, 4.0])
    assert x.sqr().hi.tolist() == pytest.approx([9.0, 16.0])
    assert x.sqr().lo[0] == 0.0
    assert (x * x).lo.tolist() == pytest.approx([-3.0, 4.0])
    assert x.powi(4).lo[0] == 0.0
    assert x.powi(3).lo.tolist() == pytest.approx([-1.0, 8.0])


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
def test_division_by_an_interval_with_zero(fmt):
    make = system(fmt).bounds
    across = make(1.0, 2.0) / make(-1.0, 1.0)
    assert (across.lo, across.hi) == (-fmt.big, fmt.big)
    assert across.defined is False
    above = make(1.0, 2.0) / make(0.0, 4.0)
    assert 0.24 < above.lo <= 0.25
    assert above.hi == fmt.big
    below = make(1.0, 2.0) / make(-4.0, 0.0)
    assert below.lo == -fmt.big
    assert -0.25 <= below.hi < -0.24
    zero = make(0.0, 2.0) / make(0.0, 1.0)
    assert zero.lo >= -3 * fmt.tiny
    assert zero.hi == fmt.big


def test_domain_edges_keep_the_real_part():
    make = system(F64).bounds
    root = make(-1.0, 4.0).sqrt()
    assert root.lo == 0.0
    assert root.hi == pytest.approx(2.0)
    assert root.defined is False
    assert root.empty is False
    assert make(-2.0, -1.0).sqrt().empty is True
    logarithm = make(-1.0, 1.0).log()
    assert logarithm.lo == -F64.big
    assert logarithm.hi == pytest.approx(0.0, abs=1e-12)
    assert make(-3.0, 0.0).log().empty is True
    arc = make(0.5, 7.0).asin()
    assert arc.lo == pytest.approx(np.pi / 6)
    assert arc.hi == pytest.approx(np.pi / 2)
    assert arc.defined is False
    assert make(1.5, 2.0).acos().empty is True


def test_steps_tell_where_they_jump():
    make = system(F64).bounds
    assert make(2.0, 2.9).floor().defined is True
    assert make(1.9, 2.1).floor().defined is False
    assert make(0.5, 2.0).sign().defined is True
    assert make(-0.5, 2.0).sign().defined is False
    assert make(2.25, 2.5).mod(make(1.0, 1.0)).defined is True
    cut = make(0.75, 1.25).mod(make(1.0, 1.0))
    assert cut.defined is False
    assert cut.lo == 0.0
    assert cut.hi == pytest.approx(1.0)


def test_waves_find_their_extrema_and_give_up_honestly():
    make = system(F32).bounds
    peak = make(1.0, 2.0).sin()
    assert peak.hi == 1.0
    assert peak.lo == pytest.approx(np.sin(1.0), abs=1e-5)
    assert make(3.0, 3.3).cos().lo == -1.0
    assert make(-0.1, 0.2).cos().hi == 1.0
    far = make(20000.0, 20000.001).sin()
    assert (far.lo, far.hi) == (-1.0, 1.0)
    assert make(1.5, 1.6).tan().defined is False
    assert make(1.5, 1.55).tan().defined is True
    assert make(9000.0, 9000.0).tan().defined is False


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
def test_no_pole_of_the_tangent_is_missed(fmt):
    odd = np.arange(1, 5000, 2)
    near = (odd * (np.pi / 2)).astype(fmt.dtype)
    lo, hi = np.nextafter(near, np.zeros_like(near)), np.nextafter(near, np.full_like(near, np.inf))
    for sign in (1, -1):
        ends = (lo, hi) if sign > 0 else (-hi, -lo)
        assert not system(fmt).bounds(*ends).tan().defined.any()
    step = np.array(0.01, fmt.dtype)
    clear = system(fmt).bounds(lo[:300] + step, hi[:300] + step)
    assert clear.tan().defined.all()


def test_atan2_knows_its_cut():
    make = system(F64).bounds
    right = make(-1.0, 1.0).atan2(make(1.0, 2.0))
    assert (right.lo, right.hi) == pytest.approx((-np.pi / 4, np.pi / 4))
    left = make(-1.0, 1.0).atan2(make(-2.0, -1.0))
    assert left.hi - left.lo == pytest.approx(2 * np.pi)
    assert left.defined is False
    upper = make(1.0, 2.0).atan2(make(-2.0, 2.0))
    assert (upper.lo, upper.hi) == pytest.approx((np.arctan2(1, 2), np.arctan2(1, -2)))
    assert upper.defined is True


def test_zero_is_excluded_only_for_certain():
    make = system(F32).bounds
    lo, hi = np.float32([0.1, -2.0, -1.0, np.nan, 1.0]), np.float32([1.0, -1.0, 1.0, np.nan, np.nan])
    assert make(lo, hi).contains_zero().tolist() == [False, False, True, True, False]
    nowhere = make(lo, hi).make(lo, hi, Flags(True, np.array([True] * 5)))
    assert not nowhere.contains_zero().any()


def test_overflow_stays_finite_and_claims_nothing():
    wide = system(F32).bounds(np.float32([1e20]), np.float32([2e20]))
    with np.errstate(over="ignore"):
        results = [wide.sqr(), wide * wide, wide.powi(5), wide.exp(), wide.cosh()]
    for huge in results:
        assert huge.hi[0] >= F32.big
        assert huge.hi[0] < np.inf
        # What is certain about the lower end: the truth is above big.
        assert 0.999 * F32.big < huge.lo[0] < 1.001 * F32.big
    assert results[2].neg().lo[0] <= -F32.big


def test_constants_are_enclosed_in_the_format():
    pi = system(F32).constant(3.141592653589793, 3.1415926535897936)
    assert pi.lo < 3.141592653589793 < pi.hi
    assert F32.exact(pi.lo)
    assert pi.hi - pi.lo <= 4 * F32.eps * 2
    assert system(F32).constant(0.5, 0.5).lo == system(F32).constant(0.5, 0.5).hi == 0.5


def test_constant_factors_are_exact_in_their_effect():
    x = system(F32).bounds(np.float32([-3.0, 1.0]), np.float32([2.0, 5.0]))
    third = x * system(F32).constant(1 / 3 - 1e-17, 1 / 3 + 1e-17)
    for i, (lo, hi) in enumerate(((-3, 2), (1, 5))):
        assert flint.arb(float(third.lo[i])) < flint.arb(lo) / 3
        assert flint.arb(float(third.hi[i])) > flint.arb(hi) / 3
        assert third.lo[i] == pytest.approx(lo / 3, rel=1e-6)
    assert (x * 2.0).lo.tolist() == [-6.0, 2.0]
    assert (x * -1.0).hi.tolist() == [3.0, -1.0]
    assert (x + 0.0) is x


def test_a_known_sign_saves_nothing_in_width():
    x = system(F64).bounds(np.array([-1.0]), np.array([2.0]))
    y = system(F64).bounds(np.array([1.0]), np.array([3.0]))
    assert x.sqr().nonnegative
    mixed = x * y.abs()
    assert (mixed.lo[0], mixed.hi[0]) == pytest.approx((-3.0, 6.0))
    both = x.sqr() * y.abs()
    assert (both.lo[0], both.hi[0]) == pytest.approx((0.0, 12.0))


@pytest.mark.parametrize("kind", [np.asarray, Fused], ids=["plain", "fused"])
def test_select_is_the_hull_where_undecided(kind):
    make = system(F32).bounds
    x = make(kind(np.float32([-2, -1, 1])), kind(np.float32([-1, 1, 2])))
    picked = x.lt(x.literal(0.0)).select(x.literal(10.0), x.literal(20.0))
    assert plain(picked.lo).tolist() == [10, 10, 20]
    assert plain(picked.hi).tolist() == [10, 20, 20]
    assert plain(picked.defined).tolist() == [True, False, True]


def test_select_between_undefined_branches():
    make = system(F64).bounds
    across, nowhere = make(-1.0, 1.0), make(-2.0, -1.0).sqrt()
    undecided = across.lt(make(0.0, 0.0))
    assert undecided.select(nowhere, nowhere).empty is True
    assert undecided.select(nowhere, across).empty is False
    assert across.lt(make(2.0, 2.0)).select(across, nowhere).defined is True
    assert across.lt(make(2.0, 2.0)).select(nowhere, across).empty is True
    assert nowhere.lt(across).select(across, across).empty is True


def test_conditions_combine():
    make = system(F64).bounds
    low, high, across = make(-2.0, -1.0), make(1.0, 2.0), make(-1.0, 1.0)
    zero = make(0.0, 0.0)
    yes, no, open_ = low.lt(zero), high.le(zero), across.lt(zero)
    assert (yes.true, yes.false) == (True, False)
    assert (no.true, no.false) == (False, True)
    assert (open_.true, open_.false) == (False, False)
    assert yes.and_(no).false
    assert yes.or_(open_).true
    assert no.and_(open_).false
    assert not yes.and_(open_).true
    assert open_.not_().true == open_.not_().false == False  # noqa: E712
    assert yes.not_().false
