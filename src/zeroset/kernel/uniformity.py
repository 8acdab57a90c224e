"""Which values are the same on every lane.

A value that derives only from uniforms and constants is uniform: targets keep it scalar, loops that depend on such
values alone need no masks, and branches on them are real branches. A vote (``any``) is uniform by its meaning.
"""

from __future__ import annotations

from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import ATOMICS
from zeroset.kernel.value import Block, Instruction, Value

_SPECIAL = frozenset({"while", "for", "if", "index", "any", *ATOMICS})
"""Operations whose results are not simply as their operands are."""


def varying_values(kernel: Kernel) -> frozenset[int]:
    """The ids of the values that may differ between lanes."""
    varying: set[int] = set()
    _block(kernel.body, varying)
    return frozenset(varying)


def _mark(values: tuple[Value, ...], flags: list[bool], varying: set[int]) -> None:
    varying.update(id(v) for v, flag in zip(values, flags, strict=True) if flag)


def _differs(value: Value, varying: set[int]) -> bool:
    return id(value) in varying


def _block(block: Block, varying: set[int]) -> None:
    for instruction in block.instructions:
        if instruction.op in _SPECIAL:
            _special(instruction, varying)
            continue
        for value in instruction.operands:
            if id(value) in varying:
                varying.update(map(id, instruction.results))
                break


def _special(instruction: Instruction, varying: set[int]) -> None:
    op = instruction.op
    if op in ("while", "for"):
        _loop(instruction, varying)
    elif op == "if":
        for region in instruction.regions:
            _block(region, varying)
        branch = _differs(instruction.operands[0], varying)
        yes, no = instruction.regions
        flags = [
            branch or _differs(a, varying) or _differs(b, varying) for a, b in zip(yes.yields, no.yields, strict=True)
        ]
        _mark(instruction.results, flags, varying)
    elif op != "any":
        varying.update(map(id, instruction.results))


def _loop(instruction: Instruction, varying: set[int]) -> None:
    """A loop's state varies if its start or its step does, or if lanes leave at different times: a fixed point."""
    body = instruction.regions[-1]
    counted = instruction.op == "for"
    start = instruction.operands[1:] if counted else instruction.operands
    state = body.parameters[1:] if counted else body.parameters
    flags = [_differs(v, varying) for v in start]
    while True:
        for region in instruction.regions:
            _mark(region.parameters[1:] if counted else region.parameters, flags, varying)
            _block(region, varying)
        leaves = _differs(instruction.operands[0] if counted else instruction.regions[0].yields[0], varying)
        grown = [flag or leaves or _differs(v, varying) for flag, v in zip(flags, body.yields, strict=True)]
        if grown == flags:
            break
        flags = grown
    _mark(state, flags, varying)
    _mark(instruction.results, flags, varying)
