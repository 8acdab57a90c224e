from __future__ import annotations

import builtins
from pathlib import Path

import pytest

from zeroset.runtime.stamps import cpu_stamp, llvm_stamp, source_stamp


def test_the_stamp_follows_the_sources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "zeroset"
    (package / "kernel").mkdir(parents=True)
    source = package / "kernel" / "ops.py"
    source.write_text("old")
    monkeypatch.setattr("zeroset.errors.__file__", str(package / "errors.py"))
    stamps = []
    for text in ("old", "new!"):
        source.write_text(text)
        source_stamp.cache_clear()
        stamps.append(source_stamp())
    (package / "kernel" / "__pycache__").mkdir()
    source_stamp.cache_clear()
    stamps.append(source_stamp())
    source_stamp.cache_clear()
    assert stamps[0] != stamps[1] == stamps[2]


def test_a_system_that_does_not_say_what_its_cpu_is(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(*arguments: object) -> None:
        raise FileNotFoundError

    monkeypatch.setattr(builtins, "open", missing)
    assert cpu_stamp() == ""


@pytest.mark.skipif(not Path("/proc/cpuinfo").exists(), reason="this system has no /proc/cpuinfo")
def test_the_cpu_is_named_by_what_does_not_change() -> None:
    assert cpu_stamp() == cpu_stamp() != ""
    assert "MHz" not in cpu_stamp()
    assert "bogomips" not in cpu_stamp().lower()


def test_llvm_is_named() -> None:
    assert "llvmlite" in llvm_stamp()
