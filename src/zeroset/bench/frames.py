"""Steady-state frames: what a surface costs at each size, what its kernels cost to make, and how far the limit is."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from zeroset.bench.devices import Devices
from zeroset.bench.limit import limit_action
from zeroset.bench.meter import Meter
from zeroset.bench.timing import Times, take_turns
from zeroset.errors import ZerosetError
from zeroset.rendering.frame import settle
from zeroset.rendering.render import render
from zeroset.runtime import Device
from zeroset.runtime.cache import Cache
from zeroset.scene.surface import Surface

SMALL = 64
"""Pixels along a side of the picture that is drawn to have everything compiled."""


@dataclass(frozen=True, slots=True)
class FrameCost:
    """One surface at one size.

    Attributes:
        size: pixels along a side.
        frame: milliseconds a frame, as ``zs.render`` gives it, in steady state.
        limit: milliseconds of one evaluation of f and its gradient a pixel.
        steps: evaluations a ray, the mean over the frame; the work of beams is not in it.
        hits: pixels that show the surface.
        unresolved: pixels that could be neither proven nor excluded.
    """

    size: int
    frame: Times
    limit: Times
    steps: float
    hits: int
    unresolved: int

    @property
    def ratio(self) -> float:
        """How many times the limit a frame takes: best by best, which other work on the machine disturbs least."""
        return self.frame.best / self.limit.best


@dataclass(frozen=True, slots=True)
class SurfaceCost:
    """One surface.

    Attributes:
        name: in the gallery.
        compile: milliseconds to trace and compile its kernels, no cache.
        load: milliseconds to have them from a warm disk cache; None where the device has none.
        frames: one for each size.
        error: why it could not be drawn, or an empty string.
    """

    name: str
    compile: float = 0.0
    load: float | None = None
    frames: tuple[FrameCost, ...] = ()
    error: str = ""


def measure(surface: Surface, sizes: Sequence[int], method: str, devices: Devices, seconds: float) -> SurfaceCost:
    """Measure one surface; an error of the surface or the method is noted, not raised.

    Args:
        surface: what is drawn, with its own camera.
        sizes: pixels along a side, one for each measurement.
        method: ray method.
        devices: where to run.
        seconds: how long frames of one size are repeated.
    """
    try:
        compiled, loaded = _making(surface, method, devices)
        frames = tuple(frame_cost(surface, size, method, devices.steady, seconds) for size in sizes)
    except ZerosetError as error:
        return SurfaceCost(surface.name, error=str(error).splitlines()[0])
    return SurfaceCost(surface.name, compiled, loaded, frames)


def warm_up(devices: Devices, method: str) -> None:
    """Draw a ball that nobody measures, so that what is loaded once for all surfaces is charged to none."""
    render("x^2 + y^2 + z^2 = 1", SMALL, method=method, device=devices.fresh(Cache(None)))


def _making(surface: Surface, method: str, devices: Devices) -> tuple[float, float | None]:
    """Milliseconds to compile everything without a cache, and to have it from one."""
    with tempfile.TemporaryDirectory(prefix="zeroset-bench-") as folder:
        spent = []
        for _ in ("compile and keep", "load"):
            meter = Meter(devices.fresh(Cache(Path(folder))))
            render(surface, SMALL, method=method, device=meter)
            settle()
            spent.append((meter.milliseconds, meter.compilations))
    (compiled, _), (loaded, again) = spent
    return compiled, None if again else loaded


def frame_cost(surface: Surface, size: int, method: str, device: Device, seconds: float) -> FrameCost:
    """Measure frames of one size."""
    draw = partial(render, surface, size, method=method, device=device)
    # What a first small picture had made in a hurry is made well in the background, on the cores that are to be timed.
    draw()
    settle()
    frame, limit = take_turns((draw, limit_action(surface, size, device)), seconds)
    image = draw()
    return FrameCost(size, frame, limit, float(image.aov("steps").mean()), image.hits, image.unresolved)
