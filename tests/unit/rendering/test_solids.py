"""Solids against closed forms: where a ray goes in and out, of which part, with which normal, and what is drawn."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.errors import MethodError
from zeroset.rendering.drawn import as_drawn

DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]
ENCLOSING = ["auto", "affine", "interval"]
A = zs.surface("x^2 + y^2 + z^2 = 1", name="a")
B = zs.surface("(x - c)^2 + y^2 + z^2 = 1", {"c": 1.0}, name="b")
FLOOR, CEILING = zs.surface("-z - h", {"h": 0.5}), zs.surface("z - h", {"h": 0.5})
SOLIDS = {
    "both": (A & B, lambda a, b: a & b),
    "either": (A | B, lambda a, b: a | b),
    "without": (A - B, lambda a, b: a & ~b),
    "all but": (~A & B, lambda a, b: ~a & b),
    "one of them": ((A - B) | (B - A), lambda a, b: a ^ b),
    "neither": ((~(A | B)).with_bounds(3.0), lambda a, b: ~(a | b)),
}
ENDS = {0: (-1.0, 1.0), 1: (0.0, 2.0)}
"""Where a line through the middle goes into each ball and out again, in x; moved in by how far off it passes."""


def skin_along(name: str, off: float) -> list[tuple[float, int, float]]:
    """x, part and sign of the outward normal's x of all that a line along x at a distance meets."""
    inside = SOLIDS[name][1]
    half = np.sqrt(1 - off * off)
    ends = sorted((center + s * half, part) for part, center in ((0, 0.0), (1, 1.0)) for s in (-1, 1))

    def within(x: float) -> bool:
        return bool(inside(np.bool_(abs(x) < half), np.bool_(abs(x - 1) < half)))

    made = []
    for x, part in ends:
        before, after = within(x - 1e-9), within(x + 1e-9)
        if before != after:
            made.append((x, part, -1.0 if after else 1.0))
    return made


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("method", ENCLOSING)
@pytest.mark.parametrize("name", SOLIDS)
def test_two_balls(name: str, method: str, device: str) -> None:
    solid = SOLIDS[name][0]
    offs = np.array([0.0, 0.11, 0.35, 0.62, 0.8])
    origins = np.stack([np.full(5, -5.0), offs, np.zeros(5)], axis=1)
    hits = zs.cast(solid, origins, [1, 0, 0], max_hits=5, method=method, device=device)
    for i, off in enumerate(offs):
        expected = skin_along(name, float(np.float32(off)))
        count = len(expected)
        assert hits.status[i].tolist() == [zs.HIT] * count + [zs.MISS] * (5 - count)
        assert np.abs(hits.t[i, :count] - 5.0 - [x for x, _, _ in expected]).max() < 1e-3
        assert hits.part[i, :count].tolist() == [part for _, part, _ in expected]
        assert np.sign(hits.normal[i, :count, 0]).tolist() == [sign for _, _, sign in expected]


def test_a_slab_of_two_half_spaces() -> None:
    slab = (FLOOR & CEILING).with_bounds(zs.Box((-1, -1, -1), (1, 1, 1)))
    hits = zs.cast(slab, [0.2, 0.1, 5], [[0, 0, -1], [0.1, 0, -1], [1, 0, 0]], max_hits=3, device="cpu")
    assert hits.status.tolist() == [[1, 1, 0], [1, 1, 0], [0, 0, 0]]
    assert hits.part[0].tolist() == [1, 0, 0]
    assert np.allclose(hits.t[0, :2], [4.5, 5.5], atol=1e-3)
    assert np.allclose(hits.normal[0, :2], [[0, 0, 1], [0, 0, -1]], atol=1e-4)


def test_inside_an_empty_or_full_solid_there_is_nothing() -> None:
    for solid in ((A - A).with_bounds(2), (A | ~A).with_bounds(2)):
        hits = zs.cast(solid, [-5, 0.1, 0.2], [1, 0, 0], device="cpu")
        # Where a surface meets itself neither sign can be excluded nor proven: an honest answer, and never a hit.
        assert hits.status[0] != zs.HIT
    apart = zs.surface("(x - 5)^2 + y^2 + z^2 = 1")
    assert zs.cast((A & apart).with_bounds(7), [-9, 0.1, 0.2], [1, 0, 0], device="cpu").status.tolist() == [zs.MISS]


@pytest.mark.parametrize("device", DEVICES)
def test_front_is_outside_and_each_part_has_its_material(device: str) -> None:
    red, green = zs.Material(front=(1, 0, 0), back=(0, 0, 1)), zs.Material(front=(0, 1, 0), back=(0, 0, 1))
    bite = A.with_material(red) - B.with_material(green)
    camera = zs.Camera(eye=(6, -3, 1), target=(0, 0, 0), fov=25)
    image = zs.render(bite, 96, camera=camera, device=device)
    part, hit = image.aov("part"), image.aov("status") != zs.MISS
    assert set(np.unique(part[hit])) == {0, 1}
    red_pixels, green_pixels = (image.pixels[hit & (part == k)].astype(int) for k in (0, 1))
    assert np.all(red_pixels[:, 0] > red_pixels[:, 1:].max(axis=1))
    # The bite is the inner side of the second ball, and yet the outside of the solid.
    assert np.all(green_pixels[:, 1] > green_pixels[:, 0])
    assert np.all(green_pixels[:, 1] > green_pixels[:, 2])


def test_fitted_bounds_hold_what_is_left() -> None:
    assert 0.86 < (A & B).fitted.reach < 1.0
    assert 1.5 < (A | B).fitted.reach < 1.75
    infinite = zs.surface("y")
    half = (A & infinite).fitted
    assert 1.0 <= half.reach < 1.2


def test_the_ends_of_a_picture_agree_with_its_rays() -> None:
    solid = (A | B) - zs.surface("x^2 + z^2 = 0.1")
    image = zs.render(solid, 80, device="cpu")
    without = zs.render(solid, 80, device="cpu", thin=False)
    assert image.unresolved <= 12
    assert image.hits - without.hits == image.unresolved - without.unresolved


def test_other_parameters_compile_nothing_and_move_the_part() -> None:
    moved = (A - B).with_params(c=1.5)
    assert as_drawn(moved).shape.digest == as_drawn(A - B).shape.digest
    hits = zs.cast(moved, [-5, 0, 0], [[1, 0, 0]], max_hits=3, device="cpu")
    assert np.allclose(hits.t[0, :2], [4.0, 5.5], atol=1e-3)


def test_light_goes_through_solids() -> None:
    glass = zs.Material(front=(0.2, 0.2, 0.2), opacity=0.0, ior=1.0)
    lens = A.with_material(glass) & B.with_material(glass)
    clear = zs.render(zs.Scene(lens, background=(0.2, 0.6, 0.9)), 48, device="cpu")
    # A lens that bends and keeps nothing shows just what is behind it.
    assert np.abs(clear.pixels.astype(int) - clear.pixels[0, 0]).max() <= 2
    assert clear.hits > 300


@pytest.mark.parametrize("method", ["mitchell", "analytic", "adaptive-marching-points"])
def test_methods_that_cannot_say_which_can(method: str) -> None:
    with pytest.raises(MethodError, match="solids") as caught:
        zs.render(A - B, 16, method=method)
    assert "'auto'" in str(caught.value.hints)


def test_thin_parts_of_solids_and_isovalues_are_drawn() -> None:
    # A line without any thickness: no ray meets it, and its pixels show it all the same.
    line = zs.surface("(x - 0.01)^2 + y^2", name="line")
    camera = zs.Camera(eye=(0, -6, 0), target=(0, 0, 0), fov=40)
    for thing, parts in (
        ((A | line).with_bounds(2.0), {1}),
        (zs.surface(line.formula, bounds=2.0).with_isovalues((0.0, 5.0)), {0}),
    ):
        image = zs.render(thing, 65, camera=camera, device="cpu")
        thin = image.aov("status") == zs.UNRESOLVED
        rows = np.flatnonzero(thin.any(axis=1))
        assert len(rows) >= 20
        assert set(np.unique(image.aov("part")[thin])) == parts
        columns = np.flatnonzero(thin.any(axis=0))
        assert columns.max() - columns.min() <= 1
        assert not zs.render(thing, 65, camera=camera, device="cpu", thin=False).unresolved


SHARED = {
    "a box less a box along four faces": ("max(|x|, |y|, |z|) = 0.8", "max(|x|, |y|, |z - 0.4|) = 0.8"),
    "the same along curved ones": ("max(x^2 + y^2, |z|) = 0.8", "max(x^2 + y^2, |z - 0.4|) = 0.8"),
}


@pytest.mark.parametrize("name", SHARED)
def test_faces_that_are_taken_off_with_what_has_them_too(name: str) -> None:
    """A part and what is taken off it share faces: nothing is left of these in a picture."""
    whole, off = (zs.surface(formula) for formula in SHARED[name])
    low = zs.surface("|z + 0.6| = 0.2")
    camera = zs.Camera(eye=(2.2, -4, 1.8))
    for thin in (False, True):
        left, same = (
            zs.render(solid.with_bounds(1.5), 200, camera, device="cpu", thin=thin).aov("status")
            for solid in (whole - off, whole & low)
        )
        assert np.count_nonzero(same) > 5000
        # A rim that was taken off may be left as a thin part, for nothing tells it from one.
        assert np.count_nonzero(left != same) <= (100 if thin else 0)


def test_nothing_is_left_of_what_is_taken_off_itself() -> None:
    ball, again = zs.surface("x^2 + y^2 + z^2 = 1"), zs.surface("x^2 + y^2 + z^2 = r^2", params={"r": 1.0})
    image = zs.render((ball - again).with_bounds(1.5), 100, device="cpu")
    # Rays that graze it may meet one of the two by what is rounded.
    assert image.hits == image.unresolved < 60
    # For rays of a caller's own it stays what it is: nothing that could be proven.
    hits = zs.cast((ball - again).with_bounds(1.5), [0.1, 0.2, -5], [0, 0, 1], device="cpu")
    assert hits.status.tolist() == [zs.UNRESOLVED]


def test_a_surface_may_be_both_in_a_solid_and_taken_off_it() -> None:
    ball, box = zs.surface("x^2 + y^2 + z^2 = 1"), zs.surface("max(|x|, |y|, |z|) = 0.8")

    def image(solid: Any) -> zs.Image:
        return zs.render(solid.with_bounds(1.6), 100, device="cpu")

    left, wanted = image((ball | box) - ball), image(box - ball)
    # What grazes the ball may be rounding.
    assert left.unresolved < 100
    assert abs(left.hits - wanted.hits) <= left.unresolved
    for nothing in (ball - ball, ball & ~ball, (box & ball) - ball):
        assert image(nothing).hits < 20


def test_parts_side_by_side_have_no_wall_between_them() -> None:
    left, right = (zs.surface(f"max(|x {sign} 1|, |y|, |z|) = 1") for sign in "+-")
    one = zs.surface("max(|x|/2, |y|, |z|) = 1")
    block = zs.surface("max(|x|/3, |y|/1.5, |z|/1.5) = 1")
    glass = zs.Material(opacity=0.3)
    for joined, same in ((left | right, one), (block - left - right, block - one)):
        pictures = [
            np.asarray(zs.render(solid.with_bounds(3.5), 120, material=glass, device="cpu")).astype(int)
            for solid in (joined, same)
        ]
        assert np.count_nonzero(abs(pictures[0] - pictures[1]).max(axis=-1) > 8) <= 3


def test_a_thin_solid_that_is_no_more_than_a_face_is_drawn() -> None:
    """Two closed halves that touch have a plane in common, and that is all of them."""
    plane = (zs.surface("x") & zs.surface("-x")).with_bounds(1.0)
    image = zs.render(plane, 60, zs.Camera(eye=(4, 1, 1)), device="cpu")
    assert image.hits > 300
