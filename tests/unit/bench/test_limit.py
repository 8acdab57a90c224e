"""The limit kernel computes f and its gradient at points that differ from pixel to pixel."""

from __future__ import annotations

import numpy as np

import zeroset as zs
from zeroset.bench.limit import PLACE, TILT, limit_action, limit_kernel
from zeroset.kernel.interp import run
from zeroset.rendering.layout import Layout
from zeroset.runtime import get_device


def test_value_and_gradient_are_added_up() -> None:
    layout = Layout(16, 16)
    buffers = {"limit": np.zeros(layout.lanes, np.float32)}
    place = dict(zip(PLACE, (0.5, -0.25, 0.125, 2.0), strict=True))
    run(limit_kernel(zs.surface("x^2*y + z").field), layout.lanes, {**layout.uniforms(), **place}, buffers)
    u = (np.arange(16) + 0.5) / 8 - 1
    u, v = np.meshgrid(u, -u)
    x, y, z = ((u * a + v * b) * 2.0 + c for a, b, c in zip(*TILT, (0.5, -0.25, 0.125), strict=True))
    expected = x**2 * y + z + 2 * x * y + x**2 + 1
    np.testing.assert_allclose(layout.unscramble(buffers["limit"]), expected, rtol=1e-5, atol=1e-5)


def test_parameters_and_arrays_are_bound() -> None:
    surface = zs.surface("sum(i, r[i]*x) + a*y", params={"r": [1.0, 2.0], "a": 3.0}, bounds=1.0)
    limit_action(surface, 8, get_device("cpu"))()
