"""How long extraction takes: from compiled kernels to vertices and triangles on the host, for benchmarks."""

from __future__ import annotations

import time

from zeroset.export.marching.extract import extract
from zeroset.export.marching.lattice import make_lattice
from zeroset.export.marching.programs import Programs
from zeroset.kernel.types import F32, Type
from zeroset.runtime import Device, get_device
from zeroset.scene.surface import Surface


def time_extraction(
    surface: Surface,
    resolution: int,
    device: str | Device = "auto",
    repeats: int = 5,
    exclude: bool = True,
    type_: Type = F32,
) -> tuple[float, ...]:
    """Milliseconds that each of some extractions took, in order, after two that do not count.

    Compiling, welding and the rim are left out: this is what marching tetrahedra are timed by elsewhere.

    Args:
        surface: what to mesh.
        resolution: cells along the longest side of the bounds.
        device: where to run.
        repeats: how many to time.
        exclude: whether blocks that certainly hold nothing are left out first.
        type_: scalar type that f is evaluated in.

    Example:
        >>> import zeroset as zs
        >>> len(time_extraction(zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5), 8, repeats=2))
        2
    """
    programs = Programs(surface, get_device(device), False, type_)
    lattice = make_lattice(surface.fitted, resolution, False)
    taken = []
    for _ in range(repeats + 2):
        begin = time.perf_counter()
        extract(programs, lattice, exclude=exclude)
        taken.append((time.perf_counter() - begin) * 1e3)
    return tuple(taken[2:])
