"""Every operation on awkward values, varying and uniform, on every target: what the interpreter gives, bit for bit."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest

from zeroset.kernel import BOOL, F32, F64, I32, U32, Kernel, KernelBuilder, Type, Value, interp, load, store
from zeroset.kernel.ops import OPS
from zeroset.kernel.types import TYPES
from zeroset.kernel.value import apply, emit
from zeroset.runtime import Device

Array = np.ndarray[Any, Any]
PURE = [op for op in OPS.values() if op.evaluate is not None]
DOMAINS = {"pow2", "mantissa", "exponent"}


def floats(type_: Type) -> Array:
    info = np.finfo(type_.dtype)
    one = type_.dtype.type(1)
    values = [0.0, float(info.smallest_subnormal), float(info.smallest_subnormal) * 12345, float(info.smallest_normal)]
    values += [
        float(np.nextafter(info.smallest_normal, 0 * one)),
        1e-30,
        0.25,
        0.49999997,
        0.5,
        0.75,
        float(one - info.epsneg),
    ]
    values += [1.0, float(one + info.eps), 1.5, 2.5, 3.0, 7.25, 255.5, 1000.1, np.pi / 2, np.pi, 2 * np.pi, 100 * np.pi]
    values += [
        2.0**22 + 0.5,
        2.0**23 - 0.5,
        2.0**23,
        2.0**24 + 1,
        2.0**31 - 128,
        2.0**31 - 1,
        2.0**31 - 0.5,
        2.0**31,
        2.0**32 - 256,
    ]
    values += [2.0**32 - 1, 2.0**32, 2.0**52 - 0.5, 2.0**53, 1e19, 1e30, float(info.max) / 2, float(info.max), np.inf]
    both = values + [-v for v in values] + [np.nan]
    return np.array(both, type_.dtype)


def integers(type_: Type) -> Array:
    info = np.iinfo(type_.dtype)
    values = [0, 1, 2, 3, 7, 31, 32, 33, 63, 127, 255, 256, 65535, 65536, 2**23, 2**24 - 1, 2**24, 2**24 + 1, 2**24 + 3]
    values += [
        2**30,
        2**30 + 1,
        2**31 - 129,
        2**31 - 65,
        2**31 - 1,
        2**31,
        2**31 + 1,
        2**32 - 129,
        2**32 - 2,
        2**32 - 1,
    ]
    values += [-v for v in values]
    return np.array([v for v in values if info.min <= v <= info.max], type_.dtype)


def awkward(type_: Type) -> Array:
    if type_ == BOOL:
        return np.array([0, 1], np.uint32)
    return floats(type_) if type_.kind == "f" else integers(type_)


def domain(name: str, type_: Type) -> Array:
    info = np.finfo(type_.dtype)
    if name == "pow2":
        return np.arange(info.minexp, info.maxexp).astype(type_.dtype)
    values = awkward(type_)
    return values[np.isfinite(values) & (values >= info.smallest_normal)]


def read(k: KernelBuilder, name: str, type_: Type, index: Value | None) -> Value:
    """Operand ``name``: an element of a buffer, or a uniform where there is no index."""
    if index is None:
        return k.uniform(name, type_)
    if type_ == BOOL:
        return load(k.buffer(name, U32), index).ne(0)
    return load(k.buffer(name, type_), index)


def write(k: KernelBuilder, name: str, index: Value, value: Value) -> None:
    if value.type == BOOL:
        value = value.convert(U32)
    store(k.buffer(name, value.type, writable=True), index, value)


def results(type_: Type, a: Value, b: Value, c: Value | None) -> dict[str, Value]:
    """Every operation of at most two operands of the type (and select), each named."""
    made: dict[str, Value] = {}
    for op in PURE:
        if type_.kind not in op.kinds or op.name in DOMAINS | {"fma"}:
            continue
        if op.name == "select":
            assert c is not None
            made[op.name] = c.select(a, b)
        elif op.result == "attr":
            for to in TYPES.values():
                if to != type_ and (op.name == "convert" or to.size == type_.size):
                    made[f"{op.name} {to}"] = emit(op.name, (a,), (to.name,), (to,))[0]
        else:
            made[op.name] = apply(op.name, *(a, b)[: op.arity])
    return made


def kernel_of(type_: Type, uniform: tuple[str, ...]) -> Kernel:
    with KernelBuilder(f"every_{type_}") as k:
        i = k.index()
        a, b = (read(k, name, type_, None if name in uniform else i) for name in "ab")
        c = read(k, "c", BOOL, None if "c" in uniform else i)
        for name, value in results(type_, a, b, c).items():
            write(k, name, i, value)
    return k.kernel


def check(
    device: Device, differ: Callable[..., Array], kernel: Kernel, uniforms: dict[str, float], data: dict[str, Array]
) -> None:
    count = max(map(len, data.values()))
    expected, given = {}, {}
    for buffer in kernel.buffers:
        start = data.get(buffer.name, np.zeros(count, buffer.type.dtype))
        expected[buffer.name] = start.copy()
        given[buffer.name] = device.allocate(buffer.type, count)
        device.write(given[buffer.name], start)
    interp.run(kernel, count, uniforms, expected)
    device.compile(kernel).run(count, uniforms, given)
    failures = []
    for buffer in kernel.buffers:
        result = device.read(given[buffer.name])
        for at in differ(expected[buffer.name], result)[:3]:
            operands = {**uniforms, **{name: values[at] for name, values in data.items()}}
            failures.append(f"{buffer.name} of {operands} is {result[at]!r}, not {expected[buffer.name][at]!r}")
    assert not failures, "\n".join(failures)


@pytest.mark.parametrize("type_", TYPES.values(), ids=str)
def test_every_pair_of_awkward_values(device: Device, differ: Callable[..., Array], type_: Type) -> None:
    values = awkward(type_)
    a, b = (x.ravel().copy() for x in np.meshgrid(values, values))
    a, b = np.concatenate([a, a]), np.concatenate([b, b])
    c = np.repeat(np.array([0, 1], np.uint32), len(a) // 2)
    check(device, differ, kernel_of(type_, ()), {}, {"a": a, "b": b, "c": c})


@pytest.mark.parametrize("type_", TYPES.values(), ids=str)
@pytest.mark.parametrize("uniform", [("b",), ("a", "c"), ("a", "b", "c")], ids="".join)
def test_uniform_operands(device: Device, differ: Callable[..., Array], type_: Type, uniform: tuple[str, ...]) -> None:
    kernel, values = kernel_of(type_, uniform), awkward(type_)
    for first, second in zip(values, np.roll(values, 5), strict=True):
        named = {"a": first.item(), "b": second.item(), "c": bool(second > first)}
        uniforms = {name: named[name] for name in uniform}
        data = {"a": values, "b": values, "c": (np.arange(len(values)) % 3 == 0).astype(np.uint32)}
        check(
            device,
            differ,
            kernel,
            uniforms,
            {name: data[name] for name in data if name not in uniform} or {"a": values[:1]},
        )


@pytest.mark.parametrize("type_", [F32, F64], ids=str)
@pytest.mark.parametrize("name", sorted(DOMAINS))
def test_parts_of_floats(device: Device, differ: Callable[..., Array], name: str, type_: Type) -> None:
    with KernelBuilder(name) as k:
        i = k.index()
        write(k, "varying", i, apply(name, read(k, "a", type_, i)))
        write(k, "uniform", i, apply(name, k.uniform("u", type_)))
    values = domain(name, type_)
    for value in values[:: max(1, len(values) // 20)]:
        check(device, differ, k.kernel, {"u": float(value)}, {"a": values})


def nearest(exact: Fraction, type_: Type) -> Any:
    """The float nearest to a rational, halves to even."""
    info = np.finfo(type_.dtype)
    if abs(exact) >= Fraction(float(info.max)) * (1 + Fraction(1, 2 ** (info.nmant + 2))):
        return type_.dtype.type(np.copysign(np.inf, exact))
    with np.errstate(all="ignore"):
        near = type_.dtype.type(min(max(float(exact), float(info.min)), float(info.max)))
        around = {float(near), float(np.nextafter(near, info.max)), float(np.nextafter(near, info.min))}
    odd = {x: int(type_.dtype.type(x).view(f"u{type_.size}")) & 1 for x in around}
    return type_.dtype.type(min(around, key=lambda x: (abs(Fraction(x) - exact), odd[x])))


@pytest.mark.parametrize("type_", [F32, F64], ids=str)
def test_fma_rounds_once_or_twice(device: Device, differ: Callable[..., Array], type_: Type) -> None:
    with KernelBuilder("fma") as k:
        i = k.index()
        write(k, "out", i, read(k, "a", type_, i).fma(read(k, "b", type_, i), read(k, "c", type_, i)))
    random = np.random.default_rng(1)
    values = np.concatenate(
        [awkward(type_), (random.normal(size=40) * 2.0 ** random.integers(-20, 20, 40)).astype(type_.dtype)]
    )
    a, b, c = random.choice(values, (3, 3000))
    # Sums that cancel show how often the product was rounded.
    with np.errstate(all="ignore"):
        c[::2] = -(a * b)[::2]
        twice = (a * b + c).astype(type_.dtype)
    data = {"a": a, "b": b, "c": c, "out": np.zeros(len(a), type_.dtype)}
    buffers = {name: device.allocate(type_, len(a)) for name in data}
    for name, values in data.items():
        device.write(buffers[name], values)
    device.compile(k.kernel).run(len(a), {}, buffers)
    result = device.read(buffers["out"])
    for at in differ(twice, result):
        x, y, z = (float(v[at]) for v in (a, b, c))
        assert np.isfinite([x, y]).all(), f"fma({x}, {y}, {z}) is {result[at]}, not {twice[at]}"
        once = nearest(Fraction(x) * Fraction(y) + Fraction(z), type_) if np.isfinite(z) else z
        assert result[at] == once, f"fma({x!r}, {y!r}, {z!r}) is {result[at]!r}, neither {once!r} nor {twice[at]!r}"


def test_denormals_are_kept(device: Device) -> None:
    with KernelBuilder("tiny") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, load(x, i) * k.uniform("half", F32))
    x = device.allocate(F32, 3)
    device.write(x, np.array([1e-38, 6e-45, -3e-39], np.float32))
    device.compile(k.kernel).run(3, {"half": 0.5}, {"x": x})
    assert device.read(x).tolist() == (np.array([1e-38, 6e-45, -3e-39], np.float32) * np.float32(0.5)).tolist()
    assert all(device.read(x))


def test_constants_are_exact(device: Device) -> None:
    numbers = {F32: [0.1, -0.0, 1e-45, 3.4028234e38, 1 / 3], F64: [0.1, -0.0, 5e-324, 1.7976931348623157e308, 1 / 3]}
    integers_ = {I32: [-(2**31), 2**31 - 1, -1], U32: [0, 2**32 - 1, 2**31]}
    for type_, values in (numbers | integers_).items():
        with KernelBuilder("constants") as k:
            out = k.buffer("out", type_, writable=True)
            for i, value in enumerate(values):
                store(out, k.index() * 0 + i, value)
        out = device.allocate(type_, len(values))
        device.compile(k.kernel).run(1, {}, {"out": out})
        assert device.read(out).tobytes() == np.array(values, type_.dtype).tobytes()


def test_every_operation_is_covered() -> None:
    covered = {"fma"} | DOMAINS
    for type_, kind in product(TYPES.values(), ("a",)):
        with KernelBuilder("names"):
            k = KernelBuilder("inner")
            with k:
                one = read(k, kind, type_, None)
                covered |= {name.split()[0] for name in results(type_, one, one, read(k, "c", BOOL, None))}
    assert covered == {op.name for op in PURE}
