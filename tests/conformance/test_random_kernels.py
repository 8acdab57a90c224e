"""Random kernels, small but with everything in them, on every target and through every pass.

Values of each type lie in a pool; a step takes some from it and puts one back. Loops and branches carry values of the
pool, and their bodies are made of steps in turn. Left out are fused multiply-add, which may round once or twice, and
the bits of floats, where NaNs differ; votes come only in dispatches of one packet. A GPU's driver may lose the sign of
a zero, which such kernels blow up into anything: GPUs get kernels of integers and truth values.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from zeroset.kernel import (
    BOOL,
    F32,
    F64,
    I32,
    U32,
    Kernel,
    KernelBuilder,
    Type,
    Value,
    any_,
    constant,
    for_,
    if_,
    load,
    while_,
)
from zeroset.kernel import store as store_to

TYPES = (F32, F64, I32, U32, BOOL)
ARITHMETIC = {
    "f": ["add", "sub", "mul", "div", "min", "max"],
    "i": ["add", "sub", "mul", "min", "max", "and", "xor", "shl", "shr"],
}
FLOAT_STEPS = ["neg", "abs", "sqrt", "floor", "ceil", "trunc", "rint", "pow2", "mantissa", "exponent"]
NUMBERS = {
    "f": [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 3.7, -1e30, 1e-40],
    "i": [0, 1, -1, 5, 31, 100],
    "u": [0, 1, 5, 31, 2**32 - 1],
}
LANES = 37


class Maker:
    """Draws one kernel."""

    def __init__(self, data: st.DataObject, votes: bool, types: tuple[Type, ...] = TYPES) -> None:
        self.data = data
        self.votes = votes
        self.types = types
        self.stored = [t for t in types if t != BOOL]
        self.budget = 40

    def draw(self, choices: list[Any]) -> Any:
        return self.data.draw(st.sampled_from(choices))

    def kernel(self) -> Kernel:
        with KernelBuilder("random") as k:
            self.i = k.index()
            self.inputs = {t: k.buffer(f"in_{t}", t) for t in self.stored}
            self.outputs = {t: k.buffer(f"out_{t}", t, writable=True) for t in self.stored}
            pool = [load(buffer, self.i) for buffer in self.inputs.values()]
            pool += [k.uniform(f"u_{t}", t) for t in self.types]
            pool += [load(self.inputs[U32], self.i).ne(0)]
            pool = self.steps(pool, 3)
            for type_, buffer in self.outputs.items():
                for n, value in enumerate([v for v in pool if v.type == type_][-2:]):
                    store_to(buffer, self.i + n * LANES, value)
        return k.kernel

    def take(self, pool: list[Value], type_: Type) -> Value:
        if self.data.draw(st.integers(0, 7)) == 0:
            return constant(self.draw([True, False] if type_ == BOOL else NUMBERS[type_.kind]), type_)
        return self.draw([v for v in pool if v.type == type_][-8:])

    def steps(self, pool: list[Value], depth: int) -> list[Value]:
        pool = list(pool)
        for _ in range(self.data.draw(st.integers(1, 8))):
            self.budget -= 1
            if self.budget < 0:
                break
            kinds = (
                ["number"] * 3
                + (["float"] if F32 in self.types else [])
                + ["compare", "logic", "select", "convert", "gather"]
            )
            kinds += ["store"] + (["vote"] if self.votes else []) + (["if", "while", "for"] if depth else [])
            pool += getattr(self, f"_{self.draw(kinds)}")(pool, depth)
        return pool

    def _number(self, pool: list[Value], depth: int) -> list[Value]:
        type_ = self.draw(self.stored)
        name = self.draw(ARITHMETIC["f" if type_.kind == "f" else "i"])
        return [apply_named(name, self.take(pool, type_), self.take(pool, type_))]

    def _float(self, pool: list[Value], depth: int) -> list[Value]:
        name, a = self.draw(FLOAT_STEPS), self.take(pool, self.draw([F32, F64]))
        if name == "pow2":
            a = a.rint().maximum(-100.0).minimum(100.0)
        elif name in ("mantissa", "exponent"):
            a = abs(a).maximum(1e-30).minimum(1e30)
        return [apply_named(name, a)]

    def _compare(self, pool: list[Value], depth: int) -> list[Value]:
        type_ = self.draw(self.stored)
        return [
            apply_named(self.draw(["lt", "le", "gt", "ge", "eq", "ne"]), self.take(pool, type_), self.take(pool, type_))
        ]

    def _logic(self, pool: list[Value], depth: int) -> list[Value]:
        name = self.draw(["and", "or", "xor", "not"])
        return [apply_named(name, *(self.take(pool, BOOL) for _ in range(1 if name == "not" else 2)))]

    def _select(self, pool: list[Value], depth: int) -> list[Value]:
        type_ = self.draw(list(self.types))
        return [apply_named("select", self.take(pool, BOOL), self.take(pool, type_), self.take(pool, type_))]

    def _convert(self, pool: list[Value], depth: int) -> list[Value]:
        return [self.take(pool, self.draw(list(self.types))).convert(self.draw(list(self.types)))]

    def _gather(self, pool: list[Value], depth: int) -> list[Value]:
        return [load(self.inputs[self.draw(self.stored)], self.take(pool, U32) & 31)]

    def _store(self, pool: list[Value], depth: int) -> list[Value]:
        type_ = self.draw(self.stored)
        store_to(self.outputs[type_], self.i + 2 * LANES, self.take(pool, type_))
        return [load(self.outputs[type_], self.i + 2 * LANES)]

    def _vote(self, pool: list[Value], depth: int) -> list[Value]:
        return [any_(self.take(pool, BOOL))]

    def _if(self, pool: list[Value], depth: int) -> list[Value]:
        types = self.data.draw(st.lists(st.sampled_from(self.types), min_size=0, max_size=3))

        def side() -> tuple[Value, ...]:
            inner = self.steps(pool, depth - 1)
            return tuple(self.take(inner, t) for t in types)

        return list(if_(self.take(pool, BOOL), side, side))

    def _while(self, pool: list[Value], depth: int) -> list[Value]:
        start = [
            self.take(pool, t) for t in self.data.draw(st.lists(st.sampled_from(self.types), min_size=1, max_size=3))
        ]
        limit = self.take(pool, U32) & 7

        def goes_on(steps: Value, *state: Value) -> Value:
            return (steps < limit) & self.take([*self.steps([*pool, *state], 0), *state], BOOL)

        def body(steps: Value, *state: Value) -> tuple[Value, ...]:
            inner = self.steps([*pool, *state], depth - 1)
            return (steps + 1, *(self.take(inner, v.type) for v in state))

        return list(while_(goes_on, body, constant(0, U32), *start))

    def _for(self, pool: list[Value], depth: int) -> list[Value]:
        start = [
            self.take(pool, t) for t in self.data.draw(st.lists(st.sampled_from(self.types), min_size=1, max_size=3))
        ]

        def body(j: Value, *state: Value) -> tuple[Value, ...]:
            inner = self.steps([*pool, j, *state], depth - 1)
            return tuple(self.take(inner, v.type) for v in state)

        return list(for_(self.take(pool, U32) & 3, body, *start))


def apply_named(name: str, *operands: Value) -> Value:
    from zeroset.kernel.value import apply

    return apply(name, *operands)


def inputs(seed: int) -> tuple[dict[str, np.ndarray[Any, Any]], dict[str, float]]:
    random = np.random.default_rng(seed)
    buffers: dict[str, np.ndarray[Any, Any]] = {}
    for type_ in TYPES[:4]:
        if type_.kind == "f":
            values = random.normal(size=LANES) * 2.0 ** random.integers(-8, 9, LANES)
            values[random.integers(0, LANES, 4)] = [0.0, -0.0, np.inf, np.nan]
        else:
            values = random.integers(-9 if type_ is I32 else 0, 10, LANES)
        buffers[f"in_{type_}"] = values.astype(type_.dtype)
        buffers[f"out_{type_}"] = np.zeros(3 * LANES, type_.dtype)
    return buffers, {"u_f32": 1.5, "u_f64": -0.25, "u_i32": -3, "u_u32": 6, "u_bool": bool(seed % 2)}


SETTINGS = settings(
    max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large]
)


@SETTINGS
@given(st.data(), st.integers(0, 99))
def test_random_kernels(agree_everywhere: Callable[..., None], data: st.DataObject, seed: int) -> None:
    kernel = Maker(data, votes=False).kernel()
    buffers, uniforms = inputs(seed)
    agree_everywhere(kernel, LANES, buffers, uniforms)


@SETTINGS
@given(st.data(), st.integers(0, 99))
def test_random_kernels_with_votes(agree_everywhere: Callable[..., None], data: st.DataObject, seed: int) -> None:
    kernel = Maker(data, votes=True).kernel()
    buffers, uniforms = inputs(seed)
    agree_everywhere(kernel, LANES, buffers, uniforms, votes=True)


@settings(SETTINGS, max_examples=15)
@given(st.data(), st.integers(0, 99))
def test_random_kernels_of_integers_on_a_gpu(
    agree_on_gpus: Callable[..., None], data: st.DataObject, seed: int
) -> None:
    kernel = Maker(data, votes=False, types=(I32, U32, BOOL)).kernel()
    buffers, uniforms = inputs(seed)
    agree_on_gpus(kernel, LANES, {b.name: buffers[b.name] for b in kernel.buffers}, uniforms)
