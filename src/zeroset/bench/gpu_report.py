"""What was measured on a GPU as tables: frames, their passes, and our frame rates beside those of papers."""

from __future__ import annotations

from collections.abc import Sequence

from zeroset.bench.gpu import FIRST, GpuCost, PassesCost
from zeroset.bench.machine import Machine
from zeroset.bench.papers import HARDWARE, PaperCost
from zeroset.bench.printed import printed_tables
from zeroset.bench.table import Table
from zeroset.bench.timing import Times

ORDER = ("beams", "primary", "second", "parts", "count", "shade")
"""Passes as a frame runs them; ``count`` comes between the others."""


def gpu_table(costs: Sequence[GpuCost], machine: Machine) -> Table:
    """Frames on a GPU."""
    sizes = max(([frame.size for frame in cost.frames] for cost in costs), key=len)
    columns = ["surface", "made", "first", "whole", "again"]
    for size in sizes:
        columns += [f"{size}² GPU", "in flight", "host", "limit", "ratio", "steps", "unres."]
    rows = tuple(_gpu_row(cost, len(columns)) for cost in costs)
    notes = (
        "Milliseconds. made: making all shaders, tracing included; first: from asking for a new formula's first",
        f"picture ({FIRST}², a draft) to its pixels, no cache of ours or the driver's; whole: to the whole one; again:",
        "first with our cache warm. GPU: a frame from its first pass to its last by the GPU's own clock, median; in",
        "flight: wall time a frame, many sent off, only the last",
        "waited for; host: what of that asking for a frame takes. limit: one evaluation of f and of its gradient a",
        "pixel, by the GPU's clock; ratio: GPU over limit, best by best. steps: evaluations a ray, beams aside;",
        "unres.: pixels left unresolved.",
        str(machine),
    )
    return Table("zeroset bench --device gpu", tuple(columns), rows, notes)


def _gpu_row(cost: GpuCost, width: int) -> tuple[str, ...]:
    if cost.error:
        return (f"{cost.name}: {cost.error}", *[""] * (width - 1))
    cells = [cost.name, f"{cost.made:.0f}", f"{cost.first:.0f}", f"{cost.whole:.0f}", f"{cost.again:.0f}"]
    for frame in cost.frames:
        cells += [_median(frame.gpu), f"{frame.wall.median:.2f}", f"{frame.host.median:.2f}", _median(frame.limit)]
        ratio = "-" if frame.ratio is None else f"{frame.ratio:.1f}"
        cells += [ratio, f"{frame.steps:.1f}", str(frame.unresolved)]
    return tuple(cells)


def _median(times: Times | None) -> str:
    return "-" if times is None else f"{times.median:.3f}"


def passes_table(costs: Sequence[PassesCost], machine: Machine) -> Table:
    """Each frame's passes."""
    seen = {name for cost in costs if cost.frame is not None for name, _ in cost.frame.passes}
    names = [name for name in ORDER if name in seen] + sorted(seen - set(ORDER))
    rows = tuple(_passes_row(cost, names) for cost in costs)
    notes = (
        "Milliseconds by the GPU's own clock, medians. A pass that runs several times has a figure for each; count:",
        "those that only set how many lanes the next one has, together. between: what of a frame is in no pass.",
        str(machine),
    )
    return Table("zeroset bench --passes", ("surface", "size", *names, "between", "frame"), rows, notes)


def _passes_row(cost: PassesCost, names: Sequence[str]) -> tuple[str, ...]:
    frame = cost.frame
    if frame is None:
        return (f"{cost.name}: {cost.error}", *[""] * (len(names) + 3))
    cells = []
    for wanted in names:
        spent = [time for label, time in frame.passes if label == wanted]
        shown = [sum(spent)] if wanted == "count" else spent
        cells.append(" + ".join(f"{time:.3f}" for time in shown) or "-")
    return cost.name, f"{frame.size}²", *cells, f"{frame.between:.3f}", _median(frame.gpu)


def papers_table(costs: Sequence[PaperCost], machine: Machine) -> Table:
    """Our frame rates beside those of papers."""
    columns = ("surface", "size", "reference", "best there", "in flight", "×", "GPU", "×", "best in the paper", "GPU ×")
    used = [table for table in printed_tables() if any(cost.reference.table is table for cost in costs)]
    notes = (
        "Frames a second. best there: the table's best and how it was made; in flight: ours by wall time, many frames",
        "sent off and only the last waited for (on the CPU: one after the other); GPU: ours by the GPU's own clock, as",
        "if nothing else took time. ×: ours over the paper's. best in the paper: over all its tables of this size,",
        "closed forms included.",
        *(
            f"{table.paper}, {table.table}: {table.size}², {table.hardware[HARDWARE]}. {table.surfaces}"
            for table in used
        ),
        str(machine),
    )
    return Table("zeroset bench --papers", columns, tuple(map(_papers_row, costs)), notes)


def _papers_row(cost: PaperCost) -> tuple[str, ...]:
    reference = cost.reference
    where = f"{reference.table.paper}, {reference.table.table}"
    if cost.error:
        return (f"{reference.name}: {cost.error}", f"{reference.table.size}²", where, *[""] * 7)
    wall, gpu = _rate(cost.wall), _rate(cost.gpu)
    return (
        reference.name,
        f"{reference.table.size}²",
        where,
        f"{reference.rate:g} ({reference.column})",
        *_beside(wall, reference.rate),
        *_beside(gpu, reference.rate),
        f"{reference.anywhere:g} ({reference.where})",
        _beside(gpu, reference.anywhere)[1],
    )


def _rate(times: Times | None) -> float | None:
    """Frames a second, at the median."""
    return None if times is None else 1e3 / times.median


def _beside(rate: float | None, other: float) -> tuple[str, str]:
    return ("-", "-") if rate is None else (f"{rate:.4g}", f"{rate / other:.3g}")
