"""Frames in steady state: both clocks on a GPU, one elsewhere."""

from __future__ import annotations

from functools import partial

import pytest
from tests.gpus import needs_gpu

from zeroset.bench.devices import Devices
from zeroset.bench.steady import frame_times
from zeroset.errors import MethodError
from zeroset.rendering.render import render


def test_wall_times_on_the_cpu() -> None:
    count = []
    wall, gpu = frame_times(lambda: count.append(1), Devices("interp", None), 0.0)
    assert (wall.count, gpu) == (3, None)
    assert len(count) == 1 + 2 + 3


@needs_gpu
def test_both_clocks_on_a_gpu() -> None:
    devices = Devices("gpu", None)
    assert devices.gpu is not None
    wall, gpu = frame_times(partial(render, "x^2 + y^2 + z^2 = 1", 16, device=devices.gpu), devices, 0.0)
    assert 0 < wall.best <= wall.median
    assert (gpu is None) == (devices.gpu.stream.clock is None)


def test_errors_come_through() -> None:
    draw = partial(render, "x + sin(y)", 8, method="analytic", device="interp")
    with pytest.raises(MethodError):
        frame_times(draw, Devices("interp", None), 0.0)
