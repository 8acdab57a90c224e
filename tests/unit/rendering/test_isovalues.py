"""Several isovalues in one traversal, held to spheres: where each is met, which one it is, its colour, its shadow."""

from __future__ import annotations

from unittest.mock import patch

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.errors import MethodError
from zeroset.rendering.drawn import as_drawn
from zeroset.rendering.frame import settle
from zeroset.rendering.tracer import Tracer
from zeroset.runtime import get_device
from zeroset.solve import resolve_method

VALUES = 0.25, 1.0, 2.25
"""Squares of the shells' radii."""
SHELLS = zs.surface("x^2 + y^2 + z^2", bounds=2.0).with_isovalues(VALUES)
DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]
TOLERANCE = 4.0 * 2.0**-14


def chords(device: str, method: str = "auto") -> tuple[zs.Hits, np.ndarray, np.ndarray]:
    """Hits of rays past the middle, the t of each shell that they should meet, and which shell it is."""
    distance = np.linspace(-1.9, 1.9, 41) + 0.003
    origins = np.stack([distance, np.full(41, -5.0), np.zeros(41)], axis=1)
    hits = zs.cast(SHELLS, origins, [0, 1, 0], max_hits=7, method=method, device=device)
    t, part = np.full((41, 7), np.nan), np.zeros((41, 7), int)
    for i, d in enumerate(np.float32(distance).astype(float)):
        met = [(5 + s * np.sqrt(v - d * d), k) for k, v in enumerate(VALUES) if v > d * d for s in (-1, 1)]
        for j, (place, k) in enumerate(sorted(met)):
            t[i, j], part[i, j] = place, k
    return hits, t, part


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("method", ["auto", "affine", "interval"])
def test_every_shell_is_met_in_order_and_told_apart(device: str, method: str) -> None:
    hits, t, part = chords(device, method)
    expected = ~np.isnan(t)
    assert np.array_equal(hits.status == zs.HIT, expected)
    assert np.abs(hits.t - t)[expected].max() < TOLERANCE
    assert np.array_equal(hits.part[expected], part[expected])
    # All normals are towards growing f, out of the middle, whichever side the ray comes from.
    assert np.all((hits.normal[..., 1] * (t - 5.0))[expected] > 0)


def test_one_isovalue_is_the_surface_with_that_much_taken_off() -> None:
    tangle = zs.gallery["tangle"]
    shifted = zs.surface(
        "x^4 - 5x^2 + y^4 - 5y^2 + z^4 - 5z^2 + 11.8 - 2.5", bounds=tangle.bounds, camera=tangle.camera
    )
    images = [zs.render(s, 96, device="cpu") for s in (tangle.with_isovalues(2.5), shifted)]
    statuses, depths = zip(*((image.aov("status"), image.aov("depth")) for image in images), strict=True)
    both = (statuses[0] == zs.HIT) & (statuses[1] == zs.HIT)
    assert np.count_nonzero(both) > 2000
    # Rounding may decide a grazing ray either way.
    assert np.count_nonzero(statuses[0] != statuses[1]) <= 3
    assert np.abs(depths[0][both] - depths[1][both]).max() < 0.01


@pytest.mark.parametrize("device", DEVICES)
def test_each_isovalue_has_its_colour(device: str) -> None:
    # Cut open by the bounds: the inner shells are seen through the hole.
    box = zs.Box((-2, 0, -2), (2, 2, 2))
    colors = (0, 0, 1), (0, 1, 0), (1, 0, 0)
    shells = zs.surface(SHELLS.formula, bounds=box).with_isovalues(VALUES, colors)
    camera = zs.Camera(eye=(0, -9, 0), target=(0, 0, 0), fov=30)
    image = zs.render(shells, 96, camera=camera, device=device)
    part, hit = image.aov("part"), image.aov("status") != zs.MISS
    assert set(np.unique(part[hit])) == {0, 1, 2}
    # Red, green and blue are channels 0, 1 and 2; the highlight is white.
    for k, channel in ((0, 2), (1, 1), (2, 0)):
        pixels = image.pixels[hit & (part == k)].astype(int)
        others = [c for c in range(3) if c != channel]
        assert np.all(pixels[:, channel] > pixels[:, others].max(axis=1))


def test_other_values_of_as_many_compile_nothing() -> None:
    device = get_device("cpu")
    # What the first frame leaves to be made later is made by the second.
    for _ in range(2):
        zs.render(SHELLS, 32, device=device)
        settle()
    with patch.object(type(device), "compile_cached", side_effect=AssertionError("compiled")):
        image = zs.render(SHELLS.with_isovalues((0.1, 0.2, 0.3)), 32, device=device)
    assert 0 < image.hits < zs.render(SHELLS, 32, device=device).hits


def test_a_close_pair_is_two_hits_and_one_at_a_double_root_stays_open() -> None:
    pair = zs.surface("x^2 + y^2 + z^2", bounds=2.0).with_isovalues((1.0, 1.004))
    hits = zs.cast(pair, [0, -5, 0], [[0, 1, 0]], max_hits=5, device="cpu")
    assert hits.status.tolist() == [[1, 1, 1, 1, 0]]
    assert hits.part.tolist() == [[1, 0, 0, 1, 0]]
    # A ray that touches the inner shell: never a proof, and never passed by.
    touch = zs.surface("x^2 + y^2 + z^2", bounds=2.0).with_isovalues((1.0, 2.0))
    hits = zs.cast(touch, [1, -5, 0], [[0, 1, 0]], max_hits=4, device="cpu")
    assert hits.status.tolist() == [[1, 2, 1, 0]]
    assert hits.part.tolist()[0][:3] == [1, 0, 1]


def test_opaque_and_clear_materials_take_the_isovalues_colours() -> None:
    clear = SHELLS.with_material(zs.Material(opacity=0.5))
    through = zs.render(clear, 64, background=(0, 0, 0), device="cpu")
    solid = zs.render(SHELLS, 64, background=(0, 0, 0), device="cpu")
    middle = through.pixels[28:36, 28:36].reshape(-1, 3).astype(int)
    # The middle shell is blue and the outer one yellow: both are in what is seen.
    assert solid.aov("part")[32, 32] == 2
    assert middle[:, 2].mean() > solid.pixels[28:36, 28:36, 2].mean() + 10


@pytest.mark.parametrize("method", ["mitchell", "analytic", "marching-points"])
def test_methods_that_cannot_say_which_can(method: str) -> None:
    with pytest.raises(MethodError, match="isovalues") as caught:
        zs.cast(SHELLS, [0, -5, 0], [[0, 1, 0]], method=method, device="cpu")
    assert "'auto'" in str(caught.value.hints)


def test_kernels_of_a_plain_surface_know_nothing_of_parts() -> None:
    plain = SHELLS.with_isovalues(None)
    tracer = Tracer(plain, resolve_method("auto"), get_device("interp"), pixels=True)
    for name in ("first", "beams", "parts", "second"):
        kernel = tracer.kernel(name)
        assert not {b.name for b in kernel.buffers} & {"part", "materials"}
        assert not any("isovalue" in u.name or u.name.startswith(("s0_", "p_s0_")) for u in kernel.uniforms)
    assert as_drawn(plain).shape.plain
    assert np.array_equal(zs.render(plain, 16, device="cpu").aov("part"), np.zeros((16, 16), np.uint32))
