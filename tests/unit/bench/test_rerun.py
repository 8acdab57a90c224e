"""Papers' tables measured once more: with the settings that they have, and every kind of table from end to end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NoReturn

import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.bench import rerun
from zeroset.bench.devices import Devices
from zeroset.bench.machine import this_machine
from zeroset.bench.paper_report import ours, paper_report, times_as_fast
from zeroset.bench.printed import PrintedTable, Row, find_tables, printed_tables
from zeroset.bench.rerun import RowCost, hand_steps, measure_row, method_of
from zeroset.bench.timing import Times
from zeroset.errors import ZerosetError
from zeroset.methods import AdaptiveMarchingPoints, Affine, Interval, MarchingPoints

FIND = zs.gallery.__getitem__


def _table(id_: str) -> PrintedTable:
    (table,) = find_tables([id_])
    return table


def _row(table: PrintedTable, surface: str) -> Row:
    return next(row for row in table.rows if surface in (row.surface, row.printed))


def _tiny(table: PrintedTable, rows: Sequence[Row]) -> PrintedTable:
    """A table with pictures of 16 by 16 and meshes of 8 cells."""
    settings = tuple(replace(s, size=16 if s.size else 0, cells=8 if s.cells else 0) for s in table.settings)
    return replace(table, size=16, rows=tuple(rows), settings=settings)


def _measured(table: PrintedTable, devices: Devices) -> list[RowCost]:
    return [cost for row in table.rows for cost in measure_row(table, row, FIND, devices, 0.0)]


@pytest.mark.parametrize("table", printed_tables(), ids=lambda table: table.id)
def test_every_table_from_end_to_end(table: PrintedTable) -> None:
    devices = Devices("cpu", 1)
    # One that the paper has every figure for.
    row = next(row for row in reversed(table.rows) if all(row.figures))
    costs = _measured(_tiny(table, [row]), devices)
    assert [cost.group for cost in costs] == list(table.groups)
    for cost in costs:
        assert [cell.error for cell in (*cost.cells, *cost.auto)] == [""] * (len(cost.cells) + len(cost.auto))
        assert all(cell.wall is not None and cell.wall.best > 0 for cell in (*cost.cells, *cost.auto))
        assert cost.auto
    for shown, cost in zip(paper_report(costs, this_machine(devices.steady)), costs, strict=True):
        (cells,) = shown.rows
        assert len(cells) == len(shown.columns) == sum(shown.blocks)
        assert cells[0] == row.title
        assert "-" not in cells
        for cell in cost.cells:
            assert all(str(figure) in cells for figure in cell.figures.values())


@needs_gpu
def test_a_row_on_a_gpu() -> None:
    table, devices = _table("sn10-3"), Devices("gpu", None)
    assert devices.gpu is not None
    (cost,) = _measured(replace(table, size=16, rows=(_row(table, "goursat"),)), devices)
    for cell in (*cost.cells, *cost.auto):
        assert cell.error == ""
        assert cell.wall is not None
        assert (cell.gpu is None) == (devices.gpu.stream.clock is None)


def _drawn(monkeypatch: pytest.MonkeyPatch, table: PrintedTable, row: Row) -> list[tuple[int, dict[str, Any]]]:
    """Size and options of everything that a row has drawn."""
    asked: list[tuple[int, dict[str, Any]]] = []

    def once(draw: Any, devices: Devices, seconds: float) -> NoReturn:
        asked.append((draw.args[1], draw.keywords))
        raise ZerosetError("not drawn at all")

    monkeypatch.setattr(rerun, "frame_times", once)
    list(measure_row(table, row, FIND, Devices("interp", None), 0.0))
    return asked


def test_a_paper_s_settings_are_what_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    five = _table("sn10-5")
    drawn = _drawn(monkeypatch, five, _row(five, "tooth"))
    plain, shadowed = drawn[:6], drawn[6:]
    assert [size for size, _ in drawn] == [512] * 12
    assert not any(options.get("shadows") for _, options in plain)
    assert all(options["shadows"] and not options["lights"][0].headlight for _, options in shadowed)
    for part in (plain, shadowed):
        assert [options.get("draft", False) for _, options in part] == [True] * 5 + [False]
        methods = [options["method"] for _, options in part[1:5]]
        assert [(m.steps, m.test) for m in methods] == [(32, "sign"), (32, "taylor"), (0, "sign"), (0, "taylor")]
        assert "method" not in part[5][1]


def test_tolerances_and_arithmetic(monkeypatch: pytest.MonkeyPatch) -> None:
    one, two = _table("k09-1"), _table("k09-2")
    *drawn, (size, auto) = _drawn(monkeypatch, one, _row(one, "klein-bottle"))
    assert [(o["method"], o["tolerance"]) for _, o in drawn] == [
        (Interval(axis="k"), 2.0**-11),
        (Interval(), 2.0**-11),
        (Affine(), 2.0**-11),
        (Affine(), 2.0**-12),
    ]
    assert (size, auto.get("tolerance")) == (1024, None)
    *drawn, _ = _drawn(monkeypatch, two, two.rows[1])
    assert {o["tolerance"] for _, o in drawn} == {2.0**-22}
    eight = _table("sn10-8")
    assert all(o.get("tolerance") is None for _, o in _drawn(monkeypatch, eight, eight.rows[0]))


def test_the_camera_goes_back_for_everybody(monkeypatch: pytest.MonkeyPatch) -> None:
    eight = _table("sn10-8")
    near, far = (next(r for r in eight.rows if r.surface == "dervish" and r.z == z) for z in (0, 4))
    assert all("camera" not in options for _, options in _drawn(monkeypatch, eight, near))
    own = zs.gallery["dervish"].camera
    assert own is not None
    cameras = {options["camera"] for _, options in _drawn(monkeypatch, eight, far)}
    (camera,) = cameras
    assert camera.target == own.target
    back = [a - b for a, b in zip(camera.eye, own.eye, strict=True)]
    away = [a - b for a, b in zip(own.eye, own.target, strict=True)]
    assert sum(v * v for v in back) ** 0.5 == pytest.approx(4.0)
    assert sum(a * b for a, b in zip(back, away, strict=True)) == pytest.approx(4.0 * sum(v * v for v in away) ** 0.5)


def test_steps_by_hand() -> None:
    one, two, seven = _table("sn10-1"), _table("sn10-2"), _table("sn10-7")
    assert method_of(one, _row(one, "hunt"), one.settings[1]) == MarchingPoints(steps=400, test="taylor")
    assert method_of(two, _row(two, "hunt"), two.settings[0]) == AdaptiveMarchingPoints(steps=84, test="sign")
    assert method_of(seven, seven.rows[0], seven.settings[2]) == MarchingPoints(steps=64, test="sign")
    # What Table 2 has; the most of the same order; of the next order; of what is no polynomial.
    assert [hand_steps("sn10-2", name) for name in ("ding-dong", "kiss", "sphere", "torus-root")] == [15, 45, 33, 100]


def test_progress_goes_from_setting_to_setting() -> None:
    table, told = _table("sn10-2"), []
    row = _tiny(table, [_row(table, "goursat")]).rows[0]
    list(measure_row(_tiny(table, [row]), row, FIND, Devices("interp", None), 0.0, told.append))
    assert told == [0.0, 0.5]


def test_what_the_gallery_has_not_keeps_its_figures() -> None:
    table = _table("sn10-6")
    devices = Devices("interp", None)
    costs = _measured(replace(table, rows=(_row(table, "Steiner2"),)), devices)
    (shown,) = paper_report(costs, this_machine(devices.steady))
    assert shown.rows == (("Steiner2: not in the gallery", "17.2", "-", "-", "320", "-", "-", "-", "-"),)


def test_a_dash_is_a_dash_and_a_failure_is_told() -> None:
    five, devices = _table("sn10-5"), Devices("cpu", 1)
    machine = this_machine(devices.steady)
    row, interval = _row(five, "blobby"), five.settings[0]
    table = replace(five, size=8, settings=(interval,), rows=(replace(row, figures=(0.0,)),))
    (shown,) = paper_report(_measured(table, devices), machine)
    assert shown.rows[0][:4] == ("blobby", "-", "-", "-")
    assert not any("mitchell-exact" in note for note in shown.notes)
    table = replace(table, rows=(replace(row, figures=(50.0,)),))
    (shown,) = paper_report(_measured(table, devices), machine)
    assert shown.rows[0][:4] == ("blobby", "50.0", "-", "-")
    assert any("blobby, interval: mitchell-exact" in note for note in shown.notes)


def test_what_sampling_gets_wrong_is_told() -> None:
    hunt, devices = _row(_table("sn10-1"), "hunt"), Devices("cpu", 1)
    table = replace(_table("sn10-1"), size=64, rows=(replace(hunt, steps=5),))
    (cost,) = _measured(table, devices)
    few = [cell.other for cell in cost.cells]
    (exact,) = _measured(replace(_table("sn10-3"), size=64, rows=(_row(_table("sn10-3"), "goursat"),)), devices)
    assert all(share is not None and share > 0.02 for share in few)
    assert exact.cells[0].other == pytest.approx(0.0, abs=0.002)
    (shown,) = paper_report([cost], this_machine(devices.steady))
    assert any("(hunt)" in note for note in shown.notes)


def test_iterations_are_counted() -> None:
    table = _table("sn10-4")
    (cost,) = _measured(replace(table, size=16, rows=(_row(table, "goursat"),)), Devices("cpu", 1))
    steps = cost.cells[0].steps
    assert steps is not None
    assert 2 < steps < 100


def test_either_unit() -> None:
    times = Times(20.0, 19.0, 3)
    assert (ours(times, "fps"), ours(times, "ms")) == (50.0, 20.0)
    assert times_as_fast(times, 25.0, "fps") == 2.0
    assert times_as_fast(times, 40.0, "ms") == 2.0
    assert times_as_fast(None, 40.0, "ms") is None
    assert times_as_fast(times, None, "fps") is None
