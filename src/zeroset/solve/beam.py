"""Beams: one conservative search for all rays of a screen tile, affine in u, v and t.

A tile's rays are o + t d with o and d affine in the frame coordinates u and v. On numbers with three symbols f is
enclosed over the whole beam between two values of t, and what is excluded there is excluded for each of its rays. The
beam strides from the near end; once its step comes down to about its own width it stops, and the tile's rays start
there. A tile whose beam reaches the far end has no hit at all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from zeroset.kernel import U32, Value, constant, while_
from zeroset.solve.field import Lowered


@dataclass(frozen=True, slots=True)
class Beam:
    """Where a tile's rays may start: t, a first step, and whether nothing is hit at all."""

    start: Value
    step: Value
    empty: Value
    steps: Value


def point_on_beam(system: Any, origin: Sequence[Any], direction: Sequence[Any], t: Any) -> list[Any]:
    """o + t d on numbers of a three-symbol system."""
    return [o + d * t for o, d in zip(origin, direction, strict=True)]


def trace_beam(
    lowered: Lowered,
    system: Any,
    origin: Sequence[Any],
    direction: Sequence[Any],
    near: Value,
    far: Value,
    finest: Value,
    outside: Callable[[Sequence[Any]], Value],
) -> Beam:
    """Stride along one beam until a step of ``finest`` cannot be excluded.

    Args:
        lowered: f in this kernel.
        system: a three-symbol affine system; symbol 2 is t.
        origin: origins of the tile's rays, as numbers in u and v.
        direction: their directions.
        near: start of the search, at or before each ray's own.
        far: its end.
        finest: the shortest step worth trying.
        outside: says where a region lies outside the bounds.
    """

    def running(a: Value, h: Value, done: Value, steps: Value) -> Value:
        return ~done & (a < far)

    def turn(a: Value, h: Value, done: Value, steps: Value) -> tuple[Value, ...]:
        b = a + h
        middle = (a + b) * 0.5
        half = (b - middle).maximum(middle - a) * (1.0 + 2.0**-20)
        point = point_on_beam(system, origin, direction, system.symbol(2, middle, half))
        f = lowered.evaluate(system, *point)
        excluded = ~f.contains_zero() | outside(point)
        stop = ~excluded & (h <= finest)
        return excluded.select(b, a), excluded.select(h * 2.0, stop.select(h, h * 0.5)), stop, steps + 1

    step = ((far - near) * 0.25).maximum(finest)
    false = ~(near.eq(near))
    a, h, done, steps = while_(running, turn, near, step, false, constant(0, U32))
    return Beam(a, h, ~done, steps)
