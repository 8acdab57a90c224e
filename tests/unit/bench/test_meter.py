"""The counting device counts what is compiled, and nothing that is remembered."""

from __future__ import annotations

import threading
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import zeroset as zs
from zeroset.bench import meter as module
from zeroset.bench.meter import Meter
from zeroset.rendering.frame import settle
from zeroset.runtime.cache import Cache
from zeroset.runtime.cpu import CpuDevice


def test_compilations_are_counted_once(tmp_path: Path) -> None:
    surface = zs.surface("x^2 + y^2 + 2z^2 = 1", bounds=1.5)
    meter = Meter(CpuDevice(cache=Cache(tmp_path)))
    zs.render(surface, 16, device=meter)
    settle()
    first, spent = meter.compilations, meter.milliseconds
    assert first >= 3
    assert spent > 0
    zs.render(surface, 16, device=meter)
    assert meter.compilations == first

    loading = Meter(CpuDevice(cache=Cache(tmp_path)))
    zs.render(surface, 16, device=loading)
    settle()
    assert loading.compilations == 0
    assert loading.milliseconds > 0


def test_pictures_are_those_of_the_wrapped_device() -> None:
    surface = zs.surface("x^2 + y^2 + 2z^2 = 1", bounds=1.5)
    device = CpuDevice(cache=Cache(None))
    assert (zs.render(surface, 32, device=Meter(device)).pixels == zs.render(surface, 32, device=device).pixels).all()
    assert Meter(device).name == "cpu"


def test_programs_obtained_at_once_are_timed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    both_inside = threading.Barrier(2, timeout=30)
    clock = iter([10.0, 13.0, 20.0, 21.0])
    ours = [threading.current_thread()]

    def now() -> float:
        # Programs of pictures before may still be under way in other threads, and have meters of their own.
        return next(clock) if threading.current_thread() in ours else 0.0

    monkeypatch.setattr(module, "time", SimpleNamespace(perf_counter=now))

    class Slow:
        """A device whose compilers wait for one another."""

        def compile(self, kernel: Any) -> Any:
            both_inside.wait()

    slow: Any = Slow()
    meter = Meter(slow)
    for _ in range(2):
        other = threading.Thread(target=meter.compile, args=(None,))
        ours.append(other)
        other.start()
        meter.compile(slow)
        other.join()
    assert meter.compilations == 4
    assert meter.milliseconds == 4000.0
