"""The devices that are measured: one for steady state, and fresh ones to see what making programs costs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.runtime import Device, get_device
from zeroset.runtime.cache import Cache

if TYPE_CHECKING:
    from zeroset.runtime.gpu.device import GpuDevice


class Devices:
    """Devices of one kind.

    The CPU and a GPU can be had afresh, with a cache of their own; any other device is what it is.

    Args:
        name: as users write it.
        threads: how many threads a frame is spread over; None leaves it to the device.

    Raises:
        DeviceError: there is no such device.

    Attributes:
        steady: draws frames in steady state.
        gpu: the same where it is a GPU, else None.

    Example:
        >>> Devices("interp", None).fresh(Cache(None)).name
        'interp'
    """

    def __init__(self, name: str, threads: int | None) -> None:
        self._known = get_device(name)
        self.gpu: GpuDevice | None = None
        if self._known.name == "gpu":
            self.gpu = self._gpu(Cache(None))
        self.steady: Device = self.gpu or self._made(Cache(None), threads)

    def fresh(self, cache: Cache) -> Device:
        """A device that knows no program, with this cache; on one thread, as compiling is."""
        return self._gpu(cache) if self.gpu is not None else self._made(cache, 1)

    def _made(self, cache: Cache, threads: int | None) -> Device:
        from zeroset.runtime.cpu import CpuDevice

        return CpuDevice(threads=threads, cache=cache) if self._known.name == "cpu" else self._known

    def _gpu(self, cache: Cache) -> GpuDevice:
        """A device on the adapter that was found, whatever ``ZEROSET_GPU`` says by now."""
        from zeroset.runtime.gpu.device import GpuDevice

        found = self._known.found if isinstance(self._known, GpuDevice) else None
        return GpuDevice(found, cache)
