"""Devices by name, each made once for the process."""

from __future__ import annotations

import threading
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


def _gpu() -> Device:
    from zeroset.runtime.gpu.device import GpuDevice

    return GpuDevice()


DEVICES: dict[str, Callable[[], Device]] = {"cpu": _cpu, "gpu": _gpu, "interp": _interp}
"""What makes each device that can be asked for by name."""


_made: dict[str, Device] = {}
_making = threading.Lock()


def get_device(device: str | Device = "auto") -> Device:
    """A device by name; a Device as it is.

    Args:
        device: ``"cpu"``, ``"gpu"``, ``"interp"``, ``"auto"`` (a GPU where there is one, else the CPU), or a Device of
            the caller's own. A GPU that was lost is opened anew.

    Raises:
        DeviceError: there is none of that name, or it is missing something; the text says what.

    Example:
        >>> get_device("interp").name
        'interp'
    """
    if not isinstance(device, str):
        if not isinstance(device, Device):
            raise DeviceError(f"a device is a name or a Device, not {device!r}", hint=_known())
        return device
    if device != "auto":
        return _device(device)
    try:
        return _device(_best())
    except DeviceError:
        # A GPU that was there when it was looked for, and is not any more.
        return _device("cpu")


def why_not_gpu() -> str:
    """Why ``"auto"`` is not a GPU here; empty where it is one."""
    from zeroset.runtime.gpu.adapter import choose, likely, wanted

    if not likely():
        return "no sign of a GPU on this machine"
    try:
        found = choose()
    except DeviceError as error:
        return error.message
    if found.software and not wanted():
        return f"{found.name} calculates on the CPU, which zeroset does faster itself"
    try:
        _device("gpu")
    except DeviceError as error:
        return error.message
    return ""


@lru_cache(maxsize=1)
def _best() -> str:
    if not why_not_gpu():
        return "gpu"
    return "cpu" if find_spec("llvmlite") is not None else "interp"


def _device(name: str) -> Device:
    make = DEVICES.get(name)
    if make is None:
        raise DeviceError(f"there is no device {name!r}", hints=(*did_you_mean(name, DEVICES), _known()))
    with _making:
        known_device = _made.get(name)
        if known_device is None or getattr(known_device, "lost", False):
            known_device = _made[name] = make()
    return known_device


def _known() -> str:
    return f"there are {', '.join(sorted(DEVICES))}, and auto for the fastest"
