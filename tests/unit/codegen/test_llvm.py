"""The code itself: no calls, the instructions that were meant, and what must not be there.

That the code computes the right thing is held by the conformance suite.
"""

from __future__ import annotations

import re
import struct

import llvmlite.binding as llvm
import pytest

from zeroset.codegen.llvm import host, machine, to_llvm, to_object
from zeroset.codegen.slots import slot_layout
from zeroset.codegen.target import Target, host_targets
from zeroset.errors import DeviceError
from zeroset.kernel import (
    BOOL,
    F32,
    F64,
    I32,
    U32,
    Kernel,
    KernelBuilder,
    Type,
    Uniform,
    Value,
    atomic,
    constant,
    for_,
    if_,
    load,
    store,
    while_,
)
from zeroset.kernel.ops import OPS
from zeroset.kernel.types import TYPES
from zeroset.kernel.value import apply, emit

TARGETS = {t.name: t for t in host()}
HERE = pytest.mark.parametrize("target", TARGETS.values(), ids=TARGETS)
X86 = pytest.mark.skipif("avx2" not in TARGETS, reason="needs an x86 CPU with AVX2")


def assembly(kernel: Kernel, target: Target) -> list[str]:
    """The instructions of a kernel's own function, without directives."""
    module = llvm.parse_assembly(to_llvm(kernel, target))
    module.verify()
    text = machine(target).emit_assembly(module)
    own = text[text.index("\nkernel:") : text.index("\ndrain:")]
    return [line.strip() for line in own.splitlines() if line.startswith("\t") and not line.startswith("\t.")]


def operation(name: str, type_: Type, uniform: bool, to: Type | None = None) -> Kernel:
    with KernelBuilder(name) as k:
        i = k.index()

        def read(operand: str, kind: Type) -> Value:
            if uniform:
                return k.uniform(operand, kind)
            return load(k.buffer(operand, U32), i).ne(0) if kind == BOOL else load(k.buffer(operand, kind), i)

        operands = [read("abc"[n], type_) for n in range(OPS[name].arity)]
        if name == "select":
            operands[0] = read("chosen", BOOL)
        value = emit(name, (operands[0],), (to.name,), (to,))[0] if to else apply(name, *operands)
        value = value.convert(U32) if value.type == BOOL else value
        store(k.buffer("out", value.type, writable=True), i, value)
    return k.kernel


def operations() -> list[tuple[str, Type, Type | None]]:
    found: list[tuple[str, Type, Type | None]] = []
    for op in OPS.values():
        if op.evaluate is None:
            continue
        for type_ in (t for t in TYPES.values() if t.kind in op.kinds):
            if op.result != "attr":
                found.append((op.name, type_, None))
            else:
                others = [t for t in TYPES.values() if t != type_ and (op.name == "convert" or t.size == type_.size)]
                found += [(op.name, type_, to) for to in others]
    return found


@HERE
def test_no_operation_calls_anything(target: Target) -> None:
    """Vector code that LLVM has no instruction for becomes a call into the C library for each lane."""
    for name, type_, to in operations():
        for uniform in (False, True):
            lines = assembly(operation(name, type_, uniform, to), target)
            calls = [line for line in lines if re.match(r"(call|jmp\s+\w+@|jmp\s+[a-z]|bl\s)", line)]
            assert not calls, f"{name} on {type_} to {to}, uniform {uniform}: {calls}"


@HERE
def test_conversions_go_by_vectors(target: Target) -> None:
    for type_ in (F32, F64):
        for to in (I32, U32):
            lines = assembly(operation("convert", type_, False, to), target)
            assert not [line for line in lines if re.match(r"v?cvtts[sd]2", line)], f"{type_} to {to}"


@X86
@pytest.mark.parametrize(
    ("name", "mnemonic"),
    [
        ("min", "vminps"),
        ("max", "vmaxps"),
        ("sqrt", "vsqrtps"),
        ("rint", "v(round|rndscale)ps"),
        ("floor", "v(round|rndscale)ps"),
        ("fma", "vfmadd...ps"),
        ("div", "vdivps"),
    ],
)
def test_operations_that_are_one_instruction(name: str, mnemonic: str) -> None:
    for target in (t for t in TARGETS.values() if t.fused):
        lines = assembly(operation(name, F32, False), target)
        assert sum(bool(re.match(mnemonic, line)) for line in lines) == 1, target.name


@X86
def test_contraction_is_the_only_freedom() -> None:
    with KernelBuilder("k") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        v = load(x, i)
        store(x, i, v * k.uniform("a", F32) + v / (v - 1.0))
    target = TARGETS["avx2"]
    flags = set(re.findall(r"= f\w+ ((?:[a-z]+ )*)<", to_llvm(k.kernel, target)))
    assert flags == {"", "contract "}
    assert any(line.startswith("vfmadd") for line in assembly(k.kernel, target))
    assert "contract" not in to_llvm(k.kernel, target.uncontracted())
    assert not any(line.startswith("vfm") for line in assembly(k.kernel, target.uncontracted()))


@pytest.mark.skipif("avx512" not in TARGETS, reason="needs a CPU with AVX-512")
def test_avx512_fills_its_registers() -> None:
    lines = assembly(operation("mul", F32, False), TARGETS["avx512"])
    assert any(line.startswith("vmulps") and "zmm" in line for line in lines)


def test_uniform_values_stay_scalar_and_outside_the_loop() -> None:
    with KernelBuilder("k") as k:
        x, i, a = k.buffer("x", F32, writable=True), k.index(), k.uniform("a", F32)
        store(x, i, load(x, i) * (a.sqrt() + 1.0))
    text = to_llvm(k.kernel, next(iter(TARGETS.values())))
    before, after = text.split("\npackets:\n")
    assert "call float @llvm.sqrt.f32(float" in before
    assert "shufflevector" in before
    assert "sqrt" not in after


def test_uniform_loops_have_no_masks() -> None:
    with KernelBuilder("k") as k:
        x, i, n = k.buffer("x", F32, writable=True), k.index(), k.uniform("n", U32)
        (v,) = for_(n, lambda j, v: v * 0.5, load(x, i))
        store(x, i, v)
    text = to_llvm(k.kernel, next(iter(TARGETS.values())))
    loop = text[text.index("head") : text.index("masked.store", text.index("head"))]
    assert "select" not in loop
    assert "reduce.or" not in loop


def test_state_that_nobody_reads_is_not_blended() -> None:
    with KernelBuilder("k") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        v, _ = while_(lambda v, w: v + w > 1.0, lambda v, w: (v * 0.5, w * 0.25), load(x, i), load(x, i))
        store(x, i, v)
    assert to_llvm(k.kernel, next(iter(TARGETS.values()))).count("select") == 1


def test_what_the_next_packets_read_is_asked_for() -> None:
    with KernelBuilder("k") as k:
        x, y, i, row = k.buffer("x", F32), k.buffer("y", F32, writable=True), k.index(), k.uniform("row", U32)
        near = load(x, i) + load(x, i + 1) + load(x, i + 4 + 1)
        store(y, i, near + load(x, i + row) + load(x, i * 3))
    text = to_llvm(k.kernel, next(iter(TARGETS.values())))
    # The lane's own place and the one in another row; not those beside it, nor those without an order.
    assert text.count("call void @llvm.prefetch") == 2


def test_the_text_is_the_same_each_time() -> None:
    target = next(iter(TARGETS.values()))
    assert to_llvm(operation("fma", F64, False), target) == to_llvm(operation("fma", F64, False), target)


def everything() -> Kernel:
    with KernelBuilder("everything") as k:
        x, n, i = k.buffer("x", F32, writable=True), k.buffer("n", U32, writable=True), k.index()
        flag = k.uniform("flag", BOOL)
        v = load(x, i * 3)
        (w,) = while_(lambda v: v > 1.0, lambda v: v * 0.5 + load(x, 0), v)
        (u,) = for_(load(n, i), lambda j, u: u + j.convert(F32).floor(), w)
        (r,) = if_(flag & (u < w), lambda: (u.fma(w, v),), lambda: (u.pow2(),))
        store(x, i * 3, r.minimum(v))
        atomic("max", n, i & 1, r.convert(U32))
    return k.kernel


def test_aarch64_by_construction() -> None:
    """No x86 intrinsic in the text, and LLVM makes NEON code of it without a call."""
    (neon,) = host_targets("aarch64-unknown-linux-gnu", "generic", {"neon": True})
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    text = to_llvm(everything(), neon)
    assert "x86" not in text
    lines = assembly(everything(), neon)
    assert any(line.startswith("fmla") for line in lines)
    assert not [line for line in lines if line.startswith("bl\t")]


@HERE
def test_objects_of_every_level(target: Target) -> None:
    text = to_llvm(everything(), target)
    sizes = [len(to_object(text, target, level)) for level in (0, 1, 2)]
    assert min(sizes) > 500
    assert to_object(text, target) == to_object(text, target, 1)


def test_long_kernels_are_compiled_in_a_hurry() -> None:
    with KernelBuilder("long") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        v = load(x, i)
        for n in range(3100):
            v = v * constant(0.5 + n, F32) + float(n)
        store(x, i, v)
    target = next(iter(TARGETS.values()))
    text = to_llvm(k.kernel, target)
    assert to_object(text, target) == to_object(text, target, 0)


def test_text_that_llvm_refuses() -> None:
    with pytest.raises(DeviceError, match="LLVM does not take"):
        to_object("define nonsense", next(iter(TARGETS.values())))


def test_slots() -> None:
    uniforms = tuple(Uniform(t.name, t) for t in TYPES.values())
    layout = slot_layout(uniforms, 2)
    assert struct.calcsize(layout) == 8 * (len(uniforms) + 2)
    packed = struct.pack(layout, 1, 2, 1.5, 2.5, -3, 4, True)
    assert struct.unpack_from("<f", packed, 16) == (1.5,)
    assert struct.unpack_from("<?", packed, 48) == (True,)
