"""Devices by name, each made once for the process."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from importlib.util import find_spec

from zeroset.errors import DeviceError, did_you_mean
from zeroset.runtime.device import Device


def _cpu() -> Device:
    from zeroset.runtime.cpu import CpuDevice

    return CpuDevice()


def _interp() -> Device:
    from zeroset.runtime.interp import InterpreterDevice

    return InterpreterDevice()


DEVICES: dict[str, Callable[[], Device]] = {"cpu": _cpu, "interp": _interp}
"""What makes each device that can be asked for by name."""


def get_device(device: str | Device = "auto") -> Device:
    """A device by name; a Device as it is.

    Args:
        device: ``"cpu"``, ``"interp"``, ``"auto"`` (the fastest here), or a Device of the caller's own.

    Raises:
        DeviceError: there is none of that name.

    Example:
        >>> get_device("interp").name
        'interp'
    """
    if not isinstance(device, str):
        return device
    if device == "auto":
        return _made("cpu" if find_spec("llvmlite") is not None else "interp")
    return _made(device)


@lru_cache(maxsize=len(DEVICES))
def _made(name: str) -> Device:
    make = DEVICES.get(name)
    if make is None:
        known = f"there are {', '.join(sorted(DEVICES))}, and auto for the fastest"
        raise DeviceError(f"there is no device {name!r}", hints=(*did_you_mean(name, DEVICES), known))
    return make()
