"""The G-buffer: what every tracing kernel writes for its ray, and the list of rays that deserve a second look."""

from __future__ import annotations

from collections.abc import Sequence

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.arith import DualSystem, RealSystem
from zeroset.kernel import F32, U32, KernelBuilder, Value, atomic, if_, lift, store
from zeroset.rendering.buffers import COUNTERS, END, FIELDS, NORMAL, SECOND
from zeroset.solve.field import Lowered, Ray
from zeroset.solve.problem import Answer
from zeroset.solve.status import MISS, UNRESOLVED


def gradient_at(lowered: Lowered, point: Sequence[Value]) -> tuple[Value, Value, Value]:
    """The unit gradient of f at a point; zero where f has none."""
    real = RealSystem(FORMAT32 if lowered.type == F32 else FORMAT64)
    dual = DualSystem(real, 3)
    f = lowered.evaluate(dual, *(dual.variable(real.exact(p), i) for i, p in enumerate(point)))
    g = [lift(d.value, lowered.type) for d in map(f.derivative, range(3))]
    # Scale by the largest component first: squares of large or small gradients would overflow or vanish.
    largest = abs(g[0]).maximum(abs(g[1])).maximum(abs(g[2]))
    usable = (largest > 1e-30) & (largest < 1e30)
    scale = 1.0 / usable.select(largest, 1.0)
    a, b, c = (usable.select(x * scale, 0.0) for x in g)
    inverse = 1.0 / a.fma(a, b.fma(b, c * c)).maximum(1e-10).sqrt()
    return a * inverse, b * inverse, c * inverse


def facing_back(lowered: Lowered, ray: Ray, answer: Answer) -> tuple[Value, ...]:
    """The normal of what was found, f32.

    Beside an edge the gradient is mostly rounding; it is turned to the side that the ray was proven to come from.
    """
    point = [answer.t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True)]
    normal = gradient_at(lowered, point)
    along = sum((n * d for n, d in zip(normal, ray.direction, strict=True)), start=lift(0.0, lowered.type))
    wrong = along * answer.side > 0.0
    return tuple(wrong.select(-n, n).convert(F32) for n in normal)


def behind(answer: Answer) -> Value:
    """Where a search that goes on along the same ray starts, f32: the find may lie at its end, so a hair later."""
    end = answer.end.convert(F32)
    return abs(end).fma(2.0**-22, end)


def write(builder: KernelBuilder, lowered: Lowered, lane: Value, ray: Ray, answer: Answer, ends: bool = False) -> None:
    """Store an answer, with the normal where something was found; ``ends``: and what lies around it."""
    if ends:
        for name, value in zip(END, (answer.clear.convert(F32), behind(answer)), strict=True):
            store(builder.buffer(name, F32, writable=True), lane, value)
    buffers = {name: builder.buffer(name, type_, writable=True) for name, type_ in FIELDS.items()}

    def nowhere() -> tuple[float, ...]:
        return (0.0, 0.0, 0.0)

    found = answer.status.ne(MISS)
    for name, value in zip(NORMAL, if_(found, lambda: facing_back(lowered, ray, answer), nowhere), strict=True):
        store(buffers[name], lane, value)
    store(buffers["t"], lane, found.select(answer.t, 0.0).convert(F32))
    store(buffers["status"], lane, answer.status)
    store(buffers["steps"], lane, answer.steps)


def ask_second_look(builder: KernelBuilder, lane: Value, answer: Answer) -> None:
    """Put an unresolved ray on the list, in no particular order."""
    lanes, clear = (builder.buffer(name, type_, writable=True) for name, type_ in SECOND.items())
    counters = builder.buffer(COUNTERS, U32, writable=True)

    def append() -> None:
        slot = atomic("add", counters, 0, 1)
        store(lanes, slot, lane)
        store(clear, slot, answer.clear.convert(F32))

    if_(answer.status.eq(UNRESOLVED), append)


def ask_for_thin(builder: KernelBuilder, lane: Value, missed: Value) -> None:
    """Mark the block of a pixel whose ray missed; several lanes may store the same 1."""
    marks = builder.buffer("block_missed", U32, writable=True)
    if_(missed, lambda: store(marks, lane >> 4, 1))
