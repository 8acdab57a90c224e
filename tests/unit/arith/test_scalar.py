import math

import numpy as np
import pytest

from zeroset.arith import scalar as s

from .scalars import Flushed, Fused, plain

KINDS = [
    pytest.param(lambda v: np.array(v, np.float32), id="float32"),
    pytest.param(lambda v: np.array(v, np.float64), id="float64"),
    pytest.param(Fused, id="fused"),
]
EDGES = [0.0, -0.0, 1.5, -2.5, 1e-30, 3e30, math.nan]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("function", "compare"), [(s.minimum, np.less), (s.maximum, np.greater)])
def test_extremes_give_the_second_operand_for_nan(kind, function, compare):
    a, b = (x.ravel() for x in np.meshgrid(EDGES, EDGES))
    expected = np.where(compare(a, b), a, b)
    assert np.array_equal(plain(function(kind(a), kind(b))), expected.astype(plain(kind(a)).dtype), equal_nan=True)


@pytest.mark.parametrize(("function", "compare"), [(s.minimum, np.less), (s.maximum, np.greater)])
@pytest.mark.parametrize("value", EDGES)
def test_extremes_of_a_literal_and_a_run_time_scalar(function, compare, value):
    for a, b in ((value, Fused(EDGES)), (Fused(EDGES), value)):
        expected = np.where(compare(plain(a), plain(b)), plain(a), plain(b)).astype(np.float32)
        assert np.array_equal(plain(function(a, b)), expected, equal_nan=True)


def test_literals_fold_away():
    x = Fused([3.0])
    assert s.mul(x, 0.0) == 0.0
    assert s.mul(1.0, x) is x
    assert s.add(x, 0.0) is x
    assert s.fma(x, 0.0, 2.0) == 2.0
    assert s.fma(0.0, x, x) is x
    assert s.neg(0.0) == 0.0
    assert s.div(0.0, x) == 0.0


def test_literal_masks_fold_away():
    mask = Fused([1.0]) > 0.0
    assert s.and_(True, mask) is mask
    assert s.and_(mask, False) is False
    assert s.or_(False, mask) is mask
    assert s.or_(mask, True) is True
    assert s.not_(True) is False
    assert s.select(True, 1.0, mask) == 1.0
    assert s.select(mask, 2.0, 2.0) == 2.0


@pytest.mark.parametrize("kind", KINDS)
def test_select_between_literals_takes_the_type_of_its_neighbour(kind):
    x = kind([1.0, -1.0, math.nan])
    chosen = s.select(s.gt(x, 0.0), 5.0, 7.0, like=x)
    assert plain(chosen).tolist() == [5.0, 7.0, 7.0]
    assert plain(chosen).dtype == plain(x).dtype


@pytest.mark.parametrize("kind", KINDS)
def test_exponents_come_apart_and_together(kind):
    x = kind([1.0, 1.5, 2.0, 0.75, 1e-20, 3e30])
    m, e = s.frexp(x)
    assert ((plain(m) >= 1) & (plain(m) < 2)).all()
    assert np.array_equal(plain(m * s.pow2(e)), plain(x))


def test_python_floats_divide_like_ieee():
    assert s.div(1.0, 0.0) == math.inf
    assert s.div(-1.0, 0.0) == -math.inf
    assert s.div(1.0, -0.0) == -math.inf
    assert math.isnan(s.div(0.0, 0.0))
    assert math.isnan(s.sqrt(-1.0))


@pytest.mark.parametrize("kind", KINDS)
def test_sign(kind):
    assert plain(s.sign(kind([2.0, -0.5, 0.0]))).tolist() == [1.0, -1.0, 0.0]


def test_float32_stays_float32():
    x = np.float32([1.0, 2.0])
    for y in (s.fma(x, 2.0, 1.0), s.maximum(x, 1.5), s.select(x > 1, x, 0.0), s.rint(x), s.sign(x)):
        assert y.dtype == np.float32


def test_rounding_functions_give_floats():
    assert [f(2.5) for f in (s.floor, s.ceil, s.trunc, s.rint)] == [2.0, 3.0, 2.0, 2.0]
    assert isinstance(s.floor(2.5), float)


def test_flushed_scalars_lose_subnormals():
    assert plain(Flushed([1e-40]) + Flushed([0.0])).tolist() == [0.0]
    assert plain(Flushed([1e-30]) * Flushed([1e-10])).tolist() == [0.0]
