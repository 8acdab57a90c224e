"""References: the best that each paper has for a surface, and what cannot be drawn beside it."""

from __future__ import annotations

import pytest

import zeroset as zs
from zeroset.bench.devices import Devices
from zeroset.bench.papers import measure_paper, references
from zeroset.errors import ZerosetError


def test_the_best_of_a_row_and_of_a_paper() -> None:
    (ding_dong,) = references(["ding-dong"])
    assert (ding_dong.rate, ding_dong.column) == (965, "interval")
    assert (ding_dong.anywhere, ding_dong.where) == (3750, "Table 3, analytic")
    both = list(references(["klein-bottle"]))
    assert [(r.table.paper, r.rate) for r in both] == [("SN10", 435), ("K09", 110)]
    assert len(list(references())) == 36 + 16


def test_references_are_a_gpu_s_and_without_shadows() -> None:
    found = {(r.table.id, r.name): r for r in references()}
    assert found["k09-1", "sphere"].column == "converged"
    assert found["sn10-5", "peninsula"].column == "AMP Taylor, tuned"
    assert found["sn10-5", "steiner"].anywhere == 1400
    assert all(r.anywhere >= r.rate for r in found.values())


def test_a_surface_without_a_reference_is_named() -> None:
    with pytest.raises(ZerosetError, match="chmutov-30"):
        list(references(["chmutov-30"]))


def test_what_cannot_be_drawn_is_noted() -> None:
    (blobby,) = references(["blobby"])
    cost = measure_paper(blobby, zs.gallery.__getitem__, "analytic", Devices("interp", None), 0.0)
    assert cost.wall is None
    assert "polynomial" in cost.error
