"""A frame: the tracer's passes and shading over buffers that live as long as the frame is reused.

A ``Frame`` belongs to one structure (what shapes its kernels, its size and device). Parameters, bounds, camera,
colours and tolerances are uniforms: drawing again allocates and compiles nothing. An ``Image`` shares the frame's
G-buffer until the next draw, and is given its own copy only then, and only if somebody still holds it.
"""

from __future__ import annotations

import threading
import weakref
from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from zeroset.kernel import Kernel
from zeroset.kernel.types import F32, U32
from zeroset.rendering.buffers import COUNTERS, LIT, MATERIALS, PICTURE, VALUE, fields
from zeroset.rendering.drawn import Drawn
from zeroset.rendering.layout import TILE, Layout
from zeroset.rendering.materials import Table, material_table
from zeroset.rendering.shading import Illumination, Lighting
from zeroset.rendering.tracer import Tracer
from zeroset.runtime import Device
from zeroset.runtime.device import HostMemory
from zeroset.scene.light import Material
from zeroset.solve.method import Method

if TYPE_CHECKING:
    from zeroset.rendering.bounce import Bounces
    from zeroset.rendering.coloring import Colors
    from zeroset.rendering.tint import Palette, Tint

Progress = Callable[[float], None]
"""Told the share of a frame that is done, from 0 to 1."""


def part_of(progress: Progress | None, part: int, parts: int) -> Progress | None:
    """The progress of one of several parts as progress of the whole."""
    return None if progress is None else lambda done: progress((part + done) / parts)


SLICES = 50
"""Parts that a frame is drawn in where somebody watches its progress."""
SMALL = 1 << 19
"""Pixels of a picture that is drawn sooner than its kernels are compiled."""
MOST_AT_ONCE = 1 << 20
"""Rays handed over at once: systems end the work of a GPU that takes seconds over it."""


class Structure(NamedTuple):
    """What shapes a frame's kernels and buffers."""

    shape: str
    method: str
    lighting: Lighting
    layout: Layout
    device: int
    tint: str


class Memory(Protocol):
    """What is asked of a device once a frame is drawn."""

    def read(self, buffer: Any) -> npt.NDArray[Any]:
        """A buffer as an array."""

    def copy(self, buffer: Any) -> Any:
        """A copy of a buffer."""


class GBuffer:
    """One frame's outputs: shared with the frame until its next draw, its own from then on; read when asked for.

    Attributes:
        range: values of the first and the last colour, where a value gives the colour.
    """

    def __init__(
        self, layout: Layout, device: Memory, buffers: Mapping[str, Any], range: tuple[float, float] | None = None
    ) -> None:
        self.range = range
        self._layout = layout
        self._device = device
        self._buffers = buffers
        self._lock = threading.Lock()

    def __reduce__(self) -> tuple[Any, ...]:
        # What is pickled or copied lies in the host's memory from then on.
        with self._lock:
            buffers = {name: self._device.read(buffer).copy() for name, buffer in self._buffers.items()}
        return GBuffer, (self._layout, HostMemory(), buffers, self.range)

    def has(self, name: str) -> bool:
        """Whether there is such an output."""
        return name in self._buffers

    def rows(self, name: str) -> npt.NDArray[Any]:
        """One output in rows."""
        with self._lock:
            return self._layout.unscramble(self._device.read(self._buffers[name]))

    def picture(self) -> npt.NDArray[np.uint8]:
        """The picture, (height, width, 4)."""
        with self._lock:
            rgba = self._device.read(self._buffers[PICTURE]).copy()
        return rgba.view(np.uint8).reshape(self._layout.height, self._layout.width, 4)

    def keep(self) -> None:
        """Copy what is shared, before it is written over."""
        with self._lock:
            self._buffers = {name: self._device.copy(buffer) for name, buffer in self._buffers.items()}


class Frame:
    """The programs and buffers of one structure."""

    def __init__(
        self,
        drawn: Drawn,
        method: Method,
        lighting: Lighting,
        layout: Layout,
        device: Device,
        draft: bool = False,
        tint: Tint | None = None,
        beams: bool = True,
    ) -> None:
        def shader() -> Kernel:
            from zeroset.rendering.shade import shade_kernel

            return shade_kernel(lighting, drawn.parts, self._tracer.beams)

        self.layout = layout
        self.device = device
        self.lock = threading.Lock()
        optics = lighting.optics
        ends = () if optics is None else optics.ends
        self._tracer = Tracer(drawn, method, device, True, shadows=lighting.shadows, ends=ends)
        self._shader = f"shade {lighting} {drawn.parts > 1} {self._tracer.beams}"
        self._bounces: Bounces | None = None
        self._colors: Colors | None = None
        # Colours and bounces are imported where there are any: most pictures have neither.
        if tint is not None:
            from zeroset.rendering.coloring import Colors

            self._colors = Colors(self._tracer, method, tint, layout, device)
        self._shades = optics is None or optics.plain
        if self._shades:
            self._tracer.add(self._shader, shader)
        if optics is not None:
            from zeroset.rendering.bounce import Bounces

            lists = self._shader if optics.plain else None
            self._bounces = Bounces(self._tracer, drawn, method, optics, layout, device, tint, lists)
        self.compile(draft, beams)
        self._buffers = self._tracer.buffers(layout.lanes, layout.tiles)
        self._fields = fields(drawn.parts)
        self._materials = Table(device)
        self.picture = device.allocate(U32, layout.width * layout.height)
        """The picture's pixels in rows, for those who show them without reading them."""
        self._shown: weakref.ref[GBuffer] | None = None

    def settle(self) -> None:
        """Wait until all of the frame's programs are there."""
        self._tracer.settle()

    def compile(self, draft: bool, beams: bool = True) -> None:
        """Begin to compile what is not there yet, or what of it a draft needs, or a picture without beams."""
        self._tracer.compile(draft, self.layout.lanes <= SMALL, beams)

    def draw(
        self,
        drawn: Drawn,
        uniforms: Mapping[str, float],
        thin: bool,
        progress: Progress | None = None,
        draft: bool = False,
        light: Illumination | None = None,
        materials: Sequence[Material] = (),
        palette: Palette | None = None,
        beams: bool = True,
    ) -> GBuffer:
        """Run the passes; gives the outputs, which a GPU may still be working on.

        Args:
            drawn: of this frame's structure.
            uniforms: everything that its kernels read.
            thin: whether to draw thin parts.
            progress: told the share that is done.
            draft: leave out second looks and thin parts, which some pixels need and every picture can do without.
            light: what shadows and rays beyond the first hit need.
            materials: of each part, where there are several.
            palette: the colours of values, for a frame that has them.
            beams: whether tiles of pixels share beams.
        """
        shown = self._shown() if self._shown is not None else None
        if shown is not None:
            shown.keep()
        bound = self._tracer.begin(drawn, uniforms, self._buffers, self.layout.tiles, draft, beams)
        if drawn.parts > 1:
            bound = {**bound, MATERIALS: self._materials.holding(material_table(materials))}
        lanes = self.layout.lanes
        part = MOST_AT_ONCE if progress is None else max(1, self.layout.tiles // SLICES) * TILE * TILE
        for first in range(0, lanes, part):
            if progress is not None:
                # Reading is waiting: what was asked for so far is done.
                self.device.read(self._buffers[COUNTERS])
                progress(first / lanes)
            self._tracer.first_look(uniforms, bound, first, min(part, lanes - first))
            self.device.submit()
        # The rays that take longest come last: who waits may want to give up even then.
        pause = None if progress is None else partial(progress, 1.0)
        if not draft:
            self._tracer.second_look(drawn, uniforms, bound, pause)
        if thin and not draft:
            self._tracer.thin_parts(drawn, uniforms, bound, self.layout.tiles, pause)
        kept = self._fields
        range_: tuple[float, float] | None = None
        if self._colors is not None and palette is not None:
            uniforms, bound = self._colors.run(drawn, palette, uniforms, bound)
            kept, range_ = {**self._fields, VALUE: F32}, self._colors.range
        if self._shades:
            if light is not None and LIT in self._buffers:
                self._tracer.shadows(drawn, light.shadows, uniforms, bound)
            if self._bounces is None:
                self._tracer.program(self._shader).run(lanes, uniforms, {**bound, PICTURE: self.picture})
        if self._bounces is not None and light is not None:
            if self._bounces.exact:
                exact, arrays = self._tracer.in_doubles(drawn)
                uniforms, bound = {**uniforms, **exact}, {**bound, **arrays}
            self._bounces.run(uniforms, bound, self.picture, light)
        self.device.submit()
        pictured = {PICTURE: self.picture} | {name: bound[name] for name in kept}
        outputs = GBuffer(self.layout, self.device, pictured, range_)
        self._shown = weakref.ref(outputs)
        return outputs


_frames: OrderedDict[Structure, Frame] = OrderedDict()
_frames_lock = threading.Lock()
KEPT = 2
"""Frames kept for the next picture of the same structure; each holds its buffers."""
KEPT_LANES = 1 << 23
"""Pixels that all kept frames may have together, the last one aside: 48 bytes of memory each."""


def frame_for(
    drawn: Drawn,
    method: Method,
    lighting: Lighting,
    layout: Layout,
    device: Device,
    draft: bool = False,
    tint: Tint | None = None,
    beams: bool = True,
) -> Frame:
    """The frame of a structure, kept from an earlier picture where there was one; its programs are being compiled."""
    colored = "" if tint is None else tint.digest
    structure = Structure(drawn.shape.digest, method.structure(), lighting, layout, id(device), colored)
    with _frames_lock:
        frame = _frames.get(structure)
        if frame is None:
            frame = Frame(drawn, method, lighting, layout, device, draft, tint, beams)
            _frames[structure] = frame
        else:
            frame.compile(draft, beams)
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
