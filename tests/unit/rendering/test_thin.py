"""Pictures seen close up: rims that are one pixel wide, sides that are right, normals where the gradient vanishes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from tests.gpus import no_gpu

import zeroset as zs
from zeroset.kernel import Kernel
from zeroset.runtime import Program
from zeroset.runtime.cache import Cache
from zeroset.runtime.cpu import CpuDevice

Array = np.ndarray[Any, Any]
DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.skipif(bool(no_gpu()), reason=no_gpu() or "there is one"))]


def directions(camera: zs.Camera, size: int) -> tuple[Array, Array]:
    """Unit directions and origins of the pixels' rays, in rows."""
    eye, across, upwards, forward, right, up = map(np.array, camera.rays(size, size))
    middles = (np.arange(size) + 0.5) * 2 / size - 1
    u, v = middles[None, :, None], -middles[:, None, None]
    ways = forward + u * right + v * up
    return eye + u * across + v * upwards, ways / np.linalg.norm(ways, axis=-1, keepdims=True)


def test_a_cuspidal_rim_is_no_wider_than_what_of_it_is_in_a_pixel() -> None:
    """A lens whose edge is a cusp: f is tiny all around it, and an affine form cannot tell its square from its cube."""
    lens = zs.surface("4(x^2 + y^2 + z^2 - 1)^3 + 27(x^2 - y^2 + 3z)^2", bounds=1.3)
    camera = zs.Camera(eye=(2.0, -3.0, 1.5), fov=30)
    size = 256
    image = zs.render(lens, size, camera, device="cpu")
    origins, ways = directions(camera, size)
    # The rim is the curve x^2 - y^2 + 3z = 0 on the unit sphere.
    angle = np.linspace(0, 2 * np.pi, 20000)
    squares = np.cos(2 * angle) / 3
    flat = np.sqrt((np.sqrt(1 + 4 * squares**2) - 1) / (2 * squares**2 + 1e-300))
    rim = np.stack([flat * np.cos(angle), flat * np.sin(angle), -squares * flat**2], axis=-1)
    assert np.allclose(np.linalg.norm(rim, axis=-1), 1.0, atol=1e-6)
    pixel = 2 * np.tan(np.radians(15)) / size
    seen = rim - origins[0, 0]
    seen /= np.linalg.norm(seen, axis=-1, keepdims=True)
    thin = image.aov("status") == zs.UNRESOLVED
    off = np.array([np.min(np.linalg.norm(seen - way, axis=-1)) for way in ways[thin]])
    assert thin.sum() > 50
    # A pixel reaches 0.71 of its side to a corner.
    assert off.max() < 1.25 * pixel
    assert np.mean(off < 0.8 * pixel) > 0.9


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize(("name", "outside"), [("barth-sextic", -1), ("cushion", -1), ("steiner", 1), ("hunt", 1)])
def test_thin_parts_show_the_side_that_the_rays_beside_them_are_on(name: str, outside: int, device: str) -> None:
    surface = zs.gallery[name]
    camera, size = surface.camera, 192
    assert camera is not None
    image = zs.render(surface, size, device=device)
    thin = (image.aov("status") == zs.UNRESOLVED) & (
        zs.render(surface, size, thin=False, device=device).aov("status") == 0
    )
    along = np.einsum("ij,ij->i", image.aov("normal")[thin], directions(camera, size)[1][thin])
    assert thin.sum() > 3
    # Where f is above 0 outside, the gradient points towards the eye; a form in f32 does not know f's sign everywhere.
    assert np.mean(along * outside <= 1e-6) >= (1.0 if device == "cpu" else 0.8)


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("size", [200, 333, 512])
def test_a_neck_thinner_than_a_pixel_has_no_gap(size: int, device: str) -> None:
    """Along it f grows in every point of a pixel, as it does beside a silhouette."""
    rows = zs.render(zs.gallery["kiss"], size, device=device).aov("status").any(axis=1)
    first, *_, last = np.flatnonzero(rows)
    assert last - first > size // 2
    assert rows[first : last + 1].all()


@pytest.mark.parametrize(("name", "most"), [("tangle", 0), ("clebsch", 0), ("torus", 0), ("chmutov-12", 1)])
def test_beside_silhouettes_nothing_is_thin(name: str, most: int) -> None:
    """In a pixel of Chmutov's no step is fine enough to show that a derivative keeps its sign: a sheet ends there."""
    assert zs.render(zs.gallery[name], 200, device="cpu").unresolved <= most


@pytest.mark.parametrize("name", ["heart", "heart-nordstrand"])
def test_normals_are_smooth_where_the_gradient_vanishes(name: str) -> None:
    surface = zs.gallery[name]
    # A narrow stripe along z = 0.
    image = zs.render(surface, 256, zs.Camera(eye=(0.5, -3.0, 0.0), target=(0.0, 0.0, 0.0), fov=2), device="cpu")
    normal, found = image.aov("normal"), image.aov("status") == zs.HIT
    assert found.all()
    beside = np.einsum("ijk,ijk->ij", normal[1:], normal[:-1])
    # Seen so close the surface is flat: from pixel to pixel a normal hardly turns.
    assert beside.min() > 0.98


def test_what_has_nothing_thin_needs_no_program_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    # A device of its own: programs of pictures before may still be under way on the common one.
    device, made = CpuDevice(cache=Cache(None)), []
    known = device.compile_cached

    def note(key: str, build: Callable[[], Kernel], quick: bool = False) -> Program:
        made.append(key.split()[0])
        return known(key, build, quick)

    monkeypatch.setattr(device, "compile_cached", note)
    zs.render(zs.surface("x^2 + y^2 + 1.5z^2 = 1.01", bounds=1.5), 64, device=device)
    assert "beams" in made
    assert "parts" not in made
    zs.render(zs.surface("1.01x^2 + y^2 = 0", bounds=1.5), 64, device=device)
    assert "parts" in made


@pytest.mark.parametrize(
    "formula",
    ["max(|x|, |y|, |z|) = 0.8", "|x| + |y| + |z| = 1", "max(x + y + z, x - y - z, y - x - z, z - x - y) = 0.6"],
)
@pytest.mark.parametrize("size", [160, 161, 240])
def test_corners_of_polyhedra_are_no_thin_parts(formula: str, size: int) -> None:
    """All faces of a corner fall off behind it, if only along a diagonal; a pixel that it hardly touches is no hit."""
    image = zs.render(zs.surface(formula, bounds=2.0), size, device="cpu")
    assert image.hits > 1000
    assert image.unresolved <= 4
