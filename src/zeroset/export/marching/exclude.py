"""The kernel that finds blocks without anything of the mesh in them, with certainty.

An affine enclosure of f over the block excludes 0. Where f has two signs in a block it has a root there, or a jump that
its enclosure holds, so what is left out has no triangle: meshes with and without exclusion are the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zeroset.arith import F32 as FORMAT32
from zeroset.export.marching.passes import any_of, coordinates, last_of, position
from zeroset.kernel import F32, U32, Kernel, KernelBuilder, Value, load, store
from zeroset.scene.clip import outside, positive
from zeroset.solve.field import Field, Lowered
from zeroset.solve.systems import automatic_system


def exclude_kernel(field: Field, kind: str, capped: bool) -> Kernel:
    """Find the blocks of ``size`` cells that certainly hold nothing of the mesh, by an affine enclosure of f.

    Open meshes need what f = 0 touches inside the bounds. At a ball their blocks are looked at with one cell more in
    front: a triangle that the ball cuts needs its vertices outside too, and the next block may own them. Capped meshes
    need the bounds as well, where f <= 0.
    """
    with KernelBuilder("mesh exclude") as builder:
        lane = builder.index()
        code = load(builder.buffer("blocks", U32), lane)
        size, last = builder.uniform("size", U32), last_of(builder)
        first = [c * size for c in coordinates(code)]
        ahead = 1 if kind == "ball" and not capped else 0
        low = position(builder, [i - i.minimum(ahead) for i in first])
        high = position(builder, [(i + size).minimum(n) for i, n in zip(first, last, strict=True)])
        system = automatic_system(field, FORMAT32, symbols=3)
        point = [_side(system, i, a, b) for i, (a, b) in enumerate(zip(low, high, strict=True))]
        f = Lowered(field, builder).evaluate(system, *point)
        empty = ~f.contains_zero()
        if kind == "ball":
            out = outside(builder, kind, system, point)
            within = _inside_ball(builder, system, point)
            empty = (positive(f) | (positive(-f) & within) | out) if capped else empty | out
        elif capped:
            ghosts = builder.uniform("ghosts", U32)
            at_face = any_of([(i < ghosts) | (i + size >= n) for i, n in zip(first, last, strict=True)])
            empty = empty & (positive(f) | ~at_face)
        store(builder.buffer("kept", U32, writable=True), lane, (~empty).convert(U32))
    return builder.kernel


def _side(system: Any, symbol: int, low: Value, high: Value) -> Any:
    """The number that is anything between two coordinates."""
    middle = (low + high) * 0.5
    half = (high - middle).maximum(middle - low) * (1.0 + 2.0**-20)
    return system.symbol(symbol, middle, half)


def _inside_ball(builder: KernelBuilder, system: Any, point: Sequence[Any]) -> Value:
    """Whether a region certainly lies inside the ball."""
    *center, radius = (system.exact(builder.uniform(name, F32)) for name in ("bx0", "by0", "bz0", "bx1"))
    x, y, z = ((p - c).sqr() for p, c in zip(point, center, strict=True))
    return positive(radius.sqr() - (x + y + z))
