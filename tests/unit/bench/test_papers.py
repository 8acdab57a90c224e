"""The papers' figures: whole, of surfaces that there are, and read the same way wherever a paper repeats them."""

from __future__ import annotations

import pytest

import zeroset as zs
from zeroset.bench.devices import Devices
from zeroset.bench.papers import PaperTable, measure_paper, paper_tables, references
from zeroset.errors import ZerosetError
from zeroset.surfaces import entry


def _table(paper: str, table: str) -> PaperTable:
    (found,) = (t for t in paper_tables() if (t.paper, t.table) == (paper, table))
    return found


@pytest.mark.parametrize("table", paper_tables(), ids=lambda t: f"{t.paper} {t.table}")
def test_rows_are_whole_and_of_gallery_surfaces(table: PaperTable) -> None:
    assert table.size in (512, 1024)
    for name, rates in table.rates.items():
        assert name in zs.gallery
        assert len(rates) == len(table.columns)
        assert max(rates) > 0


def test_the_reference_tables_have_all_their_rows() -> None:
    # Printed: 30 algebraic and 6 other surfaces; 16, of which two are constructive solids.
    assert len(_table("SN10", "Table 5").rates) == 30 + 6
    assert len(_table("K09", "Table 1").rates) == 16 - 2


def test_each_surface_is_one_of_the_paper_that_has_a_rate_for_it() -> None:
    for table in paper_tables():
        for name in table.rates:
            assert table.paper in {source.paper for source in entry(name).source}, name


def test_what_a_paper_repeats_is_read_alike() -> None:
    five, two, three = (_table("SN10", f"Table {n}").rates for n in (5, 2, 3))
    pairs = [(five[name][1:3], two[name]) for name in five.keys() & two.keys()]
    same = sum(a == b for row, other in pairs for a, b in zip(row, other, strict=True))
    near = sum(abs(a - b) <= 0.25 * b for row, other in pairs for a, b in zip(row, other, strict=True))
    assert near == 2 * len(pairs)
    assert same > 0.75 * 2 * len(pairs)
    assert all(three[name][0] > max(five[name]) for name in three if name in five)


def test_the_best_of_a_row_and_of_a_paper() -> None:
    (ding_dong,) = references(["ding-dong"])
    assert (ding_dong.rate, ding_dong.column) == (965, "interval")
    assert (ding_dong.anywhere, ding_dong.where) == (3750, "Table 3, analytic")
    both = list(references(["klein-bottle"]))
    assert [(r.table.paper, r.rate) for r in both] == [("SN10", 435), ("K09", 110)]
    assert len(list(references())) == 36 + 14


def test_a_surface_without_a_reference_is_named() -> None:
    with pytest.raises(ZerosetError, match="chmutov-30"):
        list(references(["chmutov-30"]))


def test_what_cannot_be_drawn_is_noted() -> None:
    (blobby,) = references(["blobby"])
    cost = measure_paper(blobby, zs.gallery.__getitem__, "analytic", Devices("interp", None), 0.0)
    assert cost.wall is None
    assert "polynomial" in cost.error
