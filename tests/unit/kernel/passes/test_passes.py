"""What each pass does; that it keeps the meaning is held by the conformance suite's random kernels."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator

import numpy as np
import pytest

from zeroset.errors import KernelError
from zeroset.kernel import (
    BOOL,
    F32,
    F64,
    I32,
    U32,
    Kernel,
    KernelBuilder,
    Value,
    any_,
    atomic,
    constant,
    for_,
    if_,
    interp,
    load,
    store,
    verify,
    while_,
)
from zeroset.kernel.passes import PASSES, optimise
from zeroset.kernel.text import to_text
from zeroset.kernel.value import Block, Instruction


def instructions(block: Block) -> Iterator[Instruction]:
    for instruction in block.instructions:
        yield instruction
        for region in instruction.regions:
            yield from instructions(region)


def ops(kernel: Kernel) -> Counter[str]:
    return Counter(i.op for i in instructions(verify(kernel).body))


def traced(make: Callable[[KernelBuilder, Value, Value], Value | None]) -> Kernel:
    """A kernel that stores what ``make`` gives for a varying x and a uniform a."""
    with KernelBuilder("k") as k:
        x, i = k.buffer("x", F32), k.index()
        value = make(k, load(x, i), k.uniform("a", F32))
        if value is not None:
            if value.type == BOOL:
                value = value.convert(U32)
            store(k.buffer("out", value.type, writable=True), i, value)
    return k.kernel


NOTHING = {"index", "load", "uniform", "store", "const", "convert"}


@pytest.mark.parametrize(
    ("make", "left"),
    [
        (lambda k, x, a: x * 1.0, ""),
        (lambda k, x, a: 1.0 * x, ""),
        (lambda k, x, a: x / 1.0, ""),
        (lambda k, x, a: x + -0.0, ""),
        (lambda k, x, a: x - 0.0, ""),
        (lambda k, x, a: x + 0.0, "add"),
        (lambda k, x, a: x - -0.0, "sub"),
        (lambda k, x, a: x * 0.0, "mul"),
        (lambda k, x, a: x - x, "sub"),
        (lambda k, x, a: x * -1.0, "neg"),
        (lambda k, x, a: (-x).__neg__(), ""),
        (lambda k, x, a: abs(-x), "abs"),
        (lambda k, x, a: abs(abs(x)), "abs"),
        (lambda k, x, a: x + -a, "sub"),
        (lambda k, x, a: x - -a, "add"),
        (lambda k, x, a: x / 4.0, "mul"),
        (lambda k, x, a: x / -0.125, "mul"),
        (lambda k, x, a: x / 3.0, "div"),
        (lambda k, x, a: x / 2.0**127, "div"),
        (lambda k, x, a: x.minimum(x), ""),
        (lambda k, x, a: x < x, ""),
        (lambda k, x, a: x <= x, "le"),
        (lambda k, x, a: x.eq(x), "eq"),
        (lambda k, x, a: ~~(x < a), "lt"),
        (lambda k, x, a: ~(x < a), "lt not"),
        (lambda k, x, a: ~x.eq(a), "ne"),
        (lambda k, x, a: (x < a) & True, "lt"),
        (lambda k, x, a: (x < a) & False, ""),
        (lambda k, x, a: (x < a) | True, ""),
        (lambda k, x, a: (x < a) ^ True, "lt not"),
        (lambda k, x, a: (x < a).select(x, x), ""),
        (lambda k, x, a: constant(True, BOOL).select(x, a), ""),
        (lambda k, x, a: (x < a).select(True, False), "lt"),
        (lambda k, x, a: (x < a).select(a > 1.0, False), "lt gt and"),
        (lambda k, x, a: (~(x < a)).select(x, a), "lt select"),
        (lambda k, x, a: any_(constant(True, BOOL)), ""),
        (lambda k, x, a: (constant(2.0, F32) * 3.0 + 1.0).sqrt() * x, "mul"),
        (lambda k, x, a: constant(3e38, F32) * 3.0 * x, "mul mul"),
        (lambda k, x, a: (x.convert(I32) + 0) * 1, "convert"),
        (lambda k, x, a: ~(x.convert(I32) < 3), "ge"),
        (lambda k, x, a: x.convert(I32) & -1, "convert"),
        (lambda k, x, a: x.convert(I32) ^ x.convert(I32), ""),
        (lambda k, x, a: if_(constant(False, BOOL), lambda: (x.sqrt(),), lambda: (a,))[0], ""),
        (lambda k, x, a: for_(constant(0, U32), lambda j, v: v * a, x)[0], ""),
    ],
)
def test_laws(make: Callable[[KernelBuilder, Value, Value], Value], left: str) -> None:
    folded = PASSES["dce"](PASSES["fold"](traced(make)))
    found = Counter({op: n for op, n in ops(folded).items() if op not in NOTHING})
    assert found == Counter(op for op in left.split() if op not in NOTHING)


def test_powers_of_two_divide_exactly() -> None:
    values = np.array([1e-45, 1e-38, 3.3, -7.7, 3e38, np.inf, np.nan, -0.0], np.float32)
    for divisor in (2.0**126, 2.0**-126, -4.0):
        kernel = traced(lambda k, x, a, by=divisor: x / by)
        assert "div" not in ops(PASSES["fold"](kernel))
        results = []
        for one in (kernel, PASSES["fold"](kernel)):
            out = np.zeros(len(values), np.float32)
            interp.run(one, len(values), {"a": 0.0}, {"x": values, "out": out})
            results.append(out.tobytes())
        assert results[0] == results[1]


def test_hoist_takes_invariants_and_constants_out_of_loops() -> None:
    def make(k: KernelBuilder, x: Value, a: Value) -> Value:
        def body(j: Value, v: Value) -> Value:
            (w,) = for_(constant(4, U32), lambda i, w: w * (x.sqrt() + 0.25) + (v * 3.0), v)
            return w

        return for_(k.uniform("n", U32), body, a)[0]

    kernel = PASSES["hoist"](traced(make))
    assert {i.op for i in kernel.body.instructions} >= {"sqrt", "add", "const"}
    (outer,) = [i for i in verify(kernel).body.instructions if i.op == "for"]
    assert [i.op for i in outer.regions[0].instructions] == ["mul", "for"]
    (inner,) = [i for i in outer.regions[0].instructions if i.op == "for"]
    assert [i.op for i in inner.regions[0].instructions] == ["mul", "add"]


def test_hoist_leaves_branches_and_loads_alone() -> None:
    def make(k: KernelBuilder, x: Value, a: Value) -> Value:
        y = k.buffer("y", F32)

        def body(j: Value, v: Value) -> Value:
            (w,) = if_(v > 1.0, lambda: (x.sqrt(),), lambda: (v,))
            return w + load(y, 3)

        return for_(k.uniform("n", U32), body, a)[0]

    kernel = PASSES["hoist"](traced(make))
    assert "sqrt" not in {i.op for i in kernel.body.instructions}
    assert ops(kernel)["load"] == 2
    assert Counter(i.op for i in kernel.body.instructions)["load"] == 1


def test_hoist_out_of_the_condition_of_a_while() -> None:
    kernel = traced(lambda k, x, a: while_(lambda v: v < a.sqrt(), lambda v: v * 2.0, x)[0])
    assert "sqrt" in {i.op for i in PASSES["hoist"](kernel).body.instructions}


def test_cse() -> None:
    def make(k: KernelBuilder, x: Value, a: Value) -> Value:
        y, z = k.buffer("y", F32), k.buffer("z", F32, writable=True)
        same = (x + a) * (a + x)
        swapped = (x < a) & (a > x)
        order = x.minimum(a) - a.minimum(x)
        reads = load(y, 2) + load(y, 2) + load(z, 2) + load(z, 2)
        return swapped.select(same, order) + reads

    found = ops(PASSES["cse"](traced(make)))
    assert (found["lt"] + found["gt"], found["min"], found["load"]) == (1, 2, 4)
    assert found["add"] == 1 + 4


def test_cse_knows_scopes() -> None:
    def make(k: KernelBuilder, x: Value, a: Value) -> Value:
        return if_(x > a, lambda: (x.sqrt(),), lambda: (x.sqrt() + 1.0,))[0]

    assert ops(PASSES["cse"](traced(make)))["sqrt"] == 2


def test_dce_drops_what_nobody_reads() -> None:
    def make(k: KernelBuilder, x: Value, a: Value) -> Value:
        counts = k.buffer("counts", U32, writable=True)
        atomic("add", counts, 0, 1)
        any_(x > 2.0)
        while_(lambda v: v > 1.0, lambda v: v * 0.5, x)
        if_(x > 1.0, lambda: (x.sqrt(),), lambda: (x,))

        def body(j: Value, kept: Value, dead: Value, unread: Value, through: Value) -> tuple[Value, ...]:
            return kept + through, dead * x.floor(), unread, through * 0.5

        return for_(k.uniform("n", U32), body, x, x, a, x)[0]

    kernel = PASSES["dce"](traced(make))
    found = ops(kernel)
    assert (found["while"], found["if"], found["any"], found["floor"], found["sqrt"]) == (0, 0, 0, 0, 0)
    assert (found["atomic_add"], found["store"]) == (1, 1)
    (loop,) = [i for i in kernel.body.instructions if i.op == "for"]
    assert len(loop.results) == 2
    assert [i.op for i in loop.regions[0].instructions if i.op != "const"] == ["add", "mul"]


def test_dce_keeps_what_decides_whether_a_store_runs() -> None:
    def make(k: KernelBuilder, x: Value, a: Value) -> None:
        out, i = k.buffer("out", F32, writable=True), k.index()

        def body(v: Value, w: Value) -> tuple[Value, Value]:
            if_(w.floor() > a, lambda: store(out, i, v))
            return v * 0.5, w.sqrt()

        while_(lambda v, w: v > 1.0, body, x, x)

    kernel = traced(make)
    assert ops(PASSES["dce"](kernel)) == ops(kernel)


def test_flatten_turns_small_branches_into_selects() -> None:
    found = ops(PASSES["flatten"](traced(lambda k, x, a: if_(x > a, lambda: (x * a,), lambda: (x,))[0])))
    assert (found["if"], found["select"]) == (0, 1)


@pytest.mark.parametrize(
    "side",
    [
        lambda k, x, a: x / a,
        lambda k, x, a: load(k.buffer("y", F32), 1),
        lambda k, x, a: x * a + x * x + a * a + x * 3.0,
        lambda k, x, a: for_(k.uniform("n", U32), lambda j, v: v * a, x)[0],
    ],
)
def test_flatten_leaves_other_branches(side: Callable[[KernelBuilder, Value, Value], Value]) -> None:
    kernel = traced(lambda k, x, a: if_(x > a, lambda: (side(k, x, a),), lambda: (x,))[0])
    assert PASSES["flatten"](kernel) is kernel


def test_optimise_shows_each_pass_and_leaves_its_argument() -> None:
    kernel = traced(
        lambda k, x, a: for_(constant(3, U32), lambda j, v: v * (a.convert(F64).sqrt().convert(F32) * 1.0), x)[0]
    )
    before, seen = to_text(kernel), []
    result = optimise(kernel, lambda name, made: seen.append((name, verify(made))))
    assert [name for name, _ in seen] == list(PASSES) == ["fold", "flatten", "hoist", "cse", "dce"]
    assert to_text(kernel) == before
    assert to_text(seen[-1][1]) == to_text(result) != before


def test_optimise_refuses_an_illegal_kernel() -> None:
    block = Block()
    block.instructions = [Instruction("neg", (Value(F32, None),), (), (F32,))]
    with pytest.raises(KernelError):
        optimise(Kernel("k", (), (), block))


def test_a_pass_that_breaks_the_kernel_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    def breaks(kernel: Kernel) -> Kernel:
        block = Block()
        block.instructions = kernel.body.instructions[1:]
        return Kernel(kernel.name, kernel.uniforms, kernel.buffers, block)

    def drops_a_use(kernel: Kernel) -> Kernel:
        block = Block()
        block.instructions = kernel.body.instructions[:1]
        return Kernel(kernel.name, kernel.uniforms, kernel.buffers, block)

    kernel = traced(lambda k, x, a: x * a)
    monkeypatch.setitem(PASSES, "dce", breaks)
    with pytest.raises(KernelError, match="not defined"):
        optimise(kernel)
    seen: list[str] = []
    monkeypatch.setitem(PASSES, "cse", breaks)
    monkeypatch.setitem(PASSES, "dce", drops_a_use)
    with pytest.raises(KernelError, match="not defined"):
        optimise(kernel, lambda name, made: seen.append(name))
    assert seen == ["fold", "flatten", "hoist"]


def test_passes_do_not_nest_calls_with_the_length_of_a_kernel() -> None:
    with KernelBuilder("long") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        v = load(x, i)
        for n in range(5000):
            v = v * 0.5 + float(n)
        store(x, i, v)
    assert ops(optimise(k.kernel))["mul"] == 5000
