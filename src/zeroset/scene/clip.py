"""Bounds inside kernels: the stretch of a ray inside them, and whether a region lies outside them.

A stretch is a hair longer than the exact one, by what rounding may have taken off it: a root just inside the bounds
must not be lost, however far away the ray begins.

The bounds' numbers are uniforms, so moving or resizing them never recompiles; only ball or box shapes the kernel.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zeroset.arith import F32 as FORMAT32
from zeroset.kernel import F32, F64, KernelBuilder, Type, Value
from zeroset.scene.bounds import NAMES

ROUNDING = {F32: 2.0**-21, F64: 2.0**-50}
"""Covers the roundings of a stretch, none of which is more than a few times 2^-24, or 2^-53, of what goes in."""


def _uniforms(builder: KernelBuilder, prefix: str, type_: Type) -> list[Value]:
    return [builder.uniform(prefix + name, F32).convert(type_) for name in NAMES]


def clip(
    builder: KernelBuilder, kind: str, origin: Sequence[Value], direction: Sequence[Value], prefix: str = ""
) -> tuple[Value, Value]:
    """The stretch [t0, t1] of the whole line inside the bounds; t1 <= t0 where it misses them.

    It is computed in the rays' own type. ``prefix`` is before the names of the bounds' numbers, where a kernel has
    several.
    """
    bounds = _uniforms(builder, prefix, origin[0].type)
    return _clip_ball(bounds, origin, direction) if kind == "ball" else _clip_box(bounds, origin, direction)


def _dot(a: Sequence[Value], b: Sequence[Value]) -> Value:
    return a[0].fma(b[0], a[1].fma(b[1], a[2] * b[2]))


def _clip_ball(bounds: list[Value], origin: Sequence[Value], direction: Sequence[Value]) -> tuple[Value, Value]:
    rounding = ROUNDING[bounds[0].type]
    # By the point of closest approach, whose distance does not cancel when the eye is far away.
    to_center = [c - o for c, o in zip(bounds[:3], origin, strict=True)]
    length = _dot(direction, direction)
    middle = _dot(to_center, direction) / length
    nearest = [c - middle * d for c, d in zip(to_center, direction, strict=True)]
    # Rounding moves the point and the middle no farther than this.
    blur = (
        sum((abs(c) + abs(middle * d) for c, d in zip(to_center, direction, strict=True)), start=bounds[3]) * rounding
    )
    radius = bounds[3] + blur
    inside = radius * radius - _dot(nearest, nearest)
    along = _dot([abs(c) for c in to_center], [abs(d) for d in direction]) / length * rounding
    half = (inside.maximum(0.0) / length).sqrt() * (1.0 + rounding) + along
    return middle - half, (inside > 0.0).select(middle + half, middle - half)


def _clip_box(bounds: list[Value], origin: Sequence[Value], direction: Sequence[Value]) -> tuple[Value, Value]:
    rounding = ROUNDING[bounds[0].type]
    low: Value | None = None
    high: Value | None = None
    for o, d, lo, hi in zip(origin, direction, bounds[:3], bounds[3:], strict=True):
        # A direction along the face: a slope of 1e-20 puts the faces at the far ends, on the right sides.
        inverse = 1.0 / (abs(d) < 1e-20).select(1e-20, d)
        a, b = (lo - o) * inverse, (hi - o) * inverse
        low = a.minimum(b) if low is None else low.maximum(a.minimum(b))
        high = a.maximum(b) if high is None else high.minimum(a.maximum(b))
    assert low is not None
    assert high is not None
    return low - abs(low) * rounding, high + abs(high) * rounding


def outside(builder: KernelBuilder, kind: str, system: Any, point: Sequence[Any], prefix: str = "") -> Value:
    """Whether a region, given as numbers of an enclosing system, certainly lies outside the bounds."""
    type_ = F32 if system.fmt is FORMAT32 else F64
    bounds = [system.exact(v) for v in _uniforms(builder, prefix, type_)]
    if kind == "ball":
        squares = [(p - c).sqr() for p, c in zip(point, bounds[:3], strict=True)]
        distance = squares[0] + squares[1] + squares[2] - bounds[3].sqr()
        return positive(distance)
    result: Value | None = None
    for p, lo, hi in zip(point, bounds[:3], bounds[3:], strict=True):
        here = positive(lo - p) | positive(p - hi)
        result = here if result is None else result | here
    assert result is not None
    return result


def positive(number: Any) -> Value:
    """Whether every real of an enclosure is above 0."""
    low = number.interval().lo
    assert isinstance(low, Value)
    return low > 0.0
