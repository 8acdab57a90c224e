"""How long each pass takes on the GPU itself, by its own clock; for benchmarks and the window."""

from __future__ import annotations

from typing import Any

import numpy as np

_PASSES = 256


def _nanoseconds_a_tick(device: Any) -> float:
    """How long one count of the GPU's clock is, which WebGPU would give in nanoseconds and wgpu-native does not."""
    try:
        from wgpu.backends.wgpu_native import lib

        return float(lib.wgpuQueueGetTimestampPeriod(device.queue._internal)) or 1.0
    except (ImportError, AttributeError):
        return 1.0


class Clock:
    """Timestamps around passes, where it is running.

    Args:
        device: wgpu's device, with the feature ``timestamp-query``.
    """

    def __init__(self, device: Any) -> None:
        self._device = device
        self.running = False
        self._set: Any = None
        self._buffer: Any = None
        self._labels: list[str] = []

        self._tick = _nanoseconds_a_tick(device) * 1e-6

    def start(self) -> None:
        """Time the passes from now on."""
        import wgpu

        if self._set is None:
            use = wgpu.BufferUsage
            self._set = self._device.create_query_set(type="timestamp", count=2 * _PASSES)
            self._buffer = self._device.create_buffer(size=16 * _PASSES, usage=use.QUERY_RESOLVE | use.COPY_SRC)
        self._labels = []
        self.running = True

    def writes(self, label: str) -> Any:
        """Where a pass puts its timestamps; None when there is no more room."""
        place = len(self._labels)
        if place == _PASSES:
            return None
        self._labels.append(label)
        return {
            "query_set": self._set,
            "beginning_of_pass_write_index": 2 * place,
            "end_of_pass_write_index": 2 * place + 1,
        }

    def resolve(self, encoder: Any) -> None:
        """Have what was timed so far written to memory."""
        if self.running and self._labels:
            encoder.resolve_query_set(self._set, 0, 2 * len(self._labels), self._buffer, 0)

    def stop(self) -> list[tuple[str, float, float]]:
        """Stop; gives each pass's label, beginning and end in milliseconds, in order."""
        self.running = False
        if not self._labels:
            return []
        data = self._device.queue.read_buffer(self._buffer, 0, 16 * len(self._labels))
        times = np.frombuffer(data, np.uint64).reshape(-1, 2).astype(np.float64) * self._tick
        labels, self._labels = self._labels, []
        return [(label, float(a), float(b)) for label, (a, b) in zip(labels, times, strict=True)]
