"""The definitions themselves, against values worked out by hand: every backend is held to these."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from zeroset.errors import KernelError
from zeroset.kernel import F32, F64, I32, U32, KernelBuilder, Type, any_, for_, interp, load, store
from zeroset.kernel.ops import OPS
from zeroset.kernel.types import TYPES

INF, NAN = math.inf, math.nan


def evaluate(op: str, type_: Type, *operands: float, to: Type | None = None) -> Any:
    rule = OPS[op].evaluate
    assert rule is not None
    arrays = [np.array([v], type_.dtype) for v in operands]
    with np.errstate(all="ignore"):
        return rule(*arrays, *([to] if to else []))[0]


@pytest.mark.parametrize(
    ("op", "operands", "expected"),
    [
        ("min", (1, 2), 1),
        ("min", (NAN, 2), 2),
        ("min", (2, NAN), NAN),
        ("min", (0.0, -0.0), -0.0),
        ("min", (-0.0, 0.0), 0.0),
        ("max", (1, 2), 2),
        ("max", (NAN, 2), 2),
        ("max", (2, NAN), NAN),
        ("max", (-0.0, 0.0), 0.0),
        ("rint", (0.5,), 0.0),
        ("rint", (1.5,), 2.0),
        ("rint", (-0.5,), -0.0),
        ("floor", (-0.5,), -1.0),
        ("ceil", (-0.5,), -0.0),
        ("trunc", (-1.75,), -1.0),
        ("sqrt", (-0.0,), -0.0),
        ("sqrt", (-1.0,), NAN),
        ("div", (1.0, -0.0), -INF),
        ("pow2", (-126.0,), 2.0**-126),
        ("pow2", (127.0,), 2.0**127),
        ("mantissa", (12.0,), 1.5),
        ("exponent", (12.0,), 3.0),
        ("exponent", (2.0**-126,), -126.0),
        ("abs", (-0.0,), 0.0),
        ("neg", (0.0,), -0.0),
    ],
)
@pytest.mark.parametrize("type_", [F32, F64], ids=str)
def test_floats(op: str, operands: tuple[float, ...], expected: float, type_: Type) -> None:
    result = evaluate(op, type_, *operands)
    assert result.dtype == type_.dtype
    assert (np.isnan(result) and math.isnan(expected)) or (
        result == expected and np.signbit(result) == np.signbit(expected)
    )


@pytest.mark.parametrize(
    ("value", "to", "expected"),
    [
        (-1.75, I32, -1),
        (NAN, I32, 0),
        (INF, I32, 2**31 - 1),
        (-3e9, I32, -(2**31)),
        (-0.9, U32, 0),
        (-5.0, U32, 0),
        (5e9, U32, 2**32 - 1),
        (3e9, U32, 3_000_000_000),
        (NAN, U32, 0),
    ],
)
@pytest.mark.parametrize("type_", [F32, F64], ids=str)
def test_floats_saturate_to_integers(value: float, to: Type, expected: int, type_: Type) -> None:
    assert evaluate("convert", type_, value, to=to) == expected


@pytest.mark.parametrize(
    ("op", "type_", "operands", "expected"),
    [
        ("add", I32, (2**31 - 1, 1), -(2**31)),
        ("sub", U32, (0, 1), 2**32 - 1),
        ("mul", U32, (2**16, 2**16), 0),
        ("neg", I32, (-(2**31),), -(2**31)),
        ("shl", U32, (1, 33), 2),
        ("shr", I32, (-8, 1), -4),
        ("shr", U32, (2**31, 31), 1),
        ("not", U32, (0,), 2**32 - 1),
    ],
)
def test_integers_wrap(op: str, type_: Type, operands: tuple[int, ...], expected: int) -> None:
    assert evaluate(op, type_, *operands) == expected


def test_fma_of_f32_rounds_once() -> None:
    a = float(np.float32(1 + 2.0**-12))
    assert evaluate("fma", F32, a, a, -1.0) == np.float32(2.0**-11 + 2.0**-24)


def test_every_row_has_a_meaning_or_a_handler() -> None:
    for op in OPS.values():
        handled = op.name.startswith("atomic") or hasattr(interp._Machine, f"_{op.name}")
        assert (op.evaluate is not None) != handled, op.name


def test_types_and_buffers() -> None:
    assert [t.dtype.itemsize for t in TYPES.values() if t.size] == [t.size for t in TYPES.values() if t.size]


def test_votes_count_active_lanes_only() -> None:
    with KernelBuilder("votes") as k:
        n, out, i = k.buffer("n", U32), k.buffer("out", U32, writable=True), k.index()
        (seen,) = for_(load(n, i), lambda j, seen: seen + any_(i.eq(0)).convert(U32), i * 0)
        store(out, i, seen)
    out = np.zeros(3, np.uint32)
    interp.run(k.kernel, 3, {}, {"n": np.array([1, 3, 2], np.uint32), "out": out})
    assert out.tolist() == [1, 1, 1]


def test_missing_and_wrong_arguments() -> None:
    with KernelBuilder("k") as k:
        x = k.buffer("x", F32, writable=True)
        store(x, k.index(), k.uniform("a", F32))
    with pytest.raises(KernelError, match="uniform a"):
        interp.run(k.kernel, 1, {}, {"x": np.zeros(1, np.float32)})
    with pytest.raises(KernelError, match="buffer x"):
        interp.run(k.kernel, 1, {"a": 1.0}, {"x": np.zeros(1)})
