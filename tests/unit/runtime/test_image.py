from __future__ import annotations

import ctypes
import struct

import pytest

from zeroset.codegen.llvm import host, to_llvm, to_object
from zeroset.kernel import F32, Kernel, KernelBuilder, load, store
from zeroset.runtime import image

HERE = pytest.mark.skipif(not image.can_place(), reason="images run on Linux on x86-64 only")


def kernel() -> Kernel:
    with KernelBuilder("k") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, (load(x, i) * 1.25 + 3.0).sqrt().minimum(7.5))
    return k.kernel


@HERE
@pytest.mark.parametrize("target", host(), ids=lambda t: t.name)
def test_an_image_runs_where_it_is_put(target: object) -> None:
    flat = image.link(to_object(to_llvm(kernel(), target), target), "drain")
    assert flat is not None
    for _ in range(3):
        address, keep = image.place(flat)
        data, following = (ctypes.c_float * 3)(0.8, 4.8, 999), ctypes.c_int64()
        slots = (ctypes.c_void_p * 1)(ctypes.addressof(data))
        drain = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, *[ctypes.c_int32] * 3)(address)
        assert drain(ctypes.addressof(slots), ctypes.addressof(following), 3, 64, 9) == 0
        assert list(data) == [2.0, 3.0, 7.5]
        assert keep is not None


def object_code(text: str) -> bytes:
    return to_object(text, host()[-1])


@HERE
def test_objects_with_more_in_them_are_left_to_a_linker() -> None:
    calls = "declare void @puts(ptr)\ndefine void @drain() nounwind {\n call void @puts(ptr null)\n ret void\n}"
    assert image.link(object_code(calls), "drain") is None
    zeros = "@g = internal global [64 x i8] zeroinitializer\ndefine ptr @drain() nounwind {\n ret ptr @g\n}"
    assert image.link(object_code(zeros), "drain") is None


@HERE
def test_what_is_no_object() -> None:
    code = object_code("define void @drain() nounwind {\n ret void\n}")
    assert image.link(code, "drain") is not None
    assert image.link(code, "another") is None
    assert image.link(b"", "drain") is None
    assert image.link(b"MZ" + bytes(100), "drain") is None
    for length in range(0, len(code), 7):
        image.link(code[:length], "drain")
    other = bytearray(code)
    struct.pack_into("<H", other, 18, 183)
    assert image.link(bytes(other), "drain") is None
