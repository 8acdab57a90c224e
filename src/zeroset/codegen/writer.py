"""Writes the text of one LLVM function: names, blocks, and each kernel value in its scalar or vector form.

A uniform kernel value is one LLVM scalar, a varying one a vector of W lanes. A uniform value that meets varying ones
is broadcast once, right where it is defined, so that no loop repeats it. Truth values of W lanes are vectors of bits
where the CPU has mask registers, and otherwise 32-bit lanes of ones or zeros, as its blends and ``and``s want them.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from zeroset.codegen.target import Target
from zeroset.kernel.types import BOOL, Type
from zeroset.kernel.value import Instruction, Value

SCALARS = {"f32": "float", "f64": "double", "i32": "i32", "u32": "i32", "bool": "i1"}
SUFFIXES = {"f32": "f32", "f64": "f64", "i32": "i32", "u32": "i32", "bool": "i1"}


@dataclass(slots=True)
class Register:
    """Where a kernel value lives: an LLVM name or literal, and whether it is a vector of W lanes.

    ``spot`` is the line after the definition of a scalar, kept free for its broadcast.
    """

    text: str
    vector: bool
    spot: tuple[list[str], int] | None = None


class Writer:
    """The function being written; see the module's text."""

    def __init__(self, target: Target, varying: frozenset[int]) -> None:
        self.target = target
        self.width = target.width
        self.varying = varying
        self.declarations: set[str] = set()
        self.entry: list[str] = []
        self.lines: list[str] = self.entry
        self.block = "entry"
        self.mask = ""
        self._counter = 0
        self._registers: dict[int, Register] = {}
        self._broadcasts: dict[str, str] = {}
        self._bits: dict[str, str] = {}
        self.bits_type = f"<{self.width} x i1>"
        self.mask_type = self.bits_type if target.bit_masks else f"<{self.width} x i32>"
        self.vectors = {name: f"<{self.width} x {text}>" for name, text in SCALARS.items()} | {"bool": self.mask_type}

    # ------------------------------------------------------------------ text

    def fresh(self, prefix: str = "v") -> str:
        """A name that nothing else has, without its ``%``."""
        self._counter += 1
        return f"{prefix}{self._counter}"

    def line(self, text: str) -> None:
        """One instruction without a result, or one already named."""
        self.lines.append(f"  {text}")

    def assign(self, text: str) -> str:
        """One instruction with a result; gives the result's name."""
        name = f"%{self.fresh()}"
        self.lines.append(f"  {name} = {text}")
        return name

    def reserve(self) -> tuple[list[str], int]:
        """A place in the text that is filled in later."""
        self.lines.append("")
        return self.lines, len(self.lines) - 1

    def label(self, name: str) -> None:
        """Begin a basic block."""
        self.lines.append(f"{name}:")
        self.block = name
        self._bits = {}

    def jump(self, label: str) -> None:
        """End the block with a jump."""
        self.line(f"br label %{label}")

    def branch(self, condition: str, yes: str, no: str) -> None:
        """End the block with a branch on an i1."""
        self.line(f"br i1 {condition}, label %{yes}, label %{no}")

    def call(self, name: str, result: str, *operands: tuple[str, str]) -> str:
        """Call an intrinsic, declared on first use; operands are (type, text) pairs."""
        types = ", ".join(kind for kind, _ in operands)
        self.declarations.add(f"declare {result} @{name}({types})")
        return self.assign(f"call {result} @{name}({', '.join(f'{kind} {text}' for kind, text in operands)})")

    # ---------------------------------------------------------------- values

    def is_varying(self, value: Value) -> bool:
        """Whether the value is a vector."""
        return id(value) in self.varying

    def type_of(self, type_: Type, vector: bool) -> str:
        """The LLVM type of a kernel type in one of its two forms."""
        return self.vectors[type_.name] if vector else SCALARS[type_.name]

    def suffix(self, type_: Type, vector: bool) -> str:
        """The type's part of an intrinsic's name."""
        return f"v{self.width}{SUFFIXES[type_.name]}" if vector else SUFFIXES[type_.name]

    def define(self, value: Value, text: str) -> None:
        """Bind a kernel value to what was just written."""
        vector = id(value) in self.varying
        self._registers[id(value)] = Register(text, vector, None if vector else self.reserve())

    def rename(self, value: Value, like: Value) -> None:
        """Bind a value that is another one under a new type."""
        self._registers[id(value)] = self._registers[id(like)]

    def known(self, value: Value) -> bool:
        """Whether the value was written before the loop over packets."""
        if is_constant(value):
            return True
        register = self._registers.get(id(value))
        return register is not None and register.spot is not None and register.spot[0] is self.entry

    def scalar(self, value: Value) -> str:
        """A uniform value's scalar."""
        register = self._registers.get(id(value))
        return self._literal(value) if register is None else register.text

    def vector(self, value: Value) -> str:
        """A value's W lanes; a uniform one is broadcast."""
        register = self._registers.get(id(value))
        if register is None:
            return self.splat(value.type, self._literal(value))
        if register.vector:
            return register.text
        if register.text not in self._broadcasts:
            assert register.spot is not None
            self._broadcasts[register.text] = self._broadcast(value.type, register.text, register.spot)
        return self._broadcasts[register.text]

    def _literal(self, value: Value) -> str:
        """The literal of a value that nothing has written: only constants are like that."""
        definition = value.definition
        assert definition is not None
        assert definition.op == "const"
        return literal_text(definition)

    def form(self, value: Value, vector: bool) -> str:
        """The value in the asked form."""
        return self.vector(value) if vector else self.scalar(value)

    def splat(self, type_: Type, constant: str) -> str:
        """A literal in every lane."""
        if type_ == BOOL and not self.target.bit_masks:
            return f"splat (i32 {'-1' if constant == 'true' else '0'})"
        return f"splat ({SCALARS[type_.name]} {constant})"

    def everywhere(self, number: str) -> str:
        """An i32 in every lane, made here and now."""
        lanes = f"<{self.width} x i32>"
        first = self.assign(f"insertelement {lanes} poison, i32 {number}, i64 0")
        return self.assign(f"shufflevector {lanes} {first}, {lanes} poison, {lanes} zeroinitializer")

    def _broadcast(self, type_: Type, text: str, spot: tuple[list[str], int]) -> str:
        lines, place = spot
        scalar, vector = SCALARS[type_.name], self.vectors[type_.name]
        made: list[str] = []
        if type_ == BOOL and not self.target.bit_masks:
            scalar, wide = "i32", f"%{self.fresh('w')}"
            made.append(f"  {wide} = sext i1 {text} to i32")
            text = wide
        first, name = f"%{self.fresh('e')}", f"%{self.fresh('s')}"
        made.append(f"  {first} = insertelement {vector} poison, {scalar} {text}, i64 0")
        made.append(f"  {name} = shufflevector {vector} {first}, {vector} poison, <{self.width} x i32> zeroinitializer")
        lines[place] = "\n".join(made)
        return name

    # ----------------------------------------------------------------- masks

    def bits(self, mask: str) -> str:
        """A lane mask as one bit a lane, for ``select`` and masked memory."""
        if self.target.bit_masks:
            return mask
        if mask not in self._bits:
            # Only the sign is looked at: that is what a blend instruction does.
            self._bits[mask] = self.assign(f"icmp slt {self.mask_type} {mask}, zeroinitializer")
        return self._bits[mask]

    def from_bits(self, bits: str) -> str:
        """One bit a lane as a lane mask."""
        if self.target.bit_masks:
            return bits
        mask = self.assign(f"sext {self.bits_type} {bits} to {self.mask_type}")
        self._bits[mask] = bits
        return mask

    def both(self, a: str, b: str) -> str:
        """The lanes that are in both masks."""
        return self.assign(f"and {self.mask_type} {a}, {b}")

    def without(self, a: str, b: str) -> str:
        """The lanes that are in the first mask and not in the second."""
        other = self.assign(f"xor {self.mask_type} {b}, {self.splat(BOOL, 'true')}")
        return self.both(a, other)

    def some(self, mask: str) -> str:
        """Whether some lane is in the mask, an i1."""
        bits = self.bits(mask)
        return self.call(f"llvm.vector.reduce.or.v{self.width}i1", "i1", (self.bits_type, bits))

    def every(self, mask: str) -> str:
        """Whether all lanes are in the mask, an i1."""
        bits = self.bits(mask)
        return self.call(f"llvm.vector.reduce.and.v{self.width}i1", "i1", (self.bits_type, bits))

    def choose(self, mask: str, type_: Type, a: str, b: str) -> str:
        """Lanes of ``a`` where the mask has them, else of ``b``."""
        if a == b:
            return a
        vector = self.vectors[type_.name]
        return self.assign(f"select {self.bits_type} {self.bits(mask)}, {vector} {a}, {vector} {b}")


def is_constant(value: Value) -> bool:
    """Whether the value is a literal of the kernel."""
    return value.definition is not None and value.definition.op == "const"


def literal_text(definition: Instruction) -> str:
    """The LLVM literal of a ``const`` instruction, exactly."""
    kind = definition.results[0].type.kind
    if kind == "f":
        bits = struct.unpack("<Q", struct.pack("<d", float(definition.attributes[0])))[0]
        return f"0x{bits:016X}"
    if kind == "b":
        return "true" if definition.attributes[0] == "True" else "false"
    number = int(definition.attributes[0])
    return str(number - 2**32 if number >= 2**31 else number)
