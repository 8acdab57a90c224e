"""What a GPU's arithmetic leaves open, said in the kernel language itself before a kernel becomes WGSL.

WGSL lets quotients be off by 2.5 units in the last place and square roots by more, and says little of conversions to
integers of numbers out of range. Here a quotient or root becomes the GPU's own and one Newton step from it, whose
remainder a fused multiply-add gives exactly: what comes out is within a hair of half a unit. The interpreter runs the
result as it runs any kernel, which is how tests see that nothing changes where arithmetic is exact.
"""

from __future__ import annotations

from collections.abc import Callable

from zeroset.codegen.gpu_target import GpuTarget
from zeroset.kernel.build import Kernel
from zeroset.kernel.passes.rewriter import Rewriter
from zeroset.kernel.types import F32, U32, Type
from zeroset.kernel.value import Instruction, Value, constant, tracing

_HUGE = {"f32": 2.0**120, "f64": 2.0**1000}
"""Beyond this the remainder of a Newton step may overflow, and the GPU's own result stands."""
_RANGES = {"i32": (-(2.0**31), 2.0**31, -(2**31), 2**31 - 1), "u32": (0.0, 2.0**32, 0, 2**32 - 1)}


def legalise(kernel: Kernel, target: GpuTarget) -> Kernel:
    """The kernel with all that the target does not do as the interpreter defines it spelled out."""
    return _Legaliser(target).kernel(kernel)


class _Legaliser(Rewriter):
    def __init__(self, target: GpuTarget) -> None:
        super().__init__()
        self._rules: dict[str, Callable[..., Value]] = {}
        if not target.exact_division:
            self._rules["div"] = _quotient
        if not target.exact_root:
            self._rules["sqrt"] = _root

    def instruction(self, instruction: Instruction) -> None:
        rule = self._rules.get(instruction.op)
        operands = self.all(instruction.operands)
        if instruction.op == "convert" and operands[0].type.kind == "f" and instruction.results[0].type.kind in "iu":
            with tracing(self.blocks[-1]):
                self.bind(instruction.results, (_whole(operands[0], instruction.results[0].type),))
        elif rule is not None:
            with tracing(self.blocks[-1]):
                self.bind(instruction.results, (rule(*operands),))
        else:
            super().instruction(instruction)


def _quotient(a: Value, b: Value) -> Value:
    inverse, near = 1.0 / b, a / b
    rest = (-near).fma(b, a)
    huge = _HUGE[a.type.name]
    return ((abs(rest) < huge) & (abs(inverse) < huge)).select(rest.fma(inverse, near), near)


def _root(a: Value) -> Value:
    near = a.sqrt()
    rest = (-near).fma(near, a)
    return ((a > 0.0) & (a < _HUGE[a.type.name])).select(rest.fma(0.5 / near, near), near)


def _whole(a: Value, to: Type) -> Value:
    """Conversion to an integer: saturating, 0 for a NaN, and never of a number that does not fit."""
    low, high, least, most = _RANGES[to.name]
    inside = (a > low) & (a < high)
    edge = (a >= high).select(constant(most, to), constant(least, to))
    made = inside.select(inside.select(a, constant(low, a.type)).convert(to), edge)
    return _is_number(a).select(made, constant(0, to))


def _is_number(a: Value) -> Value:
    """By its bits, where there is an integer to hold them: a compiler may take ``a == a`` for granted."""
    if a.type is not F32:
        return a.eq(a)
    return (a.bitcast(U32) & 0x7FFFFFFF) <= 0x7F800000
