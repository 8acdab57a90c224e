"""Buffers in a GPU's memory, and the way back to the host."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from zeroset.codegen.gpu_target import CONSTANT_BYTES
from zeroset.errors import DeviceError
from zeroset.kernel.types import Type
from zeroset.runtime.device import Array
from zeroset.runtime.gpu.faults import SMALLER_HINT, Faults


def _size(type_: Type, count: int, constant: bool) -> int:
    """Bytes of a buffer: constants as many as shaders declare; wgpu wants multiples of four and no empty buffers."""
    return max(count * type_.size, CONSTANT_BYTES if constant else 4)


@dataclass(frozen=True, slots=True, eq=False)
class GpuBuffer:
    """A flat array in a GPU's memory.

    Attributes:
        type: of its elements.
        count: how many.
        handle: wgpu's buffer.
        constant: whether it may be bound as constants.
    """

    type: Type
    count: int
    handle: Any
    constant: bool = False

    def __len__(self) -> int:
        return self.count

    @property
    def bytes(self) -> int:
        """Its size."""
        return _size(self.type, self.count, self.constant)

    @property
    def long(self) -> bool:
        """Whether it has more elements than constants may have."""
        return self.bytes > CONSTANT_BYTES


class Memory:
    """Makes buffers on one GPU and reads them.

    Args:
        device: wgpu's device.
        faults: of the GPU.
    """

    def __init__(self, device: Any, faults: Faults) -> None:
        self._device = device
        self._faults = faults
        self.largest: int = min(device.limits["max-buffer-size"], device.limits["max-storage-buffer-binding-size"])
        self._staging: Any = None

    def allocate(self, type_: Type, count: int, constant: bool = False) -> GpuBuffer:
        """A buffer of zeros."""
        import wgpu

        size = _size(type_, count, constant)
        if size > self.largest:
            raise DeviceError(
                f"{self._faults.name} has buffers of at most {self.largest >> 20} MiB, not of {size >> 20} MiB",
                hint=SMALLER_HINT,
            )
        use = wgpu.BufferUsage
        with self._faults.at(f"make a buffer of {size / 2**20:.1f} MiB", SMALLER_HINT):
            uses = use.STORAGE | use.COPY_SRC | use.COPY_DST | (use.UNIFORM if constant else 0)
            handle = self._device.create_buffer(size=size, usage=uses)
        return GpuBuffer(type_, count, handle, constant)

    def write(self, buffer: GpuBuffer, values: Array) -> None:
        """Set the first elements."""
        data = np.ascontiguousarray(values, buffer.type.dtype)
        if len(data) > buffer.count:
            raise DeviceError(f"{len(data)} values do not fit a buffer of {buffer.count}")
        if not len(data):
            return
        with self._faults.at("take data"):
            self._device.queue.write_buffer(buffer.handle, 0, data)

    def read(self, buffer: GpuBuffer) -> Array:
        """The elements, copied to the host; waits for all that was submitted."""
        with self._faults.at("give its results back"):
            return self._fetch(buffer)

    def _fetch(self, buffer: GpuBuffer) -> Array:
        import wgpu

        size = buffer.bytes
        if self._staging is None or self._staging.size < size:
            use = wgpu.BufferUsage
            self._staging = self._device.create_buffer(size=size, usage=use.MAP_READ | use.COPY_DST)
        encoder = self._device.create_command_encoder()
        encoder.copy_buffer_to_buffer(buffer.handle, 0, self._staging, 0, size)
        self._device.queue.submit([encoder.finish()])
        self._staging.map_sync(wgpu.MapMode.READ, 0, size)
        try:
            data = np.frombuffer(self._staging.read_mapped(0, size, copy=False), buffer.type.dtype)[: buffer.count]
            return data.copy()
        finally:
            self._staging.unmap()
