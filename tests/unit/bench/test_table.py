"""Tables on a terminal: shown whole where they fit, in blocks of columns where not."""

from __future__ import annotations

import re

import pytest

from zeroset.bench.table import Table

TABLE = Table("title", ("surface", "a", "a2", "b", "b2", "c"), (("x", "1", "2", "3", "4", "5"),), (), (1, 2, 2, 1))


@pytest.mark.parametrize(
    ("width", "pages"),
    [
        (80, [("surface", "a", "a2", "b", "b2", "c")]),
        (32, [("surface", "a", "a2", "b", "b2"), ("surface", "c")]),
        (20, [("surface", "a", "a2"), ("surface", "b", "b2"), ("surface", "c")]),
        (1, [("surface", "a", "a2"), ("surface", "b", "b2"), ("surface", "c")]),
    ],
)
def test_blocks_stay_together(
    width: int, pages: list[tuple[str, ...]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("NO_COLOR", "1")
    TABLE.show()
    heads = [line for line in capsys.readouterr().out.splitlines() if "┃" in line]
    shown = [tuple(cell.strip() for cell in line.split("┃")[1:-1]) for line in heads]
    if width > 10:
        assert [tuple(_plain(cell) for cell in line) for line in shown] == pages
    else:
        assert len(shown) == len(pages)


def _plain(cell: str) -> str:
    """Without the terminal's escapes for bold."""
    return re.sub("\\x1b\\[[0-9;]*m", "", cell).strip()


def test_a_table_without_blocks_is_one_page(capsys: pytest.CaptureFixture[str]) -> None:
    Table("title", ("a", "b"), (("1", "2"),)).show()
    assert sum("┃" in line for line in capsys.readouterr().out.splitlines()) == 1
