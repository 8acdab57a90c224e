"""Small branches become selects.

A branch costs a vote, two jumps and a blend; a handful of pure operations costs less than that, and once flattened
they can be hoisted, merged and scheduled with what lies around them.
"""

from __future__ import annotations

from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import OPS
from zeroset.kernel.passes.rewriter import Rewriter, regions_of
from zeroset.kernel.value import Block, Instruction

_LIMIT = 6
"""Most instructions of one side, constants not counted."""
_DEAR = frozenset({"div", "sqrt"})


class _Flattener(Rewriter):
    def instruction(self, instruction: Instruction) -> None:
        if not _is_small_branch(instruction):
            super().instruction(instruction)
            return
        (condition,) = self.all(instruction.operands)
        for region in instruction.regions:
            self.inside(region)
        yes, no = (self.all(region.yields) for region in instruction.regions)
        for result, a, b in zip(instruction.results, yes, no, strict=True):
            if a is b:
                self.values[id(result)] = a
                continue
            made = Instruction("select", (condition, a, b), (), (result.type,))
            self.blocks[-1].instructions.append(made)
            self.values[id(result)] = made.results[0]


def _is_small_branch(instruction: Instruction) -> bool:
    return instruction.op == "if" and all(map(_is_small, instruction.regions))


def _is_small(region: Block) -> bool:
    if len(region.instructions) > 4 * _LIMIT:
        return False
    body = [i for i in region.instructions if i.op != "const"]
    return len(body) <= _LIMIT and all(OPS[i.op].pure and i.op not in _DEAR for i in body)


def flatten(kernel: Kernel) -> Kernel:
    """Turn branches whose sides are a few pure, cheap instructions into selects."""
    wanted = any(_is_small_branch(i) for block in regions_of(kernel) for i in block.instructions)
    return _Flattener().kernel(kernel) if wanted else kernel
