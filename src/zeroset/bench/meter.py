"""A device that counts and times what is compiled on it, and leaves everything else to the device that it wraps.

A frame asks for its programs from several threads at once.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from typing import Any

from zeroset.kernel import Kernel, Type
from zeroset.runtime import Device, Program, Recipe
from zeroset.runtime.device import Array, Counted


class Meter:
    """Any device, with the time that its programs took to come about.

    Attributes:
        compilations: kernels that were compiled; what came from memory or disk is not counted.
        milliseconds: during which programs were being obtained, from wherever they came; several at once count once.

    Example:
        >>> from zeroset.rendering.frame import settle
        >>> from zeroset.rendering.render import render
        >>> from zeroset.runtime import get_device
        >>> meter = Meter(get_device("interp"))
        >>> image = render("x^2 + y^2 + z^2 = 1", size=8, device=meter)
        >>> settle()
        >>> meter.compilations > 0, meter.milliseconds > 0
        (True, True)
    """

    def __init__(self, device: Device) -> None:
        self._device = device
        self.compilations = 0
        self.milliseconds = 0.0
        self._lock = threading.Lock()
        self._active = 0
        self._begin = 0.0

    @property
    def name(self) -> str:
        """The wrapped device's name."""
        return self._device.name

    def compile(self, kernel: Kernel) -> Program:
        """The program of a kernel; counted, for nobody asks for one by kernel twice."""
        self._count()
        return self._timed(lambda: self._device.compile(kernel))

    def compile_cached(self, key: str, build: Callable[[], Kernel], quick: bool = False) -> Program:
        """The program under a key; counted where its kernel had to be traced."""

        def counted() -> Kernel:
            self._count()
            return build()

        return self._timed(lambda: self._device.compile_cached(key, counted, quick))

    def begin_apart(self, recipes: Iterable[Recipe], perhaps: Iterable[Recipe] = ()) -> None:
        """Nothing: what another process makes could not be counted."""

    def _count(self) -> None:
        with self._lock:
            self.compilations += 1

    def _timed(self, obtain: Callable[[], Program]) -> Program:
        with self._lock:
            if not self._active:
                self._begin = time.perf_counter()
            self._active += 1
        try:
            return obtain()
        finally:
            with self._lock:
                self._active -= 1
                if not self._active:
                    self.milliseconds += (time.perf_counter() - self._begin) * 1e3

    def allocate(self, type_: Type, count: int, constant: bool = False) -> Any:
        """A buffer of the wrapped device."""
        return self._device.allocate(type_, count, constant)

    def supports(self, type_: Type) -> bool:
        """Whether the wrapped device's kernels may calculate with a type."""
        return self._device.supports(type_)

    @property
    def largest(self) -> int:
        """The most bytes that a buffer of the wrapped device may have."""
        return self._device.largest

    def clear(self, buffer: Any) -> None:
        """Set all elements of a buffer to zero."""
        self._device.clear(buffer)

    def copy(self, buffer: Any) -> Any:
        """Another buffer with the same elements."""
        return self._device.copy(buffer)

    def lanes(self, count: int | Counted) -> int | None:
        """How many lanes a count is, where the wrapped device can tell."""
        return self._device.lanes(count)

    def submit(self) -> None:
        """Let the wrapped device begin what it was asked for."""
        self._device.submit()

    def write(self, buffer: Any, values: Array) -> None:
        """Set the first elements of a buffer."""
        self._device.write(buffer, values)

    def read(self, buffer: Any) -> Array:
        """The elements of a buffer."""
        return self._device.read(buffer)
