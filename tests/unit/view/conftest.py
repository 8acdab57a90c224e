from __future__ import annotations

from collections.abc import Callable

import pytest

from zeroset.cli import main


@pytest.fixture
def zeroset_command(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str]]:
    """Runs the command line in this process; gives its status and what it said on stderr."""

    def run(*args: str) -> tuple[int, str]:
        status = main([*args])
        return status, capsys.readouterr().err

    return run
