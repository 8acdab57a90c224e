"""A device that counts and times what is compiled on it, and leaves everything else to the device that it wraps."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from zeroset.kernel import Kernel, Type
from zeroset.runtime import Device, Program
from zeroset.runtime.device import Array


class Meter:
    """Any device, with the time that its programs took to come about.

    Attributes:
        compilations: kernels that were compiled; what came from memory or disk is not counted.
        milliseconds: spent on obtaining programs, from wherever they came.

    Example:
        >>> from zeroset.render.render import render
        >>> from zeroset.runtime import get_device
        >>> meter = Meter(get_device("interp"))
        >>> image = render("x^2 + y^2 + z^2 = 1", size=8, device=meter)
        >>> meter.compilations
        3
    """

    def __init__(self, device: Device) -> None:
        self._device = device
        self.compilations = 0
        self.milliseconds = 0.0

    @property
    def name(self) -> str:
        """The wrapped device's name."""
        return self._device.name

    def compile(self, kernel: Kernel) -> Program:
        """The program of a kernel; counted, for nobody asks for one by kernel twice."""
        self.compilations += 1
        return self._timed(lambda: self._device.compile(kernel))

    def compile_cached(self, key: str, build: Callable[[], Kernel]) -> Program:
        """The program under a key; counted where its kernel had to be traced."""

        def counted() -> Kernel:
            self.compilations += 1
            return build()

        return self._timed(lambda: self._device.compile_cached(key, counted))

    def _timed(self, obtain: Callable[[], Program]) -> Program:
        begin = time.perf_counter()
        try:
            return obtain()
        finally:
            self.milliseconds += (time.perf_counter() - begin) * 1e3

    def allocate(self, type_: Type, count: int) -> Any:
        """A buffer of the wrapped device."""
        return self._device.allocate(type_, count)

    def write(self, buffer: Any, values: Array) -> None:
        """Set the first elements of a buffer."""
        self._device.write(buffer, values)

    def read(self, buffer: Any) -> Array:
        """The elements of a buffer."""
        return self._device.read(buffer)
