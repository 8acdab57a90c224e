"""A paper's table once more, on this machine: each row's surface with each column's settings, and as a user gets it.

The papers' methods run as the papers run them: one search a ray in single precision, no second look and no thin parts.
``auto`` is the picture that ``zs.render`` makes when nothing is asked for, as large as the paper's and from the same
place.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from statistics import median
from typing import Any

from zeroset.bench.agreement import APART, Depth, other_pixels
from zeroset.bench.devices import Devices
from zeroset.bench.light import SUN
from zeroset.bench.printed import MESHING, PrintedTable, Row, Setting, find_tables
from zeroset.bench.steady import frame_times
from zeroset.bench.timing import Times
from zeroset.errors import ZerosetError
from zeroset.export.marching.timing import time_extraction
from zeroset.rendering.image import Image
from zeroset.rendering.render import render
from zeroset.scene.camera import Camera, parse_camera
from zeroset.scene.several import plain_surface
from zeroset.scene.solid import Solid
from zeroset.scene.surface import Surface
from zeroset.solve.method import METHODS, Method
from zeroset.surfaces import entry

UNKNOWN = "the gallery has no such surface"

Find = Callable[[str], Surface | Solid]


@dataclass(frozen=True, slots=True)
class Cell:
    """What one setting took for one row.

    Attributes:
        setting: the column; ``"auto"`` for the default method.
        size: pixels along a side; 0 for a mesh.
        figures: the paper's, by hardware; none where it has none.
        wall: milliseconds; None where it could not be done.
        gpu: milliseconds by the GPU's own clock; None without one.
        steps: evaluations a ray, the mean over those that were searched; None where nothing was drawn.
        other: the share of pixels where the default method shows something else; None where nothing was drawn.
        error: why it could not be done, or an empty string.
    """

    setting: str
    size: int
    figures: Mapping[str, float] = field(default_factory=dict)
    wall: Times | None = None
    gpu: Times | None = None
    steps: float | None = None
    other: float | None = None
    error: str = ""


@dataclass(frozen=True, slots=True)
class RowCost:
    """One row of a group of a table.

    Attributes:
        table: the paper's.
        group: of its settings.
        row: what was drawn.
        cells: one for each of the group's settings.
        auto: the default method, one for each size among the settings; none where the gallery has no such surface.
    """

    table: PrintedTable
    group: str
    row: Row
    cells: tuple[Cell, ...] = ()
    auto: tuple[Cell, ...] = ()


def measure_row(
    table: PrintedTable,
    row: Row,
    find: Find,
    devices: Devices,
    seconds: float,
    progress: Callable[[float], None] = lambda _: None,
) -> Iterator[RowCost]:
    """Measure one row of a paper's table, a group of settings at a time.

    Args:
        table: the paper's.
        row: one of its rows.
        find: gives a surface of the gallery.
        devices: where to run.
        seconds: how long each of its frames is repeated.
        progress: told the share of the row that is done.
    """
    again = _Again(table, row, find(row.surface), devices, seconds) if row.surface else None
    done = iter(range(len(table.settings)))
    for group in table.groups:
        found = [(setting, figures) for setting, figures in table.figures(row) if setting.group == group]
        if again is None:
            yield RowCost(table, group, row, tuple(Cell(s.name, 0, figures, error=UNKNOWN) for s, figures in found))
            continue
        cells = []
        for setting, figures in found:
            progress(next(done) / len(table.settings))
            cells.append(again.cell(setting, figures))
        drawn = dict.fromkeys((again.size(s), s.shadows) for s, _ in found if s.method != MESHING)
        yield RowCost(table, group, row, tuple(cells), tuple(again.auto(*each) for each in drawn))


class _Again:
    """One row's surface, drawn with any setting."""

    def __init__(self, table: PrintedTable, row: Row, drawn: Surface | Solid, devices: Devices, seconds: float) -> None:
        self._table = table
        self._row = row
        self._surface = drawn
        self._devices = devices
        self._seconds = seconds
        self._default: dict[int, Depth] = {}

    def size(self, setting: Setting) -> int:
        """Pixels along a side; none of a mesh."""
        return 0 if setting.method == MESHING else setting.size or self._table.size

    def cell(self, setting: Setting, figures: Mapping[str, float]) -> Cell:
        """One setting; an error is noted, not raised."""
        made = Cell(setting.name, self.size(setting), figures)
        try:
            return replace(made, wall=self._mesh(setting)) if not made.size else self._frame(setting, made)
        except ZerosetError as error:
            return replace(made, error=str(error).splitlines()[0])

    def auto(self, size: int, shadows: bool) -> Cell:
        """The default method; an error is noted, not raised."""
        try:
            wall, gpu = self._times(self._draw(size, shadows))
        except ZerosetError as error:
            return Cell("auto", size, error=str(error).splitlines()[0])
        return Cell("auto", size, wall=wall, gpu=gpu)

    def _mesh(self, setting: Setting) -> Times:
        options: Mapping[str, Any] = setting.options
        taken = time_extraction(plain_surface(self._surface, "a mesh"), setting.cells, self._devices.steady, **options)
        return Times(median(taken), min(taken), len(taken))

    def _frame(self, setting: Setting, cell: Cell) -> Cell:
        exponent = setting.epsilon or self._row.epsilon
        draw = self._draw(
            cell.size,
            setting.shadows,
            method=method_of(self._table, self._row, setting),
            tolerance=2.0**exponent if exponent else None,
            draft=True,
        )
        wall, gpu = self._times(draw)
        image = draw()
        depth, steps = image.aov("depth"), image.aov("steps")
        searched = steps[steps > 0]
        return replace(
            cell,
            wall=wall,
            gpu=gpu,
            steps=float(searched.mean()) if searched.size else 0.0,
            other=other_pixels(depth, self._expected(cell.size), APART * self._surface.fitted.extent),
        )

    def _expected(self, size: int) -> Depth:
        """Where the default method finds the surface, one ray a pixel."""
        if size not in self._default:
            self._default[size] = self._draw(size, False, thin=False)().aov("depth")
        return self._default[size]

    def _draw(self, size: int, shadows: bool, **options: Any) -> Callable[[], Image]:
        """A picture from the row's place, in the light that shadows need."""
        place: dict[str, Any] = {"lights": SUN, "shadows": True} if shadows else {}
        if self._row.z:
            place["camera"] = farther(parse_camera(self._surface.camera, self._surface.fitted), self._row.z)
        return partial(render, self._surface, size, device=self._devices.steady, **place, **options)

    def _times(self, draw: Callable[[], Image]) -> tuple[Times, Times | None]:
        return frame_times(draw, self._devices, self._seconds)


def farther(camera: Camera, distance: float) -> Camera:
    """A camera gone back from its target by some world length.

    Example:
        >>> farther(Camera(eye=(0.0, -5.0, 0.0)), 4.0).eye
        (0.0, -9.0, 0.0)
    """
    scale = 1.0 + distance / math.dist(camera.eye, camera.target)
    x, y, z = (to + (e - to) * scale for e, to in zip(camera.eye, camera.target, strict=True))
    return replace(camera, eye=(x, y, z))


def method_of(table: PrintedTable, row: Row, setting: Setting) -> Method:
    """The ray method of one setting for one row, with its options.

    Example:
        >>> (table,) = find_tables(["sn10-2"])
        >>> method_of(table, table.rows[0], table.settings[1])
        AdaptiveMarchingPoints(offset=0.0, steps=100, test='taylor', tau1=0.1, tau2=1.0, epsilon=0.1, silhouettes=True)
    """
    options = dict(setting.options)
    if setting.steps == "hand":
        options["steps"] = row.steps or hand_steps(table.steps_of, row.surface)
    elif setting.steps and setting.steps != "formula":
        options["steps"] = setting.steps
    return METHODS[setting.method or row.method](**options)  # type: ignore[arg-type]


def hand_steps(id_: str, name: str) -> int:
    """The steps that a table has for a surface, by hand.

    Where it has none: the most that it has for a surface of the same order, or of the next one that it has. What is no
    polynomial counts as an order of its own.

    Example:
        >>> hand_steps("sn10-2", "goursat"), hand_steps("sn10-2", "tooth")
        (24, 32)
    """
    (table,) = find_tables([id_])
    known = {row.surface: row.steps for row in table.rows}
    if name in known:
        return known[name]
    order = entry(name).degree
    by_order: dict[int, int] = {}
    for other, steps in known.items():
        degree = entry(other).degree
        by_order[degree] = max(steps, by_order.get(degree, 0))
    return by_order[min(degree for degree in by_order if degree >= order)]
