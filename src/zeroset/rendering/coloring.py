"""The passes of a colouring: the value of every pixel, the range that they are seen in, and the colours as a buffer."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from zeroset.kernel import Kernel
from zeroset.kernel.types import F32
from zeroset.rendering.buffers import COLORS, VALUE
from zeroset.rendering.drawn import Drawn
from zeroset.rendering.layout import Layout
from zeroset.rendering.tint import Palette, Tint, found_range
from zeroset.rendering.tracer import Tracer
from zeroset.rendering.values import Arrays
from zeroset.runtime import Device
from zeroset.shade.colormap import LARGEST, STEPS
from zeroset.solve.method import Method
from zeroset.solve.status import MISS


class Colors:
    """The program and the buffers of one structure's colouring.

    Args:
        tracer: makes the program along with its own.
        method: of the frame, for its offset.
        tint: by what.
        layout: of the frame.
        device: where.

    Attributes:
        values: the buffer of values, one a pixel.
        range: values of the first and the last colour in the last picture.
    """

    def __init__(self, tracer: Tracer, method: Method, tint: Tint, layout: Layout, device: Device) -> None:
        offset = method.offset != 0.0

        def build() -> Kernel:
            from zeroset.rendering.measure import value_kernel

            return value_kernel(offset, tint)

        self._name = f"value {offset} {tint.digest}"
        tracer.add(self._name, build)
        self._tracer = tracer
        self._method = method
        self._tint = tint
        self._layout = layout
        self._device = device
        self._arrays = Arrays(device)
        self.values = device.allocate(F32, layout.lanes)
        self._table = device.allocate(F32, 3 * (STEPS + 1))
        self.range = (0.0, 1.0)

    def run(
        self, drawn: Drawn, palette: Palette, uniforms: Mapping[str, float], bound: Mapping[str, Any]
    ) -> tuple[dict[str, float], dict[str, Any]]:
        """Find the values; gives the uniforms and buffers with all that shading needs to show them.

        Args:
            drawn: of this structure.
            palette: the colours.
            uniforms: the frame's.
            bound: the frame's buffers, with what the camera's rays have found.
        """
        numbers = {**uniforms, **palette.view, **self._tint.uniforms(drawn, self._method)}
        buffers = {**bound, VALUE: self.values, COLORS: self._table}
        if drawn.arrays:
            buffers |= drawn.bind(self._arrays, self._tint.type)
        self._device.write(self._table, palette.table)
        self._tracer.program(self._name).run(self._layout.lanes, numbers, buffers)
        self.range = palette.range or self._found(palette, bound)
        return numbers | palette.uniforms(*self.range), buffers

    def _found(self, palette: Palette, bound: Mapping[str, Any]) -> tuple[float, float]:
        # This waits for the device: whoever knows the range says it.
        values = self._layout.unscramble(self._device.read(self.values))
        seen = (self._layout.unscramble(self._device.read(bound["status"])) != MISS) & (np.abs(values) <= LARGEST)
        return found_range(values[seen], palette.coloring.centred)
