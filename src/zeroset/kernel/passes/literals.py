"""A rebuilding that can tell literals and make them: what ``laws`` are written on, and ``fold`` applies them with."""

from __future__ import annotations

from typing import Any

import numpy as np

from zeroset.kernel.passes.rewriter import Rewriter
from zeroset.kernel.types import BOOL, Type
from zeroset.kernel.value import Instruction, Value, constant_value


class Literals(Rewriter):
    """A rebuilding with what laws ask of values, and make of them."""

    def __init__(self) -> None:
        super().__init__()
        self._constants: dict[int, Any] = {}

    def is_constant(self, value: Value) -> bool:
        """Whether a value is a literal."""
        return value.definition is not None and value.definition.op == "const"

    def number(self, value: Value) -> Any:
        """A literal's NumPy scalar."""
        assert value.definition is not None
        known = self._constants.get(id(value))
        if known is None:
            known = self._constants[id(value)] = constant_value(value.definition)
        return known

    def is_number(self, value: Value, number: float) -> bool:
        """Whether a value is the literal ``number``, sign of zero included."""
        if not self.is_constant(value):
            return False
        known = self.number(value)
        same_sign = value.type.kind != "f" or np.signbit(known) == np.signbit(number)
        return bool(known == number and same_sign)

    def constant(self, number: Any, type_: Type) -> Value:
        """A literal in the block being made."""
        text = str(bool(number)) if type_ == BOOL else repr(float(number)) if type_.kind == "f" else str(int(number))
        return self.emit("const", (), type_, (text,))

    def emit(self, op: str, operands: tuple[Value, ...], type_: Type, attributes: tuple[Any, ...] = ()) -> Value:
        """An instruction in the block being made."""
        made = Instruction(op, operands, attributes, (type_,))
        self.blocks[-1].instructions.append(made)
        return made.results[0]

    def operand_of(self, value: Value, op: str) -> Value | None:
        """The operand of a value that a one-operand operation made, else None."""
        definition = value.definition
        return definition.operands[0] if definition is not None and definition.op == op else None
