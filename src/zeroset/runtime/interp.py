"""The interpreter as a device: the target of last resort, and the one that every other is held to."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from zeroset.errors import DeviceError, KernelError
from zeroset.kernel import interp
from zeroset.kernel.build import Kernel
from zeroset.kernel.verify import verify
from zeroset.runtime.device import Counted, HostMemory, Signature, check_array, check_count, lanes_of


class InterpreterProgram:
    """A kernel that NumPy runs, operation by operation."""

    def __init__(self, kernel: Kernel) -> None:
        self._kernel = kernel
        self.signature = Signature.of(kernel)

    def run(self, count: int | Counted, uniforms: Mapping[str, float], buffers: Mapping[str, Any]) -> None:
        """Run ``count`` lanes; see ``Program.run``."""
        lanes = check_count(self.signature, lanes_of(count))
        for buffer in self.signature.buffers:
            check_array(self.signature, buffer, buffers.get(buffer.name))
        try:
            interp.run(self._kernel, lanes, uniforms, buffers)
        except (KernelError, TypeError, ValueError, OverflowError) as error:
            raise DeviceError(str(error)) from error


class InterpreterDevice(HostMemory):
    """Runs kernels without compiling them."""

    name = "interp"

    def __init__(self) -> None:
        self._programs: dict[str, InterpreterProgram] = {}

    def compile(self, kernel: Kernel) -> InterpreterProgram:
        """The program of a kernel; see ``Device.compile``."""
        return InterpreterProgram(verify(kernel))

    def compile_cached(self, key: str, build: Callable[[], Kernel], quick: bool = False) -> InterpreterProgram:
        """The program under a key; see ``Device.compile_cached``."""
        if key not in self._programs:
            self._programs[key] = self.compile(build())
        return self._programs[key]
