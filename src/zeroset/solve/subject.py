"""A shape inside one kernel: its bodies with all their leaves lowered, ready to be evaluated on any number system."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from zeroset.kernel import F32, U32, KernelBuilder, Type, Value, constant
from zeroset.solve.body import LoweredBody
from zeroset.solve.field import Lowered
from zeroset.solve.names import OPAQUE
from zeroset.solve.problem import Answer, Problem
from zeroset.solve.shape import Leaf, Shape
from zeroset.solve.status import MISS


class Subject:
    """A shape inside one kernel.

    Attributes:
        shape: what it is.
        builder: the kernel being traced.
        type: scalar type of the evaluation, f32 or f64.
        bodies: each of its bodies.
    """

    def __init__(self, shape: Shape, builder: KernelBuilder, type_: Type = F32, offset: bool = False) -> None:
        self.shape = shape
        self.builder = builder
        self.type = type_
        self.bodies = [LoweredBody(body, builder, type_, offset) for body in shape.bodies]

    def fields(self) -> Iterator[tuple[LoweredBody, Leaf, Lowered]]:
        """All leaves with their bodies, lowered."""
        for body, leaf, _ in self.leaves():
            yield body, leaf, body.leaf(leaf)

    def leaves(self) -> Iterator[tuple[LoweredBody, Leaf, int]]:
        """All leaves with their bodies and the signs that turn their gradients outwards."""
        for body in self.bodies:
            for leaf, sign in body.body.leaves:
                yield body, leaf, sign

    def nearest(self, problem_of: Callable[[LoweredBody], Problem], trace: Callable[[Problem], Answer]) -> Answer:
        """The first thing along a ray: body after body, each only up to what the ones before have found.

        Args:
            problem_of: the search for one body along all of the ray.
            trace: searches.
        """
        best: Answer | None = None
        opaque = self.builder.uniform(OPAQUE, U32) if len(self.bodies) > 1 else constant(0, U32)
        for body in self.bodies:
            problem = problem_of(body)
            if best is not None:
                found = best.status.ne(MISS)
                problem = problem._replace(t1=found.select(problem.t1.minimum(best.end), problem.t1))
            answer = trace(problem)
            if answer.mark is None and self.shape.parts > 1:
                answer = answer._replace(mark=constant(body.body.leaves[0][0].bits, U32))
            best = answer if best is None else _nearer(best, answer, opaque)
        assert best is not None
        return best


def _nearer(a: Answer, b: Answer, opaque: Value) -> Answer:
    """Of two answers the one that comes first along the ray; of two in one place what hides the other, else the former.

    Which root comes first there is rounding: a box of glass on the ground would show now the one, now the other.
    """
    found_a, found_b = a.status.ne(MISS), b.status.ne(MISS)
    assert a.mark is not None
    assert b.mark is not None
    together = found_a & found_b & (abs(b.t - a.t) <= (a.end - a.t) + (b.end - b.t))
    hides = (a.mark & opaque).eq(0) & (b.mark & opaque).ne(0)
    second = found_b & (~found_a | together.select(hides, b.t < a.t))

    def pick(x: Value, y: Value) -> Value:
        return second.select(y, x)

    return Answer(
        pick(a.t, b.t),
        pick(a.status, b.status),
        a.steps + b.steps,
        # Where both were found, the ray is clear up to the earlier of the two places where a find may begin.
        (found_a & found_b).select(a.clear.minimum(b.clear), pick(a.clear, b.clear)),
        pick(a.side, b.side),
        together.select(a.end.maximum(b.end), pick(a.end, b.end)),
        pick(a.mark, b.mark),
        None if a.blunt is None or b.blunt is None else pick(a.blunt, b.blunt),
    )
