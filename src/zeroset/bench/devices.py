"""The devices that are measured: one for steady state, and fresh ones to see what making programs costs."""

from __future__ import annotations

from zeroset.runtime import Device, get_device
from zeroset.runtime.cache import Cache


class Devices:
    """Devices of one kind.

    Only the CPU can be had afresh, with a cache of its own; any other device is what it is.

    Args:
        name: as users write it.
        threads: how many threads a frame is spread over; None leaves it to the device.

    Raises:
        DeviceError: there is no such device.

    Example:
        >>> Devices("interp", None).fresh(Cache(None)).name
        'interp'
    """

    def __init__(self, name: str, threads: int | None) -> None:
        device = get_device(name)
        self._known = None if device.name == "cpu" else device
        self.steady = self._known or self._made(Cache(None), threads)

    def fresh(self, cache: Cache) -> Device:
        """A device that knows no program, with this cache; on one thread, as compiling is."""
        return self._known or self._made(cache, 1)

    def _made(self, cache: Cache, threads: int | None) -> Device:
        from zeroset.runtime.cpu import CpuDevice

        return CpuDevice(threads=threads, cache=cache)
