"""Text in rows and columns, for a terminal or as Markdown."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any


@dataclass(frozen=True, slots=True)
class Table:
    """Text in rows and columns.

    Attributes:
        title: what it shows.
        columns: their heads.
        rows: cells, as many as columns in each.
        notes: lines below it.
        blocks: how many columns belong together, from the left; a terminal that is too narrow for all shows some blocks
            at a time, the first one always. Empty where the table is shown whole.
    """

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()
    blocks: tuple[int, ...] = ()

    def markdown(self) -> str:
        """The table in Markdown; the first column to the left, all others to the right."""
        lines = [f"**{self.title}**", "", _line(self.columns), _line((":--", *["--:"] * (len(self.columns) - 1)))]
        lines += [_line(row) for row in self.rows]
        return "\n".join([*lines, "", *(f"{note}  " for note in self.notes)]).rstrip() + "\n"

    def show(self) -> None:
        """Print the table on the terminal."""
        from rich.console import Console

        console = Console()
        # A pipe has no width of its own; a cut table would help nobody there.
        if not console.is_terminal:
            console.width = 200
        for i, page in enumerate(self._pages(console.width)):
            console.print(self._drawn(page, "" if i else self.title))
        for note in self.notes:
            console.print(note, highlight=False, markup=False)

    def _drawn(self, page: Sequence[int], title: str) -> Any:
        """Some columns, as rich draws them."""
        from rich.table import Table as Drawn

        drawn = Drawn(title=title or None, title_justify="left")
        for i in page:
            drawn.add_column(self.columns[i], justify="right" if i else "left", no_wrap=True)
        for row in self.rows:
            drawn.add_row(*(row[i] for i in page))
        return drawn

    def _pages(self, width: int) -> Iterator[tuple[int, ...]]:
        """Columns that are shown together: whole blocks, as many as fit, and at least one beside the first."""
        if not self.blocks:
            yield tuple(range(len(self.columns)))
            return
        ends = tuple(accumulate(self.blocks))
        first, *blocks = (tuple(range(end - count, end)) for count, end in zip(self.blocks, ends, strict=True))
        page = first
        for block in blocks:
            if page != first and self._width(page + block) > width:
                yield page
                page = first
            page += block
        yield page

    def _width(self, page: Sequence[int]) -> int:
        """Characters across: cells, a space on each side of them, lines between."""
        return 1 + sum(3 + max(len(cells[i]) for cells in (self.columns, *self.rows)) for i in page)


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"
