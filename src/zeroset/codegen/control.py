"""Loops and branches of W lanes in lockstep.

What a uniform value decides is an ordinary loop or branch. Where lanes disagree, a loop runs while some lane is in it
and a branch runs each side that some lane wants; the writer's mask narrows to those lanes, and the others keep their
carried values by a blend. State that nobody reads after the loop needs none: a lane that has left may hold anything.
Code is only ever run with at least one active lane.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from zeroset.codegen.writer import Writer
from zeroset.kernel.value import Block, Instruction, Value


@dataclass(slots=True)
class _Phi:
    """A loop-carried LLVM value whose next value is not written yet."""

    name: str
    type: str
    start: str
    spot: tuple[list[str], int]
    after: str = ""


@dataclass(slots=True)
class _Loop:
    """The blocks of a loop and what it carries."""

    before: str
    head: str
    body: str
    done: str
    phis: list[_Phi] = field(default_factory=list)

    def close(self, latch: str) -> None:
        """Write the phis, now that the next values are known."""
        for phi in self.phis:
            lines, place = phi.spot
            lines[place] = f"  {phi.name} = phi {phi.type} [ {phi.start}, %{self.before} ], [ {phi.after}, %{latch} ]"


class Control:
    """Writes control flow.

    Args:
        writer: the function being written.
        block: writes a region's instructions.
        used: the ids of the values that something reads.
    """

    def __init__(self, writer: Writer, block: Callable[[Block], None], used: frozenset[int]) -> None:
        self.writer = writer
        self.block = block
        self.used = used

    # ----------------------------------------------------------------- loops

    def while_(self, instruction: Instruction) -> None:
        """Write a ``while``."""
        head, body = instruction.regions
        lanes_leave = self.writer.is_varying(head.yields[0])
        outer = self.writer.mask
        loop = self._begin()
        state = self._carry(loop, instruction.operands, body.parameters)
        active = self._phi(loop, self.writer.mask_type, outer) if lanes_leave else None
        self._bind(state, body.parameters, head.parameters, instruction.results)
        if active is not None:
            self.writer.mask = active.name
        self.block(head)
        if active is None:
            self.writer.branch(self.writer.scalar(head.yields[0]), loop.body, loop.done)
        else:
            active.after = self._enter(loop, active.name, self.writer.vector(head.yields[0]))
        self.writer.label(loop.body)
        self.block(body)
        self._end(loop, state, body.yields, instruction.results, lanes_leave, outer)

    def for_(self, instruction: Instruction) -> None:
        """Write a ``for``; the counter is uniform even where the count is not."""
        (body,) = instruction.regions
        count, start = instruction.operands[0], instruction.operands[1:]
        lanes_leave = self.writer.is_varying(count)
        outer = self.writer.mask
        loop = self._begin()
        counter = self._phi(loop, "i32", "0")
        state = self._carry(loop, start, body.parameters[1:])
        active = self._phi(loop, self.writer.mask_type, outer) if lanes_leave else None
        self.writer.define(body.parameters[0], counter.name)
        self._bind(state, body.parameters[1:], instruction.results)
        if active is None:
            more = self.writer.assign(f"icmp ult i32 {counter.name}, {self.writer.scalar(count)}")
            self.writer.branch(more, loop.body, loop.done)
        else:
            lanes = f"<{self.writer.width} x i32>"
            step = self.writer.vector(body.parameters[0])
            inside = self.writer.assign(f"icmp ult {lanes} {step}, {self.writer.vector(count)}")
            active.after = self._enter(loop, active.name, self.writer.from_bits(inside))
        self.writer.label(loop.body)
        self.block(body)
        counter.after = self.writer.assign(f"add i32 {counter.name}, 1")
        self._end(loop, state, body.yields, instruction.results, lanes_leave, outer)

    def _begin(self) -> _Loop:
        head, body, done = (self.writer.fresh(name) for name in ("head", "body", "done"))
        loop = _Loop(self.writer.block, head, body, done)
        self.writer.jump(loop.head)
        self.writer.label(loop.head)
        return loop

    def _phi(self, loop: _Loop, type_: str, start: str) -> _Phi:
        phi = _Phi(f"%{self.writer.fresh('p')}", type_, start, self.writer.reserve())
        loop.phis.append(phi)
        return phi

    def _carry(self, loop: _Loop, start: tuple[Value, ...], parameters: tuple[Value, ...]) -> list[_Phi]:
        made = []
        for value, parameter in zip(start, parameters, strict=True):
            vector = self.writer.is_varying(parameter)
            made.append(self._phi(loop, self.writer.type_of(value.type, vector), self.writer.form(value, vector)))
        return made

    def _bind(self, state: list[_Phi], first: tuple[Value, ...], *others: tuple[Value, ...]) -> None:
        """The state's values, under each name that the kernel has for them; after all phis of the block."""
        for phi, value in zip(state, first, strict=True):
            self.writer.define(value, phi.name)
        for values in others:
            for value, like in zip(values, first, strict=True):
                self.writer.rename(value, like)

    def _enter(self, loop: _Loop, active: str, condition: str) -> str:
        """Go on with the active lanes that want it, if there are any."""
        self.writer.mask = self.writer.both(active, condition)
        self.writer.branch(self.writer.some(self.writer.mask), loop.body, loop.done)
        return self.writer.mask

    def _end(
        self,
        loop: _Loop,
        state: list[_Phi],
        after: tuple[Value, ...],
        results: tuple[Value, ...],
        lanes_leave: bool,
        outer: str,
    ) -> None:
        for phi, value, result in zip(state, after, results, strict=True):
            vector = self.writer.is_varying(result)
            phi.after = self.writer.form(value, vector)
            if lanes_leave and vector and id(result) in self.used:
                phi.after = self.writer.choose(self.writer.mask, value.type, phi.after, phi.name)
        loop.close(self.writer.block)
        self.writer.jump(loop.head)
        self.writer.label(loop.done)
        self.writer.mask = outer

    # -------------------------------------------------------------- branches

    def if_(self, instruction: Instruction) -> None:
        """Write an ``if``."""
        if self.writer.is_varying(instruction.operands[0]):
            self._blend(instruction)
        else:
            self._branch(instruction)

    def _branch(self, instruction: Instruction) -> None:
        """One side or the other."""
        writer = self.writer
        labels = [writer.fresh("side"), writer.fresh("side")]
        done = writer.fresh("done")
        writer.branch(writer.scalar(instruction.operands[0]), *labels)
        sides: list[tuple[list[str], str]] = []
        for label, region in zip(labels, instruction.regions, strict=True):
            writer.label(label)
            self.block(region)
            pairs = zip(region.yields, instruction.results, strict=True)
            given = [writer.form(value, writer.is_varying(result)) for value, result in pairs]
            sides.append((given, writer.block))
            writer.jump(done)
        writer.label(done)
        names = []
        for i, result in enumerate(instruction.results):
            kind = writer.type_of(result.type, writer.is_varying(result))
            names.append(writer.assign(f"phi {kind} " + ", ".join(f"[ {given[i]}, %{at} ]" for given, at in sides)))
        for result, name in zip(instruction.results, names, strict=True):
            writer.define(result, name)

    def _blend(self, instruction: Instruction) -> None:
        """Each side that some lane wants, then for each lane the values of its side."""
        writer, outer = self.writer, self.writer.mask
        condition = writer.vector(instruction.operands[0])
        yes, no = instruction.regions
        given = self._side(yes, writer.both(outer, condition))
        writer.mask = outer
        if no.instructions:
            other = self._side(no, writer.without(outer, condition))
        else:
            other = [writer.vector(value) for value in no.yields]
        writer.mask = outer
        for result, a, b in zip(instruction.results, given, other, strict=True):
            writer.define(result, writer.choose(condition, result.type, a, b))

    def _side(self, region: Block, mask: str) -> list[str]:
        """Run a region if some lane is in the mask; gives its values as vectors, zeros where it did not run."""
        writer = self.writer
        before, run, done = writer.block, writer.fresh("side"), writer.fresh("done")
        writer.branch(writer.some(mask), run, done)
        writer.label(run)
        writer.mask = mask
        self.block(region)
        given = [writer.vector(value) for value in region.yields]
        after = writer.block
        writer.jump(done)
        writer.label(done)
        return [
            writer.assign(f"phi {writer.vectors[value.type.name]} [ zeroinitializer, %{before} ], [ {text}, %{after} ]")
            for value, text in zip(region.yields, given, strict=True)
        ]
