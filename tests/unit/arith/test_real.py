import numpy as np
import pytest

from zeroset.arith import F32, F64, RealSystem

from .scalars import Fused, plain
from .truth import cases, true_values

CASES = cases()


@pytest.mark.parametrize("name", CASES)
def test_every_operator_is_close_and_knows_its_domain(name):
    arity, call, truth = CASES[name]
    generator = np.random.default_rng(6)
    points = [generator.uniform(-3, 3, 200) for _ in range(arity)]
    with np.errstate(all="ignore"):
        result = call(*(RealSystem(F64).exact(p) for p in points))
    defined = np.broadcast_to(result.defined, 200)
    assert np.isfinite(result.value).all()
    for i, value in enumerate(true_values(truth, *points)):
        assert defined[i] == (value is not None)
        if value is not None:
            assert result.value[i] == pytest.approx(float(value.mid()), rel=1e-12, abs=1e-13)


def test_what_is_total_says_so_while_tracing():
    x = RealSystem(F32).exact(Fused([1.0, -1.0]))
    assert (x.sqr() + x.sin().exp() * 2.0).defined is True
    assert plain(x.sqrt().defined).tolist() == [True, False]
    assert plain((x / (x - 1.0)).defined).tolist() == [False, True]


@pytest.mark.parametrize("kind", [np.asarray, Fused], ids=["plain", "fused"])
def test_conditions(kind):
    x = RealSystem(F32).exact(kind(np.float32([-1.0, 0.0, 1.0])))
    zero = x.literal(0.0)
    inside = x.lt(x.literal(0.5)).and_(x.lt(zero).not_())
    assert plain(inside.select(x.literal(5.0), x.literal(7.0)).value).tolist() == [7.0, 5.0, 7.0]
    either = x.le(zero).or_(x.literal(0.5).lt(x))
    assert plain(either.select(x, zero).value).tolist() == [-1.0, 0.0, 1.0]
    guarded = zero.le(x).select(x.sqrt(), zero)
    assert plain(guarded.defined).tolist() == [True, True, True]


def test_python_operators():
    x = RealSystem(F64).exact(3.0)
    assert (1.0 + x).value == 4.0
    assert (1.0 - x).value == -2.0
    assert (6.0 / x).value == 2.0
    assert (-x).value == -3.0
    assert abs(-x).value == 3.0
    assert (x**3).value == 27.0
    assert (x**-1).value == pytest.approx(1 / 3)
    assert (x**0).value == 1.0
    assert (x / 2).value == 1.5
