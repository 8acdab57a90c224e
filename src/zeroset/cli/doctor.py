"""``zeroset doctor``: what this machine offers, what is missing, and why."""

from __future__ import annotations

import importlib.metadata
import platform
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from zeroset.runtime.gpu.adapter import Found

NEEDED = {
    "numpy": "arrays",
    "llvmlite": "machine code for the CPU; without it pictures are drawn by the slow interpreter",
    "pillow": "pictures",
    "click": "the command line",
    "rich": "progress",
    "tomli-w": "writing scene files",
    "wgpu": "drawing on a GPU",
}
"""What zeroset is installed with, and what for."""
OPTIONAL = {
    "sympy": "SymPy expressions as surfaces: pip install 'zeroset[sympy]'",
    "trimesh": "mesh files: pip install 'zeroset[export]'",
    "av": "MP4 movies: pip install 'zeroset[export]'",
    "rendercanvas": "the window: pip install 'zeroset[desktop]', or 'zeroset[notebook]' in a notebook",
    "imgui-bundle": "the window's panels: likewise",
    "glfw": "the window on a desktop: pip install 'zeroset[desktop]'",
    "anywidget": "the window in a notebook: pip install 'zeroset[notebook]'",
    "simplejpeg": "faster pictures there: likewise",
}


@click.command("doctor")
def command() -> None:
    """Say what this machine offers and what is missing, and draw a small picture to prove it."""
    for part in (_machine, _packages, _cpu, _gpu, _auto, _cache, _trial):
        for line in _guarded(part):
            click.echo(line)


def _guarded(part: Callable[[], Iterator[str]]) -> Iterator[str]:
    """What a part says; where it breaks, that it did: whoever calls a doctor has something broken to begin with."""
    try:
        yield from part()
    except Exception as error:
        yield f"{part.__name__.strip('_'):8} FAILED: {type(error).__name__}: {error}"


def _machine() -> Iterator[str]:
    import zeroset

    python, system = platform.python_version(), f"{platform.system()} {platform.machine()}"
    yield f"zeroset  {zeroset.__version__} on Python {python}, {system}"


def _packages() -> Iterator[str]:
    yield "packages"
    for names, kind in ((NEEDED, "MISSING, needed for"), (OPTIONAL, "not installed, optional, for")):
        for name, purpose in names.items():
            try:
                yield f"  {name:12} {importlib.metadata.version(name)}"
            except importlib.metadata.PackageNotFoundError:
                yield f"  {name:12} {kind} {purpose}"


def _cpu() -> Iterator[str]:
    from zeroset.errors import ZerosetError
    from zeroset.runtime import get_device

    yield "devices"
    try:
        cpu = get_device("cpu")
        target, threads = cpu.target, cpu.threads  # type: ignore[attr-defined]
        yield f"  cpu       {target.name} on {target.cpu}: {target.width} lanes of 32 bits, {threads} threads"
        yield "            (the environment variable ZEROSET_THREADS sets how many threads)"
    except ZerosetError as error:
        yield f"  cpu       MISSING: {error}"
    yield "  interp    there; slow, it defines what kernels mean"


def _gpu() -> Iterator[str]:
    """Every adapter, the one that is taken, and how it calculates."""
    from zeroset.errors import DeviceError
    from zeroset.runtime.gpu.adapter import adapters, choose, wanted

    choice = "the environment variable ZEROSET_GPU chooses one by a part of its name"
    asked = f", and asks for {wanted()!r}" if wanted() else ""
    try:
        taken = choose()
    except DeviceError as error:
        yield "  gpu       NONE: " + f"\n{' ' * 12}".join(str(error).splitlines())
        yield f"            ({choice}{asked})"
        return
    for found in adapters():
        yield from _adapter(found, found is taken)
    yield f"            ({choice}{asked})"


def _adapter(found: Found, taken: bool) -> Iterator[str]:
    kind = "; software that calculates on the CPU" if found.software else ""
    yield f"  gpu       {found.title}{kind}" + ('; this is the device "gpu"' if taken else "")
    largest = min(found.adapter.limits[name] for name in ("max-buffer-size", "max-storage-buffer-binding-size"))
    has = (("subgroups", "subgroups"), ("f64", "doubles"), ("timestamps", "timestamps"))
    features = ", ".join(f"{name} {'yes' if key in found.features else 'no'}" for name, key in has)
    yield f"            {features}; buffers of up to {largest / 2**20:,.0f} MiB"
    if taken:
        yield f"            {_opened()}"


def _opened() -> str:
    """How the GPU calculates, or why it cannot be used."""
    from zeroset.errors import DeviceError
    from zeroset.runtime import get_device
    from zeroset.runtime.gpu.device import GpuDevice

    try:
        device = get_device("gpu")
    except DeviceError as error:
        return f"CANNOT BE USED: {error.message}"
    return str(device.arithmetic) if isinstance(device, GpuDevice) else ""


def _auto() -> Iterator[str]:
    """What a picture is drawn on where nobody says."""
    from zeroset.runtime import get_device
    from zeroset.runtime.registry import why_not_gpu

    why = why_not_gpu()
    yield f"  auto      {get_device().name}{f', not the GPU: {why}' if why else ''}"


def _cache() -> Iterator[str]:
    from zeroset.runtime.cache import default_cache

    status = default_cache().status()
    if not status.enabled:
        yield f"cache    off: {status.reason}"
        return
    yield f"cache    {status.folder}: {status.files} files, {status.size / 1e6:.1f} MB"
    if status.reason:
        yield f"         the last write failed: {status.reason}"


def _trial() -> Iterator[str]:
    from zeroset.errors import ZerosetError
    from zeroset.rendering.render import render

    try:
        image = render("x^2 + y^2 + z^2 = 1", size=64)
    except ZerosetError as error:
        yield f"trial    FAILED: {error}"
        return
    verdict = "all is well" if image.hits and not image.unresolved else "this is WRONG"
    yield f"trial    a sphere, 64x64: {image.hits} pixels, {image.unresolved} unresolved: {verdict}"
