"""The command line that is timed is the one that a user types."""

from __future__ import annotations

from pathlib import Path

import pytest

from zeroset.bench.cold import command_line, measure_command
from zeroset.errors import ZerosetError
from zeroset.surfaces import entry


def test_formula_parameters_and_bounds_are_given() -> None:
    line = command_line(entry("tangle"), 64, Path("out.png"))
    assert line[line.index("render") :] == [
        *("render", "-o", "out.png", "-s", "64", "-p", "r=5.0", "-b", "3.55", "--"),
        entry("tangle").formula,
    ]
    assert "-1.006,-1.006,-1.006,1.006,1.006,1.006" in command_line(entry("chmutov-14"), 64, Path("out.png"))
    blobby = command_line(entry("blinn-blobby-30"), 64, Path("out.png"))
    assert sum(item.startswith(("cx=", "cy=", "cz=", "r=")) for item in blobby) == 4


def test_the_command_is_run_cold_and_warm() -> None:
    shares: list[float] = []
    cost = measure_command("goursat", 16, 1, (), 1, shares.append)
    assert (cost.name, cost.size, cost.runs) == ("goursat", 16, 1)
    assert 0 < cost.python < cost.warm
    assert len(shares) == 3


def test_a_failing_command_is_no_time() -> None:
    with pytest.raises(ZerosetError, match="no-such-method"):
        measure_command("goursat", 16, 1, ("-m", "no-such-method"), None, lambda share: None)
