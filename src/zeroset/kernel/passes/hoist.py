"""Loop-invariant code motion: what a loop does not change is computed once, in front of it.

Only pure instructions move, so running them where the loop would not have run does no harm. They leave loops but not
branches: a branch may be there to avoid them. Constants leave everything.
"""

from __future__ import annotations

from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import OPS
from zeroset.kernel.passes.rewriter import Rewriter, regions_of
from zeroset.kernel.value import Block, Instruction, Value


class _Hoister(Rewriter):
    def __init__(self) -> None:
        super().__init__()
        # How many blocks lie around each value, and which of the open blocks belong to loops.
        self.depths: dict[int, int] = {}
        self.loops: list[bool] = [False]

    def block(self, block: Block) -> Block:
        for parameter in block.parameters:
            self.depths[id(parameter)] = len(self.blocks)
        return super().block(block)

    def instruction(self, instruction: Instruction) -> None:
        """Rebuild an instruction in the outermost block that it may go to."""
        depth = len(self.blocks) - 1
        operands = self.all(instruction.operands)
        regions: tuple[Block, ...] = ()
        if instruction.regions:
            self.loops.append(instruction.op != "if")
            regions = tuple([self.block(r) for r in instruction.regions])
            self.loops.pop()
        elif OPS[instruction.op].pure:
            depth = self._highest(instruction.op, operands)
        for result in self.place(instruction, operands, regions, self.blocks[depth]).results:
            self.depths[id(result)] = depth

    def _highest(self, op: str, operands: tuple[Value, ...]) -> int:
        """The outermost block where the operands are known and that only loops separate from here."""
        if op == "const":
            return 0
        depth, depths, needed = len(self.blocks) - 1, self.depths, 0
        for value in operands:
            around = depths[id(value)]
            if around == depth:
                return depth
            needed = max(needed, around)
        while depth > needed and self.loops[depth]:
            depth -= 1
        return depth


def hoist(kernel: Kernel) -> Kernel:
    """Move loop-invariant pure instructions out of loops, and constants to the top."""
    return _Hoister().kernel(kernel) if len(regions_of(kernel)) > 1 else kernel
