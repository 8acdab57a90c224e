"""One layer after the other along the same rays: all hits, for ``cast`` and for what can be seen through.

Each layer's search starts where the last one's find is behind the ray. A place that stays unresolved may fill several
intervals of the search; as long as the next one touches the last it is the same place, and is passed over.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from zeroset.kernel import BOOL, F32, F64, U32, Kernel, KernelBuilder, Value, constant, load, store, while_
from zeroset.rendering.buffers import FROM, NOTHING, ONWARD, SECOND
from zeroset.rendering.gbuffer import ask_second_look, behind, write
from zeroset.rendering.primary import EMPTY_TILE, camera_ray, given_ray, in_doubles, problem_on, t_range
from zeroset.solve.field import Field, Lowered
from zeroset.solve.method import Method
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.search import search
from zeroset.solve.status import MISS, UNRESOLVED
from zeroset.solve.systems import automatic_system
from zeroset.solve.walk import Striding

DONE = EMPTY_TILE
"""Where the search goes on along a ray that has nothing more on it: beyond every bounds."""
TOUCHING = 4.0
"""Tolerances between two unresolved places that are one."""
MOST_MERGED = 256
"""Unresolved intervals that are passed over before a new place is counted all the same."""


def layer_kernel(field: Field, method: Method, kind: str, pixels: bool, second: bool) -> Kernel:
    """The next find along each ray."""
    with KernelBuilder("layer") as builder:
        lane = builder.index()
        lowered = Lowered(field, builder, offset=method.offset != 0.0)
        ray = camera_ray(builder, lane) if pixels else given_ray(builder, lane)
        start = load(builder.buffer(FROM, F32), lane)
        near, far = t_range(builder)
        problem = problem_on(builder, lowered, kind, ray, near.maximum(start), far, None)
        answer = beyond(problem, method.trace, start)
        write(builder, lowered, lane, ray, answer)
        _go_on(builder, lane, answer)
        if second:
            ask_second_look(builder, lane, answer)
    return builder.kernel


def second_layer_kernel(field: Field, offset: bool, kind: str, pixels: bool) -> Kernel:
    """The rays on the list again, in f64, from where the layer before ended."""
    with KernelBuilder("second_layer") as builder:
        place = builder.index()
        lane, clear = (load(builder.buffer(name, type_), place) for name, type_ in SECOND.items())
        lowered = Lowered(field, builder, F64, offset)
        ray = camera_ray(builder, lane) if pixels else given_ray(builder, lane)
        start = load(builder.buffer(FROM, F32), lane)
        near, far = t_range(builder)
        rough = problem_on(builder, lowered, kind, ray, near.maximum(start), far, None)
        problem = in_doubles(rough, clear)
        system = automatic_system(field, problem.fmt)
        answer = beyond(problem, lambda p: search(p, system, Striding()), start.convert(F64))
        write(builder, lowered, lane, problem.ray, answer)
        _go_on(builder, lane, answer)
    return builder.kernel


def beyond(problem: Problem, trace: Callable[[Problem], Answer], start: Value) -> Answer:
    """The first find that is not still the place that the layer before left at ``start``; any, in the first layer."""
    before = start > NOTHING * 0.5
    reach = problem.tolerance * TOUCHING
    none, zero = constant(0, U32), problem.number(0.0)

    def looking(again: Value, *state: Value) -> Value:
        return again

    def look(again: Value, count: Value, at: Value, *found: Value) -> tuple[Value, ...]:
        answer = trace(replace(problem, t0=at))
        touches = before & answer.status.eq(UNRESOLVED) & (answer.clear - at <= reach)
        more = touches & (count < MOST_MERGED) & (answer.end > at)
        spent = found[2] + answer.steps
        return more, count + 1, answer.end, answer.t, answer.status, spent, answer.clear, answer.side, answer.end

    found = (problem.t0, constant(MISS, U32), none, problem.t0, zero, problem.t0)
    state = while_(looking, look, constant(True, BOOL), none, problem.t0, *found)
    return Answer(*state[3:])


def _go_on(builder: KernelBuilder, lane: Value, answer: Answer) -> None:
    """Say where the next layer starts."""
    store(builder.buffer(ONWARD, F32, writable=True), lane, answer.status.eq(MISS).select(DONE, behind(answer)))
