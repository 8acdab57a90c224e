"""Bounds for a surface that has none: subdivide space with intervals and keep the boxes that can hold a zero.

All boxes of a level are evaluated at once, as intervals over NumPy arrays. The hull of what is kept tightens level by
level; a surface that still reaches the ends of the searched cube goes on for ever as far as a picture is concerned,
and gets a ball of a handy size instead.

Intervals do not see that terms cancel: x^4 + y^4 + z^4 - r^4/4 may be 0 in boxes of a sixteenth of their distance,
however far away they are. Where f has one sign in all boxes that are far out, affine forms look again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.arith import F64, AffineSystem, IntervalSystem
from zeroset.scene.bounds import Ball
from zeroset.scene.parameters import LARGEST
from zeroset.scene.solid import Solid
from zeroset.scene.surface import Surface

SEARCHED = 64.0, 64.0**2, 64.0**3
"""Half the sides of the cubes that are searched, each if there is nothing in the one before."""
UNBOUNDED = 6.0
"""Radius that a surface gets which leaves the first cube; one that leaves a larger one gets more in proportion."""
NOTHING = Ball(1.0)
"""Bounds of what is nowhere in the largest cube."""
BOXES = 2500
"""Boxes that a level may keep; beyond, the hull is good enough."""
EVALUATIONS = 1_000_000
"""Operations on boxes that a level may cost: long formulas keep fewer boxes."""
LEVELS = 12
FINEST = 40
"""Levels that a small thing may cost, of which a box holds all at the usual ones."""
ROUGH = 0.125
"""A box's side as a share of what is left, above which that is told too roughly."""
LOOSE, SAMPLES = 1.5, 200
"""Boxes from this share of the farthest one's distance on are looked at for changes of sign, so many of them."""
INTERVALS = IntervalSystem(F64)
FORMS = AffineSystem(F64, symbols=3, intersect=True)

Corners = npt.NDArray[np.float64]
Number = Any
"""An interval or an affine form, over arrays."""
System = IntervalSystem | AffineSystem


def fit_bounds(thing: Surface | Solid) -> Ball:
    """The smallest ball found around a surface or a solid's skin; the unit ball where space holds no zero at all."""
    for i, half in enumerate(SEARCHED):
        low, high = _kept(thing, INTERVALS, half, LEVELS + 6 * i)
        if len(low):
            break
    else:
        return NOTHING
    if _loose(thing, low, high):
        closer = _kept(thing, FORMS, half, LEVELS + 6 * i)
        low, high = closer if len(closer[0]) else (low, high)
    if np.any(low.min(axis=0) <= -half) or np.any(high.max(axis=0) >= half):
        # Of what begins farther out at least the nearest part is in it.
        nearest = float(np.sqrt((np.maximum(np.maximum(low, -high), 0.0) ** 2).sum(axis=1)).min())
        return Ball(max(UNBOUNDED * half / SEARCHED[0], 1.5 * nearest))
    center = 0.5 * (low.min(axis=0) + high.max(axis=0))
    far = np.maximum(np.abs(low - center), np.abs(high - center))
    radius = float(np.sqrt((far**2).sum(axis=1)).max())
    # A ball around the origin reads better and costs little where the surface is nearly centred.
    about_origin = float(np.sqrt((np.maximum(np.abs(low), np.abs(high)) ** 2).sum(axis=1)).max())
    if about_origin <= 1.1 * radius:
        return Ball(about_origin * 1.01)
    return Ball(radius * 1.01, (float(center[0]), float(center[1]), float(center[2])))


def _kept(thing: Surface | Solid, system: System, half: float, levels: int) -> tuple[Corners, Corners]:
    """Lower and upper corners of boxes in a cube, as small as there is room for, outside of which is no zero."""
    low, high = np.full((1, 3), -half), np.full((1, 3), half)
    most = min(BOXES, max(64, EVALUATIONS // sum(surface.field.work for surface in thing.surfaces)))
    for level in range(FINEST):
        extent = (high.max(axis=0) - low.min(axis=0)).max()
        if level >= levels and (high[0] - low[0]).max() < ROUGH * extent:
            break
        inner_low, inner_high = _split(low, high)
        kept = _may_hold_zero(thing, system, inner_low, inner_high)
        low, high = inner_low[kept], inner_high[kept]
        if not len(low) or len(low) > most:
            break
    return low, high


def _loose(thing: Surface | Solid, low: Corners, high: Corners) -> bool:
    """Whether the boxes farthest out seem to hold nothing: at no corner of theirs a function has another sign."""
    sizes = np.sqrt((np.maximum(np.abs(low), np.abs(high)) ** 2).sum(axis=1))
    far = np.flatnonzero(sizes * LOOSE >= sizes.max())
    some = far[:: -(-len(far) // SAMPLES)]
    low, high = low[some], high[some]
    corners = np.concatenate([np.where([c >> axis & 1 for axis in range(3)], high, low) for c in range(8)])
    values = _values(thing, corners).reshape(8, -1)
    levels = (0.0,) if isinstance(thing, Solid) else thing.isovalues or (0.0,)
    for level in levels:
        above = values > level
        if np.any(above.any(axis=0) & ~above.all(axis=0)):
            return False
    return True


def _values(thing: Surface | Solid, points: Corners) -> Corners:
    """f at points; of a solid something that is above 0 outside of it and below 0 inside."""
    if isinstance(thing, Surface):
        return values_at(thing, points)
    parts = [_values(part, points) for part in thing.of]
    if thing.op == "not":
        return -parts[0]
    return np.fmin(*parts) if thing.op == "or" else np.fmax(*parts)


def values_at(surface: Surface, points: Corners) -> Corners:
    """f at points, (N, 3), as closely as an enclosure tells it; NaN where it is not defined, or too large.

    Example:
        >>> import zeroset as zs
        >>> values_at(zs.surface("x^2 + y^2 - 1"), np.array([[0.0, 0.0, 5.0], [2.0, 0.0, 0.0]])).round(9).tolist()
        [-1.0, 3.0]
    """
    f = _over(surface, INTERVALS, points, points).interval()
    low, high = np.asarray(f.lo), np.asarray(f.hi)
    # Ends near the largest floats say that nothing is known.
    known = np.maximum(np.abs(low), np.abs(high)) < LARGEST
    return np.broadcast_to(np.where(known, 0.5 * (low + high), np.nan), (len(points),))


def _split(low: Corners, high: Corners) -> tuple[Corners, Corners]:
    """The eight halves of each box."""
    middle = 0.5 * (low + high)
    lows, highs = [], []
    for corner in range(8):
        upper = np.array([corner >> axis & 1 for axis in range(3)], bool)
        lows.append(np.where(upper, middle, low))
        highs.append(np.where(upper, high, middle))
    return np.concatenate(lows), np.concatenate(highs)


def _may_hold_zero(thing: Surface | Solid, system: System, low: Corners, high: Corners) -> npt.NDArray[np.bool_]:
    if isinstance(thing, Solid):
        return np.equal(_sign(thing, system, low, high), 0)
    f = _over(thing, system, low, high)
    with np.errstate(all="ignore"):
        values = [f - system.constant(v, v) for v in thing.isovalues] or [f]
        found = np.zeros(len(low), bool)
        for value in values:
            found |= np.asarray(value.contains_zero())
    return found


def _over(surface: Surface, system: System, low: Corners, high: Corners) -> Number:
    with np.errstate(all="ignore"):
        f: Number = surface.field.evaluate(system, _Boxes(surface, system, low, high))
    return f


def _sign(thing: Surface | Solid, system: System, low: Corners, high: Corners) -> npt.NDArray[np.int8]:
    """+1 outside, -1 inside, 0 where a box may hold some of the skin."""
    if isinstance(thing, Surface):
        f = _over(thing, system, low, high)
        # What has no value is not <= 0: inside is only where f is known to be defined.
        outside = np.asarray(f.signs()[0]) | np.asarray(f.empty)
        inside = ~np.asarray(f.contains_zero()) & ~outside & (np.asarray(f.defined) | thing.field.total)
        return np.broadcast_to(np.where(outside, 1, np.where(inside, -1, 0)), (len(low),)).astype(np.int8)
    signs = [_sign(part, system, low, high) for part in thing.of]
    if thing.op == "not":
        return np.negative(signs[0])
    return np.minimum(*signs) if thing.op == "or" else np.maximum(*signs)


class _Boxes:
    """Leaves of f over many boxes at once."""

    def __init__(self, surface: Surface, system: System, low: Corners, high: Corners) -> None:
        self._surface = surface
        self._system = system
        self._axes: dict[str, Number]
        if isinstance(system, AffineSystem):
            middle = 0.5 * (low + high)
            half = np.maximum(high - middle, middle - low) * (1.0 + 2.0**-40)
            self._axes = {name: system.symbol(i, middle[:, i], half[:, i]) for i, name in enumerate("xyz")}
        else:
            self._axes = {name: system.bounds(low[:, i], high[:, i]) for i, name in enumerate("xyz")}

    def variable(self, name: str) -> Number:
        known = self._axes.get(name)
        return known if known is not None else self.parameter(name)

    def parameter(self, name: str) -> Number:
        value = self._surface.params[name]
        return self._system.constant(value, value)

    def sum(self, system: Any, arrays: tuple[str, ...], body: Callable[[Mapping[str, Any]], Any]) -> Number:
        total = system.constant(0.0, 0.0)
        for values in zip(*(self._surface.arrays[name] for name in arrays), strict=True):
            total = total + body({n: system.constant(float(v), float(v)) for n, v in zip(arrays, values, strict=True)})
        result: Number = total
        return result
