"""A kernel as text: what ``zeroset explain`` prints."""

from __future__ import annotations

from zeroset.kernel.build import Kernel
from zeroset.kernel.value import Block, Value


class _Printer:
    def __init__(self) -> None:
        self._names: dict[int, str] = {}
        self.lines: list[str] = []

    def name(self, value: Value) -> str:
        return self._names.setdefault(id(value), f"%{len(self._names)}")

    def names(self, values: tuple[Value, ...]) -> str:
        return ", ".join(self.name(v) for v in values)

    def block(self, block: Block, depth: int, label: str) -> None:
        pad = "  " * depth
        head = ", ".join(f"{self.name(v)}: {v.type}" for v in block.parameters)
        self.lines.append(f"{pad}{label}({head})")
        for instruction in block.instructions:
            left = ", ".join(f"{self.name(v)}: {v.type}" for v in instruction.results)
            attributes = "".join(f" {a}" for a in instruction.attributes)
            operands = self.names(instruction.operands)
            text = f"{instruction.op}{attributes}{' ' if operands else ''}{operands}"
            self.lines.append(f"{pad}  {left} = {text}" if left else f"{pad}  {text}")
            for i, region in enumerate(instruction.regions):
                self.block(region, depth + 2, f"region {i}")
        if block.yields:
            self.lines.append(f"{pad}  yield {self.names(block.yields)}")


def to_text(kernel: Kernel) -> str:
    """The kernel's declaration and body, one instruction a line, values numbered in the order they appear."""
    printer = _Printer()
    uniforms = [f"uniform {u.name}: {u.type}" for u in kernel.uniforms]
    buffers = [
        f"buffer {b.name}: {b.type}{' writable' if b.writable else ''}{' constant' if b.constant else ''}"
        for b in kernel.buffers
    ]
    printer.block(kernel.body, 0, f"kernel {kernel.name}")
    return "\n".join([*uniforms, *buffers, *printer.lines]) + "\n"


def count_instructions(block: Block) -> int:
    """How many instructions a block holds, nested ones included."""
    return sum(1 for _ in block.walk())
