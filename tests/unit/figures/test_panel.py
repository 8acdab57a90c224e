from __future__ import annotations

import numpy as np
import pytest

import zeroset as zs
from zeroset.figures import Panel, find
from zeroset.figures.panel import draw_panel, magnified, wrong_pixels
from zeroset.rendering.frame import settle
from zeroset.runtime import get_device

SIZE = (24, 24)


def drawn(label: str = "", **settings: object) -> tuple[np.ndarray, str]:
    pixels, said = draw_panel(Panel(label, settings), SIZE, get_device("cpu"))
    return np.asarray(pixels), said


def test_a_panel_is_what_render_draws():
    pixels, label = drawn("a ball", surface="sphere")
    assert np.array_equal(pixels, zs.render(zs.gallery["sphere"], SIZE, device="cpu").pixels)
    assert label == "a ball"


def test_settings_reach_the_picture():
    plain, _ = drawn(surface="tangle")
    for change in (
        {"background": [0, 0, 0]},
        {"orbit": 30.0},
        {"camera": {"fov": 50.0}},
        {"params": {"r": 4.0}},
        {"material": {"front": [0.1, 0.9, 0.1]}},
        {"material": {"coloring": "gradient"}},
        {"isovalues": [-3.0, 2.0]},
        {"lights": [{"direction": [1, 0, 0]}]},
        {"method": {"name": "marching-points", "offset": 3.0}},
    ):
        changed, _ = drawn(surface="tangle", **change)
        assert not np.array_equal(changed, plain), change


def test_a_solid_and_a_formula():
    assert len(np.unique(drawn(solid="sesc-csg")[0])) > 5
    assert len(np.unique(drawn(formula="x^2 + y^2 + z^2 - 1", bounds=1.2)[0])) > 5


def test_numbers_in_labels_are_measured():
    image = zs.render(zs.gallery["sphere"], SIZE, device="cpu", method="marching-points")
    _, label = drawn("{steps} a ray", surface="sphere", method={"name": "marching-points"})
    assert label == f"{image.aov('steps').mean():.1f} a ray"
    _, label = drawn("{open}", surface="sphere", method={"name": "interval"}, bits=1, draft=True, thin=False)
    assert label == "100%"
    _, label = drawn("{wrong}", surface="sphere")
    assert label == "0"


@pytest.mark.parametrize(("name", "place"), [("k09-5", 0), ("k09-5", 8), ("k09-6", 1)])
def test_a_panel_is_the_same_whatever_is_compiled_by_then(name: str, place: int):
    panel, size, device = find(name).panels[place], (96, 96), get_device("cpu")
    first, label = draw_panel(panel, size, device)
    settle()
    again, same = draw_panel(panel, size, device)
    assert np.array_equal(first, again)
    assert label == same


def test_wrong_pixels_are_counted():
    ball = zs.gallery["sphere"]
    truth = zs.render(ball, SIZE, thin=False, device="cpu")
    assert wrong_pixels(truth, truth) == 0
    empty = zs.render(ball, SIZE, method=zs.methods.MarchingPoints(steps=1), device="cpu")
    assert wrong_pixels(empty, truth) == truth.hits - empty.hits > 0
    larger = zs.render(ball.with_params(r=1.04), SIZE, thin=False, device="cpu")
    assert wrong_pixels(larger, truth) >= truth.hits


def test_a_part_is_magnified():
    pixels = np.arange(4 * 4 * 3, dtype=np.uint8).reshape(4, 4, 3)
    assert np.array_equal(magnified(pixels, (0.0, 0.0, 1.0)), pixels)
    part = magnified(pixels, (0.5, 0.25, 0.5))
    assert np.array_equal(part[0, 0], pixels[1, 2])
    assert np.array_equal(part[3, 3], pixels[2, 3])


def test_a_legend_is_drawn():
    material = {"coloring": {"by": "depth", "range": [2.0, 4.0]}}
    wide = (160, 160)
    plain, _ = draw_panel(Panel("", {"surface": "sphere", "material": material}), wide, get_device("cpu"))
    legend, _ = draw_panel(
        Panel("", {"surface": "sphere", "material": material, "legend": True}), wide, get_device("cpu")
    )
    assert not np.array_equal(plain[:, 100:], legend[:, 100:])
    assert np.array_equal(plain[:, :60], legend[:, :60])
