"""Rebuilds a kernel, instruction by instruction; a pass is a rebuilding that does something else with some of them.

Kernels are never changed in place, so whoever holds one, or its digest, may keep it. What a pass leaves as it was is
shared between the old kernel and the new: instructions whose operands did not change, and the parameters of blocks.
``values`` holds the new value of each old one that did change. A pass overrides ``instruction`` or ``block``.
"""

from __future__ import annotations

from zeroset.kernel.build import Kernel
from zeroset.kernel.value import Block, Instruction, Value


class Rewriter:
    """A rebuilding that changes nothing; see the module's text."""

    def __init__(self) -> None:
        self.values: dict[int, Value] = {}
        self.blocks: list[Block] = []

    def kernel(self, kernel: Kernel) -> Kernel:
        """The rebuilt kernel."""
        return Kernel(kernel.name, kernel.uniforms, kernel.buffers, self.block(kernel.body))

    def block(self, block: Block) -> Block:
        """A block rebuilt."""
        return self.region(block, block.parameters, block.yields)

    def region(self, block: Block, parameters: tuple[Value, ...], yields: tuple[Value, ...]) -> Block:
        """A block rebuilt with some of its parameters and yields."""
        made = Block()
        made.parameters = parameters
        self.blocks.append(made)
        self.inside(block)
        self.blocks.pop()
        made.yields = self.all(yields)
        return made

    def inside(self, block: Block) -> None:
        """Rebuild a block's instructions at the end of the block being made."""
        rebuild = self.instruction
        for instruction in block.instructions:
            rebuild(instruction)

    def instruction(self, instruction: Instruction) -> None:
        """Rebuild one instruction, regions included."""
        operands = self.all(instruction.operands)
        self.place(instruction, operands, tuple([self.block(r) for r in instruction.regions]), self.blocks[-1])

    def place(
        self, instruction: Instruction, operands: tuple[Value, ...], regions: tuple[Block, ...], block: Block
    ) -> Instruction:
        """Append an instruction with new operands and regions, or itself where they are the old ones."""
        if not regions and operands is instruction.operands:
            block.instructions.append(instruction)
            return instruction
        types = tuple([v.type for v in instruction.results])
        made = Instruction(instruction.op, operands, instruction.attributes, types, regions)
        block.instructions.append(made)
        self.bind(instruction.results, made.results)
        return made

    def all(self, values: tuple[Value, ...]) -> tuple[Value, ...]:
        """What values have become; the same tuple where none has changed, which is the rule."""
        known = self.values
        for value in values:
            if id(value) in known:
                return tuple([known.get(id(v), v) for v in values])
        return values

    def bind(self, old: tuple[Value, ...], new: tuple[Value, ...]) -> None:
        """Say what values have become."""
        for before, after in zip(old, new, strict=True):
            self.values[id(before)] = after


def regions_of(kernel: Kernel) -> list[Block]:
    """Every block of a kernel, outer ones first."""
    blocks = [kernel.body]
    for block in blocks:
        for instruction in block.instructions:
            blocks.extend(instruction.regions)
    return blocks
