"""Several surfaces in one scene: which is in front, what throws a shadow on what, mirrors, layers, both devices."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.errors import MethodError, ParameterError
from zeroset.rendering.drawn import as_drawn
from zeroset.rendering.tracer import Tracer
from zeroset.runtime import get_device
from zeroset.scene.several import Several
from zeroset.solve import METHODS, resolve_method

DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]
BALL = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.2)


def ball(x: float, y: float, z: float, radius: float = 1.0) -> zs.Surface:
    """A ball inside bounds that hold nothing but it, its place parameters."""
    place = {"a": x, "b": y, "c": z, "r": radius}
    return zs.surface("(x-a)^2 + (y-b)^2 + (z-c)^2 = r^2", place, bounds=zs.Ball(1.1 * radius, (x, y, z)))


THREE = (ball(0, 0, 0), ball(0.5, 3, 0.2, 1.4), ball(-0.4, -3, 0.1, 0.6))


def roots(origin: np.ndarray, direction: np.ndarray) -> list[tuple[float, int]]:
    """All hits of the three balls along a ray, in order."""
    met = []
    for part, surface in enumerate(THREE):
        p = surface.params
        to = origin - (p["a"], p["b"], p["c"])
        a, b, c = direction @ direction, to @ direction, to @ to - p["r"] ** 2
        if b * b > a * c:
            met += [((-b + s * np.sqrt(b * b - a * c)) / a, part) for s in (-1, 1)]
    return sorted(met)


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("method", METHODS)
def test_the_nearest_comes_first_with_every_method(method: str, device: str) -> None:
    if device == "gpu" and method not in ("auto", "analytic"):
        pytest.skip("one searching and one closed form tell enough on a slow stand-in for a GPU")
    rng = np.random.default_rng(5)
    origins = np.array([0.1, -9, 0.0]) + rng.normal(size=(60, 3)) * 0.3
    directions = np.array([[0, 1, 0]]) + rng.normal(size=(60, 3)) * 0.06
    origins[30:], directions[30:] = -origins[30:], -directions[30:]
    origins, directions = origins.astype(np.float32), directions.astype(np.float32)
    hits = zs.cast(THREE, origins, directions, max_hits=7, method=method, device=device)
    for i, (o, d) in enumerate(zip(origins.astype(float), directions.astype(float), strict=True)):
        met = [(t, part) for t, part in roots(o, d) if t > 0]
        if any(b[0] - a[0] < 0.05 for a, b in pairwise(met)):
            continue
        assert hits.status[i].tolist() == [zs.HIT] * len(met) + [zs.MISS] * (7 - len(met))
        assert hits.part[i, : len(met)].tolist() == [part for _, part in met]
        assert np.allclose(hits.t[i, : len(met)], [t for t, _ in met], atol=5e-3)


def test_one_surface_pays_for_nothing() -> None:
    method, device = resolve_method("auto"), get_device("interp")
    alone = Tracer(BALL, method, device, pixels=True, shadows=True)
    scene = zs.Scene([BALL])
    assert scene.surface is BALL
    listed = Tracer(scene.surface, method, device, pixels=True, shadows=True)
    wrapped = Tracer(Several((BALL,)), method, device, pixels=True, shadows=True)
    for name in ("beams", "first", "second", "parts", "shadow"):
        digest = alone.kernel(name).digest
        assert listed.kernel(name).digest == digest
        assert wrapped.kernel(name).digest == digest


def test_each_keeps_to_its_own_bounds_and_parameters() -> None:
    halves = [
        zs.surface("x^2 + y^2 + z^2 = r^2", {"r": r}, bounds=zs.Box((-2, low, -2), (2, high, 2)))
        for r, low, high in ((1.0, -2, 0), (1.5, 0, 2))
    ]
    hits = zs.cast(halves, [0, -5, 0.1], [[0, 1, 0]], max_hits=3, device="cpu")
    assert hits.status.tolist() == [[1, 1, 0]]
    assert np.allclose(hits.t[0, :2], [5 - np.sqrt(0.99), 5 + np.sqrt(2.24)], atol=1e-3)
    moved = as_drawn(Several(tuple(halves)).with_params(r=0.5))
    assert [dict(surface.params) for _, surface in moved.surfaces] == [{"r": 0.5}, {"r": 0.5}]


def test_arrays_of_the_same_name_are_kept_apart() -> None:
    rows = [
        zs.surface("sum(i, 0.04/((x-c[i])^2 + y^2 + z^2)) = 1", {"c": places}, bounds=5)
        for places in ((-3.0, -1.0), (1.0, 2.0, 3.0))
    ]
    hits = zs.cast(rows, [[x, -5, 0] for x in (-3, -1, 0, 1, 2, 3)], [0, 1, 0], device="cpu")
    assert hits.status.tolist() == [1, 1, 0, 1, 1, 1]
    assert hits.part.tolist() == [0, 0, 0, 1, 1, 1]


@pytest.mark.parametrize("device", DEVICES)
def test_one_throws_its_shadow_on_another(device: str) -> None:
    ground = zs.surface("z", bounds=zs.Box((-3, -3, -0.1), (3, 3, 0.1)))
    above = zs.surface("x^2 + y^2 + (z - 1.5)^2 = 0.25", bounds=zs.Ball(0.6, (0, 0, 1.5)))
    sun = zs.Light(direction=(0.4, 0, 1), headlight=False)
    camera = zs.Camera(eye=(0, -9, 7), target=(0, 0, 0.5), fov=40)
    scene = zs.Scene([ground, above], camera, lights=(sun,), shadows=True)
    size = 128
    dark, free = (zs.render(replace(scene, shadows=s), size, device=device) for s in (True, False))
    u = (np.arange(size) + 0.5) * 2 / size - 1
    eye, _, _, forward, right, up = (np.asarray(v) for v in camera.rays(size, size))
    point = eye + dark.aov("t")[..., None] * (forward + u[None, :, None] * right - u[:, None, None] * up)
    plane = (dark.aov("part") == 0) & (dark.aov("status") == zs.HIT)
    darker = (dark.pixels.astype(int).sum(-1) < free.pixels.astype(int).sum(-1) - 6)[plane]
    off = np.hypot((point[plane][:, 0] + 0.6) / np.hypot(1, 0.4), point[plane][:, 1])
    assert np.count_nonzero(darker) > 100
    assert np.all(darker[off < 0.47])
    assert not np.any(darker[off > 0.53])


@pytest.mark.parametrize("device", DEVICES)
def test_a_mirror_shows_another_surface(device: str) -> None:
    mirror = zs.surface("y", bounds=zs.Box((-3, -0.1, -3), (3, 0.1, 3)))
    glass = zs.Material(front=(0, 0, 0), back=(0, 0, 0), specular=0, reflectance=1)
    red = zs.Material(front=(1, 0, 0), back=(1, 0, 0), specular=0, ambient=1, diffuse=0)
    # The ball stands behind the eye, and is seen in the mirror alone.
    thing = zs.surface("x^2 + (y + 8)^2 + z^2 = 1", bounds=zs.Ball(1.1, (0, -8, 0))).with_material(red)
    camera = zs.Camera(eye=(0, -5, 0), target=(0, 0, 0), fov=50)
    scene = zs.Scene([mirror.with_material(glass), thing], camera, background=(0, 0, 1))
    image = zs.render(scene, 96, device=device)
    assert set(np.unique(image.aov("part"))) == {0}
    is_red = image.pixels[..., 0] > 128
    # Its mirror image is a ball 8 behind the mirror, 13 from the eye: a disc of tan asin(1/13) around the middle.
    u = (np.arange(96) + 0.5) * 2 / 96 - 1
    off = np.hypot(*np.meshgrid(u, u)) * np.tan(np.radians(25))
    edge = np.tan(np.arcsin(1 / 13))
    assert np.all(is_red[off < edge - 0.01])
    assert not np.any(is_red[off > edge + 0.01])


def test_edges_between_parts_are_smoothed() -> None:
    # Two halves of one plane: no crease and no step, and yet a border.
    left, right = (zs.surface("z", bounds=zs.Box((a, -2, -0.1), (b, 2, 0.1))) for a, b in ((-2, 0), (0, 2)))
    black, white = (zs.Material(front=(v, v, v), ambient=1, diffuse=0, specular=0) for v in (0, 1))
    scene = zs.Scene([left.with_material(black), right.with_material(white)], background=(0, 1, 0))
    camera = zs.Camera(eye=(0.013, 0, 6), target=(0.013, 0, 0), up=(0, 1, 0.0), fov=20)
    image = zs.render(scene, 64, camera=camera, antialias=16, device="cpu")
    row = image.pixels[32, :, 0].astype(int)
    assert row[0] == 0
    assert row[-1] == 255
    between = (row > 20) & (row < 235)
    assert 1 <= np.count_nonzero(between) <= 2


def test_solids_and_isovalues_beside_surfaces() -> None:
    lens = ball(-3, 0, 0) & ball(-3.5, 0, 0)
    shells = zs.surface("(x-3)^2 + y^2 + z^2", bounds=zs.Ball(1.5, (3, 0, 0))).with_isovalues((0.25, 1.0))
    scene = zs.Scene([lens, BALL, shells])
    assert len(scene.materials) == 5
    hits = zs.cast(scene, [-9, 0.05, 0], [[1, 0, 0]], max_hits=9, device="cpu")
    assert hits.part.tolist() == [[0, 1, 2, 2, 4, 3, 3, 4, 0]]
    assert hits.status.tolist() == [[1] * 8 + [0]]
    with pytest.raises(MethodError):
        zs.cast(scene, [-9, 0.05, 0], [[1, 0, 0]], method="mitchell")


def test_what_cannot_be_drawn_together() -> None:
    with pytest.raises(ParameterError, match="nothing to draw"):
        zs.Scene([])
    with pytest.raises(ParameterError, match="not a str"):
        zs.Scene([BALL, "x"])  # type: ignore[list-item]
    with pytest.raises(ParameterError, match="at most 32"):
        zs.Scene([ball(i, 0, 0) for i in range(33)])


def test_a_small_thing_on_a_large_ground_is_found_as_closely_as_alone() -> None:
    ground = zs.surface("z + 1", bounds=zs.Box((-500, -500, -2), (500, 500, 0)))
    hits = zs.cast([ground, BALL], [[0.3, -5, 0.1], [0.3, -5, 0.1]], [[0, 1, 0], [0, 1, -0.5]], device="cpu")
    assert hits.part.tolist() == [1, 0]
    assert abs(float(hits.t[0]) - (5 - np.sqrt(0.9))) < 4 * 2.4 * 2.0**-14


def test_a_mirror_that_is_touched_has_no_speckles() -> None:
    """A short way to a plane is cut so sharply that rounding alone could put a mirrored ray's origin behind it."""
    mirror = zs.Material((0.55, 0.57, 0.6), (0.55, 0.57, 0.6), specular=0, reflectance=0.25)
    glass = zs.Material((0.3, 0.6, 0.4), (0.3, 0.6, 0.4), opacity=0.15, ior=1.25)
    ground = zs.surface("z + 1", bounds=zs.Box((-4, -4, -1.1), (4, 4, -0.9))).with_material(mirror)
    touching = zs.surface("(x - 2.2)^2 + (y + 0.4)^2 + z^2 = 1", bounds=zs.Ball(1.05, (2.2, -0.4, 0)))
    camera = zs.Camera(eye=(1, -9, 4), target=(2.2, -0.4, -0.6), fov=9)
    scene = zs.Scene([ground, touching.with_material(glass)], camera, background=(1, 0, 1))
    seen = zs.render(scene, 160, device="cpu").pixels[55:100, 40:120].astype(int)
    around = np.median([np.roll(seen, shift, (0, 1)) for shift in np.ndindex(3, 3)], axis=0)
    # Within the ball the picture is smooth; the roll has moved the middle of each 3 by 3 by one.
    rough = np.abs(np.roll(seen, (1, 1), (0, 1)) - around)[3:, 3:].max(axis=-1)
    assert np.count_nonzero(rough > 8) == 0


def test_what_hides_the_other_is_seen_where_two_lie_in_one_place() -> None:
    """A box of glass stands on the ground: which comes first in the scene does not matter."""
    ground = zs.surface("z + 1", bounds=zs.Box((-3, -3, -1.5), (3, 3, -0.5)))
    ground = ground.with_material(zs.Material(front=(0.8, 0.1, 0.1)))
    box = zs.surface("max(|x|, |y|, |z|) = 1", bounds=1.8)
    glass = box.with_material(zs.Material(opacity=0.2, ior=1.4, reflectance=0.1))
    camera = zs.Camera(eye=(1, -8, 3))
    for above in (box.with_material(zs.Material(opacity=0.3)), glass, box):
        pictures = [
            np.asarray(zs.render(zs.Scene(things, camera=camera), 100, device="cpu")).astype(int)
            for things in ([ground, above], [above, ground])
        ]
        assert np.count_nonzero(abs(pictures[0] - pictures[1]).max(axis=-1) > 8) <= 3
    clear = box.with_material(zs.Material(opacity=0.3))
    for things, first in (([ground, clear], 0), ([clear, ground], 1)):
        hits = zs.cast(things, [0.3, 0.2, 5], [0, 0, -1], max_hits=3, device="cpu")
        assert hits.status.tolist() == [[zs.HIT, zs.HIT, zs.MISS]]
        assert hits.part[0, :2].tolist() == [1 - first, first]
