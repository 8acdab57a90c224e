from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.export.film.named import find, names
from zeroset.export.film.path import Moment
from zeroset.export.film.storyboard import storyboard


def scenes(name: str, count: int) -> list[zs.Scene]:
    item = find(name)
    assert item is not None
    return storyboard(item.scene, count, item.vary, orbit=item.orbit)


def test_the_papers_animations_are_there() -> None:
    papers = {"cloth", "water", "sin-blob", "decocube-to-sphere", "twisting-superquadric", "moving-blobs"}
    assert papers <= set(names())
    assert find("nothing-of-the-kind") is None


@pytest.mark.parametrize("name", names())
def test_each_moves_without_a_jump_and_shows_something(name: str) -> None:
    item = find(name)
    assert item is not None
    assert item.title
    assert item.duration > 0
    for path in item.vary.values():
        assert np.allclose(path.at(Moment(0, 12)), path.at(Moment(12, 12))) or getattr(path, "shape", "") == "loop"
    first, second = (zs.render(scene, 32) for scene in scenes(name, 5)[:2])
    assert first.hits > 30
    assert not np.array_equal(first.pixels, second.pixels)


@pytest.mark.parametrize(("name", "variable"), [("cloth", "w"), ("water", "w")])
def test_loops_are_whole_periods(name: str, variable: str) -> None:
    item = find(name)
    assert item is not None
    motion = item.vary[variable]
    ends = [motion.first, motion.second]  # type: ignore[attr-defined]
    shape = item.scene.surface
    one, other = (zs.render(shape.with_params(**{variable: w}), 64, thin=False).aov("t") for w in ends)
    assert np.isfinite(one).sum() > 500
    both = np.isfinite(one) & np.isfinite(other)
    assert (np.isfinite(one) != np.isfinite(other)).sum() <= 2
    assert np.abs(one - other)[both].max() < 0.02


def test_the_morph_has_a_decocube_at_0_and_a_sphere_at_1() -> None:
    item = find("decocube-to-sphere")
    assert item is not None
    morph = item.scene.surface
    rays = np.random.default_rng(1).normal(size=(300, 3))
    for w, shape in ((0.0, zs.gallery["decocube"]), (1.0, zs.surface("x^2 + y^2 + z^2 = 1.3^2", bounds=1.8))):
        morphed, plain = (zs.cast(s, [0, 0, 0], rays) for s in (morph.with_params(w=w), shape.with_bounds(1.8)))
        assert np.array_equal(morphed.status, plain.status)
        assert np.allclose(morphed.t, plain.t, atol=2e-3, equal_nan=True)
    low, high = (item.vary["w"].at(Moment(i, 2)) for i in range(2))
    assert low < 0, "it goes on beyond the decocube"
    assert high > 1, "and beyond the sphere"


@pytest.mark.parametrize("name", ["decocube-to-sphere", "twisting-superquadric", "moving-blobs"])
def test_nothing_of_a_closed_surface_is_cut_off(name: str) -> None:
    for scene in scenes(name, 8):
        assert scene.surface.bounds is not None
        shown = zs.render(scene, 64)
        center, reach = scene.surface.bounds.center, scene.surface.bounds.reach
        roomy = zs.render(scene.surface.with_bounds(zs.Ball(1.05 * reach, center)), 64, camera=scene.camera)
        assert np.array_equal(shown.aov("status") > 0, roomy.aov("status") > 0)


def test_the_blobs_are_data() -> None:
    moved = scenes("moving-blobs", 5)
    assert len({scene.surface.field.digest for scene in moved}) == 1
    assert {len(values) for values in moved[2].surface.arrays.values()} == {30}
    assert not np.allclose(moved[0].surface.arrays["cx"], moved[1].surface.arrays["cx"])
