"""One pure instruction being written: its operands in their form, and LLVM's instructions over that form.

The same few methods write scalar code for uniform values and vector code for varying ones, so that no operation
needs to know which it is.
"""

from __future__ import annotations

from zeroset.codegen.writer import Writer
from zeroset.kernel.value import Instruction


class Emit:
    """One pure instruction being written, all its operands in one form."""

    def __init__(self, writer: Writer, instruction: Instruction) -> None:
        self.writer = writer
        self.instruction = instruction
        self.result = instruction.results[0].type
        self.vector = writer.is_varying(instruction.results[0])
        self.source = instruction.operands[-1].type
        form = writer.vector if self.vector else writer.scalar
        self.operands = [form(v) for v in instruction.operands]
        self.type = writer.type_of(self.source, self.vector)

    def splat(self, type_: str, literal: int | str) -> str:
        """A literal of an LLVM type in the instruction's form."""
        return f"splat ({type_} {literal})" if self.vector else str(literal)

    def lanes(self, scalar: str) -> str:
        """An LLVM type in the instruction's form."""
        return f"<{self.writer.width} x {scalar}>" if self.vector else scalar

    def binary(self, name: str, a: str, b: str, type_: str | None = None) -> str:
        """A two-operand LLVM instruction."""
        return self.writer.assign(f"{name} {type_ or self.type} {a}, {b}")

    def cast(self, name: str, operand: str, source: str, target: str) -> str:
        """A one-operand LLVM conversion."""
        return self.writer.assign(f"{name} {source} {operand} to {target}")

    def intrinsic(self, name: str, *operands: str) -> str:
        """An LLVM intrinsic over the operands' type."""
        type_, full = self.type, f"{name}.{self.writer.suffix(self.source, self.vector)}"
        self.writer.declarations.add(f"declare {type_} @{full}({', '.join([type_] * len(operands))})")
        return self.writer.assign(f"call {type_} @{full}({type_} {f', {type_} '.join(operands)})")

    def truth(self, bits: str) -> str:
        """One bit a lane as the form truth values have."""
        return self.writer.from_bits(bits) if self.vector else bits

    def pick(self, bits: str, type_: str, a: str, b: str) -> str:
        """LLVM's ``select`` on bits."""
        return self.writer.assign(f"select {self.lanes('i1')} {bits}, {type_} {a}, {type_} {b}")
