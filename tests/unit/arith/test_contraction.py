"""Contracting a symbol loses no zero, and a proven change of sign is one."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from zeroset.arith import F32, F64, AffineSystem
from zeroset.arith.flags import Flags

from .scalars import Flushed, Fused, plain


def quintic(t, roots):
    value = (t - roots[0]) * (t - roots[1]) * ((t - roots[2]) ** 2 + 0.25)
    return value * 0.5


@pytest.mark.parametrize("kind", [np.asarray, Fused, Flushed], ids=["plain", "fused", "flushed"])
@pytest.mark.parametrize("mode", [{}, {"intersect": True}, {"curved": True}], ids=["form", "with-interval", "curved"])
def test_no_zero_is_lost(kind, mode):
    generator = np.random.default_rng(8)
    count, roots = 4000, (0.25, 1.5, -0.75)
    width = (10.0 ** generator.uniform(-7, 0.3, count)).astype(np.float32)
    place = generator.uniform(-1.2, 1.2, count)
    centre = (0.25 + place * width).astype(np.float32)
    t = AffineSystem(F32, **mode).symbol(0, kind(centre), kind(width))
    found = quintic(t, roots).contract()
    excluded, crosses = plain(found.excluded), plain(found.crosses)
    low, high = plain(found.low).astype(float), plain(found.high).astype(float)
    at = [(root - centre.astype(float)) / width.astype(float) for root in roots[:2]]
    inside = [abs(e) <= 1 for e in at]
    for e, here in zip(at, inside, strict=True):
        assert not excluded[here].any()
        assert (low[here] <= e[here]).all()
        assert (e[here] <= high[here]).all()
    only = inside[0] ^ inside[1]
    assert not crosses[~only].any()
    # f rises through 3/2 and falls through 1/4.
    assert not plain(found.rising)[crosses & inside[0]].any()
    assert crosses.mean() > 0.3
    assert excluded[~inside[0] & ~inside[1]].mean() > 0.3
    assert (high - low)[crosses].mean() < 0.7


@settings(max_examples=200, deadline=None)
@given(
    st.floats(-10, 10, width=32), st.floats(-10, 10, width=32), st.floats(0, 5, width=32), st.sampled_from([F32, F64])
)
def test_a_strip_is_cut_where_it_meets_zero(centre, slope, error, fmt):
    form = AffineSystem(fmt).form(centre, (slope,), error)
    found = form.contract()
    assert found.low >= -1
    assert found.high <= 1
    for e in np.linspace(-1, 1, 41).tolist():
        if abs(centre + slope * e) <= error:
            assert not found.excluded
            assert found.low <= e <= found.high
    if found.crosses:
        assert (centre - slope) * (centre + slope) < 0
        assert abs(slope) - error > abs(centre)
        assert found.rising == (slope > 0)


@settings(max_examples=400, deadline=None)
@given(
    st.floats(-10, 10, width=32),
    st.floats(-10, 10, width=32),
    st.floats(-5, 5, width=32),
    st.floats(0, 5, width=32),
    st.sampled_from([F32, F64]),
)
def test_a_parabola_is_cut_where_it_meets_zero(centre, slope, bend, error, fmt):
    form = AffineSystem(fmt, curved=True).form(centre, (slope, bend), error)
    found, box = form.contract(), form.interval()
    assert found.low >= -1
    assert found.high <= 1
    assert found.excluded or found.low <= found.high
    for e in np.linspace(-1, 1, 65).tolist():
        value = centre + slope * e + bend * (2 * e * e - 1)
        assert box.lo <= value - error * 0.999
        assert value + error * 0.999 <= box.hi
        if abs(value) <= error:
            assert not found.excluded
            assert found.low <= e <= found.high
        elif not found.excluded and not found.low <= e <= found.high:
            # The sign beside what is left is that of a line that rises as the form does.
            assert (value > 0) == ((slope > 0) == (e > found.high))
    if found.crosses:
        assert (centre - slope + bend) * (centre + slope + bend) < 0
        assert abs(slope) - error > abs(centre + bend)
        assert found.rising == (slope > 0)


def test_a_parabola_is_cut_to_about_its_root():
    form = AffineSystem(F32, curved=True).form(0.1, (1.0, 0.2), 2.0**-20)
    straight = AffineSystem(F32).form(0.1, (1.0,), 0.2)
    found, wide = form.contract(), straight.contract()
    assert found.crosses
    assert found.high - found.low < 0.15 * (wide.high - wide.low)


@pytest.mark.parametrize("curved", [False, True], ids=["straight", "curved"])
def test_a_parabola_that_stays_on_one_side_is_excluded_by_its_bend(curved):
    t = AffineSystem(F32, curved=curved).symbol(0, 0.0, 1.0)
    assert (t.sqr() - t + 0.375).contract().excluded == curved
    assert (t - t.sqr() - 0.375).contract().excluded == curved


@pytest.mark.parametrize("kind", [np.asarray, Fused], ids=["plain", "fused"])
def test_the_root_of_an_exact_line_is_kept(kind):
    generator = np.random.default_rng(3)
    slope = generator.uniform(-2, 2, 3000).astype(np.float32)
    centre = (slope * generator.uniform(-1, 1, 3000)).astype(np.float32)
    found = AffineSystem(F32).form(kind(centre), (kind(slope),)).contract()
    low, high = plain(found.low).tolist(), plain(found.high).tolist()
    for c, u, least, most in zip(centre.tolist(), slope.tolist(), low, high, strict=True):
        root = -Fraction(c) / Fraction(u)
        assert Fraction(least) <= root <= Fraction(most) or abs(root) > 1
    assert np.max(plain(found.high) - plain(found.low)) < 16 * F32.eps


def test_nothing_is_proven_where_f_may_be_undefined():
    system = AffineSystem(F64)
    form = system.symbol(0, 0.0, 1.0)
    assert form.contract().crosses
    assert not form.make(0.0, (1.0,), 0.0, form.budget, Flags(defined=False)).contract().crosses
    pole = system.constant(1.0, 1.0) / form
    assert not pole.contract().crosses


def test_other_symbols_count_as_error():
    system = AffineSystem(F64, symbols=3)
    form = system.form(0.0, (0.25, 0.5, 1.0))
    along = form.contract(2)
    assert along.crosses
    assert (along.low, along.high) == pytest.approx((-0.75, 0.75))
    assert not form.contract(0).crosses
    assert (form.contract(0).low, form.contract(0).high) == (-1.0, 1.0)


def test_nan_proves_nothing():
    bad = np.array([np.nan, 1.0, np.inf, 0.0])
    for parts in ((bad, np.ones(4), np.zeros(4)), (np.zeros(4), bad, np.zeros(4)), (np.ones(4), np.ones(4), bad)):
        with np.errstate(all="ignore"):
            found = AffineSystem(F64).form(parts[0], (parts[1],), parts[2]).contract()
        unknown = np.isnan(parts[0]) | np.isnan(parts[1]) | np.isnan(parts[2])
        assert not found.excluded[unknown].any()
        assert not found.crosses[unknown].any()
        assert (found.low[unknown] == -1).all()
        assert (found.high[unknown] == 1).all()
