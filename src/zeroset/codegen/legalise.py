"""What a GPU's arithmetic leaves open, said in the kernel language itself before a kernel becomes WGSL.

WGSL lets quotients be off by 2.5 units in the last place and square roots by more, and says little of conversions to
integers of numbers out of range; and there are drivers that round f64 numbers to whole ones wrongly. Here a quotient or
root becomes the GPU's own and one Newton step from it, whose remainder a fused multiply-add gives exactly: what comes
out is within a hair of half a unit. The interpreter runs the result as it runs any kernel, which is how tests see that
nothing changes where arithmetic is exact.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from zeroset.codegen.gpu_target import GpuTarget
from zeroset.kernel.build import Kernel
from zeroset.kernel.passes.rewriter import Rewriter
from zeroset.kernel.types import F32, F64, I32, U32, Type
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
        if not target.exact_rounding:
            self._rules |= {name: partial(_rounded, name) for name in _ROUNDINGS}

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


def _rounded(name: str, a: Value) -> Value:
    """A whole number by way of integers of 20 bits and less; from 2^52 on all numbers are whole.

    Two additions of 2^52 would do, but compilers take ``(x + c) - c`` for x; and integers of more than 24 bits too, but
    Mesa makes of a conversion there and back the very rounding to zero that it gets wrong for them.
    """
    if a.type is not F64:
        return getattr(a, name)()  # type: ignore[no-any-return]
    inside = abs(a) < _WHOLE
    size = inside.select(abs(a), 0.0)
    high = (size * _PIECE**-2).convert(I32).convert(F64) * _PIECE**2
    rest = size - high
    middle = (rest * _PIECE**-1).convert(I32).convert(F64) * _PIECE
    low = (rest - middle).convert(I32)
    cut = high + middle + low.convert(F64)
    made = _ROUNDINGS[name](a, size, cut, (low & 1).ne(0))
    # A zero keeps its sign.
    return (inside & size.ne(0.0)).select(made, a)


def _signed(a: Value, size: Value) -> Value:
    return (a < 0.0).select(-size, size)


def _floor(a: Value, size: Value, cut: Value, odd: Value) -> Value:
    made = _signed(a, cut)
    return (made > a).select(made - 1.0, made)


def _ceil(a: Value, size: Value, cut: Value, odd: Value) -> Value:
    made = _signed(a, cut)
    return (made < a).select(made + 1.0, made)


def _trunc(a: Value, size: Value, cut: Value, odd: Value) -> Value:
    return _signed(a, cut)


def _rint(a: Value, size: Value, cut: Value, odd: Value) -> Value:
    rest = size - cut
    up = (rest > 0.5) | (rest.eq(0.5) & odd)
    return _signed(a, up.select(cut + 1.0, cut))


_WHOLE = 2.0**52
_PIECE = 2.0**20
_ROUNDINGS: dict[str, Callable[[Value, Value, Value, Value], Value]] = {
    "floor": _floor,
    "ceil": _ceil,
    "trunc": _trunc,
    "rint": _rint,
}


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
