"""WGSL as text: what a reader and a driver see; that it runs right is the conformance suite's business."""

from __future__ import annotations

import re

from zeroset.codegen.gpu_target import GpuTarget
from zeroset.codegen.wgsl import to_wgsl
from zeroset.codegen.wgsl_operations import EXPRESSIONS, literal
from zeroset.kernel import F32, F64, I32, U32, KernelBuilder, any_, atomic, constant, for_, if_, load, store, while_
from zeroset.kernel.ops import OPS
from zeroset.kernel.types import BOOL

TARGET = GpuTarget(exact_division=True, exact_root=True)


def test_every_pure_operation_has_an_expression() -> None:
    assert set(EXPRESSIONS) == {op.name for op in OPS.values() if op.evaluate is not None}


def test_literals() -> None:
    assert literal("0.1", F32) == "0.1f"
    assert literal("-0.0", F32) == "(-0.0f)"
    assert literal("1e-30", F64) == "1e-30lf"
    assert literal("-5", I32) == "(-5i)"
    assert literal("-2147483648", I32) == "(-2147483647i - 1i)"
    assert literal("7", U32) == "7u"
    assert literal("True", BOOL) == "true"


def test_a_whole_shader() -> None:
    with KernelBuilder("sum") as k:
        i = k.index()
        x, out = k.buffer("x", F32), k.buffer("out", F32, writable=True)
        (total,) = for_(k.uniform("terms", U32), lambda j, s: s + load(x, i + j), constant(0.0, F32))
        if_(total > 0.0, lambda: store(out, i, total))
    text = to_wgsl(k.kernel, TARGET)
    assert "terms_: u32," in text
    assert "var<storage, read> x_: array<f32>;" in text
    assert "var<storage, read_write> out_: array<f32>;" in text
    assert "@workgroup_size(64)" in text
    assert re.search(r"var s\d+: f32 = 0.0f;", text)
    assert re.search(r"for \(var i\d+ = 0u; i\d+ < call.terms_; i\d+\+\+\)", text)
    assert text.count("{") == text.count("}")
    assert "else" not in text


def test_constants_lie_in_rows_of_16_bytes() -> None:
    with KernelBuilder("look") as k:
        i = k.index()
        x, y = (k.buffer(name, type_, constant=True) for name, type_ in (("x", F32), ("y", F64)))
        store(k.buffer("out", F32, writable=True), i, load(x, i) + load(y, i).convert(F32))
    text = to_wgsl(k.kernel, TARGET)
    assert "var<uniform> x_: array<vec4<f32>, 1024>;" in text
    assert "= x_[lane / 4u][lane % 4u];" in text
    assert "var<uniform> y_: array<vec2<f64>, 1024>;" in text
    one = to_wgsl(k.kernel, GpuTarget(constants=1))
    assert "var<uniform> x_" in one
    assert "var<storage, read> y_: array<f64>;" in one


def test_carried_values_change_all_at_once() -> None:
    with KernelBuilder("swap") as k:
        one, two = load(k.buffer("x", F32), 0), load(k.buffer("x", F32), 1)
        a, b = while_(lambda a, b: a < b, lambda a, b: (b, a), one, two)
        store(k.buffer("out", F32, writable=True), 0, a - b)
    lines = [line.strip() for line in to_wgsl(k.kernel, TARGET).splitlines()]
    at = lines.index("loop {")
    first, second = (re.fullmatch(r"var (s\d+): f32 = v\d+;", lines[at - 2 + n]).group(1) for n in (0, 1))  # type: ignore[union-attr]
    inside = lines[at : lines.index("}", at + 3)]
    kept = [m for line in inside if (m := re.fullmatch(rf"let (v\d+) = ({first}|{second});", line))]
    assert {m.group(2) for m in kept} == {first, second}
    assert f"{first} = {kept[0].group(1)};" in inside


def test_counters_are_atomic_and_votes_need_subgroups() -> None:
    with KernelBuilder("count") as k:
        cells = k.buffer("cells", U32, writable=True)
        flag = load(k.buffer("flags", U32), k.index()).ne(0)

        def count() -> None:
            atomic("add", cells, 0, 1)

        if_(any_(flag), count)
    text = to_wgsl(k.kernel, TARGET)
    assert "array<atomic<u32>>" in text
    assert "atomicAdd(&cells_[0u], 1u)" in text
    assert "subgroup" not in text
    assert "subgroupAny(" in to_wgsl(k.kernel, GpuTarget(subgroups=True))


def test_what_is_not_finite_is_left_to_the_gpu() -> None:
    with KernelBuilder("pole") as k:
        store(k.buffer("x", F32, writable=True), 0, constant(1.0, F32) / constant(0.0, F32))
    text = to_wgsl(k.kernel, TARGET)
    assert re.search(r"var k\d+ = 1.0f;", text)


def test_names_that_wgsl_would_not_take() -> None:
    with KernelBuilder("names") as k:
        store(k.buffer("loop", F32, writable=True), 0, k.uniform("α'", F32))
    text = to_wgsl(k.kernel, TARGET)
    assert "loop_: array<f32>" in text
    assert "call._3b1_27_" in text
