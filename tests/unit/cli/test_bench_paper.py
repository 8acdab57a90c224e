"""``zeroset bench paper``: lists, measures, and says what is wrong; never how fast anything was."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from zeroset.bench import printed, rerun
from zeroset.bench.printed import PrintedTable, find_tables, printed_tables

Run = Callable[..., Any]
TINY = ("--seconds", "0", "--threads", "1", "--device", "cpu", "--markdown")


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """The tables with two rows each and pictures of 16 by 16."""

    def tiny(table: PrintedTable) -> PrintedTable:
        settings = tuple(replace(s, size=16 if s.size else 0, cells=8 if s.cells else 0) for s in table.settings)
        return replace(table, size=16, rows=table.rows[-2:], settings=settings)

    def found(ids: tuple[str, ...]) -> tuple[PrintedTable, ...]:
        return tuple(map(tiny, find_tables(ids)))

    monkeypatch.setattr(printed, "find_tables", found)


def _rows(out: str) -> list[list[str]]:
    lines = [line for line in out.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_without_a_table_all_are_listed(zeroset: Run) -> None:
    ran = zeroset("bench", "paper")
    assert (ran.status, ran.err) == (0, "")
    assert [line.split()[0] for line in ran.out.splitlines()] == [table.id for table in printed_tables()]


@pytest.mark.usefixtures("small")
def test_two_tables_and_their_figures(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("bench", "paper", "sn10-3", "sn10-7", *TINY, "--json", "x.json")
    assert (ran.status, ran.err) == (0, "")
    assert "SN10, Table 3" in ran.out
    assert "the paper's figures: Nvidia 8800 GTX" in ran.out
    head, _, *rows = _rows(ran.out)[:4]
    assert head == ["surface", "analytic", "ours", "×", "auto", "×"]
    assert [row[:2] for row in rows] == [["cayley", "3300"], ["ding-dong", "3750"]]

    results = json.loads((tmp_path / "x.json").read_text())["results"]
    assert [(r["table"]["id"], r["row"]["surface"]) for r in results] == [
        ("sn10-3", "cayley"),
        ("sn10-3", "ding-dong"),
        ("sn10-7", "chmutov-8"),
        ("sn10-7", "chmutov-9"),
    ]
    for row, result in zip(rows, results, strict=False):
        (cell,) = result["cells"]
        assert float(row[2]) == pytest.approx(1e3 / cell["wall"]["median"], rel=1e-2)
        assert float(row[3]) == pytest.approx(1e3 / cell["wall"]["median"] / cell["figures"]["GPU"], rel=1e-2)
        assert float(row[4]) == pytest.approx(1e3 / result["auto"][0]["wall"]["median"], rel=1e-2)


@pytest.mark.usefixtures("small")
def test_the_word_may_stand_behind_options(zeroset: Run) -> None:
    ran = zeroset("bench", *TINY, "paper", "sn10-3")
    assert ran.status == 0
    assert "SN10, Table 3" in ran.out


@pytest.mark.usefixtures("small")
def test_for_people(zeroset: Run) -> None:
    ran = zeroset("bench", "paper", "sn10-3", *TINY[:-1])
    assert ran.status == 0
    assert "ding-dong" in ran.out
    assert "3750" in ran.out


@pytest.mark.usefixtures("small")
def test_interruption_prints_what_is_done(zeroset: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    measured = rerun.measure_row

    def interrupted(table: PrintedTable, row: Any, *rest: Any) -> Any:
        if row.surface == "ding-dong":
            raise KeyboardInterrupt
        return measured(table, row, *rest)

    monkeypatch.setattr(rerun, "measure_row", interrupted)
    ran = zeroset("bench", "paper", "sn10-3", "sn10-7", *TINY, "--json", "x.json")
    assert ran.status == 130
    assert [row[0] for row in _rows(ran.out)[2:]] == ["cayley"]
    assert not (tmp_path / "x.json").exists()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["paper", "sn10-9"], "did you mean sn10-8"),
        (["paper", "sn10-1", "table-5"], "there are sn10-1, "),
        (["paper", "sn10-1", "--device", "no-such-device"], "no-such-device"),
        (["paper", "sn10-1", "--json", "no-such-folder/x.json"], "no-such-folder"),
        (["paper", "sn10-1", "--size", "64"], "--size"),
        (["--method", "affine", "paper", "sn10-1"], "--method"),
    ],
)
def test_mistakes_are_named_before_anything_is_timed(arguments: list[str], said: str, zeroset: Run) -> None:
    ran = zeroset("bench", *arguments)
    assert ran.status == 2
    assert said in ran.err
    assert ran.out == ""


def test_it_has_its_own_help(zeroset: Run) -> None:
    ran = zeroset("bench", "paper", "--help")
    assert ran.status == 0
    assert "zeroset bench paper" in ran.out
    assert "bench paper" in zeroset("bench", "--help").out
