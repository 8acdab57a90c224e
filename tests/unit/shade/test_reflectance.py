from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from zeroset.kernel import F32, KernelBuilder, interp, load, store
from zeroset.shade.power import shine
from zeroset.shade.reflectance import blinn_phong, normalised

Array = np.ndarray[Any, Any]
MATERIAL = {
    **{"front_r": 0.9, "front_g": 0.5, "front_b": 0.1, "back_r": 0.2, "back_g": 0.3, "back_b": 0.8},
    **{"ambient": 0.1, "diffuse": 0.7, "specular": 0.4, "shininess": 30.0},
}
LIGHTS = np.array([[0.6, 0.0, 0.8, 1.0, 0.9, 0.8], [0.0, -0.6, -0.8, 0.2, 0.3, 0.4]])


def shaded(normals: Array, eyes: Array, lights: Array = LIGHTS) -> Array:
    """The kernel's colours."""
    count = len(normals)
    with KernelBuilder("shade") as builder:
        lane = builder.index()
        normal, eye = ([load(builder.buffer(f"{n}{i}", F32), lane) for i in range(3)] for n in "ne")
        sources = [[builder.uniform(f"l{i}{k}", F32) for k in range(6)] for i in range(len(lights))]
        color = blinn_phong(lambda name: builder.uniform(name, F32), normal, eye, sources)
        for name, value in zip("rgb", color, strict=True):
            store(builder.buffer(name, F32, writable=True), lane, value)
    buffers = {f"{n}{i}": v[:, i].astype(np.float32) for n, v in (("n", normals), ("e", eyes)) for i in range(3)}
    buffers |= {name: np.zeros(count, np.float32) for name in "rgb"}
    uniforms = MATERIAL | {f"l{i}{k}": float(light[k]) for i, light in enumerate(lights) for k in range(6)}
    interp.run(builder.kernel, count, uniforms, buffers)
    return np.stack([buffers[name] for name in "rgb"], axis=1)


def expected(normals: Array, eyes: Array) -> Array:
    """Blinn-Phong as the textbooks have it."""
    colors = []
    for normal, eye in zip(normals, eyes, strict=True):
        side = "back" if normal @ eye < 0 else "front"
        n = -normal if side == "back" else normal
        base = np.array([MATERIAL[f"{side}_{c}"] for c in "rgb"])
        color = base * MATERIAL["ambient"]
        for light in LIGHTS:
            lambert = max(0.0, n @ light[:3])
            half = light[:3] + eye
            half /= np.linalg.norm(half)
            highlight = max(0.0, n @ half) ** MATERIAL["shininess"] * MATERIAL["specular"] if lambert > 0 else 0.0
            color = color + light[3:] * (base * MATERIAL["diffuse"] * lambert + highlight)
        colors.append(color)
    return np.array(colors)


def directions(count: int, seed: int) -> Array:
    made = np.random.default_rng(seed).normal(size=(count, 3))
    return made / np.linalg.norm(made, axis=1, keepdims=True)


def test_blinn_phong_on_both_sides() -> None:
    normals, eyes = directions(400, 1), directions(400, 2)
    assert np.allclose(shaded(normals, eyes), expected(normals, eyes), atol=2e-4)


def test_a_point_without_gradient_is_lit_as_if_it_faced_the_viewer() -> None:
    eyes = directions(50, 3)
    assert np.allclose(shaded(np.zeros_like(eyes), eyes), expected(eyes, eyes), atol=2e-4)


def test_no_light_leaves_the_ambient_colour() -> None:
    color = shaded(np.array([[0.0, 0, 1]]), np.array([[0.0, 0, 1]]), LIGHTS[:0])
    assert color[0] == pytest.approx([0.09, 0.05, 0.01])


def test_a_light_opposite_the_viewer_makes_no_nan() -> None:
    light = np.array([[0.0, 0.0, -1.0, 1, 1, 1]])
    assert np.all(np.isfinite(shaded(directions(20, 4), np.array([[0.0, 0, 1]] * 20), light)))


@pytest.mark.parametrize("exponent", [0.5, 1.0, 40.0, 10000.0])
def test_the_power_of_the_highlight(exponent: float) -> None:
    cosines = np.linspace(-1, 1.0001, 301).astype(np.float32)
    with KernelBuilder("shine") as builder:
        lane = builder.index()
        value = shine(load(builder.buffer("x", F32), lane), builder.uniform("e", F32))
        store(builder.buffer("out", F32, writable=True), lane, value)
    out = np.zeros(301, np.float32)
    interp.run(builder.kernel, 301, {"e": exponent}, {"x": cosines, "out": out})
    truth = np.clip(cosines.astype(float), 0, 1) ** exponent
    assert np.allclose(out, np.where(cosines > 1e-8, truth, 0), atol=1e-3)


def test_vectors_are_normalised_and_zero_stays_zero() -> None:
    with KernelBuilder("unit") as builder:
        lane = builder.index()
        vector = normalised([load(builder.buffer(f"v{i}", F32), lane) for i in range(3)])
        for i, value in enumerate(vector):
            store(builder.buffer(f"o{i}", F32, writable=True), lane, value)
    values = np.array([[3, 0, 4], [0, 0, 0], [1e-6, 0, 0], [1e6, 1e6, 0]], np.float32)
    buffers = {f"v{i}": values[:, i].copy() for i in range(3)} | {f"o{i}": np.zeros(4, np.float32) for i in range(3)}
    interp.run(builder.kernel, 4, {}, buffers)
    out = np.stack([buffers[f"o{i}"] for i in range(3)], axis=1)
    assert np.allclose(np.linalg.norm(out, axis=1), [1, 0, 1, 1], atol=1e-5)
