from __future__ import annotations

import importlib.metadata
from collections.abc import Callable

import pytest
from tests.gpus import needs_gpu, no_gpu

from zeroset.errors import DeviceError
from zeroset.runtime import Device, registry
from zeroset.runtime.gpu import adapter

Run = Callable[..., object]


def test_it_says_what_there_is(zeroset: Run) -> None:
    ran = zeroset("doctor")
    assert ran.status == 0
    for part in ("numpy", "llvmlite", "wgpu", "lanes of 32 bits", "threads", "ZEROSET_GPU", "cache", "all is well"):
        assert part in ran.out
    assert "MISSING" not in ran.out
    assert "FAILED" not in ran.out
    assert ("gpu       NONE" in ran.out) == bool(no_gpu())


@needs_gpu
def test_it_names_every_adapter_and_the_one_that_is_taken(zeroset: Run) -> None:
    lines = zeroset("doctor").out.splitlines()
    found = adapter.adapters()
    shown = [i for i, line in enumerate(lines) if line.startswith("  gpu  ")]
    assert len(shown) == len(found)
    assert [i for i in shown if lines[i].endswith('this is the device "gpu"')] == [shown[found.index(adapter.choose())]]
    for i, adapter_ in zip(shown, found, strict=True):
        assert adapter_.title in lines[i]
        assert ("f64 yes" in lines[i + 1]) == ("doubles" in adapter_.features)
        assert "timestamps" in lines[i + 1]
        assert "MiB" in lines[i + 1]
    assert any("units in the last place" in line for line in lines)


def test_it_says_why_there_is_no_gpu(zeroset: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(adapter, "adapters", lambda: ())
    monkeypatch.setenv("ZEROSET_GPU", "Voodoo")
    registry._best.cache_clear()
    ran = zeroset("doctor")
    registry._best.cache_clear()
    assert "gpu       NONE: there is no GPU" in ran.out
    assert "asks for 'Voodoo'" in ran.out
    assert "auto      cpu, not the GPU: there is no GPU" in ran.out
    assert "all is well" in ran.out


def test_what_breaks_is_named_and_the_rest_is_said(zeroset: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken() -> tuple[adapter.Found, ...]:
        raise KeyError("backend_type")

    monkeypatch.setattr(adapter, "adapters", broken)
    ran = zeroset("doctor")
    assert ran.status == 0
    assert "gpu      FAILED: KeyError: 'backend_type'" in ran.out
    assert "cache" in ran.out


def test_it_says_what_is_missing_and_why(zeroset: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    known = importlib.metadata.version

    def version(name: str) -> str:
        if name in ("rich", "sympy"):
            raise importlib.metadata.PackageNotFoundError(name)
        return known(name)

    def no_cpu() -> Device:
        raise DeviceError("LLVM cannot be loaded", hint="reinstall llvmlite")

    monkeypatch.setattr(importlib.metadata, "version", version)
    monkeypatch.setattr(registry, "_made", {})
    monkeypatch.setitem(registry.DEVICES, "cpu", no_cpu)
    registry._best.cache_clear()
    ran = zeroset("doctor")
    registry._best.cache_clear()
    assert ran.status == 0
    assert "rich         MISSING, needed for progress" in ran.out
    assert "sympy        not installed, optional" in ran.out
    assert "cpu       MISSING: LLVM cannot be loaded" in ran.out
    assert "trial    FAILED" in ran.out
