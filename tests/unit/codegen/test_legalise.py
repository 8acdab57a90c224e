"""Legalised kernels give what the originals give, wherever arithmetic is exact."""

from __future__ import annotations

import numpy as np
import pytest

from zeroset.codegen.gpu_target import GpuTarget
from zeroset.codegen.legalise import legalise
from zeroset.kernel import F32, F64, I32, U32, Kernel, KernelBuilder, Type, interp, load, store, verify
from zeroset.kernel.ops import OPS

ROUGH, EXACT = GpuTarget(), GpuTarget(exact_division=True, exact_root=True)


def kernel_of(type_: Type) -> Kernel:
    with KernelBuilder("all") as k:
        i = k.index()
        a, b = load(k.buffer("a", type_), i), load(k.buffer("b", type_), i)
        for name, value in {"quotient": a / b, "root": abs(a).sqrt(), "i": a.convert(I32), "u": a.convert(U32)}.items():
            store(k.buffer(name, value.type, writable=True), i, value)
    return k.kernel


def ops_of(kernel: Kernel) -> list[str]:
    return [i.op for i in kernel.body.instructions]


def run(kernel: Kernel, a: np.ndarray, b: np.ndarray) -> dict[str, np.ndarray]:
    buffers = {x.name: np.zeros(len(a), x.type.dtype) for x in kernel.buffers} | {"a": a, "b": b}
    interp.run(verify(kernel), len(a), {}, buffers)
    return buffers


def some_numbers(type_: Type) -> np.ndarray:
    random = np.random.default_rng(3)
    values = random.normal(size=4000) * 2.0 ** random.integers(-60, 60, 4000)
    awkward = [0.0, -0.0, 1.0, -1.0, 2.0**31, -(2.0**31), 2.0**32, 2.0**31 - 1, 1e30, -1e30, 0.5, -0.5, np.inf, np.nan]
    return np.concatenate([values, awkward]).astype(type_.dtype)


@pytest.mark.parametrize("type_", [F32, F64], ids=str)
def test_corrected_results_are_the_same_where_the_first_ones_are_right(type_: Type) -> None:
    a = some_numbers(type_)
    b = np.roll(a, 1234)
    with np.errstate(all="ignore"):
        before, after = run(kernel_of(type_), a, b), run(legalise(kernel_of(type_), ROUGH), a, b)
    for name in ("i", "u"):
        assert np.array_equal(before[name], after[name]), name
    for name in ("quotient", "root"):
        # The interpreter's multiply-add rounds twice in f64, which a GPU's does not.
        units = 0 if type_ is F32 else 1
        assert np.array_equal(np.isfinite(before[name]), np.isfinite(after[name]))
        here = np.isfinite(before[name])
        one, two = before[name][here], after[name][here]
        assert np.all(np.abs(one - two) <= units * np.spacing(np.abs(one))), name


def test_a_rough_quotient_is_mended() -> None:
    """The correction is run on quotients and roots that are off by two units, as WGSL allows."""
    a = np.abs(some_numbers(F32))
    a = a[(a > 1e-10) & (a < 1e10)]
    b = np.roll(a, 77)
    kernel = legalise(kernel_of(F32), ROUGH)

    def rough(name: str, *operands: np.ndarray) -> np.ndarray:
        exact = {"div": np.divide, "sqrt": np.sqrt}[name](*operands)
        return exact + 2 * np.spacing(exact)

    with pytest.MonkeyPatch.context() as patch:
        for name in ("div", "sqrt"):
            patch.setitem(OPS, name, OPS[name]._replace(evaluate=lambda *x, name=name: rough(name, *x)))
        made = run(kernel, a, b)
    for given, exact in ((made["quotient"], a.astype(float) / b), (made["root"], np.sqrt(a.astype(float)))):
        units = np.abs(given - exact) / np.spacing(exact.astype(np.float32))
        assert units.max() < 0.51, units.max()
        assert np.abs(given + 2 * np.spacing(given) - exact).max() > 0


def test_only_what_is_wanting_is_spelled_out() -> None:
    assert "div" in ops_of(kernel_of(F32))
    assert ops_of(legalise(kernel_of(F32), ROUGH)).count("div") == 3
    assert ops_of(legalise(kernel_of(F32), EXACT)).count("div") == 1


def roundings(type_: Type) -> Kernel:
    with KernelBuilder("roundings") as k:
        i = k.index()
        a = load(k.buffer("a", type_), i)
        for name in ("floor", "ceil", "trunc", "rint"):
            store(k.buffer(name, type_, writable=True), i, getattr(a, name)())
    return k.kernel


def test_f64_rounds_by_way_of_small_integers() -> None:
    halves = np.concatenate([np.arange(-40.5, 41), *(2.0**n + np.array([-1, -0.5, 0.5, 1.0, 1.5]) for n in range(54))])
    a = np.concatenate([some_numbers(F64), halves, -halves])
    plain = roundings(F64)
    with np.errstate(all="ignore"):
        before, after = run(plain, a, a), run(legalise(plain, ROUGH), a, a)
    for name in ("floor", "ceil", "trunc", "rint"):
        assert np.array_equal(before[name], after[name], equal_nan=True), name
        assert np.array_equal(np.signbit(before[name]), np.signbit(after[name])), name
    assert not {"floor", "ceil", "trunc", "rint"} & set(ops_of(legalise(plain, ROUGH)))
    assert ops_of(legalise(plain, GpuTarget(exact_rounding=True))) == ops_of(plain)
    assert ops_of(legalise(roundings(F32), ROUGH)) == ops_of(roundings(F32))
