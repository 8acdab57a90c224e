"""One layer after the other along the same rays: all hits, for ``cast`` and for what can be seen through.

Each layer's search starts where the last one's find is behind the ray. A place that stays unresolved may fill several
intervals of the search; as long as the next one touches the last it is the same place, and is passed over.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from zeroset.kernel import BOOL, F32, F64, U32, Kernel, KernelBuilder, Value, constant, load, store, while_
from zeroset.rendering.buffers import EMPTY_TILE, FORMER, FROM, NOTHING, ONWARD, SECOND
from zeroset.rendering.gbuffer import ask_second_look, behind, write
from zeroset.rendering.primary import (
    FINER,
    as_fine_as_asked,
    camera_ray,
    exact_ray,
    given_ray,
    in_doubles,
    problem_on,
    staged,
    stride,
    t_range,
    tolerance_at,
    tracing,
)
from zeroset.solve.body import LoweredBody
from zeroset.solve.method import Method
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.shape import Shape
from zeroset.solve.status import MISS, UNRESOLVED
from zeroset.solve.subject import Subject

DONE = EMPTY_TILE
"""Where the search goes on along a ray that has nothing more on it: beyond every bounds."""
TOUCHING = 4.0
"""Tolerances between two unresolved places that are one."""
PAST = 2.0**-6
"""Tolerances behind a find that belong to it: where t is near 0 rounding alone does not get away from a root."""
MOST_MERGED = 256
"""Unresolved intervals that are passed over before a new place is counted all the same."""


def layer_kernel(shape: Shape, method: Method, pixels: bool, second: bool) -> Kernel:
    """The next find along each ray."""
    with KernelBuilder("layer") as builder:
        lane = builder.index()
        subject = Subject(shape, builder, offset=method.offset != 0.0)
        ray = camera_ray(builder, lane) if pixels else given_ray(builder, lane)
        start = load(builder.buffer(FROM, F32), lane)
        near, far = t_range(builder)
        search = _Search(
            subject,
            lambda body: problem_on(body, ray, near.maximum(start), far, None, not pixels),
            tracing(method),
            lambda at: tolerance_at(builder, ray, at),
        )
        # Where f64 cannot tell whether what touches a hit is a second one, it stays unresolved.
        former = None if second else load(builder.buffer(FORMER, U32), lane)
        answer, merged, begin = beyond(search, start, former)
        if method.certified:
            answer = as_fine_as_asked(builder, ray, answer)
        write(builder, subject, lane, ray, answer)
        _go_on(builder, lane, answer)
        if second:
            # What f32 could not tell from the layer before may hold another: f64 looks from there.
            ask_second_look(builder, lane, answer, since=(merged, begin))
    return builder.kernel


def second_layer_kernel(shape: Shape, offset: bool, pixels: bool) -> Kernel:
    """The rays on the list again, in f64, from where the layer before ended."""
    with KernelBuilder("second_layer") as builder:
        place = builder.index()
        lane, clear = (load(builder.buffer(name, type_), place) for name, type_ in SECOND.items())
        subject = Subject(shape, builder, F64, offset)
        ray = camera_ray(builder, lane) if pixels else given_ray(builder, lane)
        start = load(builder.buffer(FROM, F32), lane)
        near, far = t_range(builder)
        search = _Search(
            subject,
            lambda body: in_doubles(body, problem_on(body, ray, near.maximum(start), far, None, not pixels), clear),
            staged(stride),
            lambda at: tolerance_at(builder, ray, at.convert(F32)).convert(F64) * FINER,
        )
        answer, _, _ = beyond(search, start)
        write(builder, subject, lane, exact_ray(ray), answer)
        _go_on(builder, lane, answer)
    return builder.kernel


class _Search(NamedTuple):
    """What is searched, and how.

    Attributes:
        subject: the bodies.
        problem_of: the search for one of them.
        trace: searches.
        tolerance: around a place on the ray, whatever each body's own search along all of it can tell.
    """

    subject: Subject
    problem_of: Callable[[LoweredBody], Problem]
    trace: Callable[[Problem], Answer]
    tolerance: Callable[[Value], Value]

    def after(self, at: Value) -> Answer:
        """The first find behind a place on the ray."""
        return self.subject.nearest(self._from(at), self.trace)

    def _from(self, at: Value) -> Callable[[LoweredBody], Problem]:
        if self.subject.shape.plain:
            return lambda body: self.problem_of(body)._replace(t0=at)

        def later(body: LoweredBody) -> Problem:
            problem = self.problem_of(body)
            return problem._replace(t0=problem.t0.maximum(at))

        return later


def beyond(search: _Search, start: Value, former: Value | None = None) -> tuple[Answer, Value, Value]:
    """The first find that is not still the place that the layer before left at ``start``; any, in the first layer.

    And whether anything was passed by as being still that place, and where the search began.

    Args:
        search: what is searched.
        start: where.
        former: the status of the layer before, if only what touches an unresolved place is to be passed by.
    """
    problem, *others = (search.problem_of(body) for body in search.subject.bodies)
    begin = problem.t0
    for other in others:
        begin = begin.minimum(other.t0)
    later = start.convert(problem.type) > NOTHING * 0.5
    before = later if former is None else former.eq(UNRESOLVED)
    tolerance = search.tolerance(later.select(start.convert(problem.type), begin))
    reach, past = tolerance * TOUCHING, tolerance * PAST
    begin = later.select(begin + past, begin)
    none, zero = constant(0, U32), problem.number(0.0)

    def looking(again: Value, *state: Value) -> Value:
        return again

    def look(again: Value, count: Value, at: Value, *found: Value) -> tuple[Value, ...]:
        answer = search.after(at)
        touches = before & answer.status.eq(UNRESOLVED) & (answer.clear - at <= reach)
        more = touches & (count < MOST_MERGED)
        spent = found[2] + answer.steps
        mark = () if answer.mark is None else (answer.mark,)
        onward = answer.end.maximum(at + past)
        place = (answer.t, answer.status, spent, answer.clear, answer.side, answer.end)
        return more, count + 1, onward, *place, *mark

    mark = () if search.subject.shape.plain else (none,)
    found = (begin, constant(MISS, U32), none, begin, zero, begin, *mark)
    state = while_(looking, look, constant(True, BOOL), none, begin, *found)
    return Answer(*state[3:]), state[1] > 1, begin


def _go_on(builder: KernelBuilder, lane: Value, answer: Answer) -> None:
    """Say where the next layer starts."""
    store(builder.buffer(ONWARD, F32, writable=True), lane, answer.status.eq(MISS).select(DONE, behind(answer)))
