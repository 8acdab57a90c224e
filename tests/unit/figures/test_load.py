from __future__ import annotations

import dataclasses
import string

import pytest

import zeroset as zs
from zeroset.errors import UnknownFigureError
from zeroset.export.film.named import names as animations
from zeroset.expr.polynomial import polynomial
from zeroset.figures import Panel, find, names
from zeroset.figures.entry import NUMBERS, SETTINGS
from zeroset.figures.load import DIAGRAMS
from zeroset.figures.subject import method_of, scene_of, tolerance_of

FIGURES = [
    *(f"sn10-{n}" for n in (1, 4, 5, 6, 8, 9, 10, 11, 12, 13)),
    *(f"k09-{n}" for n in (1, 5, 6, 7, 8, 9, 10, 11)),
]
PANELS = [(name, i, panel) for name in FIGURES for i, panel in enumerate(find(name).panels)]


def test_every_figure_with_surfaces_is_there():
    assert list(names()) == FIGURES
    assert not set(DIAGRAMS) & set(names())


@pytest.mark.parametrize(("name", "place", "panel"), PANELS, ids=[f"{n}-{i}" for n, i, _ in PANELS])
def test_every_panel_can_be_read(name: str, place: int, panel: Panel):
    settings = panel.settings
    assert set(settings) <= set(SETTINGS) - {"label"}
    sources = {"surface", "animation", "solid"} & set(settings)
    assert len(sources) == 1, f"{sources} say what is drawn"
    assert "formula" not in settings or "surface" in settings
    assert "animation" in settings or "at" not in settings
    assert settings.get("animation") in (*animations(), None)
    scene = scene_of(settings)
    method = method_of(settings)
    if isinstance(scene.surface, zs.Surface):
        method.check(scene.surface.field)
    tolerance = tolerance_of(settings, scene.surface)
    assert (tolerance is None) == ("bits" not in settings)
    if "crop" in settings:
        left, top, width = settings["crop"]
        assert 0 <= left < left + width <= 1
        assert 0 <= top < top + width <= 1
    fields = {field for _, field, _, _ in string.Formatter().parse(panel.label) if field is not None}
    assert fields <= set(NUMBERS)


@pytest.mark.parametrize("name", FIGURES)
def test_every_text_is_in_letters_that_the_font_has(name: str):
    figure = find(name)
    texts = [figure.title, *(row.title for row in figure.rows), *(panel.label for panel in figure.panels)]
    assert all(text.isascii() for text in texts)
    assert figure.title
    assert all(panel.label for panel in figure.panels)


def test_precision_is_a_part_of_the_extent():
    panel = next(panel for panel in find("k09-5").panels if panel.settings["bits"] == 11)
    scene = scene_of(panel.settings)
    assert tolerance_of(panel.settings, scene.surface) == scene.surface.fitted.extent / 2048


def test_rows_without_panels_have_the_figure_s_own():
    figure = find("sn10-6")
    assert [len(row.panels) for row in figure.rows] == [4, 4, 4, 4]
    assert {panel.settings["surface"] for panel in figure.rows[2].panels} == {"steiner", "cross-cap", "miter", "kiss"}
    assert figure.rows[1].panels[0].settings["method"]["offset"] == 0.01
    tests = [row.panels[0].settings["method"].get("test") for row in figure.rows]
    assert tests == ["sign", "sign", "taylor", None]


def test_the_nearest_settings_win():
    off, on = find("sn10-4").panels[0].settings["method"], find("sn10-4").panels[3].settings["method"]
    assert off == {**on, "silhouettes": False}


@pytest.mark.parametrize(("place", "order"), [(0, 20), (3, 22), (4, 30)])
def test_chmutov_by_powers_is_the_same_polynomial(place: int, order: int):
    panel = find("sn10-11").rows[0].panels[place]
    powers, known = scene_of(panel.settings).surface, zs.gallery[f"chmutov-{order}"]
    assert panel.settings["surface"] == known.name
    assert (powers.bounds, powers.field.degree) == (known.bounds, order)
    ours, theirs = polynomial(powers.field.expr), polynomial(known.field.expr)
    assert ours is not None
    assert theirs is not None
    assert ours.degrees == theirs.degrees == (order, order, order)
    corners = [(0, 0, 0), *(place for i in range(1, order + 1) for place in ((i, 0, 0), (0, i, 0), (0, 0, i)))]
    assert [ours.coefficient(*at) for at in corners] == [theirs.coefficient(*at) for at in corners]


def test_animations_move():
    first, second = (scene_of(panel.settings).surface for panel in find("sn10-10").panels[:2])
    assert list(first.arrays["cx"]) != list(second.arrays["cx"])


def test_entries_are_plain_values():
    assert dataclasses.is_dataclass(find("k09-8"))
    assert find(" K09-8 ") == find("k09-8")


@pytest.mark.parametrize(
    ("name", "said"), [("sn10-55", "did you mean"), ("sn10-7", "diagram"), ("", "lists all names")]
)
def test_what_is_no_figure_is_said(name: str, said: str):
    with pytest.raises(UnknownFigureError) as caught:
        find(name)
    assert said in str(caught.value)
    assert isinstance(caught.value, KeyError)
