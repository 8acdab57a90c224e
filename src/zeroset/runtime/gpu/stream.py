"""The work that a GPU has been asked for: recorded in order, and handed over in one submission.

Calls lie in two buffers: those whose number of lanes the host knows, and those whose number another call counts. Both
are filled at once when the work is submitted, so recording costs no transfer. A GPU carries submissions out one after
the other, which is why the slots may be used again after each.
"""

from __future__ import annotations

from typing import Any

from zeroset.runtime.gpu.clock import Clock
from zeroset.runtime.gpu.faults import Faults

SLOT = 256
"""Alignment of slots that every adapter accepts."""
SLOTS = 1024


class Slots:
    """One buffer of calls and what will be in it."""

    def __init__(self, device: Any, usage: int) -> None:
        self.handle = device.create_buffer(size=SLOT * SLOTS, usage=usage)
        self._device = device
        self._data = bytearray()

    def room(self, size: int) -> bool:
        """Whether another call fits."""
        return len(self._data) + size <= SLOT * SLOTS

    def add(self, data: bytes) -> int:
        """Add a call; gives its offset in bytes."""
        offset = len(self._data)
        self._data += data
        self._data += bytes(-len(self._data) % SLOT)
        return offset

    def send(self) -> None:
        """Fill the buffer, and begin anew."""
        if self._data:
            self._device.queue.write_buffer(self.handle, 0, self._data)
            self._data = bytearray()


class Stream:
    """Records work for one device.

    Args:
        device: wgpu's device.
        faults: of the GPU.
        timestamps: whether the device can tell the time on the GPU.
    """

    def __init__(self, device: Any, faults: Faults, timestamps: bool) -> None:
        import wgpu

        use = wgpu.BufferUsage
        self._device = device
        self._faults = faults
        self.direct = Slots(device, use.UNIFORM | use.COPY_DST)
        self.counted = Slots(device, use.UNIFORM | use.COPY_DST | use.STORAGE | use.INDIRECT)
        self.clock = Clock(device) if timestamps else None
        self._encoder: Any = None
        self._pass: Any = None

    def encoder(self) -> Any:
        """The encoder of the submission being recorded, between passes."""
        self._close_pass()
        if self._encoder is None:
            self._encoder = self._device.create_command_encoder()
        return self._encoder

    def compute(self, label: str) -> Any:
        """A compute pass to record a dispatch in; each its own where the clock runs."""
        if self.clock is not None and self.clock.running:
            return self._begin(self.clock.writes(label))
        if self._pass is None:
            self._begin(None)
        return self._pass

    def _begin(self, timestamps: Any) -> Any:
        options = {} if timestamps is None else {"timestamp_writes": timestamps}
        self._pass = self.encoder().begin_compute_pass(**options)
        return self._pass

    def _close_pass(self) -> None:
        if self._pass is not None:
            self._pass.end()
            self._pass = None

    def make_room(self, size: int) -> None:
        """Submit what there is where another call would not fit."""
        if not (self.direct.room(2 * SLOT + size) and self.counted.room(SLOT + size)):
            self.submit()

    def submit(self) -> None:
        """Hand everything over."""
        if self._encoder is None:
            return
        # Whatever happens, the next submission begins anew.
        encoder, self._encoder = self._encoder, None
        open_pass, self._pass = self._pass, None
        with self._faults.at("draw"):
            if open_pass is not None:
                open_pass.end()
            if self.clock is not None:
                self.clock.resolve(encoder)
            self.direct.send()
            self.counted.send()
            self._device.queue.submit([encoder.finish()])
