"""What the WGSL writer must know of a GPU: which of the optional features it has, and how exactly it calculates.

WGSL asks little of arithmetic: division may be off by 2.5 units in the last place and square roots by more. The error
bounds of ``arith`` want nearly the nearest number, so the writer adds a correction where a GPU does not give it
(``legalise``); whether it does is measured when the device is opened (``runtime.gpu.probe``).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from zeroset.kernel.types import Buffer

CONSTANT_BYTES = 1 << 14
"""What a buffer of constants holds; WebGPU promises room for four times as much."""


@dataclass(frozen=True, slots=True)
class GpuTarget:
    """A GPU as the code generator sees it.

    Attributes:
        subgroups: whether lanes of a subgroup can vote.
        doubles: whether there are f64 numbers and 64-bit integers to take them apart.
        exact_division: whether quotients are rounded to nearest.
        exact_root: whether square roots are rounded to nearest.
        exact_rounding: whether f64 numbers are rounded to whole ones as they should be.
        workgroup: lanes of a workgroup; 64 lanes are one tile of 8x8 pixels.
        constants: how many buffers of constants may be bound beside the uniforms; WebGPU promises twelve in all.
    """

    subgroups: bool = False
    doubles: bool = False
    exact_division: bool = False
    exact_root: bool = False
    exact_rounding: bool = False
    workgroup: int = 64
    constants: int = 11

    @property
    def identity(self) -> str:
        """Everything that decides the code, as one line; part of every cache key."""
        flags = (self.subgroups, self.doubles, self.exact_division, self.exact_root, self.exact_rounding)
        return f"wgsl|{''.join(str(int(flag)) for flag in flags)}|{self.workgroup}|{self.constants}"

    def constant(self, buffers: Iterable[Buffer]) -> frozenset[str]:
        """The names of those buffers that lie where a GPU keeps constants."""
        return frozenset([b.name for b in buffers if b.constant][: self.constants])
