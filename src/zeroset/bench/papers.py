"""The best that papers have for each surface, to be held against our frame rates."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from zeroset.bench.devices import Devices
from zeroset.bench.printed import PrintedTable, Row, printed_tables
from zeroset.bench.steady import frame_times
from zeroset.bench.timing import Times
from zeroset.errors import ZerosetError
from zeroset.rendering.render import render
from zeroset.scene.solid import Solid
from zeroset.scene.surface import Surface

HARDWARE = "GPU"
"""Whose figures references are."""


@dataclass(frozen=True, slots=True)
class Reference:
    """The best that one paper has for one surface.

    Attributes:
        name: of the surface, in the gallery.
        table: that zeroset is held against.
        rate: frames a second, the best of the table's row.
        column: of that rate.
        anywhere: the best of the paper's other tables as well, for pictures of the same size.
        where: table and column of that rate.
    """

    name: str
    table: PrintedTable
    rate: float
    column: str
    anywhere: float
    where: str


@dataclass(frozen=True, slots=True)
class PaperCost:
    """A surface drawn as large as a paper did.

    Attributes:
        reference: what the paper has.
        wall: milliseconds a frame; on a GPU with frames in flight.
        gpu: milliseconds a frame on the GPU itself; None where no GPU tells it.
        error: why the surface could not be drawn, or an empty string.
    """

    reference: Reference
    wall: Times | None = None
    gpu: Times | None = None
    error: str = ""


def references(names: Sequence[str] = ()) -> Iterator[Reference]:
    """The references for surfaces, in the papers' order; for all that a paper has when no name is given.

    Raises:
        ZerosetError: no reference table has one of the names.
    """
    rows = [(table, row) for table in printed_tables() if table.reference for row in table.rows if row.surface]
    for name in names:
        if all(name != row.surface for _, row in rows):
            raise ZerosetError(
                f"no paper has a frame rate for {name!r}", hint="zeroset bench --papers without names has them all"
            )
    for table, row in rows:
        if not names or row.surface in names:
            yield Reference(row.surface, table, *_best(table, row), *_anywhere(row.surface, table))


def _best(table: PrintedTable, row: Row) -> tuple[float, str]:
    """The best rate of a row without shadows, and its column; the first of equals."""
    found = [(rates.get(HARDWARE, 0.0), s.name) for s, rates in table.figures(row) if not s.shadows]
    return max(found, key=lambda item: item[0])


def _anywhere(name: str, reference: PrintedTable) -> tuple[float, str]:
    found = []
    for table in printed_tables():
        if (table.paper, table.size, table.unit) == (reference.paper, reference.size, "fps"):
            for row in table.rows:
                if row.surface == name:
                    rate, column = _best(table, row)
                    found.append((rate, f"{table.table}, {column}"))
    return max(found, key=lambda item: item[0])


def measure_paper(
    reference: Reference, find: Callable[[str], Surface | Solid], method: str, devices: Devices, seconds: float
) -> PaperCost:
    """Draw a reference's surface at the paper's size; an error is noted, not raised.

    Args:
        reference: what is drawn.
        find: gives a surface of the gallery.
        method: ray method.
        devices: where to run.
        seconds: how long frames are repeated.
    """
    draw = partial(render, find(reference.name), reference.table.size, method=method, device=devices.steady)
    try:
        return PaperCost(reference, *frame_times(draw, devices, seconds))
    except ZerosetError as error:
        return PaperCost(reference, error=str(error).splitlines()[0])
