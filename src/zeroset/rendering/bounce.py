"""The passes of rays beyond the first hit, and of pixels that have many rays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from zeroset.kernel import Kernel
from zeroset.kernel.types import F32, U32
from zeroset.rendering.buffers import (
    COUNTERS,
    EDGES,
    LIGHT_WORDS,
    LIGHTS,
    PICTURE,
    STACK,
    STACK_WORDS,
    TEXELS,
)
from zeroset.rendering.drawn import Drawn
from zeroset.rendering.layout import Layout
from zeroset.rendering.shading import Illumination, Optics
from zeroset.rendering.tracer import Tracer
from zeroset.runtime import Counted, Device
from zeroset.solve.method import Method

if TYPE_CHECKING:
    from zeroset.rendering.tint import Tint

TILE_LANES = 64
STACK_BYTES = 1 << 26
"""Memory for rays that wait."""
AT_ONCE = 1 << 20
"""Rays handed over at once: systems end the work of a GPU that takes seconds over it."""
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
        shader: the program that shades what was found and lists its edges, where the first hit is all; None elsewhere.

    Attributes:
        exact: whether they read all numbers in f64 too.
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
        shader: str | None = None,
    ) -> None:
        shape, offset = drawn.shape, method.offset != 0.0
        several = shape.parts > 1

        def path() -> Kernel:
            from zeroset.rendering.paths import path_kernel

            return path_kernel(shape, offset, optics, tint, self.exact)

        def sample() -> Kernel:
            from zeroset.rendering.paths import sample_kernel

            return sample_kernel(shape, offset, optics, tracer.beams, tint, self.exact)

        def edges() -> Kernel:
            from zeroset.rendering.antialias import edge_kernel

            return edge_kernel(tracer.beams, several)

        # Layers are counted: what is only rounding must not be one. Mirrored rays are as certain as the camera's.
        # So are shadows where f32 does not know the numbers.
        self.exact = (optics.through or optics.mirror or shape.large) and tracer.exact
        own = f"{shape.digest} {offset} {optics} {self.exact}{'' if tint is None else f' {tint.digest}'}"
        self._path, self._sample = f"path {own}", f"sample {own} {tracer.beams}"
        self._edges = shader or f"edges {tracer.beams} {several}"
        if not optics.plain:
            tracer.add(self._path, path)
        if optics.smooth:
            if shader is None:
                tracer.add(self._edges, edges)
            tracer.add(self._sample, sample)
        self._optics = optics
        self._tracer = tracer
        self._device = device
        self._layout = layout
        self._listed = device.allocate(U32, layout.lanes) if optics.smooth else None
        self._counters = device.allocate(U32, 1)
        self._stack: tuple[int, Any] | None = None
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
        lights, texels = light.lights, light.texels
        sides = {} if texels is None else {"face_side": round((texels.size / 18) ** 0.5)}
        common = {
            **uniforms,
            **sides,
            "lights": len(lights) // LIGHT_WORDS,
            "depth": light.depth,
            "plane": self._plane(light.depth),
            "farthest": FARTHEST,
            "shadow_tolerance": light.tolerance,
        }
        buffers = {**bound, PICTURE: picture, COUNTERS: self._counters, LIGHTS: self._kept(LIGHTS, lights)}
        if texels is not None:
            buffers[TEXELS] = self._kept(TEXELS, texels)
        if self._optics.branches:
            buffers[STACK] = self._stacked(common["plane"] * max(light.depth, 1))
        if not self._optics.plain:
            path, lanes = self._tracer.program(self._path), self._layout.lanes
            for first in range(0, lanes, common["plane"]):
                path.run(min(common["plane"], lanes - first), {**common, "first": first}, buffers)
                self._device.submit()
        if light.samples > 1:
            self._smooth(light, common, {**buffers, EDGES: self._listed})

    def _smooth(self, light: Illumination, common: Mapping[str, float], buffers: Mapping[str, Any]) -> None:
        """Draw pixels anew with many rays: parts of the frame by turns, so that none of them takes long."""
        edges, sample = self._tracer.program(self._edges), self._tracer.program(self._sample)
        lanes = self._layout.lanes
        # At edges there are far fewer: a quarter of all pixels is more than most pictures have.
        share = light.samples if light.everywhere else max(light.samples // 4, 1)
        part = max(min(AT_ONCE // share, int(common["plane"])) // TILE_LANES, 1) * TILE_LANES
        for first in range(0, lanes, part):
            numbers = {**common, "first": first, "samples": light.samples, "everywhere": int(light.everywhere)}
            self._device.clear(self._counters)
            edges.run(min(part, lanes - first), numbers, buffers)
            sample.run(Counted(self._counters, 0), numbers, buffers)
            self._device.submit()

    def _plane(self, depth: int) -> int:
        """Lanes of a run: where two rays may come of one, each needs room for those that wait."""
        most = min(AT_ONCE, self._layout.lanes)
        if not self._optics.branches:
            return most
        room = min(self._device.largest, STACK_BYTES) // (4 * STACK_WORDS * max(depth, 1))
        return max(min(most, room) // TILE_LANES, 1) * TILE_LANES

    def _stacked(self, rays: int) -> Any:
        """The stack, with room for so many rays that wait."""
        if self._stack is None or self._stack[0] < rays:
            self._stack = rays, self._device.allocate(U32, rays * STACK_WORDS)
        return self._stack[1]

    def _kept(self, name: str, values: npt.NDArray[np.float32]) -> Any:
        """A buffer with these values, written anew where they have changed."""
        known = self._data.get(name)
        if known is None or len(known[1]) != len(values):
            known = self._device.allocate(F32, max(len(values), 1), constant=name == LIGHTS), values
            self._device.write(known[0], values)
        elif known[1] is not values and not np.array_equal(known[1], values):
            self._device.write(known[0], values)
        self._data[name] = known[0], values
        return known[0]
