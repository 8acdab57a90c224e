"""``zeroset doctor``: what this machine offers, what is missing, and why."""

from __future__ import annotations

import importlib.metadata
import platform
from collections.abc import Iterator

import click

NEEDED = {
    "numpy": "arrays",
    "llvmlite": "machine code for the CPU; without it pictures are drawn by the slow interpreter",
    "pillow": "pictures",
    "click": "the command line",
    "rich": "progress",
    "tomli-w": "writing scene files",
}
"""What zeroset is installed with, and what for."""
OPTIONAL = {"sympy": "SymPy expressions as surfaces: pip install 'zeroset[sympy]'"}


@click.command("doctor")
def command() -> None:
    """Say what this machine offers and what is missing, and draw a small picture to prove it."""
    for part in (_machine, _packages, _devices, _cache, _trial):
        for line in part():
            click.echo(line)


def _machine() -> Iterator[str]:
    import zeroset

    python, system = platform.python_version(), f"{platform.system()} {platform.machine()}"
    yield f"zeroset  {zeroset.__version__} on Python {python}, {system}"


def _packages() -> Iterator[str]:
    yield "packages"
    for names, kind in ((NEEDED, "MISSING, needed for"), (OPTIONAL, "not installed, optional, for")):
        for name, purpose in names.items():
            try:
                yield f"  {name:9} {importlib.metadata.version(name)}"
            except importlib.metadata.PackageNotFoundError:
                yield f"  {name:9} {kind} {purpose}"


def _devices() -> Iterator[str]:
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
    yield "  gpu       not part of this version"


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
