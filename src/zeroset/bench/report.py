"""Measurements as tables: one description of the columns, shown on a terminal, as Markdown, or as JSON."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from zeroset.bench.cold import CommandCost
from zeroset.bench.frames import FrameCost, SurfaceCost
from zeroset.bench.machine import Machine
from zeroset.bench.memory import MemoryCost

Cost = SurfaceCost | MemoryCost | CommandCost


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


def table(costs: Sequence[Cost], machine: Machine) -> Table:
    """Measurements of one kind as a table.

    Args:
        costs: at least one, all of the same kind.
        machine: where they were made.
    """
    match costs[0]:
        case SurfaceCost():
            return _frames_table([cost for cost in costs if isinstance(cost, SurfaceCost)], machine)
        case MemoryCost():
            return _memory_table([cost for cost in costs if isinstance(cost, MemoryCost)], machine)
        case CommandCost():
            return _command_table([cost for cost in costs if isinstance(cost, CommandCost)], machine)


def _frames_table(costs: Sequence[SurfaceCost], machine: Machine) -> Table:
    sizes = max(([frame.size for frame in cost.frames] for cost in costs), key=len)
    columns = ["surface", "compile", "load"]
    for size in sizes:
        columns += [f"{size}²", "best", "limit", "ratio", "steps", "unres."]
    rows = tuple(_surface_row(cost, len(columns)) for cost in costs)
    notes = (
        "Milliseconds; a frame is the median in steady state, best the fastest. limit: one evaluation of f and of its",
        "gradient a pixel by the same compiler; ratio: frame over limit, best by best. steps: evaluations a ray, beams",
        "aside. compile: tracing and compiling all kernels; load: having them from the disk cache.",
        str(machine),
    )
    return Table("zeroset bench", tuple(columns), rows, notes)


def _surface_row(cost: SurfaceCost, width: int) -> tuple[str, ...]:
    if cost.error:
        return (f"{cost.name}: {cost.error}", *[""] * (width - 1))
    cells = [cost.name, f"{cost.compile:.0f}", "-" if cost.load is None else f"{cost.load:.1f}"]
    for frame in cost.frames:
        cells += _frame_cells(frame)
    return tuple(cells)


def _frame_cells(cost: FrameCost) -> list[str]:
    times = [f"{value:.2f}" for value in (cost.frame.median, cost.frame.best, cost.limit.median)]
    return [*times, f"{cost.ratio:.1f}", f"{cost.steps:.1f}", str(cost.unresolved)]


def _memory_table(costs: Sequence[MemoryCost], machine: Machine) -> Table:
    columns = ("surface", "frames", "size", "moving", "growth", "compilations after the first frame")
    return Table("zeroset bench --memory", columns, tuple(map(_memory_row, costs)), (str(machine),))


def _memory_row(cost: MemoryCost) -> tuple[str, ...]:
    growth = "unknown here" if cost.growth is None else f"{cost.growth:+.2f} MB"
    moved = ", ".join(("camera", *cost.moved))
    return cost.name, str(cost.frames), f"{cost.size}²", moved, growth, str(cost.compilations)


def _command_table(costs: Sequence[CommandCost], machine: Machine) -> Table:
    columns = ("formula of", "size", "cold", "warm", "python alone", "runs of each")
    note = "Whole process, formula to PNG, medians; cold and warm: disk cache empty, and with the formula in it."
    return Table("zeroset bench --cold", columns, tuple(map(_command_row, costs)), (note, str(machine)))


def _command_row(cost: CommandCost) -> tuple[str, ...]:
    seconds = (f"{value:.3f} s" for value in (cost.cold, cost.warm, cost.python))
    return cost.name, f"{cost.size}²", *seconds, str(cost.runs)


def to_json(costs: Sequence[Cost], machine: Machine) -> str:
    """Everything that was measured, machine included, as JSON text."""
    plain = {"machine": dataclasses.asdict(machine), "results": [_plain(cost) for cost in costs]}
    return json.dumps(plain, indent=1) + "\n"


def _plain(cost: Cost) -> dict[str, Any]:
    plain = dataclasses.asdict(cost)
    if isinstance(cost, SurfaceCost):
        plain["frames"] = [dataclasses.asdict(frame) | {"ratio": frame.ratio} for frame in cost.frames]
    return plain
