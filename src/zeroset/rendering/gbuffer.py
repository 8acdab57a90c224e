"""The G-buffer: what every tracing kernel writes for its ray, and the list of rays that deserve a second look."""

from __future__ import annotations

from collections.abc import Sequence

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.arith import DualSystem, RealSystem
from zeroset.kernel import F32, U32, KernelBuilder, Value, atomic, if_, lift, store
from zeroset.rendering.buffers import COUNTERS, FIELDS, NORMAL, SECOND
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


def write(builder: KernelBuilder, lowered: Lowered, lane: Value, ray: Ray, answer: Answer) -> None:
    """Store an answer, with the normal where something was found."""
    buffers = {name: builder.buffer(name, type_, writable=True) for name, type_ in FIELDS.items()}

    def at_hit() -> tuple[Value, ...]:
        point = [answer.t.fma(d, o) for o, d in zip(ray.origin, ray.direction, strict=True)]
        normal = gradient_at(lowered, point)
        # Beside an edge the gradient is mostly rounding; the side that the ray comes from has been proven.
        along = sum((n * d for n, d in zip(normal, ray.direction, strict=True)), start=lift(0.0, lowered.type))
        wrong = along * answer.side > 0.0
        return tuple(wrong.select(-n, n).convert(F32) for n in normal)

    def nowhere() -> tuple[float, ...]:
        return (0.0, 0.0, 0.0)

    found = answer.status.ne(MISS)
    for name, value in zip(NORMAL, if_(found, at_hit, nowhere), strict=True):
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
