"""Tracing as a plan of passes: beams, first look, second look; the same for a frame's pixels and a caller's rays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from zeroset.kernel.types import F32, F64, U32
from zeroset.render.gbuffer import COUNTER, FIELDS, SECOND
from zeroset.render.primary import beam_kernel, camera_ray, given_ray, second_kernel, trace_kernel
from zeroset.render.values import array_buffers, parameter_uniforms
from zeroset.runtime import Device, Program
from zeroset.scene.clip import bounds_kind
from zeroset.scene.surface import Surface
from zeroset.solve.method import Method


class Tracer:
    """The programs of one structure (formula, method, kind of bounds), made when they are first needed."""

    def __init__(self, surface: Surface, method: Method, device: Device, pixels: bool) -> None:
        self._field = surface.field
        self._method = method
        self._kind = bounds_kind(surface.fitted)
        self._device = device
        self._make_ray = camera_ray if pixels else given_ray
        self.beams = pixels and method.certified
        self._second_look = method.certified
        self._key = f"{surface.field.digest} {method.structure()} {self._kind} {pixels}"
        field, kind, offset, make_ray = self._field, self._kind, method.offset != 0.0, self._make_ray
        self._beam: Program | None = None
        if self.beams:
            self._beam = device.compile_cached(f"beams {self._key}", lambda: beam_kernel(field, offset, kind))
        self._first = device.compile_cached(
            f"first {self._key}",
            lambda: trace_kernel(field, method, kind, make_ray, self.beams, self._second_look),
        )
        self._second: Program | None = None

    def buffers(self, rays: int, tiles: int) -> dict[str, Any]:
        """Fresh buffers for so many rays and tiles."""
        wanted = FIELDS | (SECOND if self._second_look else {})
        made = {name: self._device.allocate(type_, rays) for name, type_ in wanted.items()}
        made[COUNTER] = self._device.allocate(U32, 1)
        if self.beams:
            made |= {name: self._device.allocate(F32, tiles) for name in ("tile_start", "tile_step")}
        return made

    def begin(self, surface: Surface, uniforms: Mapping[str, float], buffers: Mapping[str, Any], tiles: int) -> Mapping[str, Any]:
        """Start a frame: beams over all tiles, an empty list. Gives the buffers with the array parameters."""
        bound = {**buffers, **array_buffers(surface, self._device)} if surface.arrays else buffers
        self._device.write(buffers[COUNTER], np.zeros(1, np.uint32))
        if self._beam is not None:
            self._beam.run(tiles, uniforms, bound)
        return bound

    def first_look(self, uniforms: Mapping[str, float], bound: Mapping[str, Any], first: int, count: int) -> None:
        """Trace a run of rays."""
        self._first.run(count, {**uniforms, "first": first}, bound)

    def second_look(self, surface: Surface, uniforms: Mapping[str, float], bound: Mapping[str, Any]) -> None:
        """Trace what is on the list again, in f64."""
        count = int(self._device.read(bound[COUNTER])[0]) if self._second_look else 0
        if not count:
            return
        if self._second is None:
            field, kind, offset, make_ray = self._field, self._kind, self._method.offset != 0.0, self._make_ray
            self._second = self._device.compile_cached(
                f"second {self._key}", lambda: second_kernel(field, offset, kind, make_ray)
            )
        exact = {**uniforms, **parameter_uniforms(surface, self._method, F64)}
        arrays = array_buffers(surface, self._device, F64) if surface.arrays else {}
        self._second.run(count, exact, {**bound, **arrays})
