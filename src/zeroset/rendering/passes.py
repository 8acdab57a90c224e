"""The passes of tracing: what the kernel of each is, and when its program is made.

Kernels are imported where they are traced: a picture whose programs come from the cache loads no number system at all.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from zeroset.kernel import Kernel
from zeroset.rendering.buffers import Ends
from zeroset.solve.method import Method
from zeroset.solve.shape import Shape

AIM = "beams"
"""The pass that only spares the others work: the first draft of a surface does not wait for its program."""
DRAFT = (AIM, "first", "shadow")
"""The passes of a draft, which leaves out second looks and thin parts."""
ORDER = (*DRAFT, "second")
"""Passes in the order in which their programs are made."""
RARE = "parts"
"""The pass that many pictures need nothing of: its program is made when a pixel asks, or after the first picture."""
APART = (AIM, RARE)
"""Passes whose programs another process makes, where there is one: about half of the work."""
QUICK = (AIM, "second", RARE)
"""Passes that take little of a small picture's time; their programs are made in a hurry for the first one."""


class Passes(NamedTuple):
    """The passes of one structure.

    Attributes:
        shape: what is traced.
        method: how.
        pixels: whether the rays are a camera's, one a pixel, or a caller's.
        layered: whether each run of the first look finds what comes behind the last run's finds.
        shadows: whether there is a pass for what is in the lights' path.
        ends: which places around each find are kept, for rays that go on.
        doubles: whether the device calculates in f64.
    """

    shape: Shape
    method: Method
    pixels: bool
    layered: bool
    shadows: bool
    ends: Ends
    doubles: bool

    @property
    def beams(self) -> bool:
        """Whether tiles of pixels share beams."""
        return self.pixels and self.method.certified and not self.layered

    @property
    def exact(self) -> bool:
        """Whether what f32 leaves unresolved is looked at again in f64."""
        return self.method.certified and self.doubles

    @property
    def again(self) -> bool:
        """Whether thin parts are looked at again in f64."""
        return self.exact and self.beams

    @property
    def key(self) -> str:
        """Everything that the kernels depend on."""
        flags = f"{self.pixels} {self.layered} {self.exact} {' '.join(self.ends)}"
        return f"{self.shape.digest} {self.method.structure()} {flags}"

    def kernels(self) -> dict[str, Callable[[], Kernel]]:
        """What traces each pass's kernel, by its name."""
        made = {"first": self._first}
        if self.shadows:
            made["shadow"] = self._shadow
        if self.exact:
            made["second"] = self._second
        if self.beams:
            made[AIM] = self._beams
        if self.again:
            made[RARE] = self._parts
        return made

    @property
    def _offset(self) -> bool:
        return self.method.offset != 0.0

    def _first(self) -> Kernel:
        if self.layered:
            from zeroset.rendering.layers import layer_kernel

            return layer_kernel(self.shape, self.method, self.pixels, self.exact)
        from zeroset.rendering.primary import trace_kernel

        return trace_kernel(self.shape, self.method, self.pixels, self.beams, self.exact, self.ends)

    def _second(self) -> Kernel:
        if self.layered:
            from zeroset.rendering.layers import second_layer_kernel

            return second_layer_kernel(self.shape, self._offset, self.pixels)
        from zeroset.rendering.primary import second_kernel

        return second_kernel(self.shape, self._offset, self.pixels, self.ends, self.beams)

    def _beams(self) -> Kernel:
        from zeroset.rendering.beams import beam_kernel

        return beam_kernel(self.shape, self._offset, self.ends, self.again)

    def _parts(self) -> Kernel:
        from zeroset.rendering.parts import parts_kernel

        return parts_kernel(self.shape, self._offset, self.ends)

    def _shadow(self) -> Kernel:
        from zeroset.rendering.shadow import shadow_kernel

        return shadow_kernel(self.shape, self._offset, self.exact and self.shape.large)
