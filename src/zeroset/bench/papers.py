"""Frame rates that papers print for surfaces of the gallery, to be held against our own."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files

from zeroset.bench.devices import Devices
from zeroset.bench.frames import frame_cost
from zeroset.bench.gpu import gpu_frame
from zeroset.bench.timing import Times
from zeroset.errors import ZerosetError
from zeroset.scene.surface import Surface


@dataclass(frozen=True, slots=True)
class PaperTable:
    """One table of a paper.

    Attributes:
        paper: its short name.
        table: the table's.
        reference: whether zeroset is held against this table; others only tell of better rates in the same paper.
        size: pixels along a side of the paper's pictures.
        hardware: that the paper's figures were made on.
        columns: what each rate was made with.
        note: what stands in for what.
        rates: frames a second by our name of the surface, one for each column; 0 where the paper has none.
    """

    paper: str
    table: str
    reference: bool
    size: int
    hardware: str
    columns: tuple[str, ...]
    note: str
    rates: Mapping[str, Sequence[float]]


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
    table: PaperTable
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


@lru_cache(maxsize=1)
def paper_tables() -> tuple[PaperTable, ...]:
    """All tables that are known.

    Example:
        >>> [t.table for t in paper_tables() if t.paper == "K09"]
        ['Table 1']
    """
    text = files("zeroset.bench").joinpath("papers.toml").read_text("utf-8")
    return tuple(PaperTable(**{**t, "columns": tuple(t["columns"])}) for t in tomllib.loads(text)["tables"])


def references(names: Sequence[str] = ()) -> Iterator[Reference]:
    """The references for surfaces, in the papers' order; for all that a paper has when no name is given.

    Raises:
        ZerosetError: no reference table has one of the names.
    """
    known = [table for table in paper_tables() if table.reference]
    for name in names:
        if not any(name in table.rates for table in known):
            raise ZerosetError(
                f"no paper has a frame rate for {name!r}", hint="zeroset bench --papers without names has them all"
            )
    for table in known:
        for name, rates in table.rates.items():
            if not names or name in names:
                rate, column = _best(table, rates)
                yield Reference(name, table, rate, column, *_anywhere(name, table))


def _best(table: PaperTable, rates: Sequence[float]) -> tuple[float, str]:
    """The best rate of a row and its column; the first of equals."""
    rate = max(rates)
    return rate, table.columns[list(rates).index(rate)]


def _anywhere(name: str, reference: PaperTable) -> tuple[float, str]:
    found = []
    for table in paper_tables():
        if table.paper == reference.paper and table.size == reference.size and name in table.rates:
            rate, column = _best(table, table.rates[name])
            found.append((rate, f"{table.table}, {column}"))
    return max(found, key=lambda item: item[0])


def measure_paper(
    reference: Reference, find: Callable[[str], Surface], method: str, devices: Devices, seconds: float
) -> PaperCost:
    """Draw a reference's surface at the paper's size; an error is noted, not raised.

    Args:
        reference: what is drawn.
        find: gives a surface of the gallery.
        method: ray method.
        devices: where to run.
        seconds: how long frames are repeated.
    """
    surface, size = find(reference.name), reference.table.size
    try:
        if devices.gpu is None:
            return PaperCost(reference, frame_cost(surface, size, method, devices.steady, seconds).frame)
        cost = gpu_frame(surface, size, method, devices.gpu, seconds)
    except ZerosetError as error:
        return PaperCost(reference, error=str(error).splitlines()[0])
    return PaperCost(reference, cost.wall, cost.gpu)
