"""Memory over many frames: with parameters and camera moving, nothing may grow and nothing may be compiled."""

from __future__ import annotations

import gc
import math
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from zeroset.bench.devices import Devices
from zeroset.bench.meter import Meter
from zeroset.rendering.frame import settle
from zeroset.rendering.render import render
from zeroset.scene.camera import Camera, parse_camera
from zeroset.scene.surface import Surface

WARM_UP = 10
"""Frames before the first look at the process's size: those in which Python and the pool of threads settle."""
IN_FLIGHT = 3
"""Of so many frames one is looked at; a GPU works on the others without anybody waiting."""
SWING = 0.05
"""How far parameters move, as a share of themselves."""


@dataclass(frozen=True, slots=True)
class MemoryCost:
    """What many frames did to the process.

    Attributes:
        name: of the surface.
        frames: how many were drawn.
        size: pixels along a side.
        moved: names of the parameters that changed from frame to frame, besides the camera.
        growth: megabytes that the process grew by after the warm-up; None where the system does not say.
        objects: how many more objects wgpu holds after the last frame than after the warm-up; None without a GPU.
        compilations: after the first frame.
    """

    name: str
    frames: int
    size: int
    moved: tuple[str, ...]
    growth: float | None
    objects: int | None
    compilations: int


def resident() -> float | None:
    """Megabytes of this process in memory now; the largest so far where only that is known; None where nothing is."""
    try:
        import resource
    except ImportError:
        return None
    try:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
    except (OSError, ValueError, IndexError):
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        return peak / (2**20 if sys.platform == "darwin" else 2**10)
    return pages * resource.getpagesize() / 2**20


@dataclass(frozen=True, slots=True)
class Holding:
    """What the process holds at one moment.

    Attributes:
        resident: megabytes of memory; None where the system does not say.
        objects: of wgpu's; None without a GPU.
    """

    resident: float | None
    objects: int | None


def holding(devices: Devices) -> Holding:
    """What the process holds now, when nothing but what is in use is left."""
    gc.collect()
    if devices.gpu is None:
        return Holding(resident(), None)
    from zeroset.runtime.gpu.census import live_objects

    return Holding(resident(), live_objects())


def measure_memory(
    surface: Surface, frames: int, size: int, method: str, devices: Devices, progress: Callable[[float], None]
) -> MemoryCost:
    """Draw frames of one surface with everything moving that may move.

    Args:
        surface: what is drawn.
        frames: how many.
        size: pixels along a side.
        method: ray method.
        devices: where to run.
        progress: told the share that is done.
    """
    meter = Meter(devices.steady)
    camera = parse_camera(surface.camera, surface.fitted)
    before = Holding(None, None)
    first = 0
    for i in range(frames):
        progress(i / frames)
        image = render(_moved(surface, i / frames), size, _turned(camera, i / frames), method, meter)
        if i % IN_FLIGHT == 0 or i == frames - 1:
            # Looked at, as its user would; and a GPU never has more than a few frames before it.
            image.pixels  # noqa: B018
        # A picture that is still held when the next one is drawn would be copied.
        del image
        if i == 0:
            settle()
            first = meter.compilations
        before = holding(devices) if i == min(WARM_UP, frames - 1) else before
    after = holding(devices)
    return MemoryCost(
        surface.name,
        frames,
        size,
        tuple(surface.params),
        None if before.resident is None or after.resident is None else after.resident - before.resident,
        None if before.objects is None or after.objects is None else after.objects - before.objects,
        meter.compilations - first,
    )


def _moved(surface: Surface, share: float) -> Surface:
    swing = 1.0 + SWING * math.sin(2.0 * math.pi * 3.0 * share)
    return surface.with_params(**{name: value * swing for name, value in surface.params.items()})


def _turned(camera: Camera, share: float) -> Camera:
    return camera.orbit(360.0 * share)
