from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.gpus import needs_gpu
from tests.narrow import narrow

import zeroset as zs
from zeroset.errors import BoundsError, DeviceError, ParameterError, ZerosetError

from .measure import components, distance, edge_uses, edges, euler, face_normals, rim, slope

BALL = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.3)
TORUS = zs.surface("(x^2 + y^2 + z^2 + a)^2 = 4(x^2 + y^2)", {"a": 0.75}, bounds=1.6)
SADDLE = zs.surface("z = x^2 - y^2", bounds=1.0)
CUBE, SLAB = zs.Box((-1, -1, -1), (1, 1, 1)), zs.Box((-1, -0.5, 0), (1, 1, 0.4))


def in_order(mesh: zs.Mesh) -> Any:
    """Directed edges, each as one number."""
    pairs = edges(mesh)
    return np.sort(pairs[:, 0] * len(mesh.vertices) + pairs[:, 1])


def test_a_sphere_has_the_area_the_volume_and_the_shape_of_one() -> None:
    errors = []
    for resolution in (16, 32):
        ball = zs.mesh(BALL, resolution)
        assert ball.watertight
        assert set(edge_uses(ball)) == {2}
        assert len(np.unique(in_order(ball))) == 3 * len(ball.faces)
        assert (euler(ball), components(ball)) == (2, 1)
        assert np.allclose(np.linalg.norm(ball.vertices.astype(np.float64), axis=1), 1, atol=2e-7)
        errors.append((1 - ball.volume / (4 / 3 * math.pi), 1 - ball.area / (4 * math.pi)))
    # Inscribed triangles: both are too small, by the square of the cells.
    for coarse, fine in zip(*errors, strict=True):
        assert 0 < fine < 0.3 * coarse < 0.01


def test_a_torus_has_a_hole_and_two_balls_are_two() -> None:
    torus = zs.mesh(TORUS, 40)
    assert (torus.watertight, euler(torus), components(torus)) == (True, 0, 1)
    # R = 1, r = 1/2.
    assert torus.volume == pytest.approx(2 * math.pi**2 * 0.25, rel=0.01)
    assert torus.area == pytest.approx(4 * math.pi**2 * 0.5, rel=0.01)
    two = zs.mesh(zs.surface("((x-1)^2 + y^2 + z^2 - 1/2)((x+1)^2 + y^2 + z^2 - 1/4)", bounds=2.0), 40)
    assert (two.watertight, euler(two), components(two)) == (True, 4, 2)


def test_a_mesh_is_plain_arrays() -> None:
    ball = zs.mesh(BALL, 8)
    count, faces = len(ball.vertices), len(ball.faces)
    assert (ball.vertices.dtype, ball.vertices.shape) == (np.float32, (count, 3))
    assert (ball.faces.dtype, ball.faces.shape) == (np.uint32, (faces, 3))
    assert (ball.normals.dtype, ball.normals.shape) == (np.float32, (count, 3))
    assert np.array_equal(np.unique(ball.faces), np.arange(count))
    assert repr(ball) == f"<zeroset.Mesh {count} vertices, {faces} triangles>"


def test_triangles_and_normals_look_to_where_f_grows() -> None:
    ball = zs.mesh(BALL, 24)
    assert np.allclose(ball.normals, ball.vertices, atol=1e-5)
    outward = face_normals(ball)
    assert np.min(np.sum(outward * ball.vertices[ball.faces[:, 0]], axis=1)) > 0.5
    inner = zs.mesh(zs.surface("1 - x^2 - y^2 - z^2", bounds=1.3), 24)
    assert np.allclose(inner.normals, -inner.vertices, atol=1e-5)
    assert inner.volume == pytest.approx(-ball.volume)


@pytest.mark.parametrize("precision", ["f32", "f64"])
@pytest.mark.parametrize("name", ["tangle", "barth-sextic", "klein-bottle", "blobby", "blinn-blobby-30", "clebsch"])
def test_every_vertex_lies_on_the_surface(name: str, precision: str) -> None:
    surface = zs.gallery[name]
    resolution = 40
    found = zs.mesh(surface, resolution, device="cpu", precision=precision)
    cell = 2 * surface.fitted.reach / resolution
    off = distance(surface, found.vertices)
    # f64 leaves the rounding of the coordinates; in f32 that of f counts too, most beside double points.
    assert np.max(off) < 1e-5 * cell if precision == "f64" else np.quantile(off, 0.999) < 1e-3 * cell
    gradient = slope(surface, found.vertices)[1]
    steep = np.linalg.norm(gradient, axis=1)
    clear = steep > 1e-2 * np.median(steep)
    turned = np.sum(gradient * found.normals, axis=1)[clear] / steep[clear]
    assert np.min(turned) > 0.999


@pytest.mark.parametrize("name", ["tangle", "barth-sextic", "clebsch", "heart", "klein-bottle", "dervish", "labs"])
def test_capped_surfaces_are_watertight(name: str) -> None:
    capped = zs.mesh(zs.gallery[name], 32, cap=True)
    assert capped.watertight
    assert set(edge_uses(capped)) == {2}
    assert (
        np.linalg.norm(
            np.cross(*(capped.vertices[capped.faces[:, i]] - capped.vertices[capped.faces[:, 0]] for i in (1, 2))),
            axis=1,
        ).min()
        > 0
    )


@pytest.mark.parametrize("bounds", [1.0, zs.Box((-0.8, -0.7, -1), (0.9, 0.6, 1)), zs.Ball(0.9, (0.1, 0.2, 0.1))])
def test_where_the_bounds_cut_an_open_mesh_ends_in_them(bounds: Any) -> None:
    surface = SADDLE.with_bounds(bounds)
    opened = zs.mesh(surface, 33)
    assert not opened.watertight
    assert set(edge_uses(opened)) == {1, 2}
    ends = rim(opened).astype(np.float64)
    limits = surface.fitted
    if isinstance(limits, zs.Ball):
        assert np.allclose(np.linalg.norm(ends - limits.center, axis=1), limits.radius, atol=1e-6)
        assert np.all(np.linalg.norm(opened.vertices - limits.center, axis=1) < limits.radius * (1 + 1e-6))
    else:
        at_face = np.isclose(ends, limits.min, atol=1e-6) | np.isclose(ends, limits.max, atol=1e-6)
        assert np.all(at_face.any(axis=1))
    assert np.max(distance(surface, opened.vertices)) < 1e-6
    # A disc.
    assert euler(opened) == 1


def test_caps_close_half_a_ball_and_a_quarter_of_a_box() -> None:
    half = zs.mesh(zs.surface("z", bounds=1.0), 64, cap=True)
    assert (half.watertight, euler(half)) == (True, 2)
    assert half.volume == pytest.approx(2 / 3 * math.pi, rel=2e-3)
    assert half.area == pytest.approx(3 * math.pi, rel=2e-3)
    # The crease is sharp: a circle of radius 1 in the plane z = 0.
    level = half.vertices[np.abs(half.vertices[:, 2]) < 1e-6]
    assert np.linalg.norm(level, axis=1).max() == pytest.approx(1, abs=1e-6)
    box = zs.Box((0, 0, 0), (1, 1, 1))
    quarter = zs.mesh(zs.surface("x^2 + y^2 = 1", bounds=box), 48, cap=True)
    assert (quarter.watertight, euler(quarter), components(quarter)) == (True, 2, 1)
    assert quarter.volume == pytest.approx(math.pi / 4, rel=1e-3)
    assert quarter.area == pytest.approx(2 * math.pi / 4 + 2 + math.pi / 2, rel=1e-3)
    flat = np.abs(quarter.vertices[:, 2]) < 1e-6
    lone = flat & (np.linalg.norm(quarter.vertices[:, :2], axis=1) < 0.9) & (quarter.vertices[:, :2].min(axis=1) > 0.1)
    assert np.allclose(quarter.normals[lone], (0, 0, -1), atol=1e-5)
    whole = zs.mesh(zs.surface("x + y + z - 5 + 3 x", bounds=zs.Box((0, 0, 0), (1, 2, 3))), 12, cap=True)
    # The part of the box below a plane, by its own integral.
    assert whole.volume == pytest.approx(volume_below(), rel=1e-5)


def volume_below() -> float:
    """Volume of 4x + y + z <= 5 in the box, by fine slices of z and y: the length in x is clipped."""
    y, z = (np.arange(2000) + 0.5) / 1000, (np.arange(3000) + 0.5) / 1000
    lengths = np.clip((5 - y[:, None] - z[None, :]) / 4, 0, 1)
    return float(lengths.sum() * 1e-6)


def test_a_gap_at_the_bounds_thinner_than_a_cell_takes_nothing_with_it() -> None:
    for sign in ("", "-"):
        touching = zs.mesh(zs.surface(f"{sign}(x^2 + y^2 + z^2 - 1)", bounds=1.001), 24)
        assert (touching.watertight, euler(touching)) == (True, 2)


def test_boxes_need_not_be_cubes() -> None:
    bounds = zs.Box((-1.5, -1.2, -1.1), (1.3, 1.4, 5))
    ball = zs.mesh(BALL.with_bounds(bounds), 60)
    assert (ball.watertight, euler(ball)) == (True, 2)
    assert ball.volume == pytest.approx(4 / 3 * math.pi, rel=0.02)


def test_zeros_at_the_points_of_the_lattice_leave_no_hole_and_no_sliver() -> None:
    # Planes, and a ball of which whole lattice planes meet the surface.
    for text, shape in (("z", 1), ("|x| + |y| + |z| = 1", 2), ("max(|x|, |y|, |z|) = 1/2", 2)):
        found = zs.mesh(zs.surface(text, bounds=zs.Box((-2, -2, -2), (2, 2, 2))), 16)
        a, b, c = (found.vertices[found.faces[:, i]] for i in range(3))
        assert np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > 1e-4
        assert euler(found) == shape
    plane = zs.mesh(zs.surface("z", bounds=zs.Box((-2, -2, -2), (2, 2, 2))), 16)
    assert len(plane.vertices) == 17**2
    assert plane.area == pytest.approx(16)


def test_poles_and_ends_of_where_f_is_defined_are_no_surface() -> None:
    with pytest.raises(BoundsError, match="poles"):
        zs.mesh(zs.surface("1/x", bounds=1.0), 15)
    both = zs.mesh(zs.surface("(x - 1/2)/(x + 1/2)", bounds=1.0), 20)
    assert np.allclose(both.vertices[:, 0], 0.5, atol=1e-6)
    half = zs.mesh(zs.surface("y - sqrt(x)", bounds=CUBE), 25)
    assert np.max(distance(zs.surface("y^2 - x", bounds=1.0), half.vertices)) < 1e-5
    assert half.vertices[:, 1].min() > -1e-6
    step = zs.mesh(zs.surface("floor(x) + 1/2", bounds=1.0), 21)
    assert np.allclose(step.vertices[:, 0], 0, atol=1e-5)


@pytest.mark.parametrize("formula", ["(x + y + z)^2", "x^2", "x^2 + y^2 + z^2", "|x|"])
def test_where_f_only_touches_zero_it_is_said_to_keep_its_sign(formula: str) -> None:
    with pytest.raises(BoundsError, match=r"f is 0 but does not change its sign") as caught:
        zs.mesh(zs.surface(formula, bounds=1.0), 16)
    assert "of f = g^2 mesh g" in str(caught.value)
    with pytest.raises(BoundsError, match=r"f does not change its sign"):
        zs.mesh(zs.surface(formula + " + 1", bounds=1.0), 16)


def test_excluded_blocks_held_nothing() -> None:
    from zeroset.export.marching.extract import active_blocks, extract
    from zeroset.export.marching.lattice import make_lattice
    from zeroset.export.marching.programs import Programs
    from zeroset.kernel import F32
    from zeroset.runtime import get_device

    for name, capped in (("barth-sextic", False), ("barth-sextic", True), ("sin-blob", False), ("cloth", True)):
        surface = zs.gallery[name]
        programs = Programs(surface, get_device("cpu"), capped, F32)
        lattice = make_lattice(surface.fitted, 45, capped)
        whole, part = (extract(programs, lattice, exclude=exclude) for exclude in (False, True))
        blocks = active_blocks(programs, lattice, programs.put(lattice.coordinates, F32))
        assert 0 < len(blocks) < np.prod(lattice.blocks)
        # What an open mesh has beyond its ball may be left out.
        kept = whole.kinds == 0
        if capped:
            assert np.array_equal(whole.vertices, part.vertices)
            assert np.array_equal(whole.corners, part.corners)
        assert np.array_equal(whole.vertices[kept], part.vertices[part.kinds == 0])


def test_slabs_fit_together(monkeypatch: pytest.MonkeyPatch) -> None:
    from zeroset.export.marching import extract

    surface = zs.gallery["tangle"]
    whole = zs.mesh(surface, 50, device="cpu")
    monkeypatch.setattr(extract, "SLAB", 1)
    monkeypatch.setattr(extract, "WATCHED_SLAB", 60)
    shares: list[float] = []
    for part in (zs.mesh(surface, 50, device="cpu"), zs.mesh(surface, 50, device="cpu", progress=shares.append)):
        assert np.array_equal(part.vertices, whole.vertices)
        assert np.array_equal(part.faces, whole.faces)
    assert shares[0] == 0
    assert shares == sorted(shares)
    assert len(shares) >= 3
    assert shares[-1] <= 1


def test_parameters_and_arrays_are_read() -> None:
    small = zs.mesh(zs.surface("x^2 + y^2 + z^2 = r", {"r": 0.25}, bounds=1.0), 32)
    assert np.allclose(np.linalg.norm(small.vertices, axis=1), 0.5, atol=1e-6)
    blobs = zs.surface("sum(i, 0.1/((x - c[i])^2 + y^2 + z^2)) = 1", {"c": [-0.5, 0.6]}, bounds=1.4)
    found = zs.mesh(blobs, 32)
    assert (found.watertight, components(found)) == (True, 2)
    moved = zs.mesh(blobs.with_params(c=[-0.2, 0.2]), 32)
    assert components(moved) == 1


@pytest.mark.parametrize("name", ["tangle", "clebsch", "blobby"])
def test_the_interpreter_finds_the_same_triangles(name: str) -> None:
    same_mesh(zs.gallery[name], "interp", 14)


@needs_gpu
@pytest.mark.parametrize("name", ["tangle", "clebsch", "blobby", "blinn-blobby-30", "sphere"])
def test_a_gpu_finds_the_same_triangles(name: str) -> None:
    same_mesh(zs.gallery[name], "gpu", 40)


def same_mesh(surface: zs.Surface, device: str, resolution: int) -> None:
    for cap in (False, True):
        one, other = (zs.mesh(surface, resolution, cap, d, "f32") for d in ("cpu", device))
        assert np.array_equal(one.faces, other.faces)
        # Along an edge that all but touches the surface the root itself is uncertain, but not that it is one.
        cell = 2 * surface.fitted.reach / resolution
        off = np.linalg.norm(one.vertices - other.vertices, axis=1)
        assert np.quantile(off, 0.99) < 1e-4 * cell
        if not cap:
            assert max(np.max(distance(surface, made.vertices)) for made in (one, other)) < 1e-3 * cell


def test_a_mesh_comes_out_the_same_again() -> None:
    first, again = (zs.mesh(TORUS, 30) for _ in range(2))
    assert np.array_equal(first.vertices, again.vertices)
    assert np.array_equal(first.faces, again.faces)
    assert np.array_equal(first.normals, again.normals)


@pytest.mark.parametrize(
    ("arguments", "error", "said"),
    [
        ({"resolution": 1}, ParameterError, "from 2 to 1024"),
        ({"resolution": 5000}, ParameterError, "from 2 to 1024"),
        ({"resolution": 8.5}, ParameterError, "whole number"),
        ({"resolution": "8"}, ParameterError, "whole number"),
        ({"precision": "f23"}, ParameterError, "did you mean f32"),
        ({"device": "cpuu"}, DeviceError, "did you mean cpu"),
        ({"surface": "x^2 + "}, ZerosetError, "missing"),
        ({"surface": "x + a"}, ZerosetError, "a"),
        ({"surface": zs.surface("x^2 + y^2 + z^2 + 1", bounds=1)}, BoundsError, "does not change its sign"),
        ({"surface": zs.surface("x - 7", bounds=2)}, BoundsError, "try other bounds"),
        ({"surface": zs.surface("(x - 0.3)^2", bounds=2)}, BoundsError, "mesh g"),
    ],
)
def test_what_cannot_be_meshed_is_said(arguments: dict[str, Any], error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        zs.mesh(**{"surface": BALL, "resolution": 8, **arguments})


def test_no_f64_is_said() -> None:
    device = narrow()
    with pytest.raises(DeviceError, match="does not calculate in f64"):
        zs.mesh(BALL, 8, device=device, precision="f64")
    assert zs.mesh(BALL, 8, device=device).watertight


def test_extraction_can_be_timed_alone() -> None:
    from zeroset.export.marching.timing import time_extraction

    taken = time_extraction(BALL, 16, "cpu", repeats=3, exclude=False)
    assert len(taken) == 3
    assert min(taken) > 0


def test_a_block_that_is_left_out_by_mistake_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    from zeroset.export.marching import extract

    whole = zs.mesh(TORUS, 30, device="cpu")
    known = extract.active_blocks
    calls = []

    def forgetful(*given: Any) -> Any:
        calls.append(given)
        return np.delete(known(*given), 20)

    monkeypatch.setattr(extract, "active_blocks", forgetful)
    again = zs.mesh(TORUS, 30, device="cpu")
    assert len(calls) == 1
    assert np.array_equal(again.vertices, whole.vertices)
    assert np.array_equal(again.faces, whole.faces)


@pytest.mark.parametrize("bounds", [1.0, zs.Ball(0.9, (0.1, 0, 0)), CUBE, SLAB], ids=["ball", "aside", "cube", "slab"])
@pytest.mark.parametrize(
    "text",
    ["max(x, y)", "|y - z| - 2x y - 1/4", "sin(3x) + y z - 1/2 min(y, 1/2)", "exp(-x^2) - 2 cos(2y) + z^2", "x^3 / 2",
     "tanh(5z) + x y - (x - y)^2", "2|x| + y^4 - 1/2", "x y z"],
)  # fmt: skip
@pytest.mark.parametrize("resolution", [8, 15])
def test_kinks_multiple_roots_and_lattice_planes_are_closed_too(text: str, bounds: Any, resolution: int) -> None:
    surface = zs.surface(text, bounds=bounds)
    opened, capped = (zs.mesh(surface, resolution, cap, device="cpu") for cap in (False, True))
    assert capped.watertight
    for made in (opened, capped):
        corners = made.vertices[made.faces].astype(np.float64)
        assert np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).min() > 0
        assert np.all(np.isfinite(made.normals))
    limits = surface.fitted
    if isinstance(limits, zs.Ball):
        assert np.linalg.norm(opened.vertices - limits.center, axis=1).max() < limits.radius * (1 + 1e-6)


def test_the_skin_of_a_solid_is_meshed() -> None:
    """A ball with a square hole through it: closed, and as large as it must be."""
    big, thin = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5), zs.surface("max(|x|, |y|) = 0.3")
    made = zs.mesh((big - thin).with_bounds(1.5), resolution=96, device="cpu")
    assert made.watertight
    side = np.linspace(-0.3, 0.3, 201)[:-1] + 0.0015
    x, y = np.meshgrid(side, side)
    hole = float((2 * np.sqrt(1 - x * x - y * y)).mean() * 0.36)
    assert made.volume == pytest.approx(4 / 3 * math.pi - hole, rel=2e-3)


def test_several_and_isovalues_are_one_mesh() -> None:
    shells = zs.surface("x^2 + y^2 + z^2", bounds=2.0).with_isovalues((0.25, 1.0, 100.0))
    other = zs.surface("(x - 3)^2 + y^2 + z^2 = 0.25", bounds=zs.Ball(1.0, (3.0, 0.0, 0.0)))
    heard: list[float] = []
    made = zs.mesh([shells, other], resolution=48, device="cpu", progress=heard.append)
    assert made.watertight
    assert made.volume == pytest.approx(4 / 3 * math.pi * (0.125 + 1 + 0.125), rel=0.01)
    assert heard == sorted(heard)
    assert heard[-1] == 1.0
    with pytest.raises(BoundsError, match="nothing to mesh"):
        zs.mesh(shells.with_isovalues((100.0, 200.0)), resolution=8, device="cpu")
