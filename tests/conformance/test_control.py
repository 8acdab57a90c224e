"""Structured control flow on every target: lanes that leave early, loops in branches, votes, tails."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from zeroset.kernel import (
    BOOL,
    F32,
    F64,
    I32,
    U32,
    Buffer,
    KernelBuilder,
    Value,
    any_,
    constant,
    for_,
    if_,
    load,
    store,
    while_,
)

COUNTS = (1, 3, 4, 7, 15, 16, 17, 31, 64, 77, 1000)


def start() -> tuple[KernelBuilder, np.random.Generator]:
    return KernelBuilder("control"), np.random.default_rng(7)


def zero() -> Value:
    return constant(0, U32)


@pytest.mark.parametrize("count", COUNTS)
def test_tails_leave_the_rest_alone(agree: Callable[..., object], count: int) -> None:
    with KernelBuilder("tail") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, load(x, i) + 1.0)
    agree(k.kernel, count, {"x": np.arange(count + 40, dtype=np.float32)})


def test_no_lanes(agree: Callable[..., object]) -> None:
    with KernelBuilder("none") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, load(x, i) + 1.0)
    agree(k.kernel, 0, {"x": np.zeros(4, np.float32)})


@pytest.mark.parametrize("type_", [F32, F64], ids=str)
def test_lanes_leave_a_loop_early(agree: Callable[..., object], type_: object) -> None:
    k, random = start()
    with k:
        x, n, i = k.buffer("x", type_, writable=True), k.buffer("n", U32, writable=True), k.index()

        def halve(v: Value, steps: Value) -> tuple[Value, Value]:
            return v * 0.5, steps + 1

        v, steps = while_(lambda v, steps: v > 1.0, halve, load(x, i), zero())
        store(x, i, v)
        store(n, i, steps)
    values = (random.random(77) * 2.0 ** random.integers(-3, 40, 77)).astype(type_.dtype)
    agree(k.kernel, 77, {"x": values, "n": np.zeros(77, np.uint32)})


def test_state_that_nobody_reads(agree: Callable[..., object]) -> None:
    """It may hold anything in lanes that have left, and must not lead the others astray."""
    k, random = start()
    with k:
        x, i = k.buffer("x", F32, writable=True), k.index()

        def body(v: Value, w: Value, steps: Value) -> tuple[Value, ...]:
            return v + w, w * 1.5, steps + 1

        v, _, _ = while_(lambda v, w, steps: (v < 100.0) & (steps < 50), body, load(x, i), load(x, i), zero())
        store(x, i, v)
    agree(k.kernel, 77, {"x": random.random(77).astype(np.float32) * 10})


def test_nested_loops_of_varying_length(agree: Callable[..., object]) -> None:
    k, random = start()
    with k:
        n, m, out, i = k.buffer("n", U32), k.buffer("m", U32), k.buffer("out", U32, writable=True), k.index()

        def outer(j: Value, total: Value) -> Value:
            def inner(left: Value, sum_: Value) -> tuple[Value, Value]:
                return left - 1, sum_ * 3 + left + j

            _, sum_ = while_(lambda left, sum_: left > 0, inner, (load(m, i) + j) & 7, total)
            return sum_

        (total,) = for_(load(n, i), outer, zero())
        store(out, i, total)
    numbers = {"n": random.integers(0, 9, 77), "m": random.integers(0, 99, 77), "out": np.zeros(77)}
    agree(k.kernel, 77, {name: data.astype(np.uint32) for name, data in numbers.items()})


@pytest.mark.parametrize("rounds", [0, 1, 5])
def test_uniform_loops_and_branches(agree: Callable[..., object], rounds: int) -> None:
    k, random = start()
    with k:
        x, i, rounds_ = k.buffer("x", F32, writable=True), k.index(), k.uniform("rounds", U32)
        flag, scale = k.uniform("flag", BOOL), k.uniform("scale", F32)

        def turn(j: Value, v: Value, u: Value) -> tuple[Value, Value]:
            (w,) = if_(flag & (j > 1), lambda: v * u, lambda: scale)
            return v + w, u * scale

        v, u = for_(rounds_, turn, load(x, i), scale)
        (last,) = while_(lambda s: s < 10.0, lambda s: s + scale, u)
        store(x, i, v + last)
    for flag_ in (False, True):
        data = {"x": random.random(37).astype(np.float32)}
        agree(k.kernel, 37, data, {"rounds": rounds, "flag": flag_, "scale": 1.25})


def test_loops_in_branches_and_branches_in_loops(agree: Callable[..., object]) -> None:
    k, random = start()
    with k:
        n, out, i = k.buffer("n", I32), k.buffer("out", I32, writable=True), k.index()

        def collatz(v: Value, steps: Value) -> tuple[Value, Value]:
            (after,) = if_((v & 1).eq(0), lambda: v >> 1, lambda: for_(constant(2, U32), lambda j, w: w + v, v + 1)[0])
            return after, steps + 1

        def long() -> tuple[Value, Value]:
            return while_(lambda v, steps: (v > 1) & (steps < 200), collatz, load(n, i), constant(0, I32))

        a, b = if_(load(n, i) > 10, long, lambda: (load(n, i) * 2, constant(-1, I32)))
        store(out, i, a * 1000 + b)
    agree(k.kernel, 77, {"n": random.integers(-20, 90, 77).astype(np.int32), "out": np.zeros(77, np.int32)})


def test_stores_in_branches(agree: Callable[..., object]) -> None:
    k, random = start()
    with k:
        x, out, i = k.buffer("x", F32), k.buffer("out", F32, writable=True), k.index()
        v = load(x, i)

        def upper() -> None:
            store(out, i, v * 2.0)
            if_(v > 0.75, lambda: store(out, i + 100, v))

        if_(v > 0.5, upper, lambda: store(out, (i * 2) + 200, -v))
    agree(k.kernel, 77, {"x": random.random(77).astype(np.float32), "out": np.full(400, 9, np.float32)})


def test_votes(agree: Callable[..., object], packet: int) -> None:
    """One packet is the whole dispatch here, as it is for the interpreter."""
    k, random = start()
    with k:
        x, out, i = k.buffer("x", F32), k.buffer("out", U32, writable=True), k.index()
        v = load(x, i)

        def body(steps: Value, w: Value) -> tuple[Value, Value]:
            (low,) = if_(w < 0.5, lambda: any_(w < 0.1).convert(U32), lambda: any_(w < 0.1).convert(U32) + 10)
            return steps + low + 1, w * 0.9

        steps, _ = while_(lambda steps, w: any_(w > 0.3) & (w > 0.05), body, zero(), v)
        store(out, i, steps)
    agree(k.kernel, packet, {"x": random.random(packet).astype(np.float32), "out": np.zeros(packet, np.uint32)})


def test_a_vote_of_a_uniform_value(agree: Callable[..., object]) -> None:
    with KernelBuilder("vote") as k:
        out = k.buffer("out", U32, writable=True)
        store(out, k.index(), any_(k.uniform("u", F32) > 1.0).convert(U32))
    for u in (0.5, 1.5):
        agree(k.kernel, 21, {"out": np.zeros(21, np.uint32)}, {"u": u})


def test_masks_carried_through_loops(agree: Callable[..., object]) -> None:
    k, random = start()
    with k:
        x, out, i = k.buffer("x", F64), k.buffer("out", U32, writable=True), k.index()

        def body(v: Value, found: Value, open_: Value, steps: Value) -> tuple[Value, ...]:
            found = found | (v > 3.0)
            return v * 1.5, found, open_ & ~found, steps + 1

        yes, no = constant(True, BOOL), constant(False, BOOL)
        _, found, open_, steps = while_(
            lambda v, found, open_, steps: open_ & (steps < 9), body, load(x, i), no, yes, zero()
        )
        store(out, i, steps * 4 + found.convert(U32) * 2 + open_.convert(U32))
    agree(k.kernel, 77, {"x": random.random(77), "out": np.zeros(77, np.uint32)})


def test_a_branch_that_gives_uniform_values(agree: Callable[..., object]) -> None:
    k, random = start()
    with k:
        x, out, i, u = k.buffer("x", F32), k.buffer("out", F32, writable=True), k.index(), k.uniform("u", F32)
        deep = u.sqrt() / (u + 3.0)
        (a,) = if_(load(x, i) > 0.5, lambda: u / 3.0, lambda: for_(constant(3, U32), lambda j, w: w / deep, u)[0])
        (b,) = if_(u > 1.0, lambda: load(x, i) / u, lambda: deep)
        store(out, i, a + b)
    for u in (0.5, 1.5):
        agree(k.kernel, 37, {"x": random.random(37).astype(np.float32), "out": np.zeros(37, np.float32)}, {"u": u})


def test_deep_nesting(agree: Callable[..., object]) -> None:
    k, random = start()

    def nest(out: Buffer, i: Value, v: Value, depth: int) -> Value:
        if depth == 0:
            return v * 1.25 + 0.125
        (inner,) = if_(
            v > 0.5, lambda: for_((i & 3) + 1, lambda j, w: nest(out, i, w * 0.5, depth - 1), v)[0], lambda: -v
        )
        return inner

    with k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, nest(x, i, load(x, i), 5))
    agree(k.kernel, 37, {"x": random.random(37).astype(np.float32) * 4})
