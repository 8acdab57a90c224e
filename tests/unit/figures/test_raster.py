from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.figures import raster
from zeroset.figures.raster import draw_mesh, rasterised
from zeroset.runtime import get_device
from zeroset.scene.scene import Scene

EYE = zs.Camera(eye=(0, -4, 0), target=(0, 0, 0), fov=45)


def triangle(y: float, normal: tuple[float, float, float], half: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    corners = np.array([(-half, y, -half), (half, y, -half), (0, y, half)], np.float32)
    return corners, np.array([normal] * 3, np.float32)


def mesh_of(*parts: tuple[np.ndarray, np.ndarray]) -> zs.Mesh:
    points, normals = (np.concatenate(each) for each in zip(*parts, strict=True))
    return zs.Mesh(points, np.arange(len(points), dtype=np.uint32).reshape(-1, 3), normals)


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_the_nearer_triangle_is_seen(order: tuple[int, int]):
    parts = [triangle(0.0, (0, -1, 0)), triangle(1.0, (1, 0, 0), 2.0)]
    normals, seen = rasterised(mesh_of(*(parts[i] for i in order)), EYE.rays(40, 40), 40)
    assert tuple(normals[22, 20]) == (0, -1, 0)
    assert tuple(normals[36, 20]) == (1, 0, 0)
    assert not seen[0, 0]
    assert np.all(normals[~seen] == 0)


def test_a_triangle_covers_its_area():
    _, seen = rasterised(mesh_of(triangle(0.0, (0, -1, 0))), EYE.rays(400, 400), 400)
    pixel = 2 * 4 * np.tan(np.radians(22.5)) / 400
    assert abs(seen.sum() * pixel**2 - 2.0) < 0.02


def test_many_parts_give_the_same_picture(monkeypatch: pytest.MonkeyPatch):
    ball = zs.mesh(zs.gallery["sphere"], 16, device="cpu")
    rays = EYE.rays(64, 64)
    whole = rasterised(ball, rays, 64)
    monkeypatch.setattr(raster, "AT_ONCE", 50)
    parts = rasterised(ball, rays, 64)
    assert np.array_equal(whole[1], parts[1])
    assert np.allclose(whole[0], parts[0])


def test_there_are_no_gaps_between_triangles():
    ball = zs.mesh(zs.gallery["sphere"], 24, device="cpu")
    _, seen = rasterised(ball, EYE.rays(200, 200), 200)
    rows, columns = np.nonzero(seen)
    middle = (np.hypot(rows - 99.5, columns - 99.5)) < 50
    assert middle.sum() == (np.hypot(*(np.indices((200, 200)) - 99.5)) < 50).sum()


def test_a_fine_mesh_looks_as_rays_do():
    surface = zs.gallery["torus"]
    camera = zs.Camera(eye=(3, -4, 3))
    scene = Scene(surface, camera, background=(0.1, 0.2, 0.3))
    meshed = draw_mesh(scene, 96, 80, get_device("cpu")).astype(int)
    traced = zs.render(scene, 80, device="cpu").pixels.astype(int)
    assert meshed.shape == (80, 80, 3)
    apart = np.abs(meshed - traced).max(axis=-1)
    assert np.mean(apart > 12) < 0.03
    assert np.array_equal(meshed[0, 0], traced[0, 0])
