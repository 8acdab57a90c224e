from __future__ import annotations

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
    any_,
    atomic,
    constant,
    for_,
    if_,
    load,
    store,
    while_,
)
from zeroset.kernel.types import Type


def scale(factor: float) -> Kernel:
    with KernelBuilder("scale") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, load(x, i) * factor)
    return k.kernel


def test_equal_kernels_have_equal_digests() -> None:
    assert scale(2.0).digest == scale(2.0).digest
    assert scale(2.0).digest != scale(2.5).digest
    assert scale(0.0).digest != scale(-0.0).digest


def test_whatever_differs_is_in_the_digest() -> None:
    def made(
        name: str = "k", uniform: str = "a", writable: bool = True, swap: bool = False, other: bool = False,
        type_: Type = U32, count: int = 2,
    ) -> Kernel:  # fmt: skip
        with KernelBuilder(name) as k:
            out, i = k.buffer("out", F32, writable=True), k.index()
            x, a = load(k.buffer("x", F32, writable=writable), i), k.uniform(uniform, F32)
            first, second = (x - a, a - x) if swap else (a - x, x - a)
            (y,) = if_(x > 0.0, lambda: (first,), lambda: (second,))
            (y,) = for_(count, lambda j, v: v * (y if other else a), y)
            store(out, i, y.convert(type_).convert(F32))
        return k.kernel

    kernels = [
        made(), made(name="l"), made(uniform="b"), made(writable=False), made(swap=True), made(other=True),
        made(type_=I32), made(count=3),
    ]  # fmt: skip
    assert len({kernel.digest for kernel in kernels}) == len(kernels)
    assert made().digest == kernels[0].digest


def test_equal_instructions_are_traced_once() -> None:
    with KernelBuilder("once") as k:
        a = k.uniform("a", F32)
        assert (a + 1.0) is (a + 1.0)
        assert (a + 1.0) is not (a + 1.5)
        assert a * 0.0 is not a * -0.0
        outer = a * 2.0
        if_(a > 0.0, lambda: (a * 2.0 + 1.0,), lambda: (a * 3.0,))
        assert outer is a * 2.0
        # What a branch computed is not known outside it.
        assert len(k._body.instructions) == len(set(map(id, k._body.instructions)))
        assert (a * 3.0).definition in k._body.instructions


def test_a_value_outside_its_kernel() -> None:
    with KernelBuilder("k") as k:
        a = k.uniform("a", F32)
    with pytest.raises(KernelError, match="outside the kernel"):
        a + 1.0


def test_a_value_has_no_truth() -> None:
    with KernelBuilder("k") as k, pytest.raises(KernelError, match="no truth"):
        bool(k.uniform("a", F32) > 0.0)


@pytest.mark.parametrize(
    ("value", "type_"), [(np.nan, F32), (np.inf, F64), (1e39, F32), (-1, U32), (2**31, I32), (0.5, I32)]
)
def test_numbers_that_are_no_constants(value: float, type_: object) -> None:
    with KernelBuilder("k"), pytest.raises(KernelError, match="constant"):
        constant(value, type_)


def test_constants_are_rounded_to_their_type() -> None:
    with KernelBuilder("k") as k:
        a = k.uniform("a", F32)
        assert (a + 0.1) is (a + float(np.float32(0.1)))
        assert (np.float32(0.5) + a) is (0.5 + a)


def test_types_must_agree() -> None:
    with KernelBuilder("k") as k:
        a, n, flag = k.uniform("a", F32), k.uniform("n", I32), k.uniform("flag", BOOL)
        for wrong in (lambda: a + n, lambda: n.sqrt(), lambda: flag + flag, lambda: a.select(a, a), lambda: a & a):
            with pytest.raises(KernelError):
                wrong()


def test_declarations() -> None:
    with KernelBuilder("k") as k:
        k.uniform("a", F32)
        k.buffer("x", F32)
        with pytest.raises(KernelError, match="uniform a"):
            k.uniform("a", F64)
        with pytest.raises(KernelError, match="buffer x"):
            k.buffer("x", F32, writable=True)
        with pytest.raises(KernelError, match="read only"):
            store(k.buffer("x", F32), 0, 1.0)
        with pytest.raises(KernelError, match="integer buffer"):
            atomic("add", k.buffer("y", F32, writable=True), 0, 1.0)
        with pytest.raises(KernelError, match="not finished"):
            _ = k.kernel


def test_carried_state_must_match() -> None:
    with KernelBuilder("k") as k:
        a, n = k.uniform("a", F32), k.uniform("n", U32)
        with pytest.raises(KernelError, match="carries 1 values"):
            while_(lambda v: v > 1.0, lambda v: (v, v), a)
        with pytest.raises(KernelError, match="carries a f32"):
            for_(n, lambda i, v: i, a)
        with pytest.raises(KernelError, match="condition of while_"):
            while_(lambda v: v, lambda v: v, a)
        with pytest.raises(KernelError, match="if_"):
            if_(a > 0.0, lambda: (a,), lambda: (n,))
        with pytest.raises(KernelError, match="not Python numbers"):
            if_(a > 0.0, lambda: (1.0,), lambda: (a,))
        # Python numbers are taken where the type is known.
        (b,) = if_(any_(a > 0.0), lambda: (a,), lambda: (1.0,))
        assert b.type == F32
