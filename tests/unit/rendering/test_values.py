from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.kernel.types import F32, F64
from zeroset.rendering.values import parameter_uniforms, stored
from zeroset.runtime import get_device
from zeroset.solve.field import length_name, parameter_names


@pytest.mark.parametrize("value", [0.1, -1 / 3, np.pi, 1e-38, 1e-45, 123456789.0, 1e30])
def test_what_is_stored_and_its_error_hold_the_parameter(value: float) -> None:
    near, error = stored(np.array([value]), F32)
    assert near.dtype == error.dtype == np.float32
    assert float(near[0]) - float(error[0]) <= value <= float(near[0]) + float(error[0])
    assert float(error[0]) <= max(abs(value) * 2.0**-23, 2.0**-126)


@pytest.mark.parametrize("value", [0.0, 1.0, -0.25, 5.0])
def test_what_is_exactly_stored_has_no_error(value: float) -> None:
    assert stored(np.array([value]), F32)[1][0] == 0
    assert stored(np.array([value, 0.1]), F64)[1].tolist() == [0, 0]


def test_uniforms_have_the_parameters_the_offset_and_the_lengths() -> None:
    surface = zs.surface("a*x + sum(i, c[i]*y)", {"a": 0.5, "c": [1.0, 2.0, 3.0]})
    uniforms = parameter_uniforms(surface, zs.methods.Auto(offset=0.25))
    assert uniforms[parameter_names("a", F32)[0]] == 0.5
    assert uniforms[length_name("c")] == 3
    assert 0.25 in uniforms.values()


def test_a_parameter_between_two_floats_is_meant_exactly() -> None:
    # The plane z = a with a = 0.1: what is proven is about 0.1, not about its nearest float32.
    plane = zs.surface("z = a", {"a": 0.1}, bounds=1.0)
    hits = zs.cast(plane, [0.0, 0.0, 0.5], [[0.0, 0.0, -1.0]], tolerance=1e-7, device=get_device("cpu"))
    assert abs(0.5 - float(hits.t[0]) - 0.1) < 1e-5
