"""Common subexpressions: equal pure instructions in scope become one.

Tracing already merges what is written twice; this finds what became equal later (hoisted out of two loops, folded),
what is equal but for the order of its operands, and loads of read-only buffers: those see the same element each time,
and the lanes that are active in an inner block are active outside it.
"""

from __future__ import annotations

from typing import Any

from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import OPS
from zeroset.kernel.passes.rewriter import Rewriter
from zeroset.kernel.value import Block, Instruction, Value

_COMMUTE = frozenset({"add", "mul", "eq", "ne", "and", "or", "xor"})
_SWAP = {"gt": "lt", "ge": "le"}


class _Merger(Rewriter):
    def __init__(self, read_only: frozenset[str]) -> None:
        super().__init__()
        self.read_only = read_only
        self.seen: dict[Any, tuple[Value, ...]] = {}
        self.added: list[list[Any]] = []

    def block(self, block: Block) -> Block:
        self.added.append([])
        copy = super().block(block)
        for key in self.added.pop():
            del self.seen[key]
        return copy

    def instruction(self, instruction: Instruction) -> None:
        op = instruction.op
        if not OPS[op].pure and not (op == "load" and instruction.attributes[0] in self.read_only):
            super().instruction(instruction)
            return
        operands = self.all(instruction.operands)
        key = _key(op, operands, instruction)
        results = self.seen.get(key)
        if results is None:
            self.seen[key] = self.place(instruction, operands, (), self.blocks[-1]).results
            self.added[-1].append(key)
        else:
            self.bind(instruction.results, results)


def _key(op: str, operands: tuple[Value, ...], instruction: Instruction) -> Any:
    ids: Any = map(id, operands)
    if op in _COMMUTE:
        ids = sorted(ids)
    elif op in _SWAP:
        op = _SWAP[op]
        ids = map(id, operands[::-1])
    return (op, instruction.attributes, instruction.results[0].type, *ids)


def cse(kernel: Kernel) -> Kernel:
    """Merge equal pure instructions and equal loads of read-only buffers."""
    return _Merger(frozenset(b.name for b in kernel.buffers if not b.writable)).kernel(kernel)
