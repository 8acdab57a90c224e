"""Buffers in a GPU's memory, and the way back to the host."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from zeroset.errors import DeviceError
from zeroset.kernel.types import Type
from zeroset.runtime.device import Array
from zeroset.runtime.gpu.faults import SMALLER_HINT, Faults


@dataclass(frozen=True, slots=True, eq=False)
class GpuBuffer:
    """A flat array in a GPU's memory.

    Attributes:
        type: of its elements.
        count: how many.
        handle: wgpu's buffer.
    """

    type: Type
    count: int
    handle: Any

    def __len__(self) -> int:
        return self.count

    @property
    def bytes(self) -> int:
        """Its size; wgpu wants multiples of four and no empty buffers."""
        return max(self.count * self.type.size, 4)


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

    def allocate(self, type_: Type, count: int) -> GpuBuffer:
        """A buffer of zeros."""
        import wgpu

        size = max(count * type_.size, 4)
        if size > self.largest:
            raise DeviceError(
                f"{self._faults.name} has buffers of at most {self.largest >> 20} MiB, not of {size >> 20} MiB",
                hint=SMALLER_HINT,
            )
        use = wgpu.BufferUsage
        with self._faults.at(f"make a buffer of {size / 2**20:.1f} MiB", SMALLER_HINT):
            handle = self._device.create_buffer(size=size, usage=use.STORAGE | use.COPY_SRC | use.COPY_DST)
        return GpuBuffer(type_, count, handle)

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
