"""First pictures: what drafts leave out, and which programs are waited for, made in a hurry, or made well."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.bench.meter import Meter
from zeroset.kernel import Kernel
from zeroset.rendering.frame import settle
from zeroset.runtime import Program, get_device


class Noting(Meter):
    """A device that remembers which passes it was asked to make, by the first word of their keys."""

    def __init__(self, name: str) -> None:
        super().__init__(get_device(name))
        self.asked: set[str] = set()
        self.well: set[str] = set()

    def compile_cached(self, key: str, build: Callable[[], Kernel], quick: bool = False) -> Program:
        self.asked.add(key.split()[0])
        if not quick:
            self.well.add(key.split()[0])
        return super().compile_cached(key, build, quick)


def drawn(device: Any, **options: Any) -> zs.Image:
    return zs.render(zs.gallery["tangle"], 96, device=device, **options)


def test_a_draft_leaves_out_what_few_pixels_need() -> None:
    steiner = zs.gallery["steiner"]
    draft, whole = (zs.render(steiner, 256, draft=draft, device="cpu") for draft in (True, False))
    assert whole.hits > draft.hits
    missing = (whole.aov("status") != zs.MISS) & (draft.aov("status") == zs.MISS)
    assert np.all(whole.aov("status")[missing] == zs.UNRESOLVED)


@pytest.mark.parametrize("where", ["cpu", pytest.param("gpu", marks=needs_gpu)])
def test_a_first_draft_does_without_beams_and_shows_the_same(where: str) -> None:
    device = Noting(where)
    first = drawn(device, draft=True)
    assert first.hits > 1000
    assert device.asked == {"first", "shade"}
    settle()
    assert device.asked >= {"beams", "first", "shade"}
    aimed = drawn(device, draft=True)
    # What f32 leaves unresolved hangs on where rays start; what is seen does not.
    assert np.array_equal(first.aov("status") == zs.MISS, aimed.aov("status") == zs.MISS)
    assert np.allclose(first.aov("depth"), aimed.aov("depth"), atol=2e-3)
    # Beams are of use: rays start near what they meet.
    assert aimed.aov("steps").sum() < first.aov("steps").sum()


def test_a_draft_without_beams_is_the_same_whenever_it_is_drawn() -> None:
    device = Noting("cpu")
    interval, coarse = zs.methods.Interval(), 2.0**-4
    options = {"method": interval, "tolerance": coarse, "draft": True, "beams": False}
    first = drawn(device, **options)
    assert first.unresolved > 1000
    aimed = drawn(device, **{**options, "draft": False, "thin": False, "beams": True})
    settle()
    again = drawn(device, **options)
    assert np.array_equal(first.pixels, again.pixels)
    assert np.array_equal(first.aov("t"), again.aov("t"), equal_nan=True)
    assert not np.array_equal(first.aov("t"), aimed.aov("t"), equal_nan=True)


def test_whole_pictures_without_beams_show_the_same() -> None:
    steiner = zs.gallery["steiner"]
    with_, without = (zs.render(steiner, 128, device="cpu", beams=beams) for beams in (True, False))
    assert np.array_equal(with_.aov("status"), without.aov("status"))
    assert with_.unresolved > 50


def test_whole_pictures_and_sums_have_beams() -> None:
    for surface, options in (("torus", {}), ("blinn-blobby", {"draft": True})):
        device = Noting("cpu")
        zs.render(zs.gallery[surface], 64, device=device, **options)  # type: ignore[arg-type]
        assert "beams" in device.asked


@pytest.mark.parametrize(("surface", "well"), [("tangle", False), ("sarti-dodecic", True)])
def test_beams_with_much_to_do_are_made_well_before_they_do_it(surface: str, well: bool) -> None:
    device = Noting("cpu")
    zs.render(zs.gallery[surface], 64, device=device)
    assert ("beams" in device.well) == well
