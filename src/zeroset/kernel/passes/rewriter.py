"""Copies a kernel, instruction by instruction; a pass is a copy that does something else with some of them.

Kernels are never changed in place, so whoever holds one, or its digest, may keep it. A pass overrides
``instruction``, or reads and fills ``values``: the copy's value for each value of the original.
"""

from __future__ import annotations

from zeroset.kernel.build import Kernel
from zeroset.kernel.value import Block, Instruction, Value


class Rewriter:
    """A plain copy; see the module's text."""

    def __init__(self) -> None:
        self.values: dict[int, Value] = {}
        self.blocks: list[Block] = []

    def kernel(self, kernel: Kernel) -> Kernel:
        """The copy of a kernel."""
        return Kernel(kernel.name, kernel.uniforms, kernel.buffers, self.block(kernel.body))

    def block(self, block: Block) -> Block:
        """The copy of a block."""
        copy = Block(tuple(p.type for p in block.parameters))
        self.bind(block.parameters, copy.parameters)
        self.blocks.append(copy)
        self.inside(block)
        self.blocks.pop()
        copy.yields = self.all(block.yields)
        return copy

    def inside(self, block: Block) -> None:
        """Copy a block's instructions to the end of the block being made."""
        for instruction in block.instructions:
            self.instruction(instruction)

    def instruction(self, instruction: Instruction) -> None:
        """Copy one instruction, regions included."""
        operands = self.all(instruction.operands)
        copy = self.make(instruction, operands, tuple(self.block(r) for r in instruction.regions))
        self.bind(instruction.results, copy.results)

    def make(self, like: Instruction, operands: tuple[Value, ...], regions: tuple[Block, ...] = ()) -> Instruction:
        """Append an instruction like another one, on other operands and regions."""
        types = tuple([v.type for v in like.results])
        copy = Instruction(like.op, operands, like.attributes, types, regions)
        self.blocks[-1].instructions.append(copy)
        return copy

    def all(self, values: tuple[Value, ...]) -> tuple[Value, ...]:
        """The copies of values."""
        known = self.values
        return tuple([known[id(v)] for v in values])

    def bind(self, originals: tuple[Value, ...], copies: tuple[Value, ...]) -> None:
        """Say which values stand for which."""
        for original, copy in zip(originals, copies, strict=True):
            self.values[id(original)] = copy


def regions_of(kernel: Kernel) -> list[Block]:
    """Every block of a kernel, outer ones first."""
    blocks = [kernel.body]
    for block in blocks:
        for instruction in block.instructions:
            blocks.extend(instruction.regions)
    return blocks
