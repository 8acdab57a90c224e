from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from zeroset.arith import F32, F64

reals = st.floats(-1e30, 1e30, allow_nan=False)
FORMATS = pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])


@pytest.mark.parametrize("fmt", [F32, F64], ids=["f32", "f64"])
def test_constants_are_those_of_the_dtype(fmt):
    info = np.finfo(fmt.dtype)
    assert fmt.eps == info.eps / 2
    assert fmt.quantum == info.tiny
    assert fmt.big < info.max
    assert 1 / fmt.big <= fmt.tiny
    assert fmt.tiny > 4096 * fmt.quantum


@given(reals)
def test_round_is_the_rounding_of_numpy(value):
    expected = float(np.float32(value)) if abs(value) >= F32.quantum else 0.0
    assert F32.round(value) == expected
    assert F64.round(value) == (value if abs(value) >= F64.quantum else 0.0)


@given(reals, st.sampled_from([F32, F64]))
def test_down_and_up_enclose_within_two_spacings(value, fmt):
    down, up = fmt.down(value), fmt.up(value)
    assert down <= value <= up
    assert fmt.exact(down)
    assert fmt.exact(up)
    assert up - down <= max(2 * fmt.eps * abs(value), fmt.quantum)
    if fmt.exact(value):
        assert down == up == value


@pytest.mark.parametrize("value", [1.0, -1.0, 0.5, 3.0, -(2.0**-20), 1 - 2.0**-24])
def test_step_goes_to_the_neighbour(value):
    for direction in (-1, 1):
        expected = np.nextafter(np.float32(value), np.float32(direction * np.inf))
        assert F32.step(value, direction) == float(expected)


def test_step_from_zero_skips_subnormals():
    assert F32.step(0.0, 1) == F32.quantum
    assert F32.step(F32.quantum, -1) == 0.0


@FORMATS
def test_values_past_big_count_as_big(fmt):
    assert fmt.round(4 * fmt.big) == fmt.big
    assert fmt.up(-4 * fmt.big) == -fmt.big


@given(st.fractions(-(10**9), 10**9), st.sampled_from([F32, F64]))
def test_ceiling_is_above_a_rational_and_close(value, fmt):
    ceiling = fmt.ceiling(value)
    assert Fraction(ceiling) >= value
    assert Fraction(ceiling) - value <= max(4 * Fraction(fmt.eps) * abs(value), Fraction(fmt.quantum))
