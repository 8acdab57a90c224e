"""The CPU and the GPU draw the same picture: the same kernels, the same plan, arithmetic that differs in last bits.

So their rays differ in last bits too, and a ray that just touches a sheet on one device may pass it on the other, and
hit the next. Such pixels count as different like those with another status.
"""

from __future__ import annotations

import os

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.methods import METHODS, Affine, Interval, Method
from zeroset.rendering.render import default_tolerance
from zeroset.scene.surface import Surface

ALL = bool(os.environ.get("ZEROSET_TRUTH_METHODS"))
"""Whether every method is compared on every surface, and not one alone: half an hour's work in software."""
SIZE = 96
DIFFERENT = 0.001
"""Share of the pixels that may have another status, or show another sheet of the surface."""
APART = 8
"""Tolerances that depths on the same sheet may be apart by."""


def methods_for(surface: Surface) -> list[Method]:
    """Every method that treats a surface, but for the default one."""
    made: list[Method] = [METHODS[name]() for name in METHODS if name != "auto"]
    made += [Affine(axis="k"), Interval(axis="k")]
    degree = surface.field.degree
    most = {"analytic": 4, "mitchell-exact": 5}
    return [m for m in made if m.name not in most or (degree is not None and degree <= most[m.name])]


def compare(surface: Surface, method: Method | str) -> str:
    """What is wrong; empty where the devices agree."""
    cpu, gpu = (zs.render(surface, SIZE, method=method, device=device) for device in ("cpu", "gpu"))
    one, two = cpu.aov("status"), gpu.aov("status")
    both = (one != zs.MISS) & (two != zs.MISS)
    apart = np.abs(cpu.aov("t") - gpu.aov("t")) / default_tolerance(surface.fitted)
    other_status, other_sheet = np.count_nonzero(one != two), np.count_nonzero(both & (apart > APART))
    if other_status + other_sheet > DIFFERENT * one.size:
        return f"of {one.size} pixels {other_status} have another status and {other_sheet} another depth"
    return ""


@needs_gpu
@pytest.mark.parametrize(("name", "number"), [(name, i) for i, name in enumerate(zs.gallery)])
def test_pictures_agree(name: str, number: int) -> None:
    surface = zs.gallery[name]
    others = methods_for(surface)
    assert compare(surface, "auto") == ""
    for method in others if ALL else [others[number % len(others)]]:
        assert compare(surface, method) == "", method
