"""The CPU's own instructions as text, for people who want to see what their formula has become."""

from __future__ import annotations

from zeroset.codegen import llvm
from zeroset.codegen.target import Target


def to_assembly(text: str, target: Target, level: int = 1) -> str:
    """The assembly of LLVM IR, as ``llvm.to_object`` would translate it.

    Args:
        text: what ``llvm.to_llvm`` gave.
        target: for whom.
        level: how hard the code generator tries, 0 to 3.
    """
    import llvmlite.binding as binding

    machine = llvm.machine(target, level)
    module = binding.parse_assembly(text, binding.create_context())
    module.verify()
    return str(machine.emit_assembly(module))
