"""Constant folding, and laws that hold bit for bit.

Constants meet through ``OPS[...].evaluate``, the definition of each operation, and only where the result is finite:
kernels hold no other constants. The laws are those that IEEE arithmetic keeps for every operand, NaN, infinities and
the sign of zero included (``x - 0`` is x, ``x + 0`` is not; ``x / 4`` is ``x * 0.25``, ``x / 3`` stays).
"""

from __future__ import annotations

import numpy as np

from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import OPS
from zeroset.kernel.passes.laws import LAWS
from zeroset.kernel.passes.literals import Literals
from zeroset.kernel.types import TYPES
from zeroset.kernel.value import Instruction, Value

_TELLING = frozenset({"const", "neg", "abs", "not", "lt", "le", "gt", "ge", "eq", "ne"})
"""Operations that a law looks for behind an operand."""


class Folder(Literals):
    """A rebuilding in which constants are computed and laws applied."""

    def instruction(self, instruction: Instruction) -> None:
        """Rebuild an instruction, or bind its result to what it equals."""
        if instruction.regions:
            self._control(instruction)
            return
        operands = self.all(instruction.operands)
        value = self._simplify(instruction, operands) if _is_special(operands) else None
        if value is None:
            self.place(instruction, operands, (), self.blocks[-1])
        else:
            self.values[id(instruction.results[0])] = value

    def _simplify(self, instruction: Instruction, operands: tuple[Value, ...]) -> Value | None:
        op = OPS[instruction.op]
        if op.evaluate is None or not operands:
            return operands[0] if instruction.op == "any" and self.is_constant(operands[0]) else None
        if all(map(self.is_constant, operands)):
            return self._evaluate(instruction, operands)
        law = LAWS.get(instruction.op)
        return None if law is None else law(self, *operands)

    def _evaluate(self, instruction: Instruction, operands: tuple[Value, ...]) -> Value | None:
        arrays = [np.asarray([self.number(v)], v.type.dtype) for v in operands]
        op, type_ = OPS[instruction.op], instruction.results[0].type
        extra = (TYPES[instruction.attributes[0]],) if op.result == "attr" else ()
        assert op.evaluate is not None
        with np.errstate(all="ignore"):
            result = np.asarray(op.evaluate(*arrays, *extra)).astype(type_.dtype)[0]
        return self.constant(result, type_) if np.isfinite(result) else None

    def _control(self, instruction: Instruction) -> None:
        """Branches on constants and loops that never run vanish; the rest is rebuilt."""
        op = instruction.op
        decided = self.all(instruction.operands[:1])
        if op == "if" and self.is_constant(decided[0]):
            region = instruction.regions[0 if self.number(decided[0]) else 1]
            self.inside(region)
            self.bind(instruction.results, self.all(region.yields))
        elif op == "for" and self.is_constant(decided[0]) and self.number(decided[0]) == 0:
            self.bind(instruction.results, self.all(instruction.operands[1:]))
        else:
            super().instruction(instruction)


def _is_special(operands: tuple[Value, ...]) -> bool:
    """Whether some law may apply: an operand that tells something, or the same one twice. Few instructions have one."""
    for value in operands:
        definition = value.definition
        if definition is not None and definition.op in _TELLING:
            return True
    return len(operands) > 1 and (operands[0] is operands[1] or operands[-2] is operands[-1])


def fold(kernel: Kernel) -> Kernel:
    """Compute what is constant and drop what changes nothing, bit for bit."""
    return Folder().kernel(kernel)
