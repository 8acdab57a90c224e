"""``zeroset doctor``: what this machine offers, what is missing, and why."""

from __future__ import annotations

import importlib.metadata
import importlib.util
import platform
from collections.abc import Iterator

import click

NEEDED = {"numpy": "arrays", "llvmlite": "machine code for the CPU", "lark": "formulas", "pillow": "pictures",
          "click": "the command line", "rich": "progress", "tomli-w": "writing scene files"}  # fmt: skip
OPTIONAL = {"sympy": "SymPy expressions as surfaces (pip install 'zeroset[sympy]')"}


@click.command("doctor")
def command() -> None:
    """Say what this machine offers and what is missing, and draw a small picture to prove it."""
    for line in (*_machine(), *_packages(), *_devices(), *_cache(), *_trial()):
        click.echo(line)


def _machine() -> Iterator[str]:
    import zeroset

    yield f"zeroset {zeroset.__version__} on Python {platform.python_version()}, {platform.system()} {platform.machine()}"


def _packages() -> Iterator[str]:
    for names, kind in ((NEEDED, "MISSING, needed for"), (OPTIONAL, "not installed, optional:")):
        for name, purpose in names.items():
            try:
                yield f"  {name} {importlib.metadata.version(name)}"
            except importlib.metadata.PackageNotFoundError:
                yield f"  {name} {kind} {purpose}"


def _devices() -> Iterator[str]:
    yield "devices"
    if importlib.util.find_spec("llvmlite") is None:
        yield "  cpu    absent: llvmlite is not installed; pictures are drawn by the slow interpreter"
    else:
        from zeroset.runtime import get_device
        from zeroset.runtime.pool import thread_count

        target = get_device("cpu").target  # type: ignore[attr-defined]
        yield f"  cpu    {target.cpu}, {target.width} lanes of 32 bits, {thread_count()} threads (ZEROSET_THREADS changes that)"
    yield "  interp always there; defines what kernels mean, slow"
    yield "  gpu    not part of this version"


def _cache() -> Iterator[str]:
    from zeroset.runtime.cache import status

    yield f"cache    {status()}"


def _trial() -> Iterator[str]:
    from zeroset.errors import ZerosetError
    from zeroset.render.render import render

    try:
        image = render("x^2 + y^2 + z^2 = 1", size=64)
    except ZerosetError as error:
        yield f"trial    FAILED: {error}"
        return
    yield f"trial    a sphere, 64x64: {image.hits} pixels, {image.unresolved} unresolved: all is well"

