from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from zeroset.cli import main


@dataclass(frozen=True)
class Ran:
    """What a command said, and its exit status."""

    status: int
    out: str
    err: str


@pytest.fixture
def zeroset(capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Ran]:
    """Runs the command line in this process and in an empty folder; nothing may be left half written there."""
    monkeypatch.chdir(tmp_path)

    def run(*args: str) -> Ran:
        status = main([*args])
        out, err = capsys.readouterr()
        assert "Traceback" not in out + err
        assert [path.name for path in tmp_path.rglob("*") if path.name.endswith(".part")] == []
        return Ran(status, out, err)

    return run
