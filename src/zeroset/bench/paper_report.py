"""Papers' tables with our figures beside theirs: one table for each group of a paper's columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from zeroset.bench.agreement import APART
from zeroset.bench.machine import Machine
from zeroset.bench.printed import MESHING, PrintedTable, Row, Setting
from zeroset.bench.rerun import RowCost
from zeroset.bench.table import Table
from zeroset.bench.timing import Times

ARITHMETIC = {"interval": "IA", "affine": "RAA"}
"""K09's names of methods."""


def paper_report(costs: Sequence[RowCost], machine: Machine) -> tuple[Table, ...]:
    """Tables in the papers' order, a paper's own split into its groups of columns.

    Args:
        costs: rows, those of one table together.
        machine: where they were measured.
    """
    made = []
    for _, of_table in groupby(costs, lambda cost: cost.table.id):
        rows = list(of_table)
        table = rows[0].table
        groups = [group for group in table.groups if any(cost.group == group for cost in rows)]
        for group in groups:
            mine = [cost for cost in rows if cost.group == group]
            made.append(_group_table(table, group, mine, machine if group == groups[-1] else None))
    return tuple(made)


def _group_table(table: PrintedTable, group: str, costs: Sequence[RowCost], machine: Machine | None) -> Table:
    """One group; notes stand below the last one, which is given the machine."""
    settings = [setting for setting in table.settings if setting.group == group]
    sizes = dict.fromkeys(setting.size or table.size for setting in settings if setting.method != MESHING)
    counted = any(cost.row.iterations for cost in costs)
    blocks = [["surface", *(head for head, _ in _circumstances(table, costs[0].row))]]
    blocks += [_heads(setting, counted) for setting in settings]
    blocks += [[f"auto {size}²" if len(sizes) > 1 else "auto", "×"] for size in sizes]
    columns = tuple(head for block in blocks for head in block)
    title = (
        f"zeroset bench paper {table.id}: {table.paper}, {table.table}, {table.about}{f', {group}' if group else ''}"
    )
    return Table(
        f"{title} (the paper's figures: {_hardware(table)})",
        columns,
        tuple(_row(cost, settings, len(columns)) for cost in costs),
        _notes(table, costs, machine) if machine is not None else (),
        tuple(map(len, blocks)),
    )


def _hardware(table: PrintedTable) -> str:
    """What the paper's figures were made on, by the names that columns have for it where there are several."""
    named = [f"{name}, {text}" for name, text in table.hardware.items()]
    return "; ".join(named if len(named) > 1 else table.hardware.values())


def _circumstances(table: PrintedTable, row: Row) -> Iterator[tuple[str, str]]:
    """Heads and cells of what a row says besides its figures."""
    if row.z is not None:
        yield "z", f"{row.z:g}"
    if any(not setting.method for setting in table.settings):
        yield "by", ARITHMETIC[row.method]
    if row.epsilon:
        yield "ε", f"2^{row.epsilon}"
    if row.steps:
        yield "steps", str(row.steps)
    if row.iterations:
        yield "iterations", str(row.iterations)


def _heads(setting: Setting, counted: bool) -> list[str]:
    """Those of one setting; ``counted`` where the paper has iterations, which ours stand beside."""
    heads = ["ours"] if counted else []
    if not setting.figures:
        return [*heads, setting.name]
    if len(setting.figures) == 1:
        return [*heads, setting.name, "ours", "×"]
    first, *others = setting.figures
    return [*heads, f"{setting.name}, {first}", *others, "ours", *(f"× {where}" for where in setting.figures)]


def _row(cost: RowCost, settings: Sequence[Setting], width: int) -> tuple[str, ...]:
    unit = cost.table.unit
    cells = [cost.row.title, *(cell for _, cell in _circumstances(cost.table, cost.row))]
    if not cost.row.surface:
        cells[0] += ": not in the gallery"
    for setting, cell in zip(settings, cost.cells, strict=True):
        printed = [cell.figures.get(where) for where in setting.figures]
        counted = [_number(cell.steps)] if cost.row.iterations else []
        ratios = [_number(times_as_fast(cell.wall, figure, unit)) for figure in printed]
        cells += [*counted, *map(_as_printed, printed), _number(ours(cell.wall, unit)), *ratios]
    for cell in cost.auto:
        best = _best([figure for c in cost.cells if c.size == cell.size for figure in c.figures.values()], unit)
        cells += [_number(ours(cell.wall, unit)), _number(times_as_fast(cell.wall, best, unit))]
    return tuple(cells + ["-"] * (width - len(cells)))


def _best(figures: Sequence[float], unit: str) -> float | None:
    if not figures:
        return None
    return max(figures) if unit == "fps" else min(figures)


def ours(times: Times | None, unit: str) -> float | None:
    """Our median in a paper's unit."""
    if times is None:
        return None
    return 1e3 / times.median if unit == "fps" else times.median


def times_as_fast(times: Times | None, figure: float | None, unit: str) -> float | None:
    """How many times as fast as a paper's figure, in either unit."""
    mine = ours(times, unit)
    if mine is None or figure is None:
        return None
    return mine / figure if unit == "fps" else figure / mine


def _as_printed(figure: float | None) -> str:
    return "-" if figure is None else str(figure)


def _number(value: float | None) -> str:
    """Three digits, or whole where there are more."""
    if value is None:
        return "-"
    return f"{value:.0f}" if value >= 99.95 else f"{value:.3g}"


def _notes(table: PrintedTable, costs: Sequence[RowCost], machine: Machine) -> tuple[str, ...]:
    sizes = sorted({setting.size or table.size for setting in table.settings if setting.method != MESHING})
    pictures = " and ".join(f"{size}²" for size in sizes)
    flight = ", many frames sent off and only the last waited for" if machine.gpu else ""
    return (
        f"{'Frames a second' if table.unit == 'fps' else 'Milliseconds'}, pictures of {pictures}.",
        f"ours: medians by wall time{flight}; ×: how many times as fast as the paper's figure.",
        "auto: the default, certified method as a user gets it; × over the row's best figure for that size.",
        "Views, near and far planes are not printed: ours are the gallery's views and bounds.",
        "The papers' methods run as the papers run them: one search a ray in single precision.",
        *table.notes,
        *((table.surfaces,) if table.surfaces else ()),
        *_disagreements(costs),
        *_failures(costs),
        str(machine),
    )


def _disagreements(costs: Sequence[RowCost]) -> Iterator[str]:
    """How much of the pictures is not what the default method shows, one line for all settings that draw."""
    said = []
    for name in dict.fromkeys(cell.setting for cost in costs for cell in cost.cells):
        found = [
            (cell.other, cost.row.title)
            for cost in costs
            for cell in cost.cells
            if cell.setting == name and cell.other is not None
        ]
        if found:
            worst, where = max(found)
            mean = sum(share for share, _ in found) / len(found)
            said.append(f"{name} {100 * mean:.2g} %, at most {100 * worst:.2g} % ({where})")
    if said:
        yield (
            "Pixels where auto shows something else (surface or none, or surface "
            f"{100 * APART:g} % of the bounds' extent away), the mean over rows: {'; '.join(said)}."
        )


def _failures(costs: Sequence[RowCost]) -> list[str]:
    """What could not be done though the paper could; where it has a dash, one of ours says enough."""
    return [
        f"{cost.row.title}, {cell.setting}: {cell.error}."
        for cost in costs
        for cell in (*cost.cells, *cost.auto)
        if cost.row.surface and cell.error and (cell.figures or cell in cost.auto)
    ]
