"""The truth of solids and isovalues: each leaf's roots certified by Arb, combined by the boolean.

Between its roots each leaf keeps its sign, so the solid's inside and outside, or how many isovalues are below f, follow
from the signs at the start and the roots in order. A root of a leaf that changes neither is no event at all: a search
that reports it is wrong.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

import zeroset as zs
from zeroset import Surface
from zeroset.scene.solid import Solid

from .judge import EDGE, Event, Kind, Line, Verdict, Work, _bisected, _Cells, _exact
from .tape import Tape

APART = 8.0
"""Tolerances between two roots of leaves, closer than which a search may take them for one."""
WORK = 3000


@dataclass(frozen=True)
class Met:
    """What a ray certainly meets first: the verdict, and the part of its root."""

    verdict: Verdict
    part: int | None


class Skin:
    """Judges rays at a solid's skin, or at isovalues."""

    def __init__(self, thing: Solid | Surface) -> None:
        self.thing = thing
        self._leaves = thing.surfaces if isinstance(thing, Solid) else tuple(_minus(thing, v) for v in thing.isovalues)
        self._tapes = [Tape(leaf) for leaf in self._leaves]

    def label(self, signs: Sequence[int]) -> int:
        """Inside (-1) or outside (+1) of a solid; how many isovalues are below f."""
        if isinstance(self.thing, Solid):
            return _sign(self.thing, dict(zip(self._leaves, signs, strict=True)))
        return sum(sign > 0 for sign in signs)

    def first(self, origin: Sequence[float], direction: Sequence[float]) -> Met | None:
        """What the exact ray meets first; None where Arb left something open, or leaves meet in one place."""
        line = Line(self.thing, origin, direction)  # type: ignore[arg-type]
        outer, inner = (line.stretch(wider, 0.0, np.inf) for wider in (EDGE, -EDGE))
        if outer is None:
            return Met(Verdict((), line.tolerance, None, 0), None)
        events, signs = [], []
        for leaf, tape in enumerate(self._tapes):
            work = Work(WORK)
            polynomial = tape.polynomial(line.origin, line.direction)
            found = _exact(polynomial, outer) if polynomial is not None else _bisected(tape, line, outer, work)
            events += [(float(a), float(b), kind, leaf) for a, b, kind in found]
            signs.append(_Cells(tape, line, Work(WORK))._sign(outer[0]))
        events.sort()
        near = any(b[0] - a[1] < APART * line.tolerance for a, b in pairwise(events))
        if near or 0 in signs or any(kind is not Kind.CROSS for _, _, kind, _ in events):
            return None
        made: list[Event] = []
        part = None
        for a, b, kind, leaf in events:
            before = self.label(signs)
            signs[leaf] = -signs[leaf]
            if self.label(signs) == before:
                continue
            inside = inner is not None and a >= float(inner[0]) and b <= float(inner[1])
            made.append(Event(a, b, kind, not inside))
            if inside:
                part = leaf
                break
        return Met(Verdict(tuple(made), line.tolerance, (float(outer[0]), float(outer[1])), 0), part)


def _minus(surface: Surface, value: float) -> Surface:
    """f - value as a surface of its own."""
    return zs.surface(surface.field.expr - value, dict(surface.params) | dict(surface.arrays))


def _sign(thing: Solid | Surface, signs: dict[Surface, int]) -> int:
    if isinstance(thing, Surface):
        return signs[thing]
    of = [_sign(part, signs) for part in thing.of]
    return -of[0] if thing.op == "not" else max(of) if thing.op == "and" else min(of)


def aimed(thing: Solid | Surface, count: int, seed: int) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    """Rays from outside, from inside and from far away, some along the axes, of all lengths."""
    rng = np.random.default_rng(seed)
    bounds = thing.fitted
    center, reach = np.asarray(bounds.center), bounds.reach
    target = center + reach * rng.uniform(-0.6, 0.6, (count, 3))
    far = rng.choice([0.3, 3.0, 3.0, 3.0, 100.0], count)[:, None]
    origin = center + far * reach * _unit(rng.normal(size=(count, 3)))
    along = rng.random(count) < 0.15
    origin[along, :2] = target[along, :2]
    way = _unit(target - origin)
    scale = np.where(rng.random(count) < 0.3, 10.0 ** rng.uniform(-2, 2, count), 1.0)
    return origin.astype(np.float32), (way * scale[:, None]).astype(np.float32)


def _unit(v: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    return np.asarray(v / np.linalg.norm(v, axis=1, keepdims=True))
