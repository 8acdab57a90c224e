"""Dead code: instructions, carried state and branch results that nothing reads.

What stores need is alive, then whatever something alive needs. A loop without an effect whose results are not read
goes too: loops of kernels end. Two steps, mark and sweep, each linear.
"""

from __future__ import annotations

from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import ATOMICS
from zeroset.kernel.passes.rewriter import Rewriter
from zeroset.kernel.value import Block, Instruction, Value

_Carried = tuple[Instruction, int]
_EFFECTS = frozenset({"store", *ATOMICS})


class _Marks:
    """Finds the values and the instructions with regions that are alive."""

    def __init__(self, kernel: Kernel) -> None:
        self.values: set[int] = set()
        self.instructions: set[int] = set()
        self._owners: dict[int, _Carried] = {}
        self._parents: dict[int, Instruction] = {}
        self._pending: list[Value] = []
        effects = self._survey(kernel)
        for instruction in effects:
            self._keep(instruction)
            self._pending += instruction.operands
        self._follow()

    def _survey(self, kernel: Kernel) -> list[Instruction]:
        """Note who owns parameters and regions; gives the instructions that have an effect."""
        effects = []
        todo: list[tuple[Block, Instruction | None]] = [(kernel.body, None)]
        while todo:
            block, owner = todo.pop()
            if owner is not None:
                for i, parameter in enumerate(block.parameters):
                    self._owners[id(parameter)] = (owner, i - (owner.op == "for"))
            for instruction in block.instructions:
                if owner is not None:
                    self._parents[id(instruction)] = owner
                if instruction.op in _EFFECTS:
                    effects.append(instruction)
                elif instruction.regions:
                    todo += [(region, instruction) for region in instruction.regions]
        return effects

    def _keep(self, instruction: Instruction) -> None:
        """An instruction runs, so what it lies in runs, and what decides whether it runs is needed."""
        outer: Instruction | None = instruction
        while outer is not None and id(outer) not in self.instructions:
            self.instructions.add(id(outer))
            if outer.op == "while":
                self._pending += outer.regions[0].yields
            elif outer.op in ("for", "if"):
                self._pending.append(outer.operands[0])
            outer = self._parents.get(id(outer))

    def _follow(self) -> None:
        """From what is needed to what that needs, until nothing is new."""
        pending, seen = self._pending, self.values
        while pending:
            value = pending.pop()
            if id(value) in seen:
                continue
            seen.add(id(value))
            definition = value.definition
            if definition is None:
                owner, place = self._owners[id(value)]
                self._keep(owner)
                if place >= 0:
                    pending.append(owner.results[place])
                continue
            self._keep(definition)
            if definition.regions:
                self._carry(definition, definition.results.index(value))
            else:
                pending += definition.operands

    def _carry(self, instruction: Instruction, place: int) -> None:
        """One result of a loop or branch is alive: so is what it starts with and what its regions give."""
        if instruction.op == "if":
            self._pending += [region.yields[place] for region in instruction.regions]
            return
        first = 1 if instruction.op == "for" else 0
        self._pending += [instruction.operands[first + place], instruction.regions[-1].yields[place]]


class _Sweeper(Rewriter):
    def __init__(self, marks: _Marks) -> None:
        super().__init__()
        self.marks = marks

    def instruction(self, instruction: Instruction) -> None:
        if id(instruction) not in self.marks.instructions:
            return
        if not instruction.regions:
            super().instruction(instruction)
            return
        kept = [i for i, v in enumerate(instruction.results) if id(v) in self.marks.values]
        first = {"if": 1, "for": 1, "while": 0}[instruction.op]
        operands = instruction.operands[:first]
        if instruction.op != "if":
            operands += tuple(instruction.operands[first + i] for i in kept)
        operands = self.all(operands)
        regions = tuple(self._region(instruction, i, kept) for i in range(len(instruction.regions)))
        types = tuple(instruction.results[i].type for i in kept)
        copy = Instruction(instruction.op, operands, instruction.attributes, types, regions)
        self.blocks[-1].instructions.append(copy)
        self.bind(tuple(instruction.results[i] for i in kept), copy.results)

    def _region(self, instruction: Instruction, number: int, kept: list[int]) -> Block:
        """A region with the kept state only; the condition of a ``while`` keeps its one yield."""
        region = instruction.regions[number]
        counter = 1 if instruction.op == "for" else 0
        shown = list(range(counter)) + ([counter + i for i in kept] if region.parameters else [])
        is_condition = instruction.op == "while" and number == 0
        yields = region.yields if is_condition else tuple(region.yields[i] for i in kept)
        return self.region(region, tuple(region.parameters[i] for i in shown), yields)


def dce(kernel: Kernel) -> Kernel:
    """Drop instructions, carried state and results that no store depends on."""
    return _Sweeper(_Marks(kernel)).kernel(kernel)
