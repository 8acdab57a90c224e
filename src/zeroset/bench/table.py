"""Text in rows and columns, for a terminal or as Markdown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Table:
    """Text in rows and columns.

    Attributes:
        title: what it shows.
        columns: their heads.
        rows: cells, as many as columns in each.
        notes: lines below it.
    """

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()

    def markdown(self) -> str:
        """The table in Markdown; the first column to the left, all others to the right."""
        lines = [f"**{self.title}**", "", _line(self.columns), _line((":--", *["--:"] * (len(self.columns) - 1)))]
        lines += [_line(row) for row in self.rows]
        return "\n".join([*lines, "", *(f"{note}  " for note in self.notes)]).rstrip() + "\n"

    def show(self) -> None:
        """Print the table on the terminal."""
        from rich.console import Console
        from rich.table import Table as Drawn

        drawn = Drawn(title=self.title, title_justify="left")
        for i, column in enumerate(self.columns):
            drawn.add_column(column, justify="right" if i else "left", no_wrap=True)
        for row in self.rows:
            drawn.add_row(*row)
        console = Console()
        # A pipe has no width of its own; a cut table would help nobody there.
        if not console.is_terminal:
            console.width = 200
        console.print(drawn)
        for note in self.notes:
            console.print(note, highlight=False, markup=False)


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |"
