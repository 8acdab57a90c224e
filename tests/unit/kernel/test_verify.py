"""Each rule of a legal kernel, broken once."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from zeroset.errors import KernelError
from zeroset.kernel import BOOL, F32, F64, U32, Buffer, Kernel, KernelBuilder, Uniform, if_, load, store, verify, while_
from zeroset.kernel.value import Block, Instruction, Value

ONE = Instruction("const", (), ("1.0",), (F32,))
TWO = Instruction("const", (), ("2.0",), (F64,))
YES = Instruction("const", (), ("True",), (BOOL,))
ZERO = Instruction("const", (), ("0",), (U32,))
STRAY = Value(F32, None)


def body(*instructions: Instruction) -> Kernel:
    block = Block()
    block.instructions = [ONE, TWO, YES, ZERO, *instructions]
    buffers = (Buffer("x", F32, True), Buffer("y", F32, False), Buffer("n", U32, True))
    return Kernel("k", (Uniform("a", F32),), buffers, block)


def region(parameters: tuple[object, ...], *yields: Value) -> Block:
    block = Block(parameters)
    block.yields = yields or block.parameters
    return block


one, two, yes, zero = (i.results[0] for i in (ONE, TWO, YES, ZERO))

ILLEGAL: dict[str, Callable[[], Instruction]] = {
    "no such operation": lambda: Instruction("cosine", (one,), (), (F32,)),
    "takes 2 operands": lambda: Instruction("add", (one,), (), (F32,)),
    "different types": lambda: Instruction("add", (one, two), (), (F32,)),
    "not defined on": lambda: Instruction("shl", (one, one), (), (F32,)),
    "should be bool": lambda: Instruction("lt", (one, one), (), (F32,)),
    "should be f32": lambda: Instruction("select", (yes, one, one), (), (F64,)),
    "chooses by a bool": lambda: Instruction("select", (one, one, one), (), (F32,)),
    "used where it is not defined": lambda: Instruction("neg", (STRAY,), (), (F32,)),
    "no finite constant": lambda: Instruction("const", (), ("nan",), (F32,)),
    "index is u32": lambda: Instruction("index", (), (), (F32,)),
    "uniform b": lambda: Instruction("uniform", (), ("b",), (F32,)),
    "converts to": lambda: Instruction("convert", (one,), ("u32",), (F32,)),
    "sizes differ": lambda: Instruction("bitcast", (one,), ("f64",), (F64,)),
    "a vote": lambda: Instruction("any", (one,), (), (BOOL,)),
    "buffer z": lambda: Instruction("load", (zero,), ("z",), (F32,)),
    "buffer y": lambda: Instruction("store", (zero, one), ("y",), ()),
    "buffer x": lambda: Instruction("store", (zero, two), ("x",), ()),
    "atomics are on integers": lambda: Instruction("atomic_add", (zero, one), ("x",), (F32,)),
    "types of its state": lambda: Instruction("while", (one,), (), (F64,), (region((F32,), yes), region((F32,)))),
    "a block yields": lambda: Instruction("while", (one,), (), (F32,), (region((F32,), one), region((F32,)))),
    "region's parameters": lambda: Instruction("while", (one,), (), (F32,), (region((F64,), yes), region((F32,)))),
    "count is u32": lambda: Instruction("for", (one,), (), (), (region((F32,)),)),
    "counter and the state": lambda: Instruction("for", (zero, one), (), (F32,), (region((F32,)),)),
    "branches on one bool": lambda: Instruction("if", (one,), (), (), (region(()), region(()))),
}


@pytest.mark.parametrize("rule", ILLEGAL)
def test_each_rule(rule: str) -> None:
    with pytest.raises(KernelError, match=rule):
        verify(body(ILLEGAL[rule]()))


def test_values_of_a_region_end_with_it() -> None:
    inside = Instruction("neg", (one,), (), (F32,))
    side = Block()
    side.instructions = [inside]
    branch = Instruction("if", (yes,), (), (), (side, Block()))
    with pytest.raises(KernelError, match="used where it is not defined"):
        verify(body(branch, Instruction("abs", inside.results, (), (F32,))))


def test_a_legal_kernel_comes_back() -> None:
    with KernelBuilder("k") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        (v,) = while_(lambda v: v > 1.0, lambda v: v * 0.5, load(x, i))
        (w,) = if_(v > 0.75, lambda: (v.sqrt(),), lambda: (-v,))
        store(x, i, w)
    assert verify(k.kernel) is k.kernel
