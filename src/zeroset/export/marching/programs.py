"""The programs that mesh one surface on one device: compiled side by side, used for every slab."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from zeroset.export.marching.lattice import Lattice
from zeroset.kernel import F32, U32, Kernel, Type
from zeroset.rendering.making import Making
from zeroset.rendering.values import Arrays, parameter_uniforms
from zeroset.runtime import Device, Program
from zeroset.scene.bounds import bounds_kind, bounds_uniforms
from zeroset.scene.surface import Surface
from zeroset.solve import resolve_method

SNAP = 2.0**-22
"""Vertices so near a lattice point, as a part of the largest coordinate, are at it: float32 has hardly more to tell."""


class Programs:
    """What one surface's mesh is made with.

    Args:
        surface: with its bounds.
        device: where to run.
        capped: whether the mesh is to be closed at the bounds.
        type_: scalar type that f is evaluated in.
    """

    def __init__(self, surface: Surface, device: Device, capped: bool, type_: Type) -> None:
        self.surface = surface
        self.device = device
        self.capped = capped
        self.type = type_
        self._arrays = Arrays(device)
        self._making = Making(device)
        kernels = self._kernels()
        self._usual = [name for name in kernels if name != "rim"]
        for name, (key, build) in kernels.items():
            self._making.add(name, key, build)

    def _kernels(self) -> dict[str, tuple[str, Callable[[], Kernel]]]:
        """Key and builder of each kernel."""
        field, kind, capped, type_ = self.surface.field, bounds_kind(self.surface.fitted), self.capped, self.type

        # Imported where they are traced: what comes from the cache needs no number system.
        def exclude() -> Kernel:
            from zeroset.export.marching.exclude import exclude_kernel

            return exclude_kernel(field, kind, capped)

        def sample() -> Kernel:
            from zeroset.export.marching.passes import sample_kernel

            return sample_kernel(field, kind, capped, type_)

        def root() -> Kernel:
            from zeroset.export.marching.roots import root_kernel

            return root_kernel(field, kind, capped, type_)

        def rim() -> Kernel:
            from zeroset.export.marching.roots import rim_kernel

            return rim_kernel(field, capped, type_)

        def mark() -> Kernel:
            from zeroset.export.marching.passes import mark_kernel

            return mark_kernel(type_)

        def lists() -> Kernel:
            from zeroset.export.marching.passes import list_kernel

            return list_kernel()

        def join() -> Kernel:
            from zeroset.export.marching.passes import join_kernel

            return join_kernel()

        one = f"{field.digest} {kind}"
        return {
            "exclude": (f"mesh exclude {one} {capped}", exclude),
            "sample": (f"mesh sample {one} {capped} {type_}", sample),
            "mark": (f"mesh mark {type_}", mark),
            "list": ("mesh list", lists),
            "root": (f"mesh root {one} {capped} {type_}", root),
            "join": ("mesh join", join),
            "rim": (f"mesh rim {one} {capped} {type_}", rim),
        }

    def compile(self) -> None:
        """Begin to compile what every mesh needs, two kernels at a time."""
        self._making.begin(self._usual, 2)

    def program(self, name: str) -> Program:
        """One of the programs; waits for it where it is being compiled."""
        return self._making.get(name)

    def uniforms(self, lattice: Lattice) -> dict[str, float]:
        """Everything that the kernels read besides buffers."""
        snap = min(SNAP * float(np.abs(lattice.coordinates).max()), lattice.cell * 2.0**-6)
        plain, exact = (parameter_uniforms(self.surface, resolve_method("auto"), t) for t in (F32, self.type))
        return lattice.uniforms() | bounds_uniforms(self.surface.fitted) | plain | exact | {"snap": snap}

    def arrays(self) -> dict[str, Any]:
        """The buffers of array parameters, in every type that kernels ask for."""
        if not self.surface.arrays:
            return {}
        return self._arrays.bind(self.surface, F32) | self._arrays.bind(self.surface, self.type)

    def put(self, values: np.ndarray[Any, Any], type_: Type = U32) -> Any:
        """A fresh buffer with these elements."""
        made = self.device.allocate(type_, len(values))
        self.device.write(made, np.ascontiguousarray(values, type_.dtype))
        return made

    def run(self, name: str, count: int, uniforms: Mapping[str, float], buffers: Mapping[str, Any]) -> None:
        """Run one program."""
        if count:
            self.program(name).run(count, uniforms, buffers)
