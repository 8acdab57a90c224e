"""Measurements as tables: one description of the columns, shown on a terminal, as Markdown, or as JSON."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from typing import Any

from zeroset.bench.cold import CommandCost
from zeroset.bench.frames import FrameCost, SurfaceCost
from zeroset.bench.gpu import GpuCost, PassesCost
from zeroset.bench.gpu_report import gpu_table, papers_table, passes_table
from zeroset.bench.light import LightCost
from zeroset.bench.machine import Machine
from zeroset.bench.memory import MemoryCost
from zeroset.bench.papers import PaperCost
from zeroset.bench.rerun import RowCost
from zeroset.bench.table import Table

Cost = SurfaceCost | MemoryCost | CommandCost | GpuCost | PassesCost | PaperCost | LightCost


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
        case GpuCost():
            return gpu_table([cost for cost in costs if isinstance(cost, GpuCost)], machine)
        case PassesCost():
            return passes_table([cost for cost in costs if isinstance(cost, PassesCost)], machine)
        case PaperCost():
            return papers_table([cost for cost in costs if isinstance(cost, PaperCost)], machine)
        case LightCost():
            return _light_table([cost for cost in costs if isinstance(cost, LightCost)], machine)
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
    columns = ("surface", "frames", "size", "moving", "growth", "GPU objects", "compilations after the first frame")
    return Table("zeroset bench --memory", columns, tuple(map(_memory_row, costs)), (str(machine),))


def _memory_row(cost: MemoryCost) -> tuple[str, ...]:
    growth = "unknown here" if cost.growth is None else f"{cost.growth:+.2f} MB"
    moved = ", ".join(("camera", *cost.moved))
    objects = "-" if cost.objects is None else f"{cost.objects:+d}"
    return cost.name, str(cost.frames), f"{cost.size}²", moved, growth, objects, str(cost.compilations)


def _light_table(costs: Sequence[LightCost], machine: Machine) -> Table:
    columns = ("surface", "with", "size", "plain", "frame", "× plain", "the papers' own")
    notes = (
        "Milliseconds, medians, one light, pixels fetched; plain and frame take turns. × plain: best by best.",
        "The papers' own: what the same costs in K09 or SN10, where they say it.",
        str(machine),
    )
    return Table("zeroset bench --light", columns, tuple(map(_light_row, costs)), notes)


def _light_row(cost: LightCost) -> tuple[str, ...]:
    if cost.plain is None or cost.frame is None or cost.ratio is None:
        return (f"{cost.name}: {cost.error}", cost.feature, f"{cost.size}²", *[""] * 4)
    goal = "-" if cost.goal is None else f"{cost.goal:.1f}"
    times = f"{cost.plain.median:.2f}", f"{cost.frame.median:.2f}"
    return cost.name, cost.feature, f"{cost.size}²", *times, f"{cost.ratio:.2f}", goal


def _command_table(costs: Sequence[CommandCost], machine: Machine) -> Table:
    columns = ("formula of", "size", "cold", "warm", "python alone", "runs of each")
    note = "Whole process, formula to PNG, medians; cold and warm: disk cache empty, and with the formula in it."
    bytecode = "Python's bytecode is there in both, as where pip installed zeroset."
    return Table("zeroset bench --cold", columns, tuple(map(_command_row, costs)), (note, bytecode, str(machine)))


def _command_row(cost: CommandCost) -> tuple[str, ...]:
    seconds = (f"{value:.3f} s" for value in (cost.cold, cost.warm, cost.python))
    return cost.name, f"{cost.size}²", *seconds, str(cost.runs)


def to_json(costs: Sequence[Cost] | Sequence[RowCost], machine: Machine) -> str:
    """Everything that was measured, machine included, as JSON text."""
    plain = {"machine": dataclasses.asdict(machine), "results": [_plain(cost) for cost in costs]}
    return json.dumps(plain, indent=1) + "\n"


def _plain(cost: Cost | RowCost) -> dict[str, Any]:
    plain = dataclasses.asdict(cost)
    if isinstance(cost, SurfaceCost | GpuCost):
        plain["frames"] = [dataclasses.asdict(frame) | {"ratio": frame.ratio} for frame in cost.frames]
    if isinstance(cost, LightCost):
        plain["ratio"] = cost.ratio
    if isinstance(cost, PaperCost):
        # A table's other rows are said in theirs.
        del plain["reference"]["table"]["rows"], plain["reference"]["table"]["settings"]
    if isinstance(cost, RowCost):
        plain["table"] = {name: plain["table"][name] for name in ("id", "paper", "table", "unit", "hardware")}
        del plain["row"]["figures"]  # They are in the cells.
    return plain
