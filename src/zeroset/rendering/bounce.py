"""The passes of rays beyond the first hit: one run for each length of path, on two queues by turns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.kernel import Kernel
from zeroset.kernel.types import F32, U32
from zeroset.rendering.buffers import (
    ACCUMULATED,
    COUNTERS,
    LIGHT_WORDS,
    LIGHTS,
    PICTURE,
    QUEUE_WORDS,
    QUEUED,
    QUEUEING,
    TEXELS,
)
from zeroset.rendering.drawn import Drawn
from zeroset.rendering.layout import Layout
from zeroset.rendering.shading import Illumination, Optics
from zeroset.rendering.tint import Tint
from zeroset.rendering.tracer import Tracer
from zeroset.runtime import Counted, Device
from zeroset.solve.method import Method

TILE_LANES = 64
MOST_DEEP = 32
"""Runs in a row: surfaces that one ray may meet after the first."""
FARTHEST = 1e30


class Bounces:
    """The programs and buffers of one structure's further rays.

    Args:
        tracer: makes the programs along with its own.
        drawn: what the rays meet.
        method: of the frame, for its offset.
        optics: which rays there are.
        layout: of the frame.
        device: where.
        tint: what the surface is coloured by; None for nothing.
    """

    def __init__(
        self,
        tracer: Tracer,
        drawn: Drawn,
        method: Method,
        optics: Optics,
        layout: Layout,
        device: Device,
        tint: Tint | None = None,
    ) -> None:
        shape, offset = drawn.shape, method.offset != 0.0
        several = shape.parts > 1

        def first() -> Kernel:
            from zeroset.rendering.paths import first_path_kernel

            return first_path_kernel(shape, offset, optics, tint is not None)

        def path() -> Kernel:
            from zeroset.rendering.paths import path_kernel

            return path_kernel(shape, offset, optics, tint)

        def resolve() -> Kernel:
            from zeroset.rendering.paths import resolve_kernel

            return resolve_kernel(optics.plain)

        def edges() -> Kernel:
            from zeroset.rendering.antialias import edge_kernel

            return edge_kernel(tracer.beams, several)

        self._edges = f"edges {tracer.beams} {several}"
        if optics.smooth:
            tracer.add(self._edges, edges)
        own = f"{shape.digest} {offset} {optics}"
        first_own, path_own = ("", "") if tint is None else (" colored", f" {tint.digest}")
        self._names = f"path_first {own}{first_own}", f"path {own}{path_own}", f"resolve {optics.plain}"
        self._plain = optics.plain
        for name, build in zip(self._names, (first, path, resolve), strict=True):
            if not (self._plain and build is first):
                tracer.add(name, build)
        self._tracer = tracer
        self._device = device
        self._layout = layout
        self._capacity = max(layout.lanes * optics.rays_a_pixel, 1 << 14)
        self._queues = [device.allocate(U32, self._capacity * QUEUE_WORDS) for _ in range(2)]
        self._sums = device.allocate(U32, layout.lanes * 4)
        self._counters = device.allocate(U32, MOST_DEEP + 2)
        self._data: dict[str, tuple[Any, npt.NDArray[np.float32]]] = {}

    def run(
        self,
        uniforms: Mapping[str, float],
        bound: Mapping[str, Any],
        picture: Any,
        light: Illumination,
    ) -> None:
        """Shade what was found, follow the rays that come of it, and write the picture.

        Args:
            uniforms: the frame's, the material's and the surroundings'.
            bound: the frame's buffers, with what the camera's rays have found.
            picture: where the bytes go.
            light: the lights, the surroundings, and how far rays are followed.
        """
        first, _, resolve = self._names
        lights, texels, depth = light.lights, light.texels, light.depth
        sides = {} if texels is None else {"face_side": round((texels.size / 18) ** 0.5)}
        common = {
            **uniforms,
            **sides,
            "lights": len(lights) // LIGHT_WORDS,
            "capacity": self._capacity,
            "plane": self._layout.lanes,
            "farthest": FARTHEST,
            "shadow_tolerance": light.tolerance,
        }
        buffers = {**bound, ACCUMULATED: self._sums, COUNTERS: self._counters, LIGHTS: self._kept(LIGHTS, lights)}
        if texels is not None:
            buffers[TEXELS] = self._kept(TEXELS, texels)
        self._device.clear(self._sums)
        self._device.clear(self._counters)
        if not self._plain:
            numbers = {**common, "next": 0, "goes_on": int(depth > 0)}
            self._tracer.program(first).run(self._layout.lanes, numbers, {**buffers, QUEUEING: self._queues[0]})
            self._follow(depth, common, buffers)
        if light.samples > 1:
            self._smooth(light, common, buffers)
        self._tracer.program(resolve).run(self._layout.lanes, common, {**buffers, PICTURE: picture})

    def _follow(self, depth: int, common: Mapping[str, float], buffers: Mapping[str, Any]) -> None:
        """Follow what is on the first queue over so many surfaces."""
        path = self._tracer.program(self._names[1])
        here, there = self._queues
        for level in range(depth):
            numbers = {**common, "next": level + 1, "goes_on": int(level + 1 < depth)}
            path.run(Counted(self._counters, level), numbers, {**buffers, QUEUED: here, QUEUEING: there})
            here, there = there, here

    def _smooth(self, light: Illumination, common: Mapping[str, float], buffers: Mapping[str, Any]) -> None:
        """Draw pixels anew with many rays: parts of the frame by turns, as many as the queue is sure to hold."""
        edges = self._tracer.program(self._edges)
        lanes = self._layout.lanes
        # At edges there are far fewer: a quarter of all pixels is more than any picture has.
        share = light.samples if light.everywhere else max(light.samples // 4, 1)
        part = max(min(self._capacity // share, lanes) // TILE_LANES, 1) * TILE_LANES
        for first in range(0, lanes, part):
            self._device.clear(self._counters)
            numbers = {
                **common,
                "first": first,
                "next": 0,
                "samples": light.samples,
                "everywhere": int(light.everywhere),
            }
            edges.run(min(part, lanes - first), numbers, {**buffers, QUEUEING: self._queues[0]})
            self._follow(light.depth + 1, common, buffers)
            self._device.submit()

    def _kept(self, name: str, values: npt.NDArray[np.float32]) -> Any:
        """A buffer with these values, written anew where they have changed."""
        known = self._data.get(name)
        if known is None or len(known[1]) != len(values):
            known = self._device.allocate(F32, max(len(values), 1)), values
            self._device.write(known[0], values)
        elif known[1] is not values and not np.array_equal(known[1], values):
            self._device.write(known[0], values)
        self._data[name] = known[0], values
        return known[0]
