"""Loads, stores and atomics on every target: gathers, scatters, lanes whose index leads nowhere, many threads."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from zeroset.kernel import F32, F64, I32, U32, KernelBuilder, Type, atomic, constant, for_, if_, interp, load, store
from zeroset.runtime import Device


@pytest.mark.parametrize("type_", [F32, F64, I32, U32], ids=str)
def test_gather_and_scatter(agree: Callable[..., object], type_: Type) -> None:
    random = np.random.default_rng(3)
    with KernelBuilder("shuffle") as k:
        source, where = k.buffer("source", type_), k.buffer("where", U32)
        out, i = k.buffer("out", type_, writable=True), k.index()
        store(out, load(where, i), load(source, load(where, i) ^ 1) + load(source, i * 0 + 5))
    data = {"source": random.integers(0, 99, 80).astype(type_.dtype), "where": random.permutation(80).astype(np.uint32)}
    agree(k.kernel, 77, {**data, "out": np.zeros(80, type_.dtype)})


@pytest.mark.parametrize("shift", [-3, 0, 5])
def test_neighbours(agree: Callable[..., object], shift: int) -> None:
    """The dispatch index plus something uniform is one vector access, at both ends of the buffer too."""
    with KernelBuilder("neighbours") as k:
        source, out, i = k.buffer("source", F32), k.buffer("out", F32, writable=True), k.index()
        there = i.convert(I32) + k.uniform("shift", I32)
        inside = (there >= 0) & (there < 77)
        (value,) = if_(inside, lambda: load(source, there) / load(source, 76 - i), lambda: constant(-1.0, F32))
        store(out, i + k.uniform("first", U32), value)
    data = {"source": np.arange(1, 78, dtype=np.float32), "out": np.zeros(80, np.float32)}
    agree(k.kernel, 77, data, {"shift": shift, "first": 3})


@pytest.mark.parametrize("shift", [1, 3, 4, 6])
@pytest.mark.parametrize("first", [0, 5, 64])
def test_many_lanes_share_an_element(agree: Callable[..., object], shift: int, first: int) -> None:
    """Lanes in a row may load one element each 2^k, and begin in the middle of such a run."""
    with KernelBuilder("shared") as k:
        source, out, i = k.buffer("source", F32), k.buffer("out", F32, writable=True), k.index()
        lane = i + k.uniform("first", U32)
        (value,) = if_((i & 3).ne(1), lambda: load(source, lane >> shift) + 1.0, lambda: constant(-1.0, F32))
        store(out, i, value)
    data = {"source": np.arange((77 + first >> shift) + 1, dtype=np.float32), "out": np.zeros(77, np.float32)}
    agree(k.kernel, 77, data, {"first": first})


def test_an_index_through_floats_is_no_index(agree: Callable[..., object]) -> None:
    with KernelBuilder("floats") as k:
        source, out, i = k.buffer("source", F32), k.buffer("out", F32, writable=True), k.index()
        store(out, i, load(source, (i.convert(F32) + 1.75).convert(U32)))
    agree(k.kernel, 37, {"source": np.arange(40, dtype=np.float32), "out": np.zeros(37, np.float32)})


def test_inactive_lanes_touch_nothing(device: Device) -> None:
    """Their indices are far outside: an access would end the process."""
    with KernelBuilder("wild") as k:
        source, out, i = k.buffer("source", F32), k.buffer("out", F32, writable=True), k.index()
        far = i * 40_000_000
        even = (i & 1).eq(0)
        (value,) = if_(even, lambda: load(source, i >> 1) / 3.0, lambda: constant(1.0, F32))
        if_(even & (i < 2), lambda: store(out, far, value / load(source, far)))
    source, out = device.allocate(F32, 40), device.allocate(F32, 4)
    device.write(source, np.full(40, 2, np.float32))
    device.compile(k.kernel).run(77, {}, {"source": source, "out": out})
    assert device.read(out).tolist() == [np.float32(np.float32(2) / np.float32(3)) / np.float32(2), 0, 0, 0]


def test_uniform_loads_of_arrays(agree: Callable[..., object]) -> None:
    random = np.random.default_rng(5)
    with KernelBuilder("sum") as k:
        centres, x, i = k.buffer("centres", F32), k.buffer("x", F32, writable=True), k.index()
        v = load(x, i)
        (total,) = for_(
            k.uniform("count", U32), lambda j, s: s + (v - load(centres, j)).maximum(0.0), constant(0.0, F32)
        )
        store(x, i, total)
    agree(
        k.kernel,
        37,
        {"centres": random.random(30).astype(np.float32), "x": random.random(37).astype(np.float32)},
        {"count": 30},
    )


def test_stores_are_seen_by_later_loads(agree: Callable[..., object], packet: int) -> None:
    with KernelBuilder("again") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        before = load(x, i)
        store(x, i, before + 1.0)
        store(x, i, load(x, i) * before + load(x, 0))
    agree(k.kernel, packet, {"x": np.arange(packet, dtype=np.float32)})


@pytest.mark.parametrize("type_", [I32, U32], ids=str)
@pytest.mark.parametrize("operation", ["add", "min", "max"])
def test_atomics_of_one_packet(agree: Callable[..., object], packet: int, operation: str, type_: Type) -> None:
    """Lanes of a packet take their turns in order, so even the values before are certain."""
    random = np.random.default_rng(11)
    with KernelBuilder("atomics") as k:
        place, value = k.buffer("place", U32), k.buffer("value", type_)
        cells, before, i = k.buffer("cells", type_, writable=True), k.buffer("before", type_, writable=True), k.index()

        def turn() -> None:
            store(before, i, atomic(operation, cells, load(place, i), load(value, i)))

        if_(load(value, i).ne(7), turn)
    values = random.integers(-50 if type_ is I32 else 2**31 - 5, 50 if type_ is I32 else 2**31 + 5, packet)
    data = {
        "place": random.integers(0, 3, packet).astype(np.uint32),
        "value": values.astype(type_.dtype),
        "cells": np.array([-3, 0, 3], np.int64).astype(type_.dtype),
        "before": np.zeros(packet, type_.dtype),
    }
    agree(k.kernel, packet, data)


def test_lanes_that_add_to_one_element(agree: Callable[..., object], packet: int) -> None:
    random = np.random.default_rng(13)
    with KernelBuilder("together") as k:
        value, cells = k.buffer("value", I32), k.buffer("cells", I32, writable=True)
        before, i = k.buffer("before", I32, writable=True), k.index()

        def turn() -> None:
            store(before, i, atomic("add", cells, k.uniform("place", U32), load(value, i)))
            atomic("add", cells, 2, 5)

        if_(load(value, i) > 0, turn)
    data = {"value": random.integers(-9, 10, packet), "cells": np.arange(3), "before": np.zeros(packet)}
    agree(k.kernel, packet, {name: values.astype(np.int32) for name, values in data.items()}, {"place": 1})


@pytest.mark.parametrize("place", ["uniform", "varying"])
def test_atomics_of_many_threads(device: Device, place: str) -> None:
    """Every lane gets a number of its own, and none is lost."""
    count = 100_003
    with KernelBuilder("numbers") as k:
        cells, got, i = k.buffer("cells", U32, writable=True), k.buffer("got", U32, writable=True), k.index()
        store(got, i, atomic("add", cells, constant(0, U32) if place == "uniform" else i >> 31, 1))
    cells, got = device.allocate(U32, 1), device.allocate(U32, count)
    program = device.compile(k.kernel)
    for _ in range(3):
        device.write(cells, np.zeros(1, np.uint32))
        program.run(count, {}, {"cells": cells, "got": got})
        assert device.read(cells)[0] == count
        assert np.array_equal(np.sort(device.read(got)), np.arange(count))


def test_an_unread_count(device: Device) -> None:
    with KernelBuilder("count") as k:
        cells, i = k.buffer("cells", U32, writable=True), k.index()

        def add() -> None:
            atomic("add", cells, 0, k.uniform("step", U32))

        if_((i & 3).eq(1), add)
    cells, expected = device.allocate(U32, 1), np.zeros(1, np.uint32)
    device.compile(k.kernel).run(1001, {"step": 3}, {"cells": cells})
    interp.run(k.kernel, 1001, {"step": 3}, {"cells": expected})
    assert device.read(cells)[0] == expected[0] == 750
