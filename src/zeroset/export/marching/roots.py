"""The kernels that put vertices onto the surface: the root of f on each crossing edge, and vertices at a ball's rim.

The root is bracketed by the signs at the edge's ends and stays so. The ITP method of Oliveira and Takahashi (2020)
takes the secant where it serves and never more evaluations than bisection and one.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

from zeroset.export.marching.lattice import MISSING
from zeroset.export.marching.passes import GHOST, is_ghost, place_of, position
from zeroset.export.marching.solid import LARGE, Point, Solid, dot, unit
from zeroset.kernel import F32, U32, Kernel, KernelBuilder, Scalar, Type, Value, constant, for_, load, store, while_
from zeroset.solve.field import Field

WITHIN, BEYOND, NO_ROOT = 0, 1, 2
"""Kinds of vertices: a root of f in the bounds; one outside them, or of a capped mesh one of the bounds themselves; a
pole, or an end of where f is defined."""
HALVINGS = 20
"""The bracket ends at 2^-20 of the edge; the last secant goes on from there."""
GROWTH = 8.0
"""A bracket at whose ends |f| has grown so many times holds a pole."""
TURNS = 8
"""Newton steps that a vertex of the rim may take."""
NEAR = 1e-2
"""How near the ball they must end, as a part of the edge that they began on."""


class Edge(NamedTuple):
    """An edge of the lattice, from f <= 0 to f > 0.

    Attributes:
        start: the end inside.
        way: from there to the other end.
        at: lattice points of both ends.
        values: of the function that is meshed at both ends.
    """

    start: tuple[Value, ...]
    way: tuple[Value, ...]
    at: tuple[Value, Value]
    values: tuple[Value, Value]

    @property
    def to_ghost(self) -> Value:
        """Whether the end outside is a ghost, which stands at the face itself."""
        return self.values[1] >= 0.5 * GHOST

    def point(self, t: Value) -> tuple[Value, ...]:
        """The point at a part of the way."""
        return tuple(t.fma(w, s) for s, w in zip(self.start, self.way, strict=True))


def root_kernel(field: Field, kind: str, capped: bool, type_: Type) -> Kernel:
    """One vertex a lane: where it lies, its normal, its kind, and the lattice point that it is at."""
    with KernelBuilder("mesh root") as builder:
        lane = builder.index()
        solid = Solid(field, builder, kind, capped, type_)
        edge = _edge(builder, load(builder.buffer("keys", U32), lane), type_)
        t, rooted = _root(solid, edge)
        point = edge.point(t)
        f, gradient = solid.slope(point)
        normal: Point = unit(gradient)
        g = solid.bounds(point)
        # A box's own faces have a direction that their triangles tell.
        beyond = edge.to_ghost if g is None else g > f if capped else g > 0.0
        if capped:
            out: Sequence[Scalar] = (0.0, 0.0, 0.0) if g is None else unit(solid.outward(point))
            normal = tuple(beyond.select(o, n) for o, n in zip(out, normal, strict=True))
        _write(builder, lane, point, normal)
        chosen = rooted.select(beyond.convert(U32), NO_ROOT)
        store(builder.buffer("kinds", U32, writable=True), lane, chosen)
        store(builder.buffer("at", U32, writable=True), lane, _met(builder, edge, t))
    return builder.kernel


def _write(builder: KernelBuilder, lane: Value, point: Point, normal: Point) -> None:
    """Store where a vertex lies and its normal."""
    vertices = builder.buffer("vertices", F32, writable=True)
    for i, value in enumerate((*point, *normal)):
        store(vertices, lane * 6 + i, value.convert(F32))


def _edge(builder: KernelBuilder, key: Value, type_: Type) -> Edge:
    """The edge of a key: the lane of its first point, then three bits that say which axes it goes along."""
    first, along = key >> 3, key & 7
    values = builder.buffer("values", type_)
    step = (along & 1) + (along & 2) * 4 + (along & 4) * 16
    here = place_of(builder, first).indices
    there = tuple(i + ((along >> axis) & 1) for axis, i in enumerate(here))
    a, b = load(values, first), load(values, first + step)
    turned = a > 0.0
    ends = [[v.convert(type_) for v in position(builder, indices)] for indices in (here, there)]
    points = [_number(builder, indices) for indices in (here, there)]
    # Differences of neighbouring coordinates, all nearly exact.
    start = tuple(turned.select(q, p) for p, q in zip(*ends, strict=True))
    other = tuple(turned.select(p, q) for p, q in zip(*ends, strict=True))
    way = tuple(q - p for p, q in zip(start, other, strict=True))
    at = (turned.select(points[1], points[0]), turned.select(points[0], points[1]))
    return Edge(start, way, at, (turned.select(b, a), turned.select(a, b)))


def _number(builder: KernelBuilder, indices: Point) -> Value:
    """A lattice point as one number; a ghost counts as no point of its own."""
    x, y, z = indices
    wide, deep = builder.uniform("last_x", U32) + 1, builder.uniform("last_y", U32) + 1
    return is_ghost(builder, indices).select(MISSING, (z * deep + y) * wide + x)


def _root(solid: Solid, edge: Edge) -> tuple[Value, Value]:
    """Where on the edge the root is, and whether it is one."""
    first, second = edge.values
    number = partial(constant, type_=solid.type)
    settled = edge.to_ghost | first.eq(0.0)
    goal = 2.0**-HALVINGS

    def running(a: Value, b: Value, fa: Value, fb: Value, room: Value) -> Value:
        return b - a > 2.0 * goal

    def turn(a: Value, b: Value, fa: Value, fb: Value, room: Value) -> tuple[Value, ...]:
        width, middle = b - a, (a + b) * 0.5
        secant = a - fa * (width / (fb - fa))
        towards = (middle - secant < 0.0).select(number(-1.0), 1.0)
        inward = 0.2 * width * width
        truncated = (abs(middle - secant) <= inward).select(middle, secant + towards * inward)
        radius = room - width * 0.5
        guess = (abs(truncated - middle) <= radius).select(truncated, middle - towards * radius)
        # What rounding made of it must still lie in the bracket.
        guess = (guess > a).select(guess, middle)
        guess = (guess < b).select(guess, middle)
        value, defined = solid.value(edge.point(guess))
        value = defined.select(value, LARGE)
        low, high = value <= 0.0, value >= 0.0
        return low.select(guess, a), high.select(guess, b), low.select(value, fa), high.select(value, fb), room * 0.5

    zero = number(0.0)
    a, b, fa, fb, _ = while_(running, turn, zero, settled.select(zero, 1.0), first, second, number(1.0))
    t = a - fa * ((b - a) / (fb - fa).maximum(1e-37))
    t = ((t >= a) & (t <= b)).select(t, a)
    grown = (-fa).minimum(fb) > GROWTH * (-first).maximum(second)
    rooted = settled | ~(grown | (fb >= LARGE))
    return settled.select(zero, t), rooted


def _met(builder: KernelBuilder, edge: Edge, t: Value) -> Value:
    """The lattice point that a vertex lies at, within what float32 can tell."""
    x, y, z = (abs(w) for w in edge.way)
    longest = x.maximum(y).maximum(z)
    near = builder.uniform("snap", F32).convert(t.type)
    here, there = t * longest <= near, (1.0 - t) * longest <= near
    return here.select(edge.at[0], there.select(edge.at[1], MISSING))


def rim_kernel(field: Field, capped: bool, type_: Type) -> Kernel:
    """One vertex of a ball's rim a lane: from between a vertex within and one beyond, to where f and g vanish."""
    with KernelBuilder("mesh rim") as builder:
        lane = builder.index()
        solid = Solid(field, builder, "ball", capped, type_)
        ends = builder.buffer("ends", F32)
        p, q = (tuple(load(ends, lane * 6 + 3 * end + i).convert(type_) for i in range(3)) for end in range(2))
        way = tuple(b - a for a, b in zip(p, q, strict=True))
        # Between a root of f and one of the ball nothing better is known than the middle.
        t = constant(0.5, type_) if capped else _leaving(solid, p, way)
        start = tuple(t.fma(w, a) for w, a in zip(way, p, strict=True))
        reach = dot(way, way).sqrt()

        def turn(_: Value, *point: Value) -> tuple[Value, ...]:
            off = tuple(m - c for m, c in zip(_towards_both(solid, point), start, strict=True))
            # A step that leaves the neighbourhood is no step of Newton's any more.
            share = (reach / dot(off, off).sqrt().maximum(1e-37)).minimum(1.0)
            return tuple(share.fma(o, c) for o, c in zip(off, start, strict=True))

        moved = for_(TURNS, turn, *start)
        g = solid.bounds(moved)
        assert g is not None
        # At jumps, and where f and the ball touch, there is nothing to converge to.
        arrived = abs(g) <= reach * NEAR
        point = tuple(arrived.select(m, c) for m, c in zip(moved, start, strict=True))
        _write(builder, lane, point, unit(solid.slope(point)[1]))
    return builder.kernel


def _leaving(solid: Solid, start: Point, way: Point) -> Value:
    """Where a way out of the ball crosses it, as a part of the way."""
    out, g = solid.outward(start), solid.bounds(start)
    assert g is not None
    # |out + t way|^2 = radius^2, by the form of the root that does not cancel; g is (|out|^2 - radius^2) / 2 radius.
    a, b, c = dot(way, way), dot(out, way), (-2.0 * solid.radius * g).maximum(0.0)
    root = b.fma(b, a * c).sqrt()
    t = (b > 0.0).select(c / (b + root).maximum(1e-37), (root - b) / a.maximum(1e-37))
    return t.minimum(1.0)


def _towards_both(solid: Solid, point: Point) -> tuple[Value, ...]:
    """The shortest step after which f and the bounds vanish, as their gradients have it."""
    f, gradient = solid.slope(point)
    g = solid.bounds(point)
    assert g is not None
    along, out = unit(gradient), unit(solid.outward(point))
    # In lengths: f over the size of its gradient; g is one already.
    steepness = dot(gradient, along)
    usable = (steepness > 1e-30) & (steepness < LARGE)
    f = usable.select(f / usable.select(steepness, 1.0), 0.0)
    cosine = dot(along, out)
    sine = 1.0 - cosine * cosine
    steep = usable & (sine > 1e-3)
    scale = steep.select(1.0 / steep.select(sine, 1.0), 0.0)
    by_f, by_g = (f - cosine * g) * scale, (g - cosine * f) * scale
    return tuple(p - by_f * a - by_g * o for p, a, o in zip(point, along, out, strict=True))


__all__ = ["BEYOND", "NO_ROOT", "WITHIN", "rim_kernel", "root_kernel"]
