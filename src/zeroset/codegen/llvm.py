"""Kernel to LLVM IR, and LLVM IR to object code.

One function runs the lanes ``begin .. end - 1`` of a dispatch in packets of W (``begin`` is a multiple of W); what
derives from uniforms alone is computed once, before the loop over packets. A second function, ``drain``, takes chunks
of lanes off a shared counter until none are left, so that the threads of a dispatch meet only in one atomic add.

Arguments come in slots, see ``slots``.
"""

from __future__ import annotations

import ctypes
from typing import Any

from zeroset.codegen.control import Control
from zeroset.codegen.memory import Memory
from zeroset.codegen.operations import write_pure
from zeroset.codegen.target import Target, host_targets
from zeroset.codegen.writer import SCALARS, Writer
from zeroset.errors import DeviceError
from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import OPS
from zeroset.kernel.types import BOOL
from zeroset.kernel.uniformity import varying_values
from zeroset.kernel.value import Block, Instruction

_LONG = 6000
"""Lines of LLVM IR past which the code generator hurries: 0.1 s instead of 0.6 s at 8,000, for code 10% slower.

Levels 2 and 3 gave nothing over 1 on ray kernels; level 0 costs those of some hundred instructions a third."""

_DRAIN = """
define i32 @drain(ptr %args, ptr %next, i32 %count, i32 %chunk, i32 %budget) nounwind {
entry:
  br label %take
take:
  %left = phi i32 [ %budget, %entry ], [ %less, %run ]
  %out = icmp eq i32 %left, 0
  br i1 %out, label %more, label %claim
claim:
  %wide = zext i32 %chunk to i64
  %at = atomicrmw add ptr %next, i64 %wide monotonic, align 8
  %all = zext i32 %count to i64
  %over = icmp uge i64 %at, %all
  br i1 %over, label %empty, label %run
run:
  %stop = add i64 %at, %wide
  %end = call i64 @llvm.umin.i64(i64 %stop, i64 %all)
  %first = trunc i64 %at to i32
  %last = trunc i64 %end to i32
  call void @kernel(ptr %args, i32 %first, i32 %last)
  %less = sub i32 %left, 1
  br label %take
more:
  ret i32 1
empty:
  ret i32 0
}
declare i64 @llvm.umin.i64(i64, i64)
"""


class _Function:
    """One kernel being written as a function."""

    def __init__(self, kernel: Kernel, target: Target) -> None:
        self.kernel = kernel
        self.writer = Writer(target, varying_values(kernel))
        used = _used(kernel)
        self.memory = Memory(self.writer, kernel.buffers, used)
        self.control = Control(self.writer, self.block, used)
        self.packet: list[str] = []
        self.handlers = {
            "load": self.memory.load,
            "store": self.memory.store,
            "while": self.control.while_,
            "for": self.control.for_,
            "if": self.control.if_,
            "any": self.any_,
            "index": self.index,
            "uniform": self.uniform,
        }

    def text(self) -> str:
        writer, width = self.writer, self.writer.width
        for i in range(len(self.kernel.buffers)):
            self._slot(f"%buffer{i}", "ptr", i)
        writer.lines = self.packet
        writer.label("packets")
        writer.line("%packet = phi i32 [ %begin, %entry ], [ %following, %finish ]")
        lanes, steps = f"<{width} x i32>", ", ".join(f"i32 {i}" for i in range(width))
        writer.line(f"%lanes = add {lanes} {writer.everywhere('%packet')}, <{steps}>")
        writer.mask = writer.from_bits(writer.assign(f"icmp ult {lanes} %lanes, {writer.everywhere('%end')}"))
        self.block(self.kernel.body, top=True)
        writer.jump("finish")
        writer.label("finish")
        writer.line(f"%following = add i32 %packet, {width}")
        writer.branch(writer.assign("icmp ult i32 %following, %end"), "packets", "leave")
        head = ["define internal void @kernel(ptr %args, i32 %begin, i32 %end) nounwind {", "entry:"]
        tail = ["leave:", "  ret void", "}"]
        lines = [*sorted(writer.declarations), *head, *writer.entry, "  br label %packets", *self.packet, *tail]
        return "\n".join(line for line in lines if line) + "\n" + _DRAIN

    def _slot(self, name: str, type_: str, slot: int) -> None:
        place = self.writer.assign(f"getelementptr i64, ptr %args, i64 {slot}")
        self.writer.line(f"{name} = load {type_}, ptr {place}, align 8")

    def block(self, block: Block, top: bool = False) -> None:
        """Write a region's instructions; at the top, what no packet changes goes before the packets."""
        for instruction in block.instructions:
            if top and self._before_packets(instruction):
                self.writer.lines = self.writer.entry
                self.instruction(instruction)
                self.writer.lines = self.packet
            else:
                self.instruction(instruction)

    def _before_packets(self, instruction: Instruction) -> bool:
        if not all(map(self.writer.known, instruction.operands)):
            return False
        if instruction.op == "load":
            return not self.memory.writable[instruction.attributes[0]]
        return OPS[instruction.op].pure and instruction.op != "index"

    def instruction(self, instruction: Instruction) -> None:
        op = instruction.op
        handler = self.handlers.get(op)
        if handler is not None:
            handler(instruction)
        elif op.startswith("atomic"):
            self.memory.atomic(instruction)
        elif op != "const":
            write_pure(self.writer, instruction)

    def any_(self, instruction: Instruction) -> None:
        writer = self.writer
        (condition,), (result,) = instruction.operands, instruction.results
        if writer.is_varying(condition):
            writer.define(result, writer.some(writer.both(writer.mask, writer.vector(condition))))
        else:
            writer.define(result, writer.scalar(condition))

    def index(self, instruction: Instruction) -> None:
        self.writer.define(instruction.results[0], "%lanes")

    def uniform(self, instruction: Instruction) -> None:
        """Uniforms are read where they are first met, before the packets."""
        (result,), name = instruction.results, instruction.attributes[0]
        position = [u.name for u in self.kernel.uniforms].index(name)
        outside, self.writer.lines = self.writer.lines, self.writer.entry
        text = f"%{self.writer.fresh('u')}"
        stored = "i8" if result.type == BOOL else SCALARS[result.type.name]
        self._slot(text, stored, len(self.kernel.buffers) + position)
        if result.type == BOOL:
            text = self.writer.assign(f"icmp ne i8 {text}, 0")
        self.writer.define(result, text)
        self.writer.lines = outside


def _used(kernel: Kernel) -> frozenset[int]:
    """The ids of the values that something reads."""
    used: set[int] = set()
    blocks = [kernel.body]
    while blocks:
        block = blocks.pop()
        used.update(map(id, block.yields))
        for instruction in block.instructions:
            used.update(map(id, instruction.operands))
            blocks.extend(instruction.regions)
    return frozenset(used)


def to_llvm(kernel: Kernel, target: Target) -> str:
    """The LLVM IR of a verified kernel for a target."""
    return _Function(kernel, target).text()


def host() -> tuple[Target, ...]:
    """The targets that this machine runs, the best first."""
    import llvmlite.binding as llvm

    return host_targets(llvm.get_process_triple(), llvm.get_host_cpu_name(), dict(llvm.get_host_cpu_features()))


def machine(target: Target, level: int = 1) -> Any:
    """LLVM's target machine; ``level`` is how hard its code generator tries, 0 to 3."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    found = llvm.Target.from_triple(target.triple)
    # The small model reaches constants relative to the code; they are loaded beside it.
    return found.create_target_machine(
        cpu=target.cpu, features=target.features, opt=level, reloc="pic", codemodel="small"
    )


def to_object(text: str, target: Target, level: int | None = None) -> bytes:
    """Object code of LLVM IR.

    Args:
        text: what ``to_llvm`` gave.
        target: for whom.
        level: how hard the code generator tries, 0 to 3; None decides by the length of the text.

    Raises:
        DeviceError: LLVM refuses the text, which is a bug in zeroset.
    """
    import llvmlite.binding as llvm

    if level is None:
        level = 1 if text.count("\n") <= _LONG else 0
    maker = machine(target, level)
    try:
        module = llvm.parse_assembly(text, llvm.create_context())
        module.verify()
        return _emit(maker, module)
    except RuntimeError as error:
        raise DeviceError(f"LLVM does not take the code of a kernel: {str(error).splitlines()[0]}") from error


def _emit(maker: Any, module: Any) -> bytes:
    """Object code of a module, made outside llvmlite's global lock where that can be had.

    llvmlite allows one call into LLVM at a time in the whole process. LLVM itself works on several modules at once as
    long as each has a context and a target machine of its own, as here; so the call goes past the lock, which lets
    the kernels of a frame be compiled side by side.
    """
    from llvmlite.binding import ffi

    locked = ffi.lib.LLVMPY_TargetMachineEmitToMemory
    unlocked = getattr(locked, "_cfn", None)
    if unlocked is None:
        return bytes(maker.emit_object(module))
    with ffi.OutputString() as error:
        buffer = unlocked(maker, module, 1, error)
        if not buffer:
            raise RuntimeError(str(error))
    start, size = ffi.lib.LLVMPY_GetBufferStart(buffer), ffi.lib.LLVMPY_GetBufferSize(buffer)
    try:
        return ctypes.string_at(start, size)
    finally:
        ffi.lib.LLVMPY_DisposeMemoryBuffer(buffer)
