"""The G-buffer: what every tracing kernel writes for its ray, and the list of rays that deserve a second look.

Where there are several parts, what was met is the one of them that the search has left as possible, and of several such
the one that the point is nearest to, by |f| over the length of the gradient.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.arith import DualSystem, RealSystem
from zeroset.kernel import F32, F64, U32, KernelBuilder, Value, atomic, constant, if_, lift, store
from zeroset.rendering.buffers import CLEAR, COUNTERS, END, NORMAL, PART, SECOND, Ends, fields
from zeroset.solve.body import LoweredBody
from zeroset.solve.field import Lowered, Ray
from zeroset.solve.problem import Answer
from zeroset.solve.shape import Leaf
from zeroset.solve.status import MISS, UNRESOLVED
from zeroset.solve.subject import Subject

STEEPEST = {F32: 2.0**120, F64: 2.0**960}
"""The longest gradient whose direction can be told; one over the shortest."""
FAR = 1e30
"""Distance of what cannot be told."""


class _Slope(NamedTuple):
    """f at a point, its gradient up to ``scale`` and ``inverse``, which together are one over the gradient's length."""

    value: Value
    gradient: tuple[Value, Value, Value]
    scale: Value
    inverse: Value
    usable: Value

    @property
    def unit(self) -> tuple[Value, Value, Value]:
        a, b, c = (x * self.inverse for x in self.gradient)
        return a, b, c


def gradient_at(lowered: Lowered, point: Sequence[Value]) -> tuple[Value, Value, Value]:
    """The unit gradient of f at a point; zero where f has none."""
    return _slope_at(lowered, point).unit


def _slope_at(lowered: Lowered, point: Sequence[Value]) -> _Slope:
    real = RealSystem(FORMAT32 if lowered.type == F32 else FORMAT64)
    dual = DualSystem(real, 3)
    f = lowered.evaluate(dual, *(dual.variable(real.exact(p), i) for i, p in enumerate(point)))
    g = [lift(d.value, lowered.type) for d in map(f.derivative, range(3))]
    # Scale by the largest component first: squares of large or small gradients would overflow or vanish.
    largest = abs(g[0]).maximum(abs(g[1])).maximum(abs(g[2]))
    usable = (largest > 1.0 / STEEPEST[lowered.type]) & (largest < STEEPEST[lowered.type])
    scale = 1.0 / usable.select(largest, 1.0)
    a, b, c = (usable.select(x * scale, 0.0) for x in g)
    inverse = 1.0 / a.fma(a, b.fma(b, c * c)).maximum(1e-10).sqrt()
    return _Slope(lift(f.value.value, lowered.type), (a, b, c), scale, inverse, usable)


def facing_back(lowered: Lowered, ray: Ray, answer: Answer) -> tuple[Value, ...]:
    """The normal of what was found, f32.

    Beside an edge the gradient is mostly rounding; it is turned to the side that the ray was proven to come from.
    """
    return _turned(gradient_at(lowered, _point(ray, answer)), ray, answer)


def _point(ray: Ray, answer: Answer) -> list[Value]:
    return [answer.t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True)]


def _turned(normal: Sequence[Value], ray: Ray, answer: Answer) -> tuple[Value, ...]:
    along = sum((n * d for n, d in zip(normal, ray.direction, strict=True)), start=lift(0.0, answer.t.type))
    wrong = along * answer.side > 0.0
    return tuple(wrong.select(-n, n).convert(F32) for n in normal)


def meet(subject: Subject, ray: Ray, answer: Answer) -> tuple[Value, ...]:
    """The normal of what was found, f32, and its part, u32, where there is more than one."""
    if subject.shape.plain:
        return facing_back(subject.bodies[0].first, ray, answer)
    assert answer.mark is not None
    mark, point, none = answer.mark, _point(ray, answer), constant(0, U32)
    far = [constant(v, subject.type) for v in (2.0 * FAR, 0.0, 0.0, 0.0)]
    best: tuple[Value, ...] = (*far, none)
    for body, leaf, sign in subject.leaves():

        def near(body: LoweredBody = body, leaf: Leaf = leaf, sign: int = sign) -> tuple[Value, ...]:
            return _near(body, leaf, sign, mark, point)

        here = if_((mark & leaf.bits).ne(0), near, lambda: (*far, none))
        nearer = here[0] < best[0]
        best = tuple(nearer.select(a, b) for a, b in zip(here, best, strict=True))
    part = () if subject.shape.parts == 1 else (best[4],)
    return *_turned(best[1:4], ray, answer), *part


def _near(body: LoweredBody, leaf: Leaf, sign: int, mark: Value, point: Sequence[Value]) -> tuple[Value, ...]:
    """How far a point is from a leaf, about; the leaf's unit normal there, out of the solid; and the part."""
    slope = _slope_at(body.leaf(leaf), point)
    normal = slope.unit if sign > 0 else tuple(-n for n in slope.unit)
    off, part = abs(slope.value), constant(leaf.part, U32)
    if leaf.levels:
        off = constant(FAR, body.type)
        for i, value in enumerate(body.values(leaf)):
            here = (mark & (1 << (leaf.part + i))).ne(0).select(abs(slope.value - value), FAR)
            part = (here < off).select(constant(leaf.part + i, U32), part)
            off = off.minimum(here)
    distance = slope.usable.select(off * (slope.scale * slope.inverse), FAR).minimum(FAR)
    return distance, *normal, part


def behind(answer: Answer) -> Value:
    """Where a search that goes on along the same ray starts, f32: the find may lie at its end, so a hair later."""
    end = answer.end.convert(F32)
    return abs(end).fma(2.0**-22, end)


def write_ends(builder: KernelBuilder, lane: Value, answer: Answer, ends: Ends) -> None:
    """Store where rays that go on may do so."""
    places = {CLEAR: answer.clear.convert(F32), END: behind(answer)}
    for name in ends:
        store(builder.buffer(name, F32, writable=True), lane, places[name])


def write(builder: KernelBuilder, subject: Subject, lane: Value, ray: Ray, answer: Answer, ends: Ends = ()) -> None:
    """Store an answer, with the normal where something was found; ``ends``: and these places around it."""
    write_ends(builder, lane, answer, ends)
    buffers = {name: builder.buffer(name, type_, writable=True) for name, type_ in fields(subject.shape.parts).items()}

    names = NORMAL if subject.shape.parts == 1 else (*NORMAL, PART)

    def nowhere() -> tuple[float, ...]:
        return (0.0, 0.0, 0.0) if len(names) == 3 else (0.0, 0.0, 0.0, 0)

    found = answer.status.ne(MISS)
    for name, value in zip(names, if_(found, lambda: meet(subject, ray, answer), nowhere), strict=True):
        store(buffers[name], lane, value)
    store(buffers["t"], lane, found.select(answer.t, 0.0).convert(F32))
    store(buffers["status"], lane, answer.status)
    store(buffers["steps"], lane, answer.steps)


def ask_second_look(
    builder: KernelBuilder,
    lane: Value,
    answer: Answer,
    blunt: bool = False,
    since: tuple[Value, Value] | None = None,
) -> None:
    """Put an unresolved ray on the list, in no particular order.

    Args:
        builder: of the kernel.
        lane: the ray's place.
        answer: what it has met.
        blunt: whether one whose hit no slope has proven is put there too.
        since: which others, and from where on these are looked at again.
    """
    lanes, clear = (builder.buffer(name, type_, writable=True) for name, type_ in SECOND.items())
    counters = builder.buffer(COUNTERS, U32, writable=True)

    def append() -> None:
        slot = atomic("add", counters, 0, 1)
        store(lanes, slot, lane)
        store(clear, slot, reached.convert(F32))

    wanted, reached = answer.status.eq(UNRESOLVED), answer.clear
    if since is not None:
        wanted, reached = wanted | since[0], since[0].select(since[1], reached)
    if blunt and answer.blunt is not None:
        wanted = answer.status.ne(MISS) & (wanted | answer.blunt)
    if_(wanted, append)
