"""The legend: what it says, where it is, and that it fits."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

import zeroset as zs
from zeroset.errors import ZerosetError
from zeroset.rendering.legend import Key, bar_colors, map_colors, with_legend
from zeroset.rendering.ticks import exact_labels, labels, ticks

KEY = Key("Gaussian curvature", "coolwarm", (-2.0, 2.0), below=True, above=True, missing=True)


def plain(size: tuple[int, int], shade: int) -> np.ndarray:
    return np.full((size[1], size[0], 3), shade, np.uint8)


@pytest.mark.parametrize("shade", [255, 8])
@pytest.mark.parametrize("size", [(1024, 1024), (640, 360), (200, 300), (100, 100), (48, 48), (20, 20), (300, 40)])
def test_it_fits_every_picture(size: tuple[int, int], shade: int) -> None:
    before = plain(size, shade)
    after = with_legend(before, KEY)
    assert after.shape == before.shape
    assert np.all(before == shade)
    changed = np.argwhere(np.any(after != shade, axis=-1))
    assert len(changed) > 20
    if min(size) >= 100:
        # It stands away from the borders, in the right half.
        assert changed.min(axis=0)[0] > 0
        assert changed.max(axis=0)[0] < size[1] - 1
        assert size[0] * 0.4 < changed.min(axis=0)[1]
        assert changed.max(axis=0)[1] < size[0] - 1


@pytest.mark.parametrize("shade", [255, 8])
def test_letters_can_be_read_on_light_and_on_dark(shade: int) -> None:
    made = with_legend(plain((600, 600), shade), KEY).astype(int)
    around, letters = made[560:595, 480:590].mean(axis=-1), made[380:, 440:].mean(axis=-1)
    assert abs(float(np.median(around)) - shade) < 40
    contrast = letters.max() if shade < 128 else 255 - letters.min()
    assert contrast > 180


def test_the_bar_runs_from_the_first_colour_at_the_bottom() -> None:
    made = with_legend(plain((600, 600), 255), Key("x", "gray", (0.0, 1.0)))
    bar = bar_colors("gray", 270)[::-1]
    places = [(x, y) for x in range(300, 600) for y in range(330) if np.array_equal(made[y : y + len(bar), x], bar)]
    assert len(places) >= 10
    assert len({y for _, y in places}) == 1
    assert bar[0].mean() > bar[-1].mean() + 150


@pytest.mark.parametrize("values", [(0.0,), (-4.0, 0.0, 0.5, 6.0), tuple(map(float, range(16)))])
@pytest.mark.parametrize("colors", ["lagoon", "wheel"])
def test_a_few_values_have_a_block_of_their_colour_each(values: tuple[float, ...], colors: str) -> None:
    range_ = (-2.0, 7.0)
    made = with_legend(plain((600, 600), 255), Key("isovalue", colors, range_, values=values))
    shares = (np.array(values) + 2.0) / 9.0
    expected = [tuple(c) for c in map_colors(colors, shares)[::-1].tolist()]
    assert sum(_run(made[:, x], expected) for x in range(300, 600)) >= 10


def _run(column: np.ndarray, expected: list[tuple[int, ...]]) -> bool:
    """Whether the colours of a column from its top are these, each over some pixels, and then no more of them."""
    seen = [tuple(c) for c in column.tolist() if tuple(c) in expected]
    kept = [c for i, c in enumerate(seen) if i == 0 or c != seen[i - 1]]
    return kept == [c for i, c in enumerate(expected) if i == 0 or c != expected[i - 1]]


def test_the_legend_of_isovalues_has_the_colours_that_the_surface_has() -> None:
    shells = zs.surface("x^2 + y^2 + z^2", bounds=zs.Box((-2, 0, -2), (2, 2, 2))).with_isovalues((0.25, 1.0, 2.25))
    flat = zs.Material(ambient=1.0, diffuse=0.0, specular=0.0, coloring="isovalue")
    image = zs.render(shells, 300, zs.Camera((0, -9, 0), (0, 0, 0), fov=25), material=flat, device="cpu")
    assert image.values == (0.25, 1.0, 2.25)
    legend = image.legend()
    for y, x in ((150, 150 + 17), (150, 150 + 50), (150, 150 + 100)):
        color = image.pixels[y, x].astype(int)
        near = np.abs(legend[:, 240:].astype(int) - color).max(axis=-1) <= 2
        assert near.sum() > 50
    assert zs.render(shells, 32, color_by="depth").values == ()


@pytest.mark.parametrize(
    ("values", "texts"),
    [
        ((0.0, 0.25, 1.0), ["0", "0.25", "1"]),
        ((-1.5, 0.0, 6.0), ["-1.5", "0", "6"]),
        ((1e-7, 2e7), ["1e-7", "2e7"]),
        ((0.12345678, 0.12345679), ["0.12345678", "0.12345679"]),
        ((1.0 / 3.0,), ["0.3333"]),
    ],
)
def test_values_that_somebody_chose_are_written_as_they_are(values: tuple[float, ...], texts: list[str]) -> None:
    assert exact_labels(values) == texts


def test_arrows_and_a_patch_only_where_there_is_something_to_say() -> None:
    blank = plain((600, 600), 255)
    quiet = with_legend(blank, Key("x", "ember", (0.0, 1.0)))
    for change in ({"below": True}, {"above": True}, {"missing": True}):
        assert not np.array_equal(with_legend(blank, Key("x", "ember", (0.0, 1.0), **change)), quiet)


def test_long_names_are_cut() -> None:
    made = with_legend(plain((300, 300), 255), Key("sin(3x)*cos(4y)*exp(-z^2) + x^2*y^2*z^2 - 17", "ember", (0.0, 1.0)))
    changed = np.argwhere(np.any(made != 255, axis=-1))
    assert changed.min(axis=0)[1] > 150


@pytest.mark.parametrize("most", [2, 4, 6, 9])
@pytest.mark.parametrize(
    "span", [(0.0, 1.0), (-2.0, 2.0), (-0.013, 0.4), (3.0, 4e6), (1e-9, 3e-9), (-7e12, 7e12), (5, 5.2)]
)
def test_round_numbers(span: tuple[float, float], most: int) -> None:
    low, high = span
    found = ticks(low, high, most)
    hair = 1e-6 * (high - low)
    assert len(found) <= most
    assert all(low - hair <= v <= high + hair for v in found)
    assert np.ptp(np.diff(found)) < hair if len(found) > 2 else True
    texts = labels(found)
    assert len(set(texts)) == len(texts)
    assert [float(t) for t in texts] == pytest.approx(found, abs=1e-3 * (high - low))
    assert max(map(len, texts), default=0) <= 10


def test_a_picture_with_its_legend(tmp_path: Path) -> None:
    image = zs.render("x^2 + y^2 + z^2 = 1", (320, 240), color_by="x + y")
    plainly = np.asarray(Pillow.open(image.save(tmp_path / "plain.png")))
    marked = np.asarray(Pillow.open(image.save(tmp_path / "marked.png", legend=True)))
    assert np.array_equal(plainly, image.pixels)
    assert np.array_equal(marked, image.legend())
    apart = np.any(plainly != marked, axis=-1)
    assert 0.02 < apart.mean() < 0.35
    assert not apart[:, :160].any()


def test_no_legend_without_a_coloring(tmp_path: Path) -> None:
    image = zs.render("x^2 + y^2 + z^2 = 1", 32)
    with pytest.raises(ZerosetError, match="no legend"):
        image.save(tmp_path / "none.png", legend=True)
    assert not (tmp_path / "none.png").exists()
