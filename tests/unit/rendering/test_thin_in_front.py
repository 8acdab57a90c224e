"""What is thinner than a pixel is seen in front of another surface as it is beside it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.gpus import no_gpu

import zeroset as zs

Array = np.ndarray[Any, Any]
DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.skipif(bool(no_gpu()), reason=no_gpu() or "there is one"))]
SIZE = 256
CAMERA = zs.Camera(eye=(6.0, 5.0, 1.5), fov=30)


def pixels_of(curve: Array) -> Array:
    """Column and row of points, (n, 2), in pixels."""
    eye, _, _, forward, right, up = map(np.array, CAMERA.rays(SIZE, SIZE))
    seen = curve - eye
    depth = seen @ forward
    u, v = seen @ right / depth / (right @ right), seen @ up / depth / (up @ up)
    return np.stack([(u + 1) * SIZE / 2, (1 - v) * SIZE / 2], axis=-1)


def sphere_hides(curve: Array, square: float) -> Array:
    """Whether points lie behind the sphere around the origin with this squared radius, seen from the eye."""
    eye = np.array(CAMERA.eye)
    way = curve - eye
    along = -(way @ eye) / np.einsum("ij,ij->i", way, way)
    nearest = eye + np.clip(along, 0, 1)[:, None] * way
    return np.asarray(np.einsum("ij,ij->i", nearest, nearest) < square)


@pytest.mark.parametrize("device", DEVICES)
def test_a_line_without_thickness_passes_in_front_of_a_ball(device: str) -> None:
    """A line is where a sum of two squares is 0: no ray meets it."""
    surface = zs.surface("(x^2 + y^2 + z^2 - 1) ((x - 2 + z)^2 + (y - z)^2)", bounds=2.5)
    image = zs.render(surface, SIZE, CAMERA, device=device)
    z = np.linspace(-0.6, 1.4, 4001)
    line = np.stack([2 - z, z, z], axis=-1)
    line = line[~sphere_hides(line, 1.02) & (np.linalg.norm(line, axis=-1) < 2.3)]
    column, row = pixels_of(line).T
    thin = image.aov("status") == zs.UNRESOLVED
    ball = zs.render(zs.surface("x^2 + y^2 + z^2 - 1", bounds=2.5), SIZE, CAMERA, device=device).aov("status") == zs.HIT
    before = ball[row.astype(int), column.astype(int)]
    # It is in front of the ball over some part of it, and drawn all along: also where it leaves the ball's outline.
    assert before.mean() > 0.3
    assert np.all(thin[row.astype(int), column.astype(int)])
    rows, columns = np.nonzero(thin & ball)
    off = [np.min(np.hypot(column - c - 0.5, row - r - 0.5)) for r, c in zip(rows, columns, strict=True)]
    # A pixel reaches 0.71 of its side to a corner.
    assert max(off) < 0.8
    # It is drawn where the pixel as a whole could first not be excluded: before the line, far in front of the ball.
    depth = image.aov("depth")[row.astype(int), column.astype(int)]
    nearer = 1 - depth / np.linalg.norm(line - np.array(CAMERA.eye), axis=-1)
    assert nearer.min() > -1e-3
    assert nearer.max() < 0.05


@pytest.mark.parametrize("device", DEVICES)
def test_a_wire_in_front_of_a_ball_is_not_dotted(device: str) -> None:
    """Some rays meet it and some do not: it is a tenth of a pixel thick."""
    surface = zs.surface("((x^2 + y^2 - 1.5)^2 + (z - 0.2 x)^2 - 1e-6) (x^2 + y^2 + z^2 - 0.6)", bounds=2.5)
    depth = zs.render(surface, SIZE, CAMERA, device=device).aov("depth")
    bare = zs.render(zs.surface("x^2 + y^2 + z^2 - 0.6", bounds=2.5), SIZE, CAMERA, device=device).aov("depth")
    angle = np.linspace(0, 2 * np.pi, 20001)
    ring = np.sqrt(1.5) * np.stack([np.cos(angle), np.sin(angle), 0.2 * np.cos(angle)], axis=-1)
    ring = ring[~sphere_hides(ring, 0.62)]
    column, row = pixels_of(ring).T.astype(int)
    before = np.isfinite(bare[row, column])
    assert before.sum() > 2000
    assert np.all(depth[row, column][before] < bare[row, column][before] - 0.1)


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("name", ["tangle", "blinn-blobby", "chmutov-6", "4-bretzel", "superquadric"])
def test_one_sheet_in_front_of_another_is_no_thin_thing(name: str, device: str) -> None:
    surface = zs.gallery[name]
    with_thin, without = (zs.render(surface, SIZE, thin=thin, device=device).aov("status") for thin in (True, False))
    assert (without == zs.HIT).any()
    assert np.array_equal(with_thin, without)
