"""Pictures where f jumps or has no value: nothing is there if f has the same sign on either side."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.gpus import no_gpu

import zeroset as zs

Array = np.ndarray[Any, Any]
DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.skipif(bool(no_gpu()), reason=no_gpu() or "there is one"))]
SIZE = 96
CAMERA = zs.Camera(eye=(4.1, -6.2, 3.3), fov=30)


def rays() -> tuple[Array, Array]:
    """The eye, and the directions of the pixels' rays."""
    eye, _, _, forward, right, up = map(np.array, CAMERA.rays(SIZE, SIZE))
    middles = (np.arange(SIZE) + 0.5) * 2 / SIZE - 1
    return eye, forward + middles[None, :, None] * right - middles[:, None, None] * up


def seen(formula: str, bounds: Any, device: str = "cpu") -> tuple[zs.Image, Array]:
    """A picture, and the points that it shows."""
    image = zs.render(zs.surface(formula, bounds=bounds), SIZE, CAMERA, device=device)
    eye, ways = rays()
    return image, (eye + np.nan_to_num(image.aov("t"))[..., None] * ways)[image.aov("status") > 0]


@pytest.mark.parametrize("device", DEVICES)
def test_balls_repeated_by_mod_have_no_walls_between_them(device: str) -> None:
    formula = "(mod(x,1)-1/2)^2 + (mod(y,1)-1/2)^2 + (mod(z,1)-1/2)^2 = 0.1"
    image, points = seen(formula, zs.Box((-2, -2, -2), (2, 2, 2)), device)
    assert image.unresolved == 0
    assert len(points) > 1000
    off = np.linalg.norm(points - np.floor(points) - 0.5, axis=1)
    assert np.abs(off - np.sqrt(0.1)).max() < 2e-3
    # Rays meet what a ray through 64 balls meets.
    eye, ways = rays()
    ways /= np.linalg.norm(ways, axis=-1, keepdims=True)
    centres = np.stack(np.meshgrid(*[np.arange(-1.5, 2.0)] * 3), axis=-1).reshape(-1, 3) - eye
    along = ways @ centres.T
    nearest = np.sqrt(np.maximum((centres**2).sum(1) - along**2, 0)).min(axis=-1)
    sure = np.abs(nearest - np.sqrt(0.1)) > 1e-3
    assert np.array_equal((image.aov("status") > 0)[sure], (nearest < np.sqrt(0.1))[sure])


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize(
    ("formula", "bounds", "off"),
    [
        ("sqrt(x^2 + y^2) = 1 + 0.3cos(3atan2(y, x))", 2.0, None),
        ("z = if(|x| < 0.001, 1, sin(x)/x)", 3.0, lambda p: p[:, 2] - np.sinc(p[:, 0] / np.pi)),
        ("z = x*log(x)", 2.0, lambda p: p[:, 2] - p[:, 0] * np.log(np.maximum(p[:, 0], 1e-9))),
        ("z = exp(-1/x^2)", 2.0, lambda p: p[:, 2] - np.exp(-1 / p[:, 0] ** 2)),
        ("log(x) + y = z", 2.0, lambda p: p[:, 2] - p[:, 1] - np.log(p[:, 0])),
    ],
)
def test_nothing_is_drawn_where_f_has_no_value(formula: str, bounds: float, off: Any, device: str) -> None:
    image, points = seen(formula, bounds, device)
    assert len(points) > 500
    assert image.unresolved <= 4
    if off is None:
        off = lambda p: np.hypot(p[:, 0], p[:, 1]) - 1 - 0.3 * np.cos(3 * np.arctan2(p[:, 1], p[:, 0]))  # noqa: E731
    with np.errstate(all="ignore"):
        assert np.quantile(np.abs(off(points)), 0.995) < 0.02


def test_a_jump_with_another_sign_behind_it_is_drawn() -> None:
    image, _ = seen("z = floor(x)", 2.0)
    assert image.unresolved > 100


@pytest.mark.parametrize("device", DEVICES)
def test_a_wall_shows_one_side(device: str) -> None:
    """The cap of a tube that ends where atan2 jumps."""
    tube = zs.surface("(x^2 + y^2 - 1)^2 + (z - atan2(y, x)/2)^2 = 0.05", bounds=2.2)
    image = zs.render(tube, 200, zs.Camera(eye=(-2.0, -5.0, 3.0), target=(-1.0, 0.0, 1.57), fov=14), device=device)
    wall = image.aov("status") == zs.UNRESOLVED
    assert wall.sum() > 200
    normal = image.aov("normal")
    for a, b in ((np.s_[1:], np.s_[:-1]), (np.s_[:, 1:], np.s_[:, :-1])):
        beside = np.einsum("ijk,ijk->ij", normal[a], normal[b])[wall[a] & wall[b]]
        assert np.mean(beside > 0.9) > 0.98


def test_rays_of_ones_own_are_not_told_that_there_is_nothing() -> None:
    """A caller gets what is proven: nothing is known of f right beside x = 0."""
    hits = zs.cast(zs.surface("z = sin(x)/x", bounds=4), [[-3, 0.2, 2.5], [-3, 0.2, 0.5]], [[1, 0.1, 0], [1, 0, 0]])
    assert hits.status.tolist() == [zs.UNRESOLVED, zs.HIT]


@pytest.mark.parametrize("device", DEVICES)
def test_a_sheet_is_drawn_up_to_where_f_ends(device: str) -> None:
    """Seen from its edge the sheet lies less than a tolerance behind the end of f's domain, and yet is pixels high."""
    size, camera = 160, zs.Camera(eye=(-0.5, 0, 0.12), target=(0, 0, 0.03), fov=25)
    image = zs.render(zs.surface("z - sqrt(x)", bounds=1.5), size, camera, device=device)
    eye, _, _, forward, _, up = map(np.array, camera.rays(size, size))
    middles = (np.arange(size) + 0.5) * 2 / size - 1
    heights = [(eye + 0.5 / (forward - v * up)[0] * (forward - v * up))[2] for v in middles]
    # Rays that come above z = 0 to where x is 0 meet the sheet; one row may be closer to it than f32 tells.
    rows = (image.aov("status") > 0).mean(axis=1)[np.array(heights) > 0]
    assert len(rows) > 60
    assert np.count_nonzero(rows < 1) <= 1


def test_a_root_before_a_jump_back_is_drawn() -> None:
    surface = zs.surface("if(1e-3 < (y-z), x, y) - tanh(sin(acosh(hypot(40x, y-z))))", bounds=1.5)
    image = zs.render(surface, SIZE, CAMERA, device="cpu")
    eye, ways = rays()
    hits = zs.cast(surface, eye, ways.reshape(-1, 3), device="cpu")
    proven = (hits.status == zs.HIT).reshape(SIZE, SIZE)
    assert proven.sum() > 2000
    assert np.count_nonzero(proven & (image.aov("status") == zs.MISS)) <= 0.005 * proven.sum()
