"""A frame: the tracer's passes and shading over buffers that live as long as the frame is reused.

A ``Frame`` belongs to one structure (what shapes its kernels, its size and device). Parameters, bounds, camera,
colours and tolerances are uniforms: drawing again allocates and compiles nothing. An ``Image`` shares the frame's
G-buffer until the next draw, and is given its own copy only then, and only if somebody still holds it.
"""

from __future__ import annotations

import threading
import weakref
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.kernel import Kernel
from zeroset.kernel.types import U32
from zeroset.rendering.buffers import FIELDS
from zeroset.rendering.layout import TILE, Layout
from zeroset.rendering.tracer import Tracer
from zeroset.runtime import Device, Program
from zeroset.scene.bounds import bounds_kind
from zeroset.scene.surface import Surface
from zeroset.solve.method import Method

Progress = Callable[[float], None]
"""Told the share of a frame that is done, from 0 to 1."""

SLICES = 50
"""Parts that a frame is drawn in where somebody watches its progress."""


@dataclass(frozen=True, slots=True)
class Structure:
    """What shapes a frame's kernels and buffers."""

    field: str
    method: str
    bounds: str
    lights: int
    layout: Layout
    device: int


class GBuffer:
    """One frame's G-buffer: shared with the frame until its next draw, its own from then on."""

    def __init__(self, layout: Layout, arrays: Mapping[str, npt.NDArray[Any]]) -> None:
        self._layout = layout
        self._arrays = arrays
        self._lock = threading.Lock()

    def rows(self, name: str) -> npt.NDArray[Any]:
        """One output in rows."""
        with self._lock:
            return self._layout.unscramble(self._arrays[name])

    def keep(self) -> None:
        """Copy what is shared, before it is written over."""
        with self._lock:
            self._arrays = {name: array.copy() for name, array in self._arrays.items()}


class Frame:
    """The programs and buffers of one structure."""

    def __init__(self, surface: Surface, method: Method, lights: int, layout: Layout, device: Device) -> None:
        self.layout = layout
        self.device = device
        self.lock = threading.Lock()
        self._tracer = Tracer(surface, method, device, pixels=True)
        self._lights = lights
        self._tracer.compile(self._shader)
        self._buffers = self._tracer.buffers(layout.lanes, layout.tiles)
        self._rgba = device.allocate(U32, layout.width * layout.height)
        self._shown: weakref.ref[GBuffer] | None = None

    def settle(self) -> None:
        """Wait until all of the frame's programs are there."""
        self._tracer.settle()

    def _shader(self) -> Program:
        def build() -> Kernel:
            from zeroset.rendering.shade import shade_kernel

            return shade_kernel(self._lights)

        return self.device.compile_cached(f"shade {self._lights}", build)

    def draw(
        self, surface: Surface, uniforms: Mapping[str, float], thin: bool, progress: Progress | None = None
    ) -> tuple[npt.NDArray[np.uint8], GBuffer]:
        """Run the passes; gives the picture, (height, width, 4), and the G-buffer."""
        shown = self._shown() if self._shown is not None else None
        if shown is not None:
            shown.keep()
        bound = self._tracer.begin(surface, uniforms, self._buffers, self.layout.tiles)
        lanes = self.layout.lanes
        part = lanes if progress is None else max(1, self.layout.tiles // SLICES) * TILE * TILE
        for first in range(0, lanes, part):
            if progress is not None:
                progress(first / lanes)
            self._tracer.first_look(uniforms, bound, first, min(part, lanes - first))
        self._tracer.second_look(surface, uniforms, bound)
        if thin:
            self._tracer.thin_parts(uniforms, bound, self.layout.tiles)
        self._shader().run(lanes, uniforms, {**bound, "rgba": self._rgba})
        arrays = {name: self.device.read(self._buffers[name]) for name in FIELDS}
        outputs = GBuffer(self.layout, arrays)
        self._shown = weakref.ref(outputs)
        picture = self.device.read(self._rgba).copy().view(np.uint8)
        return picture.reshape(self.layout.height, self.layout.width, 4), outputs


_frames: OrderedDict[Structure, Frame] = OrderedDict()
_frames_lock = threading.Lock()
KEPT = 2
"""Frames kept for the next picture of the same structure; each holds its buffers."""
KEPT_LANES = 1 << 23
"""Pixels that all kept frames may have together, the last one aside: 48 bytes of memory each."""


def frame_for(surface: Surface, method: Method, lights: int, layout: Layout, device: Device) -> Frame:
    """The frame of a structure, kept from an earlier picture where there was one."""
    kind = bounds_kind(surface.bounds)
    structure = Structure(surface.field.digest, method.structure(), kind, lights, layout, id(device))
    with _frames_lock:
        frame = _frames.get(structure)
        if frame is None:
            frame = Frame(surface, method, lights, layout, device)
            _frames[structure] = frame
        _frames.move_to_end(structure)
        while len(_frames) > 1 and (len(_frames) > KEPT or sum(f.layout.lanes for f in _frames.values()) > KEPT_LANES):
            _frames.popitem(last=False)
    return frame


def settle() -> None:
    """Wait until everything that the kept frames have begun to compile is there; for those who count or time it."""
    with _frames_lock:
        frames = tuple(_frames.values())
    for frame in frames:
        frame.settle()
