"""Programs made side by side, in a hurry first and well later."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from zeroset.kernel import F32, Kernel, KernelBuilder, load, store
from zeroset.rendering.making import Making
from zeroset.runtime.cache import Cache
from zeroset.runtime.cpu import CpuDevice


def doubling(name: str, factor: float = 2.0) -> Kernel:
    with KernelBuilder(name) as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, load(x, i) * factor)
    return k.kernel


class Recording(CpuDevice):
    """A CPU that remembers in what order and in which way it was asked."""

    def __init__(self) -> None:
        super().__init__(cache=Cache(None))
        self.asked: list[tuple[str, bool]] = []
        self.gate = threading.Event()
        self.gate.set()

    def compile_cached(self, key: str, build: Callable[[], Kernel], quick: bool = False) -> Any:
        self.asked.append((key, quick))
        self.gate.wait(10)
        return super().compile_cached(key, build, quick)


@pytest.fixture
def device() -> Recording:
    return Recording()


def making(device: Recording, *names: str) -> Making:
    made = Making(device)
    for i, name in enumerate(names):
        made.add(name, f"key of {name}", lambda name=name, i=i: doubling(name, 2.0 + i))  # type: ignore[misc]
    return made


def test_programs_are_made_once_and_run(device: Recording) -> None:
    made = making(device, "a", "b")
    made.begin(["a", "b"], 2)
    made.begin(["a"], 2)
    data = np.ones(5, np.float32)
    made.get("a").run(5, {}, {"x": data})
    made.get("b").run(5, {}, {"x": data})
    assert data.tolist() == [6.0] * 5
    assert sorted(device.asked) == [("key of a", False), ("key of b", False)]


def test_what_nobody_began_is_made_where_it_is_asked_for(device: Recording) -> None:
    made = making(device, "a")
    assert "a" in made
    assert "b" not in made
    assert made.get("a") is made.get("a")
    assert device.asked == [("key of a", False)]


def test_pending_until_it_is_there(device: Recording) -> None:
    made = making(device, "a")
    device.gate.clear()
    made.begin(["a"], 1)
    assert made.pending("a")
    device.gate.set()
    made.get("a")
    assert not made.pending("a")


def test_the_good_program_takes_the_quick_ones_place(device: Recording) -> None:
    made = making(device, "a", "b")
    made.begin(["a", "b"], 2, ["a"])
    quick, good = made.get("a"), made.get("b")
    made.settle()
    assert made.get("a") is not quick
    assert made.get("b") is good
    assert device.asked.count(("key of a", True)) == device.asked.count(("key of a", False)) == 1
    asked = list(device.asked)
    made.improve()
    made.settle()
    assert device.asked == asked


@pytest.mark.parametrize("improving", [False, True])
def test_who_needs_the_good_program_waits_for_it(device: Recording, improving: bool) -> None:
    made = making(device, "a", "b")
    made.begin(["a", "b"], 2, quick=["a"])
    quick = made.get("a")
    if improving:
        made.improve()
    good = made.best("a")
    assert good is not quick
    assert made.get("a") is made.best("a") is good
    assert made.best("b") is made.get("b")
    assert sorted(device.asked) == [("key of a", False), ("key of a", True), ("key of b", False)]


def test_an_error_comes_to_who_asks(device: Recording) -> None:
    made = Making(device)

    def broken() -> Kernel:
        raise ValueError("no kernel")

    made.add("a", "a", broken)
    made.begin(["a"], 1)
    with pytest.raises(ValueError, match="no kernel"):
        made.get("a")


def test_quick_and_good_code_give_the_same_bits() -> None:
    device = CpuDevice(cache=Cache(None))
    quick = device.compile_cached("k", lambda: doubling("k", 1.1), quick=True)
    good = device.compile_cached("k", lambda: doubling("k", 1.1))
    assert quick is not good
    # Whoever is in a hurry takes the good one where it is there.
    assert device.compile_cached("k", lambda: doubling("k", 1.1), quick=True) is good
    values = np.random.default_rng(3).normal(size=1000).astype(np.float32)
    ours, theirs = values.copy(), values.copy()
    quick.run(1000, {}, {"x": ours})
    good.run(1000, {}, {"x": theirs})
    assert np.array_equal(ours, theirs)
