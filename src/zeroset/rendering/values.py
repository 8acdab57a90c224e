"""Parameters as kernels read them: a value in the kernel's scalar type and, beside it, what storing it left out.

So a kernel in f32 treats the parameter 0.1 as the interval around its nearest f32 that holds 0.1, and what it proves
is about the number that the user gave.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.kernel.types import F32, Type
from zeroset.runtime import Device
from zeroset.scene.surface import Enclosure, Surface
from zeroset.solve.method import Method
from zeroset.solve.names import OFFSET, array_names, isovalue_name, length_name, parameter_names

Floats = npt.NDArray[Any]


def stored(exact: npt.NDArray[np.float64], type_: Type) -> tuple[Floats, Floats]:
    """Numbers in a scalar type, and bounds of what that leaves out, rounded up; exactly stored ones have 0."""
    return stored_between(exact, exact, type_)


def stored_between(low: npt.NDArray[np.float64], high: npt.NDArray[np.float64], type_: Type) -> tuple[Floats, Floats]:
    """The same for numbers that are known to lie between two neighbouring doubles."""
    exact = 0.5 * low + 0.5 * high
    near = exact.astype(type_.dtype)
    left_out = np.maximum(np.abs(low - near), np.abs(high - near))
    error = np.nextafter(left_out.astype(type_.dtype), type_.dtype.type(np.inf))
    # What is too small for a normal number may be flushed to zero, the value as well as its error.
    smallest = np.finfo(type_.dtype).tiny
    lost = (left_out > 0) | ((left_out + np.abs(exact) != 0) & (np.abs(exact) < smallest))
    return near, np.where(lost, np.maximum(error, smallest), type_.dtype.type(0))


def parameter_uniforms(surface: Surface, method: Method, type_: Type = F32, prefix: str = "") -> dict[str, float]:
    """The parameters' values, the arrays' lengths and the method's options by uniform name.

    ``prefix`` is before the names of the surface's own numbers, where a kernel has several surfaces.
    """
    numbers = {OFFSET: method.offset} | {isovalue_name(i): value for i, value in enumerate(surface.isovalues)}
    values = {**surface.settled.numbers, **{name: (value, value) for name, value in numbers.items()}}
    named = method.uniforms() | scalar_uniforms(values, type_, prefix)
    return named | {length_name(prefix + name): len(surface.arrays[name]) for name in surface.field.arrays}


def scalar_uniforms(values: Mapping[str, Enclosure], type_: Type = F32, prefix: str = "") -> dict[str, float]:
    """Enclosures of scalar parameters as what is stored, and what that leaves out, by uniform name."""
    low, high = np.array(list(values.values()), np.float64).T
    near, error = stored_between(low, high, type_)
    named = {}
    for i, name in enumerate(values):
        value_name, error_name = parameter_names(prefix + name, type_)
        named[value_name], named[error_name] = float(near[i]), float(error[i])
    return named


class Arrays:
    """The buffers of array parameters on one device: made once, written anew where values have changed.

    Each array has two, for its values and for what rounding leaves out of them.
    """

    def __init__(self, device: Device) -> None:
        self._device = device
        self._buffers: dict[str, Any] = {}
        self._written: dict[str, Floats] = {}

    def bind(self, surface: Surface, type_: Type = F32, prefix: str = "") -> dict[str, Any]:
        """The buffers by name, with the surface's values in them."""
        bound: dict[str, Any] = {}
        for name in surface.field.arrays:
            for key, values in zip(array_names(prefix + name, type_), stored(surface.arrays[name], type_), strict=True):
                bound[key] = self._buffer(key, values, type_)
        return bound

    def _buffer(self, key: str, values: Floats, type_: Type) -> Any:
        written = self._written.get(key)
        if written is None or len(written) != len(values):
            self._buffers[key] = self._device.allocate(type_, len(values), constant=True)
        if written is None or not np.array_equal(written, values):
            self._device.write(self._buffers[key], values)
            self._written[key] = values
        return self._buffers[key]


__all__ = ["Arrays", "parameter_uniforms", "scalar_uniforms", "stored"]
