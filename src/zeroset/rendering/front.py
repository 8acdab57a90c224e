"""Where in front of what a ray has met there may be something thin: neither before its tile's beam, nor close by.

Close by, the other rays through a tile or a pixel meet the same surface, the earlier the more it is turned away.
"""

from __future__ import annotations

from zeroset.kernel import F32, U32, KernelBuilder, Value, if_, load, store
from zeroset.rendering.buffers import EMPTY_TILE, NORMAL, OPEN
from zeroset.rendering.layout import pixel_coordinates
from zeroset.rendering.view import pixel_ray
from zeroset.shade.reflectance import dot
from zeroset.solve.status import MISS

STEEPEST = 3.0
"""Tangent of the angle between a ray and a normal that is reckoned with; also where there is no normal."""


def ask_for_thin(builder: KernelBuilder, lane: Value, start: Value) -> None:
    """Mark the block of a pixel whose ray had room for something thin; several lanes may store the same 1.

    Its tile's beam could not go on from ``start``. Either that was the surface that the ray has met soon after, or
    there may be something that the ray has passed by.
    """
    missed, t, reach = _met(builder, lane)
    marks = builder.buffer(OPEN, U32, writable=True)
    if_((missed | (t - start > reach)) & (start < EMPTY_TILE), lambda: store(marks, lane >> 4, 1))


def free_up_to(builder: KernelBuilder, lane: Value, far: Value) -> Value:
    """Up to where something thin is looked for in a pixel: ``far`` where its ray misses, else before what it met."""
    missed, t, reach = _met(builder, lane)
    return missed.select(far, t - reach)


def _met(builder: KernelBuilder, lane: Value) -> tuple[Value, Value, Value]:
    """Whether a pixel's ray has missed, where not, and how far in front of that the surface in its tile may reach."""
    status = load(builder.buffer("status", U32, writable=True), lane)
    t, *normal = (load(builder.buffer(name, F32, writable=True), lane) for name in ("t", *NORMAL))
    direction = pixel_ray(builder, *pixel_coordinates(builder, lane)).direction
    along, length = dot(direction, normal), dot(direction, direction)
    square = along * along
    # The squared tangent; |d|^2 can be a little less than (d n)^2 as they are rounded.
    squared = ((length - square) / square.maximum(length * 1e-6)).maximum(0.0)
    return status.eq(MISS), t, builder.uniform("finest", F32) * (squared.sqrt().minimum(STEEPEST) + 1.0)
