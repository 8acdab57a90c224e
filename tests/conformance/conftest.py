"""One suite, every backend: each test here runs on each of ``devices()`` and is held to the interpreter, bit for bit.

A new backend joins by one line in ``devices``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest

from zeroset.errors import DeviceError
from zeroset.kernel import Kernel, interp, verify
from zeroset.kernel.passes import optimise
from zeroset.runtime import Device
from zeroset.runtime.cache import Cache
from zeroset.runtime.cpu import CpuDevice, host
from zeroset.runtime.gpu.device import GpuDevice

Agree = Callable[..., dict[str, np.ndarray[Any, Any]]]


def devices() -> dict[str, Device]:
    """Every backend of this machine. Contraction is off: with it, sums of products may differ by a rounding."""
    cpus = {f"cpu-{t.name}": CpuDevice(t.uncontracted(), threads=2, cache=Cache(None)) for t in host()}
    return cpus | ({} if isinstance(GPU, str) else {"gpu": GPU})


def _gpu() -> GpuDevice | str:
    """The best GPU, or why there is none."""
    try:
        return GpuDevice(cache=Cache(None))
    except DeviceError as error:
        return str(error).splitlines()[0]


GPU = _gpu()
DEVICES = devices()


@pytest.fixture(params=[*DEVICES] if "gpu" in DEVICES else [*DEVICES, "gpu"], scope="session")
def device(request: pytest.FixtureRequest) -> Device:
    """Each backend in turn; a GPU that is not there is skipped, aloud."""
    if request.param not in DEVICES:
        pytest.skip(f"no GPU: {GPU}")
    return DEVICES[request.param]


@pytest.fixture
def packet(device: Device) -> int:
    """Lanes that vote together; 1 is right for a device that does not say."""
    return device.target.width if isinstance(device, CpuDevice) else 1


def differences(a: np.ndarray[Any, Any], b: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Where two arrays differ in any bit; NaNs are all one."""
    bits = f"u{a.dtype.itemsize}"
    different = a.view(bits) != b.view(bits)
    if a.dtype.kind == "f":
        different &= ~(np.isnan(a) & np.isnan(b))
    return np.flatnonzero(different)


@pytest.fixture(scope="session")
def differ() -> Callable[..., np.ndarray[Any, Any]]:
    return differences


def agree_on(
    device: Device,
    kernel: Kernel,
    count: int,
    buffers: Mapping[str, np.ndarray[Any, Any]],
    uniforms: Mapping[str, float] | None = None,
) -> dict[str, np.ndarray[Any, Any]]:
    """Run a kernel as it is and optimised on the interpreter, and on a device; give back what all of them wrote."""
    expected = {name: data.copy() for name, data in buffers.items()}
    interp.run(verify(kernel), count, uniforms or {}, expected)
    optimised = {name: data.copy() for name, data in buffers.items()}
    # Watched, so that the kernel is verified after each pass.
    interp.run(optimise(kernel, lambda name, made: None), count, uniforms or {}, optimised)
    given = {}
    for buffer in kernel.buffers:
        given[buffer.name] = device.allocate(buffer.type, len(buffers[buffer.name]))
        device.write(given[buffer.name], buffers[buffer.name])
    device.compile(kernel).run(count, uniforms or {}, given)
    for buffer in kernel.buffers:
        for who, result in (("passes", optimised[buffer.name]), (device.name, device.read(given[buffer.name]))):
            wrong = differences(expected[buffer.name], result)
            right = expected[buffer.name][wrong][:8]
            assert not len(wrong), f"{who}: {buffer.name}{wrong[:8]} is {result[wrong][:8]}, not {right}"
    return expected


@pytest.fixture
def agree(device: Device) -> Agree:
    """``agree(kernel, count, buffers, uniforms)`` on the device under test."""
    return lambda *arguments, **named: agree_on(device, *arguments, **named)


@pytest.fixture(scope="session")
def agree_everywhere() -> Agree:
    """The same on every CPU target at once, for generated kernels."""

    def check(kernel: Kernel, count: int, *arguments: Any, votes: bool = False) -> None:
        for one in DEVICES.values():
            if isinstance(one, CpuDevice):
                agree_on(one, kernel, one.target.width if votes else count, *arguments)

    return check


@pytest.fixture(scope="session")
def agree_on_gpus() -> Agree:
    """``agree`` on the GPU, for generated kernels that any GPU must run exactly."""
    if isinstance(GPU, str):
        pytest.skip(f"no GPU: {GPU}")
    return lambda *arguments, **named: agree_on(GPU, *arguments, **named)
