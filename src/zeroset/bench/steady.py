"""Frames in steady state on any device: by the wall's clock, and by a GPU's own where there is one."""

from __future__ import annotations

from collections.abc import Callable

from zeroset.bench.devices import Devices
from zeroset.bench.flight import gpu_turns, in_flight, spans
from zeroset.bench.timing import Times, take_turns
from zeroset.rendering.frame import settle


def frame_times(draw: Callable[[], object], devices: Devices, seconds: float) -> tuple[Times, Times | None]:
    """Milliseconds a frame by the wall's clock, and by the GPU's own; None where no GPU tells it.

    On a GPU frames are in flight: many are sent off, only the last is waited for. Elsewhere one follows the other.

    Args:
        draw: asks for one frame and reads nothing of it.
        devices: where it draws.
        seconds: how long frames are repeated, by either clock.

    Example:
        >>> wall, gpu = frame_times(lambda: None, Devices("interp", None), 0.0)
        >>> wall.count >= 3, gpu
        (True, None)
    """
    draw()
    settle()
    if devices.gpu is None:
        return take_turns((draw,), seconds)[0], None
    (frames,) = gpu_turns(devices.gpu, (draw,), seconds)
    wall, _ = in_flight(devices.gpu, draw, seconds)
    return wall, spans(frames)
