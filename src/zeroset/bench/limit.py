"""The limit that frames are held against: one evaluation of f and its gradient for each pixel, by the same compiler.

No method that looks at every pixel can be faster than this, so the ratio of a frame to it says what finding the root
costs. The points come from the pixels' places, so that nothing can be computed beforehand, and one number a pixel is
stored, which keeps everything alive and measures evaluation rather than memory.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from zeroset.arith import F32 as FORMAT
from zeroset.arith import DualSystem, RealSystem
from zeroset.kernel import F32, Kernel, KernelBuilder, lift, store
from zeroset.rendering.layout import Layout, pixel_coordinates
from zeroset.rendering.values import Arrays, parameter_uniforms
from zeroset.runtime import Device
from zeroset.scene.surface import Surface
from zeroset.solve import resolve_method
from zeroset.solve.field import Field, Lowered

PLACE = ("center_x", "center_y", "center_z", "reach")
"""Uniforms that put the points into the bounds."""
TILT = ((1.0, 0.1, -0.2), (-0.3, 1.0, 0.4))
"""How x, y and z follow the frame's two coordinates: a slanted plane through the middle of the bounds."""


def limit_kernel(field: Field) -> Kernel:
    """f and its gradient on a plane of points, one a pixel, added up to one number."""
    with KernelBuilder("limit") as builder:
        lane = builder.index()
        u, v = pixel_coordinates(builder, lane)
        *center, reach = (builder.uniform(name, F32) for name in PLACE)
        point = [(u * a + v * b).fma(reach, c) for a, b, c in zip(*TILT, center, strict=True)]
        real = RealSystem(FORMAT)
        dual = DualSystem(real, 3)
        f = Lowered(field, builder).evaluate(dual, *(dual.variable(real.exact(p), i) for i, p in enumerate(point)))
        total = lift(f.value.value, F32)
        for i in range(3):
            total = total + f.derivative(i).value
        store(builder.buffer("limit", F32, writable=True), lane, total)
    return builder.kernel


def limit_action(surface: Surface, size: int, device: Device) -> Callable[[], None]:
    """What computes the limit of a square frame once, made ready to be timed.

    Args:
        surface: what is evaluated, with its parameters.
        size: pixels along a side.
        device: where to run.
    """
    layout = Layout(size, size)
    program = device.compile_cached(f"limit {surface.field.digest}", lambda: limit_kernel(surface.field))
    buffers = {"limit": device.allocate(F32, layout.lanes)} | Arrays(device).bind(surface)
    bounds = surface.fitted
    uniforms = layout.uniforms() | parameter_uniforms(surface, resolve_method("auto"))
    uniforms |= dict(zip(PLACE, (*bounds.center, bounds.reach), strict=True))
    return partial(program.run, layout.lanes, uniforms, buffers)
