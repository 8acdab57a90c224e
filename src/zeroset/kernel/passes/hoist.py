"""Loop-invariant code motion: what a loop does not change is computed once, in front of it.

Only pure instructions move, so running them where the loop would not have run does no harm. They leave loops but not
branches: a branch may be there to avoid them. Constants leave everything.
"""

from __future__ import annotations

from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import OPS
from zeroset.kernel.passes.rewriter import Rewriter, regions_of
from zeroset.kernel.value import Block, Instruction


class _Hoister(Rewriter):
    def __init__(self) -> None:
        super().__init__()
        # How many blocks lie around each of the copy's values, and which of the open blocks belong to loops.
        self.depths: dict[int, int] = {}
        self.loops: list[bool] = [False]

    def block(self, block: Block) -> Block:
        for parameter in block.parameters:
            self.depths[id(parameter)] = len(self.blocks)
        return super().block(block)

    def instruction(self, instruction: Instruction) -> None:
        depth = len(self.blocks) - 1
        if not instruction.regions:
            if OPS[instruction.op].pure:
                depth = self._highest(instruction)
            copy = self._copy(instruction, depth)
        else:
            operands = self.all(instruction.operands)
            self.loops.append(instruction.op != "if")
            regions = tuple(self.block(r) for r in instruction.regions)
            self.loops.pop()
            copy = self.make(instruction, operands, regions)
            self.bind(instruction.results, copy.results)
        for result in instruction.results:
            self.depths[id(result)] = depth

    def _copy(self, instruction: Instruction, depth: int) -> Instruction:
        types = tuple([v.type for v in instruction.results])
        copy = Instruction(instruction.op, self.all(instruction.operands), instruction.attributes, types)
        self.blocks[depth].instructions.append(copy)
        self.bind(instruction.results, copy.results)
        return copy

    def _highest(self, instruction: Instruction) -> int:
        """The outermost block where the operands are known and that only loops separate from here."""
        if instruction.op == "const":
            return 0
        depths = self.depths
        needed = max([depths[id(v)] for v in instruction.operands], default=0)
        depth = len(self.blocks) - 1
        while depth > needed and self.loops[depth]:
            depth -= 1
        return depth


def hoist(kernel: Kernel) -> Kernel:
    """Move loop-invariant pure instructions out of loops, and constants to the top."""
    return _Hoister().kernel(kernel) if len(regions_of(kernel)) > 1 else kernel
