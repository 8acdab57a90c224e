"""The papers' tables as data: every figure that they print, and with what settings each was made.

One file a table in ``data/``, read from scans; where a figure of one stands in another as well, each keeps its own.
What a setting does not say (a tolerance, steps) the row says. ``papers`` takes references from here, ``rerun`` draws
what the tables have.

SN10: J. M. Singh and P. J. Narayanan, Real-Time Ray Tracing of Implicit Surfaces on the GPU, IEEE TVCG 16(2), 2010.
K09: A. Knoll, Y. Hijazi, A. Kensler, M. Schott, C. Hansen, H. Hagen, Fast Ray Tracing of Arbitrary Implicit Surfaces
with Interval and Affine Arithmetic, Computer Graphics Forum 28(1), 2009.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.resources import files

from zeroset.errors import ZerosetError, did_you_mean

MESHING = "marching-tetrahedra"
"""The method of settings that make triangles instead of drawing."""


@dataclass(frozen=True, slots=True)
class Setting:
    """How one of a table's columns was made.

    Attributes:
        name: the column's head.
        method: ray method, or ``MESHING``; empty where the row says which.
        options: of the method, besides steps.
        steps: of a sampling method: a number, ``"hand"`` for the row's, ``"formula"`` for SN10's formula.
        group: settings of one group are shown together; empty where a table has one group.
        shadows: whether one light throws shadows.
        size: pixels along a side; 0 for the table's.
        cells: of a mesh along the longest side of the bounds.
        epsilon: exponent of the tolerance, a power of 2 in world units; 0 takes the row's, or the default where that
            has none.
        figures: the hardware of each figure that a row has for it, in order.
    """

    name: str
    method: str = ""
    options: Mapping[str, object] = field(default_factory=dict)
    steps: int | str = ""
    group: str = ""
    shadows: bool = False
    size: int = 0
    cells: int = 0
    epsilon: int = 0
    figures: Sequence[str] = ("GPU",)


@dataclass(frozen=True, slots=True)
class Row:
    """One surface in a table.

    Attributes:
        figures: those of the first setting, then of the next; 0 where the paper has none.
        surface: our name of it; empty where the gallery has it not.
        printed: the paper's name, where ours would not do.
        steps: of sampling methods, by hand; 0 where the table has none.
        iterations: the paper's average; 0 where the table has none.
        epsilon: exponent of the tolerance; 0 where the table has none.
        z: how far the camera goes back from the gallery's view.
        method: where settings have none.
    """

    figures: Sequence[float]
    surface: str = ""
    printed: str = ""
    steps: int = 0
    iterations: int = 0
    epsilon: int = 0
    z: float | None = None
    method: str = ""

    @property
    def title(self) -> str:
        """What it is called beside its figures."""
        return self.printed or self.surface


@dataclass(frozen=True, slots=True)
class PrintedTable:
    """One table of a paper.

    Attributes:
        id: what users call it.
        paper: its short name.
        table: the table's.
        about: what it compares.
        unit: ``"fps"``, frames a second, or ``"ms"``, milliseconds a frame.
        size: pixels along a side of the paper's pictures.
        hardware: that the figures were made on, the main one first.
        rows: surfaces, or surfaces in various circumstances.
        settings: columns.
        notes: which settings stand in for the paper's, and what cannot be had.
        surfaces: which of ours stand in for the paper's, and which are missing.
        reference: whether zeroset is held against this table by ``zeroset bench --papers``.
        steps_of: id of the table whose steps its rows take.
    """

    id: str
    paper: str
    table: str
    about: str
    unit: str
    size: int
    hardware: Mapping[str, str]
    rows: tuple[Row, ...]
    settings: tuple[Setting, ...]
    notes: Sequence[str] = ()
    surfaces: str = ""
    reference: bool = False
    steps_of: str = ""

    @property
    def groups(self) -> tuple[str, ...]:
        """Its groups of settings, in order."""
        return tuple(dict.fromkeys(setting.group for setting in self.settings))

    def figures(self, row: Row) -> Iterator[tuple[Setting, Mapping[str, float]]]:
        """Each setting with the row's figures for it, by hardware; what is a dash in the paper is left out."""
        first = 0
        for setting in self.settings:
            after = first + len(setting.figures)
            found = zip(setting.figures, row.figures[first:after], strict=True)
            yield setting, {where: figure for where, figure in found if figure}
            first = after


@lru_cache(maxsize=1)
def printed_tables() -> tuple[PrintedTable, ...]:
    """All tables that are known: SN10's, then K09's.

    Example:
        >>> [table.id for table in printed_tables() if table.paper == "K09"]
        ['k09-1', 'k09-2']
    """
    found = (item.read_text("utf-8") for item in files("zeroset.bench").joinpath("data").iterdir())
    tables = [_table(tomllib.loads(text)) for text in found]
    return tuple(sorted(tables, key=lambda table: (table.paper != "SN10", table.id)))


def _table(data: Mapping[str, object]) -> PrintedTable:
    rows, settings, rest = (
        data["rows"],
        data["settings"],
        {k: v for k, v in data.items() if k not in ("rows", "settings")},
    )
    made = {"rows": tuple(Row(**row) for row in rows), "settings": tuple(Setting(**s) for s in settings)}  # type: ignore[attr-defined]
    return PrintedTable(**rest, **made)  # type: ignore[arg-type]


def find_tables(ids: Sequence[str]) -> tuple[PrintedTable, ...]:
    """Tables by id, in the order asked for, each once; all of them for ``"all"``.

    Raises:
        ZerosetError: there is no table of one of the names; the message has the nearest ones and all that there are.

    Example:
        >>> [table.table for table in find_tables(["sn10-3"])]
        ['Table 3']
    """
    known = {table.id: table for table in printed_tables()}
    for id_ in ids:
        if id_ not in known and id_ != "all":
            hints = (*did_you_mean(id_, known), f"there are {', '.join(known)} and all")
            raise ZerosetError(f"there is no table {id_!r}", hints=hints)
    return tuple(known.values()) if "all" in ids else tuple(known[id_] for id_ in dict.fromkeys(ids))
