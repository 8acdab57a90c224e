"""Finding a GPU: which adapters there are, which one is taken, and what it is opened with.

``ZEROSET_GPU`` chooses one by a part of its name (or ``llvmpipe``, a driver without a GPU). Otherwise a discrete GPU
comes before an integrated one, and both before a driver in software.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from zeroset.errors import DeviceError

_ORDER = {"DiscreteGPU": 0, "IntegratedGPU": 1, "Unknown": 2, "CPU": 3}
BACKENDS = ("Vulkan", "Metal", "D3D12")
"""What wgpu has compute shaders on; OpenGL's lack too much."""
_FEATURES = {
    "subgroups": ("subgroup",),
    "doubles": ("shader-f64", "shader-int64"),
    "timestamps": ("timestamp-query",),
}
"""Optional features, and what wgpu calls them; each is asked for where all its parts are offered."""
_LIMITS = ("max-buffer-size", "max-storage-buffer-binding-size", "max-storage-buffers-per-shader-stage")
NEEDED_BUFFERS = 16
"""Buffers that a kernel may bind; WebGPU guarantees 8, all desktop GPUs have more."""


class Found(NamedTuple):
    """An adapter that could be opened.

    Attributes:
        adapter: wgpu's.
        name: of the GPU.
        driver: what drives it, with its version where it says so.
        backend: ``Vulkan``, ``Metal`` or ``D3D12``.
        software: whether it is no GPU but a driver that calculates on the CPU.
        features: of those that zeroset makes use of.
    """

    adapter: Any
    name: str
    driver: str
    backend: str
    software: bool
    features: frozenset[str]

    @property
    def title(self) -> str:
        """One line for people."""
        return f"{self.name}, {self.backend}" + (f" ({self.driver})" if self.driver else "")


def wanted() -> str:
    """The part of a GPU's name that ``ZEROSET_GPU`` asks for; empty for the best."""
    return os.environ.get("ZEROSET_GPU", "")


def likely() -> bool:
    """Whether a GPU may be here, from signs that cost nothing: wgpu itself takes a tenth of a second to load."""
    if wanted():
        return True
    if not sys.platform.startswith("linux"):
        return True
    return any(
        any(Path(folder).glob(pattern)) for folder, pattern in (("/dev/dri", "render*"), ("/dev", "nvidia[0-9]*"))
    )


@lru_cache(maxsize=1)
def adapters() -> tuple[Found, ...]:
    """Every adapter of this machine that zeroset can use, the best first.

    Raises:
        DeviceError: wgpu is not installed, or cannot be loaded.
    """
    try:
        import wgpu
    except (ImportError, OSError, RuntimeError) as error:
        raise DeviceError(f"wgpu, which speaks to GPUs, cannot be loaded: {error}", hint="pip install wgpu") from error
    try:
        with quiet_wayland():
            offered = wgpu.gpu.enumerate_adapters_sync()
    except RuntimeError as error:
        raise DeviceError(f"the graphics drivers cannot be asked for GPUs: {error}") from error
    found = [_found(a) for a in offered if a.info["backend_type"] in BACKENDS]
    return tuple(sorted(found, key=lambda f: _ORDER.get(f.adapter.info["adapter_type"], 2)))


@contextmanager
def quiet_wayland() -> Iterator[None]:
    """Ask for adapters in here: else Wayland's library, which they ask for a display, may complain on stderr.

    It does so wherever there is no session, as in a container; a notebook shows that in red. Given any folder for the
    session's sockets, it finds none in there and is silent.
    """
    missing = not os.environ.get("XDG_RUNTIME_DIR")
    if missing:
        os.environ["XDG_RUNTIME_DIR"] = "/nonexistent"
    try:
        yield
    finally:
        if missing:
            os.environ.pop("XDG_RUNTIME_DIR", None)


def _found(adapter: Any) -> Found:
    info = adapter.info
    has = frozenset(name for name, parts in _FEATURES.items() if all(p in adapter.features for p in parts))
    software = info["adapter_type"] == "CPU"
    return Found(adapter, info["device"], info["description"], info["backend_type"], software, has)


def choose() -> Found:
    """The adapter to use; raises ``DeviceError`` where there is none, or none of the name that was asked for."""
    found = adapters()
    asked = wanted()
    if not found:
        raise DeviceError("there is no GPU with a Vulkan, Metal or Direct3D 12 driver", hints=_cures())
    matching = [f for f in found if asked.lower() in f.title.lower()]
    if not matching:
        names = "; ".join(f.title for f in found)
        raise DeviceError(f"ZEROSET_GPU asks for {asked!r}, which is no GPU here", hint=f"there are: {names}")
    return matching[0]


def _cures() -> tuple[str, ...]:
    cpu = 'device="cpu" draws the same pictures'
    if sys.platform.startswith("linux"):
        return "install the GPU's Vulkan driver; Debian's mesa-vulkan-drivers has those for AMD, Intel and none", cpu
    return (cpu,)


def open_device(found: Found) -> Any:
    """wgpu's device, with every feature and limit that zeroset makes use of; raises ``DeviceError``."""
    adapter = found.adapter
    features = [part for name in sorted(found.features) for part in _FEATURES[name]]
    limits = {name: adapter.limits[name] for name in _LIMITS}
    if limits["max-storage-buffers-per-shader-stage"] < NEEDED_BUFFERS:
        raise DeviceError(f"{found.name} binds too few buffers at once: {NEEDED_BUFFERS} are needed")
    try:
        return adapter.request_device_sync(required_features=features, required_limits=limits)
    except RuntimeError as error:
        raise DeviceError(f"{found.name} cannot be opened: {error}", hint='use device="cpu"') from error
