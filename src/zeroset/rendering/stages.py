"""A long ray, searched stage by stage, for a tolerance that t itself allows.

An f32 near t is no finer than a part of t, so that far along a ray roots cannot be told as closely as they can near its
beginning. With one tolerance for all of a ray, what lies near would be found as roughly as what may lie farthest away.
A stage is as long as its own start, or as its tolerance can be kept: rays of ordinary scenes have one, and one that
goes on for 10^20 has thirty.
"""

from __future__ import annotations

from collections.abc import Callable

from zeroset.kernel import BOOL, F32, F64, U32, Value, constant, while_
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.status import MISS

RESOLUTION = {F32: 2.0**-20, F64: 2.0**-48}
"""The shortest step that moves along a ray, as a part of t."""
LONGER = 2.0
"""How many times its start, or its tolerance, a stage goes on for."""


def in_stages(problem: Problem, trace: Callable[[Problem], Answer]) -> Answer:
    """The first find of a problem, whose first step is for the first stage.

    Args:
        problem: with the tolerance that was asked for.
        trace: the search for one stage.
    """
    asked = problem.asked
    assert asked is not None
    resolution = RESOLUTION[problem.type]
    first = asked * (LONGER / resolution)

    def running(going: Value, *state: Value) -> Value:
        return going

    def stage(going: Value, begin: Value, *before: Value) -> tuple[Value, ...]:
        # From far behind the ray's origin stages become shorter towards it.
        end = (begin < -first).select(begin * 0.5, (begin * LONGER).maximum(first)).minimum(problem.t1)
        tolerance = asked.maximum(abs(begin).maximum(abs(end)) * resolution)
        rest = (end - begin) * 0.125
        step = begin.eq(problem.t0).select(problem.step.minimum(rest), rest)
        answer = trace(problem._replace(t0=begin, t1=end, tolerance=tolerance, step=step))
        more = answer.status.eq(MISS) & (end < problem.t1)
        told = answer.t, answer.status, before[2] + answer.steps, answer.clear, answer.side, answer.end
        says_blunt.append(answer.blunt is not None)
        blunt = no if answer.blunt is None else answer.blunt
        return more, more.select(end, begin), *told, blunt, *(() if answer.mark is None else (answer.mark,))

    says_blunt: list[bool] = []
    zero, none, no = problem.number(0.0), constant(0, U32), constant(False, BOOL)
    told = (problem.t0, constant(MISS, U32), none, problem.t0, zero, problem.t0, no)
    marks = () if problem.body is None else (none,)
    state = while_(running, stage, ~no, problem.t0, *told, *marks)
    mark = state[9] if marks else None
    t, status, steps, clear, side, end, blunt = state[2:9]
    return Answer(t, status, steps, clear, side, end, mark, blunt if says_blunt[0] else None)
