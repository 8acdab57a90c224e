"""The papers' tables: whole, of surfaces and methods that there are, and read alike wherever a paper repeats them."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

import zeroset as zs
from zeroset.bench.printed import MESHING, PrintedTable, find_tables, printed_tables
from zeroset.bench.rerun import method_of
from zeroset.errors import ZerosetError
from zeroset.rendering.drawn import as_drawn
from zeroset.surfaces import entry, solids

ROWS = {"sn10-1": 29, "sn10-2": 29, "sn10-3": 11, "sn10-4": 17, "sn10-5": 36, "sn10-6": 9, "sn10-7": 6, "sn10-8": 16}
ROWS |= {"k09-1": 16, "k09-2": 4}
"""How many lines each table has on paper; Table 8 has one for each of four distances."""
MISSING = {"Steiner2", "Absolute Value"}
every_table = pytest.mark.parametrize("table", printed_tables(), ids=lambda table: table.id)


def _figures(id_: str) -> Mapping[str, Mapping[str, float]]:
    """By surface, then by setting; of a setting with several figures the first one."""
    (table,) = find_tables([id_])
    return {
        row.surface: {s.name: next(iter(found.values())) for s, found in table.figures(row) if found and not s.shadows}
        for row in table.rows
    }


def test_all_tables_have_all_their_rows() -> None:
    assert {table.id: len(table.rows) for table in printed_tables()} == ROWS


@every_table
def test_rows_are_whole(table: PrintedTable) -> None:
    assert table.unit in ("fps", "ms")
    assert table.size in (128, 512, 1024)
    expected = sum(len(setting.figures) for setting in table.settings)
    for row in table.rows:
        assert len(row.figures) == expected, row
        assert max(row.figures) > 0
        assert (
            (row.surface in zs.gallery or row.surface in zs.gallery.solids) if row.surface else (row.printed in MISSING)
        )
    assert {where for setting in table.settings for where in setting.figures} == set(table.hardware)


@every_table
def test_every_setting_has_a_method_that_there_is(table: PrintedTable) -> None:
    for setting in table.settings:
        assert (setting.cells > 0) == (setting.method == MESHING)
        for row in table.rows:
            if row.surface and setting.method != MESHING:
                method = method_of(table, row, setting)
                assert method.name == (setting.method or row.method)
                assert bool(setting.steps) == hasattr(method, "steps")


@every_table
def test_what_a_paper_has_a_figure_for_can_be_done(table: PrintedTable) -> None:
    for row in table.rows:
        for setting, figures in table.figures(row):
            if row.surface and figures and setting.method != MESHING:
                as_drawn(zs.gallery.find(row.surface)).check(method_of(table, row, setting))


@every_table
def test_each_surface_is_one_of_the_paper_or_said_to_be_another_s(table: PrintedTable) -> None:
    for row in table.rows:
        solid = solids().get(row.surface)
        item = entry(row.surface) if solid is None and row.surface else solid
        if item is not None and table.paper not in {source.paper for source in item.source}:
            assert "K09's" in table.surfaces, row


def test_what_a_paper_repeats_is_read_alike() -> None:
    five, two, three, four = (_figures(f"sn10-{n}") for n in (5, 2, 3, 4))
    pairs = [
        (five[name][f"AMP {test}, tuned"], two[name][test])
        for name in five.keys() & two.keys()
        for test in ("sign", "Taylor")
    ]
    assert all(abs(a - b) <= 0.25 * b for a, b in pairs)
    assert sum(a == b for a, b in pairs) > 0.75 * len(pairs)
    assert all(three[name]["analytic"] > max(five[name].values()) for name in three if name in five)
    assert all(four[name]["interval"] == five[name]["interval"] for name in four if name in five)


def test_table_8_begins_with_table_5_s_frame_rates() -> None:
    (eight,) = find_tables(["sn10-8"])
    five = _figures("sn10-5")
    compared = 0
    for row in eight.rows:
        if row.z == 0 and row.surface in five:
            rates = {setting.name: 1e3 / found["GPU"] for setting, found in eight.figures(row)}
            assert rates["AMP"] == pytest.approx(five[row.surface]["AMP sign, tuned"], rel=0.05)
            assert rates["interval"] == pytest.approx(five[row.surface]["interval"], rel=0.01)
            compared += 1
    assert compared == 3


def test_k09_s_tables_agree() -> None:
    one, (two,) = _figures("k09-1"), find_tables(["k09-2"])
    for row in two.rows:
        if row.epsilon == -11:
            found = {setting.name: figures for setting, figures in two.figures(row)}
            assert found["t"]["GPU"] == one[row.surface]["IA"]
            assert found["K"]["CPU"] == pytest.approx(one[row.surface]["IA, K"], rel=0.03)


def test_tables_are_found_by_id() -> None:
    assert [table.id for table in find_tables(["k09-1", "sn10-7", "k09-1"])] == ["k09-1", "sn10-7"]
    assert find_tables(["sn10-1", "all"]) == printed_tables()
    with pytest.raises(ZerosetError, match="there is no table 'sn10-9'") as caught:
        find_tables(["sn10-1", "sn10-9"])
    assert "sn10-8" in caught.value.hints[0]
    assert all(table.id in caught.value.hints[1] for table in printed_tables())
