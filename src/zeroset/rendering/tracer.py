"""Tracing as a plan of passes: beams, first look, second look, thin parts; for a frame's pixels and a caller's rays.

Each pass is a kernel over named buffers. The later ones run on lists that the earlier ones make, mostly short.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from zeroset.kernel import Kernel
from zeroset.kernel.types import F32, F64, U32
from zeroset.rendering.buffers import (
    BLOCK,
    COUNTERS,
    FORMER,
    FROM,
    IN_BLOCKS,
    IN_TILES,
    LISTS,
    LIT,
    NOTHING,
    ONWARD,
    OPEN,
    PARTS,
    SECOND,
    THIN,
    THIN_PIXEL,
    THIN_REACH,
    Ends,
    fields,
)
from zeroset.rendering.drawn import Drawn, as_drawn
from zeroset.rendering.layout import TILE
from zeroset.rendering.making import Making
from zeroset.rendering.passes import AIM, APART, DRAFT, ORDER, QUICK, RARE, Passes
from zeroset.rendering.values import Arrays
from zeroset.runtime import Counted, Device, Program
from zeroset.scene.several import Drawable
from zeroset.solve.method import Method

Buffers = Mapping[str, Any]
Pause = Callable[[], object]
FEW = 512
"""Rays that are searched in f64 between two pauses: each may take its time."""
STEPS = 8
"""Steps that a ray without a beam begins with."""
AT_ONCE = 5
"""Programs that are made side by side: compilers are to be kept at work while other kernels are being traced."""


class Tracer:
    """The programs of one structure (formulas, method, kinds of bounds).

    Attributes:
        certified: whether the method proves its answers; only then are there beams, second looks and thin parts.
        beams: whether tiles of pixels share beams.
        exact: whether what f32 leaves unresolved is looked at again in f64.

    Args:
        surface: what is traced: a surface, a solid, or several.
        method: how.
        device: where.
        pixels: whether the rays are a camera's, one a pixel, or a caller's.
        shadows: whether there is a pass for what is in the lights' path.
        ends: which places around each find are kept, for rays that go on.
        layered: whether each run of the first look finds what comes behind the last run's finds (``layers``).
    """

    def __init__(
        self,
        surface: Drawable | Drawn,
        method: Method,
        device: Device,
        pixels: bool,
        layered: bool = False,
        shadows: bool = False,
        ends: Ends = (),
    ) -> None:
        whole = as_drawn(surface)
        self._passes = Passes(whole.shape, method, pixels, layered, shadows, ends, device.supports(F64))
        self._device = device
        self.certified = method.certified
        self.beams, self.exact = self._passes.beams, self._passes.exact
        self._arrays = Arrays(device)
        self._sums = whole.arrays
        self._shared: list[str] = []
        self._making = Making(device)
        self._drawn = False
        self._hurry = False
        for name, build in self._passes.kernels().items():
            self._making.add(name, f"{name} {self._passes.key}", build)

    def kernel(self, name: str) -> Kernel:
        """The kernel of one pass as it is traced, for those who want to look at it."""
        return self._making.kernel(name)

    def program(self, name: str) -> Program:
        """The program of one pass: compiled by now, being compiled, or compiled here."""
        return self._making.get(name)

    def add(self, name: str, build: Callable[[], Kernel]) -> None:
        """Have another program made along with the passes' own, under its name alone: every structure shares it."""
        self._shared.append(name)
        self._making.add(name, name, build)

    def compile(self, draft: bool, hurry: bool, beams: bool = True) -> None:
        """Begin to compile what is not there yet; ``program`` waits for the one that it is asked for.

        Args:
            draft: only what a draft needs.
            hurry: whether a first picture is so small that compiling for it takes longer than drawing it.
            beams: whether rays are to have beams.
        """
        passes = [name for name in (DRAFT if draft else ORDER) if name in self._making]
        if AIM in passes and (not beams or (self._unaimed(draft) and not self._drawn)):
            passes.remove(AIM)
        self._hurry = hurry and not self._drawn
        # Of what a whole picture needs, second looks come last.
        before = passes if draft else passes[:-1]
        wanted = [*before, *self._shared, *passes[len(before) :]]
        more = [RARE] if self._passes.again and not draft else []
        if self._device.name == "gpu":
            # A GPU cannot say without being waited for whether a list is empty, so that it needs every program.
            # A draft: the driver compiles the first shader while the second is traced, one tracing at a time.
            self._making.begin([*wanted, *more], 1 if draft else 2)
        elif self._drawn:
            # Who draws once more may do so often: then nothing that is still to come shall hold up a picture.
            self._making.begin([*wanted, *more], AT_ONCE)
            self._making.improve()
        else:
            self._making.begin(wanted, AT_ONCE, (*QUICK, *self._shared) if hurry else (), APART)

    def settle(self) -> None:
        """Wait until everything is there that was begun or that another picture may ask for, and as good as it gets."""
        self._making.begin([name for name in (AIM, RARE) if name in self._making], 1)
        self._making.settle()

    def outputs(self, rays: int) -> dict[str, Any]:
        """Fresh buffers for what is found along so many rays."""
        return {name: self._device.allocate(type_, rays) for name, type_ in fields(self._passes.shape.parts).items()}

    def buffers(self, rays: int, tiles: int) -> dict[str, Any]:
        """Fresh buffers for so many rays and tiles, those of the outputs included where there is one layer."""
        wanted = ({} if self._passes.layered else fields(self._passes.shape.parts)) | (SECOND if self.exact else {})
        made = {name: self._device.allocate(type_, rays) for name, type_ in wanted.items()}
        made[COUNTERS] = self._device.allocate(U32, LISTS)
        made |= {name: self._device.allocate(F32, rays) for name in self._passes.ends}
        if self._passes.shadows:
            made[LIT] = self._device.allocate(U32, rays)
        if self.beams:
            made |= {name: self._device.allocate(F32, tiles) for name in ("tile_start", "tile_step")}
            made[OPEN] = self._device.allocate(U32, rays // BLOCK)
            for cells, pixels in ((THIN["block"], BLOCK), (THIN["quarter"], BLOCK // 4)):
                made[cells.lanes] = self._device.allocate(U32, rays // pixels)
                made[cells.reach] = self._device.allocate(F32, rays // pixels)
            listed = {THIN_PIXEL: U32, THIN_REACH: F32} | (PARTS if self._passes.again else {})
            made |= {name: self._device.allocate(type_, rays) for name, type_ in listed.items()}
        return made

    def begin(
        self,
        drawn: Drawn,
        uniforms: Mapping[str, float],
        buffers: Buffers,
        tiles: int,
        draft: bool = False,
        beams: bool = True,
    ) -> Buffers:
        """Start a frame: empty lists, beams over all tiles. Gives the buffers with the array parameters.

        Args:
            drawn: what is traced.
            uniforms: everything that the kernels read.
            buffers: the frame's.
            tiles: how many there are.
            draft: whether rays do without beams while the program that makes those is still being compiled.
            beams: whether they have any at all.
        """
        self._drawn = True
        bound = {**buffers, **drawn.bind(self._arrays)} if drawn.arrays else buffers
        self._device.clear(buffers[COUNTERS])
        if self.beams:
            self._device.clear(buffers[OPEN])
            if not beams or (self._unaimed(draft) and not self._making.ready(AIM)):
                self._aim_nowhere(uniforms, buffers, tiles)
                return bound
            self.program(AIM).run(tiles, {**uniforms, "level": IN_TILES}, bound)
            if self._making.pending("first"):
                # A driver that compiles when a shader first runs may do so while the next one is being written.
                self._device.submit()
        return bound

    def _unaimed(self, draft: bool) -> bool:
        """Whether rays may have no beam yet.

        A sum is a short text and long in every step: on a CPU its beams are there soon, and worth it. GPUs' drivers
        compile one shader after the other.
        """
        return draft and self.beams and not (self._sums and self._device.name == "cpu")

    def _aim_nowhere(self, uniforms: Mapping[str, float], buffers: Buffers, tiles: int) -> None:
        """Say of every tile that its rays may meet something anywhere."""
        near, far = uniforms["near"], uniforms["far"]
        for name, value in (("tile_start", near), ("tile_step", (far - near) / STEPS)):
            self._device.write(buffers[name], np.full(tiles, value, np.float32))

    def first_look(self, uniforms: Mapping[str, float], bound: Buffers, first: int, count: int) -> None:
        """Trace a run of rays."""
        self.program("first").run(count, {**uniforms, "first": first}, bound)

    def layers(
        self, drawn: Drawn, uniforms: Mapping[str, float], bound: Buffers, rays: int, most: int
    ) -> list[dict[str, Any]]:
        """What lies behind one another along each ray: the outputs of each layer, the first one first."""
        here, onward = (self._device.allocate(F32, rays) for _ in range(2))
        self._device.write(here, np.full(rays, NOTHING, np.float32))
        former = self._device.allocate(U32, rays)
        self._device.clear(former)
        found: list[dict[str, Any]] = []
        for _ in range(most):
            found.append(self.outputs(rays))
            self._device.clear(bound[COUNTERS])
            layer = {**bound, **found[-1], FROM: here, ONWARD: onward, FORMER: former}
            self.program("first").run(rays, uniforms, layer)
            self.second_look(drawn, uniforms, layer)
            here, onward, former = onward, here, found[-1]["status"]
        return found

    def second_look(
        self, drawn: Drawn, uniforms: Mapping[str, float], bound: Buffers, pause: Pause | None = None
    ) -> None:
        """Trace the rays that the first look left unresolved again, in f64; where there is no f64 they stay so.

        ``pause`` is called now and then where it can be told how many there are.
        """
        if not self.exact or self._device.lanes(Counted(bound[COUNTERS], 0)) == 0:
            return
        self._in_doubles("second", Counted(bound[COUNTERS], 0), drawn, uniforms, bound, pause)

    def _in_doubles(
        self,
        name: str,
        lanes: Counted,
        drawn: Drawn,
        uniforms: Mapping[str, float],
        bound: Buffers,
        pause: Pause | None = None,
    ) -> None:
        """Run a pass that reads its numbers in f64."""
        exact, arrays = self.in_doubles(drawn)
        numbers, buffers = {**uniforms, **exact, "listed": 0}, {**bound, **arrays}
        count = None if pause is None else self._device.lanes(lanes)
        if pause is None or count is None:
            self.program(name).run(lanes, numbers, buffers)
            return
        for first in range(0, count, FEW):
            pause()
            self.program(name).run(min(FEW, count - first), {**numbers, "listed": first}, buffers)

    def in_doubles(self, drawn: Drawn) -> tuple[dict[str, float], dict[str, Any]]:
        """The numbers that a pass in f64 reads beside a frame's, and the arrays."""
        return drawn.parameters(self._passes.method, F64), drawn.bind(self._arrays, F64) if drawn.arrays else {}

    def shadows(
        self, drawn: Drawn, lights: Iterable[Mapping[str, float]], uniforms: Mapping[str, float], bound: Buffers
    ) -> None:
        """See which lights reach what was found."""
        self._device.clear(bound[LIT])
        if self.exact and drawn.shape.large:
            exact, arrays = self.in_doubles(drawn)
            uniforms, bound = {**uniforms, **exact}, {**bound, **arrays}
        rays = len(bound[LIT])
        for light in lights:
            self.program("shadow").run(rays, {**uniforms, **light}, bound)

    def thin_parts(
        self,
        drawn: Drawn,
        uniforms: Mapping[str, float],
        bound: Buffers,
        tiles: int,
        pause: Pause | None = None,
    ) -> None:
        """Draw what lies between the rays: by blocks, quarters of those, pixels, and parts of those, last in f64."""
        if not self.beams:
            return
        program, blocks = self.program(AIM), tiles * TILE * TILE // BLOCK
        program.run(blocks, {**uniforms, "level": IN_BLOCKS}, bound)
        # What one run puts on a list, the next looks at in pieces.
        for counter, each in ((1, 4), (2, 4), (3, BLOCK)):
            cells = Counted(bound[COUNTERS], counter, each)
            if counter == 1 and (self._device.lanes(cells) or 0) > blocks:
                # A block in four is open: terms cancel, and to look closer takes longer than to make it faster.
                program = self._making.best(AIM)
            program.run(cells, {**uniforms, "level": IN_BLOCKS + counter}, bound)
        left = Counted(bound[COUNTERS], 4)
        if self._passes.again and self._device.lanes(left) != 0:
            self._making.begin((RARE,), 1, (RARE,) if self._hurry else ())
            self._in_doubles(RARE, left, drawn, uniforms, bound, pause)
