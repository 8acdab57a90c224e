from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from zeroset.kernel import F32, U32, KernelBuilder, Value, interp, load, store
from zeroset.shade.tone import encode, pack

Array = np.ndarray[Any, Any]


def run(function: Callable[[Value], Value], values: Array) -> Array:
    with KernelBuilder("tone") as builder:
        lane = builder.index()
        store(builder.buffer("out", F32, writable=True), lane, function(load(builder.buffer("x", F32), lane)))
    buffers = {"x": values.astype(np.float32), "out": np.zeros(len(values), np.float32)}
    interp.run(builder.kernel, len(values), {}, buffers)
    return buffers["out"]


def srgb(x: Array) -> Array:
    """IEC 61966-2-1."""
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 1e-9) ** (1 / 2.4) - 0.055)


def test_the_curve_is_srgb_to_a_small_part_of_a_byte() -> None:
    x = np.linspace(0, 1, 20001)
    difference = np.abs(run(encode, x) - srgb(x)) * 255
    assert difference.max() < 0.06
    assert np.all(run(encode, np.array([0.0])) == 0.0)


def test_every_byte_comes_back_as_itself() -> None:
    bytes_ = np.arange(256)
    encoded = bytes_ / 255
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    assert np.array_equal(np.floor(run(encode, linear) * 255 + 0.5), bytes_)


def test_the_curve_never_falls() -> None:
    assert np.all(np.diff(run(encode, np.linspace(0, 1, 5001))) >= 0)


@pytest.mark.parametrize(("outside", "clamped"), [(-1.0, 0.0), (-1e30, 0.0), (7.0, 1.0), (1e30, 1.0)])
def test_what_is_too_dark_or_too_bright_is_clamped(outside: float, clamped: float) -> None:
    assert run(encode, np.array([outside]))[0] == pytest.approx(clamped, abs=1e-4)


def test_bytes_are_rounded_and_packed_with_red_lowest() -> None:
    with KernelBuilder("pack") as builder:
        lane = builder.index()
        color = [load(builder.buffer(name, F32), lane) for name in "rgb"]
        store(builder.buffer("out", U32, writable=True), lane, pack(color))
    values = np.array([[0, 0, 0], [1, 1, 1], [1, 0, 0], [0.5, 0.25, 2.0], [-1, 0.001, 0.002]], np.float32)
    buffers: dict[str, Array] = {name: values[:, i].copy() for i, name in enumerate("rgb")}
    buffers["out"] = np.zeros(len(values), np.uint32)
    interp.run(builder.kernel, len(values), {}, buffers)
    rgba = buffers["out"].astype("<u4").view(np.uint8).reshape(-1, 4)
    assert rgba.tolist() == [
        [0, 0, 0, 255],
        [255, 255, 255, 255],
        [255, 0, 0, 255],
        [128, 64, 255, 255],
        [0, 0, 1, 255],
    ]
