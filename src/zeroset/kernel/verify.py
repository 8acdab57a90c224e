"""What a legal kernel is. Runs before and after the passes, and after each one for those who watch them; a violation
is a bug in zeroset, said clearly.

Legal: every operand is defined before its use in an enclosing scope; operand and result types follow the operation
table; loops and branches carry and yield matching types; memory operations name declared buffers of the right type;
``index`` and ``uniform`` are declared. Constants are finite, so that no target meets an infinity in its text.
"""

from __future__ import annotations

from math import isfinite

from zeroset.errors import KernelError
from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import OPS, result_type
from zeroset.kernel.types import BOOL, TYPES, U32, Type
from zeroset.kernel.value import Block, Instruction


class _Verifier:
    def __init__(self, kernel: Kernel) -> None:
        self.kernel = kernel
        self.uniforms = {u.name: u.type for u in kernel.uniforms}
        self.buffers = {b.name: b for b in kernel.buffers}
        self.defined: set[int] = set()
        # Most instructions repeat an operation on types already found right: its name, its one result, its operands.
        self.legal: set[tuple[str | Type, ...]] = set()

    def fail(self, instruction: Instruction | None, why: str) -> None:
        where = f" in {instruction.op}" if instruction is not None else ""
        raise KernelError(f"kernel {self.kernel.name} is not legal{where}: {why}")

    def block(self, block: Block, expected: tuple[Type, ...]) -> None:
        """Check a block whose values go out of scope at its end."""
        inside = [id(v) for v in block.parameters]
        self.defined.update(inside)
        defined, legal = self.defined, self.legal
        for instruction in block.instructions:
            for operand in instruction.operands:
                if id(operand) not in defined:
                    self.fail(instruction, "an operand is used where it is not defined")
            results = instruction.results
            operands = [v.type for v in instruction.operands]
            if len(results) != 1 or (instruction.op, results[0].type, *operands) not in legal:
                self.instruction(instruction)
            for result in results:
                defined.add(id(result))
                inside.append(id(result))
        if any(id(v) not in defined for v in block.yields):
            self.fail(None, "a block yields a value that is not defined in it")
        if tuple(v.type for v in block.yields) != expected:
            self.fail(None, f"a block yields {[str(v.type) for v in block.yields]}, not {[str(t) for t in expected]}")
        self.defined.difference_update(inside)

    def instruction(self, instruction: Instruction) -> None:
        types = tuple([v.type for v in instruction.operands])
        results = tuple([v.type for v in instruction.results])
        op = OPS.get(instruction.op)
        if op is None:
            self.fail(instruction, "there is no such operation")
            return
        if op.arity >= 0 and len(types) != op.arity:
            self.fail(instruction, f"it takes {op.arity} operands, not {len(types)}")
        if op.result in ("same", "bool") and op.name != "any":
            try:
                expected = result_type(op, types)
            except ValueError as error:
                self.fail(instruction, str(error))
                return
            if results != (expected,):
                self.fail(instruction, f"its result should be {expected}")
            self.legal.add((op.name, expected, *types))
            return
        check = getattr(self, f"_{op.name}", None) or (self._atomic if op.name.startswith("atomic") else None)
        if check is None:
            self.fail(instruction, "the verifier does not know it")
        else:
            check(instruction, types, results)

    def _const(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        if len(results) != 1 or len(instruction.attributes) != 1:
            self.fail(instruction, "a constant is one value of one type")
        kind, text = results[0].kind, instruction.attributes[0]
        try:
            legal = text in ("True", "False") if kind == "b" else isfinite(float(text) if kind == "f" else int(text))
        except ValueError:
            legal = False
        if not legal:
            self.fail(instruction, f"{text} is no finite constant of type {results[0]}")

    def _uniform(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        if self.uniforms.get(instruction.attributes[0]) != results[0]:
            self.fail(instruction, f"uniform {instruction.attributes[0]} is not declared as {results[0]}")

    def _index(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        if results != (U32,):
            self.fail(instruction, "the index is u32")

    def _any(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        if types != (BOOL,) or results != (BOOL,):
            self.fail(instruction, "a vote is bool to bool")

    def _convert(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        if results != (TYPES[instruction.attributes[0]],):
            self.fail(instruction, "its result is not the type that it converts to")

    def _bitcast(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        self._convert(instruction, types, results)
        if types[0].size != results[0].size or not results[0].size:
            self.fail(instruction, "the sizes differ")

    def _load(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        buffer = self.buffers.get(instruction.attributes[0])
        if buffer is None or results != (buffer.type,) or types[0].kind not in "iu":
            self.fail(instruction, f"buffer {instruction.attributes[0]} is not declared so")

    def _store(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        buffer = self.buffers.get(instruction.attributes[0])
        if buffer is None or not buffer.writable or types[0].kind not in "iu" or types[1] != buffer.type:
            self.fail(instruction, f"buffer {instruction.attributes[0]} is not declared so")

    def _atomic(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        self._store(instruction, types, results)
        if types[1].kind not in "iu" or results != (types[1],):
            self.fail(instruction, "atomics are on integers and give the value before")

    def _while(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        head, loop = instruction.regions
        self._carries(instruction, types, results)
        for region in (head, loop):
            if tuple(v.type for v in region.parameters) != types:
                self.fail(instruction, "a region's parameters are not the state's types")
        self.block(head, (BOOL,))
        self.block(loop, types)

    def _for(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        (loop,) = instruction.regions
        if types[0] != U32:
            self.fail(instruction, "the count is u32")
        self._carries(instruction, types[1:], results)
        if tuple(v.type for v in loop.parameters) != types:
            self.fail(instruction, "the region's parameters are not the counter and the state")
        self.block(loop, types[1:])

    def _if(self, instruction: Instruction, types: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        if types != (BOOL,):
            self.fail(instruction, "it branches on one bool")
        for region in instruction.regions:
            self.block(region, results)

    def _carries(self, instruction: Instruction, state: tuple[Type, ...], results: tuple[Type, ...]) -> None:
        if state != results:
            self.fail(instruction, "its results are not the types of its state")


def verify(kernel: Kernel) -> Kernel:
    """Check a kernel and give it back; raises ``KernelError`` naming the operation and the rule that it breaks."""
    _Verifier(kernel).block(kernel.body, ())
    return kernel
