from __future__ import annotations

import importlib.metadata
from collections.abc import Callable

import pytest

from zeroset.errors import DeviceError
from zeroset.runtime import registry

Run = Callable[..., object]


def test_it_says_what_there_is(zeroset: Run) -> None:
    ran = zeroset("doctor")
    assert ran.status == 0
    for part in ("numpy", "llvmlite", "lanes of 32 bits", "threads", "cache", "all is well"):
        assert part in ran.out
    assert "MISSING" not in ran.out


def test_it_says_what_is_missing_and_why(zeroset: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    known = importlib.metadata.version

    def version(name: str) -> str:
        if name in ("rich", "sympy"):
            raise importlib.metadata.PackageNotFoundError(name)
        return known(name)

    def no_cpu(_: str) -> object:
        raise DeviceError("LLVM cannot be loaded", hint="reinstall llvmlite")

    monkeypatch.setattr(importlib.metadata, "version", version)
    monkeypatch.setattr(registry, "_made", no_cpu)
    ran = zeroset("doctor")
    assert ran.status == 0
    assert "rich      MISSING, needed for progress" in ran.out
    assert "sympy     not installed, optional" in ran.out
    assert "cpu       MISSING: LLVM cannot be loaded" in ran.out
    assert "trial    FAILED" in ran.out
