"""Thin parts: what of the surface lies between the rays because it is thinner than a pixel.

Down to lines and points without any thickness, such as Steiner's axes (SN10 figure 6, K09 figure 6). The same kernel
runs twice. First a lane is a block of 4x4 pixels of which a ray missed: the few blocks that may hold something thin
go on a list. Then a lane is a pixel of those blocks; where its own beam may hold something thin it is drawn, as
UNRESOLVED.
"""

from __future__ import annotations

from zeroset.kernel import F32, U32, Kernel, KernelBuilder, atomic, constant, if_, load, store
from zeroset.render.buffers import BLOCK, COUNTERS
from zeroset.render.gbuffer import write
from zeroset.render.layout import TILE, pixel_coordinates, tile_of
from zeroset.render.primary import EMPTY_TILE, camera_ray, t_range
from zeroset.render.view import frame_patch
from zeroset.solve.beam import find_thin
from zeroset.solve.field import Field, Lowered
from zeroset.solve.problem import Answer
from zeroset.solve.status import MISS, UNRESOLVED

FINENESS = 1.0, 0.125
"""The shortest step along a beam as a part of its width, for blocks and for pixels."""


def thin_kernel(field: Field, offset: bool, kind: str) -> Kernel:
    """Blocks (uniform ``fine`` 0) or the pixels of the blocks on the list (``fine`` 1)."""
    with KernelBuilder("thin") as builder:
        index = builder.index()
        fine = builder.uniform("fine", U32).ne(0)
        blocks = builder.buffer("thin_block", U32, writable=True)
        block = fine.select(load(blocks, index >> 4), index)
        lane = block * BLOCK + fine.select(index & (BLOCK - 1), constant(0, U32))
        lowered = Lowered(field, builder, offset=offset)

        # A block's middle lies a pixel and a half right of and below the middle of its first pixel.
        pixel = builder.uniform("pixel", F32)
        shift = fine.select(constant(0.0, F32), pixel * 1.5)
        u, v = pixel_coordinates(builder, lane)
        width = fine.select(constant(1.0, F32), 4.0)
        patch = frame_patch(builder, lowered, kind, u + shift, v - shift, pixel * width * 0.5)

        missed = load(builder.buffer("status", U32, writable=True), lane).eq(MISS)
        marked = load(builder.buffer("block_missed", U32), block).ne(0)
        tile = tile_of(lane)
        start, step = (load(builder.buffer(name, F32), tile) for name in ("tile_start", "tile_step"))
        start = (marked & (missed | ~fine)).select(start, EMPTY_TILE)
        shortest = fine.select(constant(FINENESS[1] / TILE, F32), 4.0 * FINENESS[0] / TILE)
        thin = find_thin(patch, start, t_range(builder)[1], step, builder.uniform("finest", F32) * shortest)

        def draw() -> None:
            answer = Answer(thin.t, constant(UNRESOLVED, U32), thin.steps, thin.t)
            if_(thin.found, lambda: write(builder, lowered, lane, camera_ray(builder, lane), answer))

        def append() -> None:
            counters = builder.buffer(COUNTERS, U32, writable=True)
            if_(thin.found, lambda: store(blocks, atomic("add", counters, 1, 1), block))

        if_(fine, draw, append)
    return builder.kernel
