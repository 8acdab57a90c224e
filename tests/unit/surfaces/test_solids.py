"""The gallery's solids: K09's two CSG objects."""

from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.errors import UnknownSurfaceError
from zeroset.scene.solid import Solid
from zeroset.surfaces import solids


def directions(solid: Solid, size: int) -> np.ndarray:
    """The direction of every pixel's ray through the solid's own camera."""
    _, _, _, forward, right, up = (np.asarray(v) for v in (solid.camera or zs.Camera()).rays(size, size))
    u = (np.arange(size) + 0.5) * 2 / size - 1
    return np.asarray(forward + u[None, :, None] * right - u[:, None, None] * up)


@pytest.mark.parametrize("name", ["icos-csg", "sesc-csg"])
def test_each_is_drawn_with_all_its_parts(name: str) -> None:
    solid = zs.gallery.solids[name]
    image = zs.render(solid, 72, device="cpu")
    met = image.aov("part")[image.aov("status") != zs.MISS]
    assert set(np.unique(met)) == set(range(len(solid.surfaces)))
    assert image.unresolved < 10
    # Nothing of a closed solid is cut open by its bounds: no back is seen.
    hit = image.aov("status") == zs.HIT
    assert np.all((image.aov("normal") * directions(solid, 72)).sum(-1)[hit] < 0.01)
    assert all(source.paper == "K09" and "10" in source.figures for source in solids()[name].source)


def test_sesc_is_the_paper_s_condition() -> None:
    """((sc > 0) and (0 in se)) or ((se < 0) and (0 in sc)), at points that rays have met."""
    solid = zs.gallery.solids["sesc-csg"]
    image = zs.render(solid, 48, device="cpu", thin=False)
    points = np.asarray((solid.camera or zs.Camera()).eye) + image.aov("t")[..., None] * directions(solid, 48)
    hit = image.aov("status") == zs.HIT
    x, y, z = points[hit].T
    se = x**6 + (y**4 + z**4) ** 4 / 2 - 20
    sc = (
        x * y + np.cos(z) + 1.741 * np.sin(2 * x) * np.sin(z) * np.cos(y) + np.sin(2 * y) * np.sin(x) * np.cos(z)
        + np.sin(2 * z) * np.sin(y) * np.cos(x) - np.cos(2 * x) * np.cos(2 * y) + np.cos(2 * y) * np.cos(2 * z)
        + np.cos(2 * z) * np.cos(2 * x) + 0.05
    )  # fmt: skip
    part = image.aov("part")[hit]
    assert np.all(sc[part == 0] > -0.01)
    assert np.all(np.abs(se[part == 0]) < 0.5)
    assert np.all(se[part == 1] < 0.5)
    assert np.all(np.abs(sc[part == 1]) < 0.01)


def test_a_name_that_is_none() -> None:
    with pytest.raises(UnknownSurfaceError, match="no solid 'icos'"):
        zs.gallery.solids["icos"]
    with pytest.raises(UnknownSurfaceError, match="is a solid") as caught:
        zs.gallery["icos-csg"]
    assert "zs.gallery.solids" in str(caught.value.hints)
