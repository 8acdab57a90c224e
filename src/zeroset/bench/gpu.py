"""Frames on a GPU: by the GPU's own clock, by the wall's with frames in flight, and from formula to first picture."""

from __future__ import annotations

import gc
import statistics
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from zeroset.bench.devices import Devices
from zeroset.bench.flight import Passes, gpu_turns, in_flight, spans
from zeroset.bench.limit import limit_action
from zeroset.bench.meter import Meter
from zeroset.bench.timing import Times
from zeroset.errors import ZerosetError
from zeroset.rendering.frame import settle
from zeroset.rendering.render import render
from zeroset.runtime.cache import Cache
from zeroset.scene.surface import Surface

if TYPE_CHECKING:
    from zeroset.runtime.gpu.device import GpuDevice


FIRST = 512
"""Pixels along a side of a first picture."""


@dataclass(frozen=True, slots=True)
class GpuFrameCost:
    """One surface at one size.

    Attributes:
        size: pixels along a side.
        gpu: milliseconds from the first pass's beginning to the last one's end by the GPU's clock; None without one.
        wall: milliseconds a frame with frames in flight.
        host: milliseconds of those that asking for a frame takes.
        limit: milliseconds of one evaluation of f and its gradient a pixel by the GPU's clock; None without one.
        passes: name and milliseconds of each pass, medians, in order.
        between: milliseconds of a frame that are in no pass, the median.
        steps: evaluations a ray, the mean over the frame; the work of beams is not in it.
        hits: pixels that show the surface.
        unresolved: pixels that could be neither proven nor excluded.
    """

    size: int
    gpu: Times | None
    wall: Times
    host: Times
    limit: Times | None
    passes: tuple[tuple[str, float], ...]
    between: float
    steps: float
    hits: int
    unresolved: int

    @property
    def ratio(self) -> float | None:
        """How many times the limit a frame takes on the GPU: best by best, as on the CPU."""
        return None if self.gpu is None or self.limit is None else self.gpu.best / self.limit.best


@dataclass(frozen=True, slots=True)
class GpuCost:
    """One surface.

    Attributes:
        name: in the gallery.
        made: milliseconds during which its programs were being made: traced, written as WGSL, compiled by the driver.
        first: milliseconds from asking for its first picture, a draft such as the window shows at first, to its
            pixels; no cache, on a device that has drawn another formula before.
        whole: the same to the pixels of the whole picture.
        again: like first with the shaders in the disk cache; the driver compiles them anew.
        frames: one for each size.
        error: why it could not be drawn, or an empty string.
    """

    name: str
    made: float = 0.0
    first: float = 0.0
    whole: float = 0.0
    again: float = 0.0
    frames: tuple[GpuFrameCost, ...] = ()
    error: str = ""


@dataclass(frozen=True, slots=True)
class PassesCost:
    """One surface at one size, to be shown pass by pass.

    Attributes:
        name: in the gallery.
        frame: what was measured; None where it could not be drawn.
        error: why not, or an empty string.
    """

    name: str
    frame: GpuFrameCost | None = None
    error: str = ""


def measure_passes(surface: Surface, size: int, method: str, gpu: GpuDevice, seconds: float) -> PassesCost:
    """Measure frames of one size; an error of the surface or the method is noted, not raised."""
    try:
        return PassesCost(surface.name, gpu_frame(surface, size, method, gpu, seconds))
    except ZerosetError as error:
        return PassesCost(surface.name, error=str(error).splitlines()[0])


def measure_gpu(
    surface: Surface, sizes: Sequence[int], method: str, devices: Devices, gpu: GpuDevice, seconds: float
) -> GpuCost:
    """Measure one surface; an error of the surface or the method is noted, not raised.

    Args:
        surface: what is drawn, with its own camera.
        sizes: pixels along a side, one for each measurement.
        method: ray method.
        devices: gives fresh devices.
        gpu: draws frames in steady state.
        seconds: how long frames of one size are repeated, by either clock.
    """
    try:
        made, first, whole, again = _making(surface, method, devices)
        frames = tuple(gpu_frame(surface, size, method, gpu, seconds) for size in sizes)
    except ZerosetError as error:
        return GpuCost(surface.name, error=str(error).splitlines()[0])
    return GpuCost(surface.name, made, first, whole, again, frames)


def _making(surface: Surface, method: str, devices: Devices) -> tuple[float, float, float, float]:
    """Milliseconds during which programs were made, to the first and the whole picture, and to that of a warm cache."""
    with tempfile.TemporaryDirectory(prefix="zeroset-bench-") as folder:
        spent = []
        for _ in ("no cache", "warm cache"):
            # Devices hold one another in circles: those of earlier surfaces must go before their memory is needed.
            gc.collect()
            device = devices.fresh(Cache(Path(folder)))
            render("x^2 + y^2 + z^2 = 1", FIRST, device=device).pixels  # noqa: B018
            settle()
            meter = Meter(device)
            begin = time.perf_counter()
            for draft in (True, False):
                render(surface, FIRST, method=method, device=meter, draft=draft).pixels  # noqa: B018
                spent.append((time.perf_counter() - begin) * 1e3)
            settle()
            spent.append(meter.milliseconds)
    first, whole, made, again, _, _ = spent
    return made, first, whole, again


def gpu_frame(surface: Surface, size: int, method: str, device: GpuDevice, seconds: float) -> GpuFrameCost:
    """Measure frames of one size."""

    def draw() -> None:
        # Nothing is read and nothing is held, so the next frame neither waits nor copies.
        render(surface, size, method=method, device=device)

    draw()
    settle()
    frames, limits = gpu_turns(device, (draw, limit_action(surface, size, device)), seconds)
    wall, host = in_flight(device, draw, seconds)
    image = render(surface, size, method=method, device=device)
    return GpuFrameCost(
        size,
        spans(frames),
        wall,
        host,
        spans(limits),
        _medians(frames),
        statistics.median(frame.span - frame.busy for frame in frames) if frames else 0.0,
        float(image.aov("steps").mean()),
        image.hits,
        image.unresolved,
    )


def _medians(frames: Sequence[Passes]) -> tuple[tuple[str, float], ...]:
    """Each pass's median over frames; every frame has the same passes, for the host records them unseen."""
    if not frames:
        return ()
    columns = zip(*(frame.each for frame in frames), strict=True)
    return tuple((column[0][0], statistics.median(spent for _, spent in column)) for column in columns)
