from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import zeroset as zs
from zeroset.errors import FormulaError, ParameterError, SceneFileError
from zeroset.scene.colored import suited
from zeroset.scene.coloring import QUANTITIES, as_coloring
from zeroset.scene.file import dumps, loads

BALL = zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 1.0})


def test_what_is_chosen_by_default() -> None:
    assert zs.Coloring("mean-curvature").chosen_map == "coolwarm"
    assert zs.Coloring("depth").chosen_map == "lagoon"
    assert zs.Coloring("x*y").chosen_map == "lagoon"
    assert zs.Coloring("x*y", "earth").centred
    assert not zs.Coloring("x*y").centred
    assert zs.Coloring("gaussian-curvature", "gray").centred
    assert zs.Coloring("x", "wheel").cyclic
    assert zs.Coloring("x", range=[0, 1]).range == (0.0, 1.0)  # type: ignore[arg-type]
    assert zs.Material(coloring="steps").coloring == zs.Coloring("steps")  # type: ignore[arg-type]
    assert as_coloring(None) is None


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"by": ""}, "must be text"),
        ({"by": 3}, "must be text"),
        ({"by": "x", "map": "rainbow"}, "no colour map 'rainbow'"),
        ({"by": "x", "range": (1, 1)}, "begin below its end"),
        ({"by": "x", "range": (1,)}, "two numbers"),
        ({"by": "x", "range": 5}, "two numbers"),
        ({"by": "x", "range": ("a", 2)}, "must be a number"),
        ({"by": "x", "range": (0, float("inf"))}, "must be finite"),
    ],
    ids=str,
)
def test_colorings_that_cannot_be(wrong: dict[str, Any], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        zs.Coloring(**wrong)


def test_a_scene_looks_at_the_formula() -> None:
    shells = BALL.with_isovalues((0.0, 0.5))
    for by in (*QUANTITIES, "r*x + w", "atan2(y, x)"):
        assert zs.Scene(shells, material=zs.Material(coloring=zs.Coloring(by))).material.coloring is not None
    with pytest.raises(FormulaError, match="value is missing"):
        zs.Scene(BALL, material=zs.Material(coloring=zs.Coloring("x +")))


def test_which_surfaces_are_coloured() -> None:
    plane, by = zs.surface("x + y + z"), zs.Material(coloring=zs.Coloring("r*x"))
    shells = plane.with_isovalues((0.0, 0.5))
    things = [BALL - plane, shells, BALL.with_material(zs.Material())]
    for given, shown in (("z", (True, True, True, False)), ("r*x", (True, False, False, False))):
        found = zs.Scene(things, material=zs.Material(coloring=given)).colored  # type: ignore[arg-type]
        assert found is not None
        assert (found.coloring, found.shown, found.range) == (zs.Coloring(given), shown, None)
    alone = zs.Scene([plane, BALL.with_material(by)]).colored
    assert alone is not None
    assert alone.shown == (False, True)
    levels = zs.Scene(
        [BALL, shells, shells.with_isovalues(2.0)], material=zs.Material(coloring=zs.Coloring("isovalue"))
    )
    assert levels.colored is not None
    assert (levels.colored.shown, levels.colored.range) == ((False, True, True), (0.0, 2.0))
    assert zs.Scene([plane, BALL]).colored is None
    # A material that nothing has colours nothing.
    assert zs.Scene(BALL.with_material(zs.Material()), material=by).colored is None


def test_what_suits_a_surface() -> None:
    other = zs.surface("x + y + z")
    for coloring in (None, zs.Coloring("steps"), zs.Coloring("w*x")):
        assert suited(coloring, other) is coloring
    assert suited(zs.Coloring("r*x"), BALL) == zs.Coloring("r*x")
    assert suited(zs.Coloring("r*x"), other) is None


@pytest.mark.parametrize(
    "coloring", [zs.Coloring("gaussian-curvature", "earth", (-2.5, 2)), zs.Coloring("r*x"), zs.Coloring()], ids=repr
)
def test_scene_files_keep_it(coloring: zs.Coloring, tmp_path: Path) -> None:
    scene = zs.Scene(BALL, material=zs.Material(coloring=coloring, shininess=10))
    assert zs.load(zs.save(scene, tmp_path / "scene.toml")) == scene
    assert dumps(loads(dumps(scene))) == dumps(scene)


@pytest.mark.parametrize("coloring", [zs.Coloring("gradient", "earth", (-2.5, 2)), zs.Coloring("r*x")], ids=repr)
def test_scene_files_keep_it_on_one_of_several(coloring: zs.Coloring, tmp_path: Path) -> None:
    own, plane = BALL.with_material(zs.Material(coloring=coloring)), zs.surface("x + y + z")
    for things in ([plane, own], [plane - own, plane.with_isovalues(1.0)], plane & own):
        for usual in (zs.Material(), zs.Material(coloring=coloring)):
            scene = zs.Scene(things, material=usual)  # type: ignore[arg-type]
            again = zs.load(zs.save(scene, tmp_path / "scene.toml"))
            assert again == scene
            assert again.colored == scene.colored


def test_the_short_form_and_files_without_any() -> None:
    short = loads('formula = "x^2 + y + z"\nmaterial = {coloring = "depth"}')
    assert short.material.coloring == zs.Coloring("depth")
    assert "coloring" not in dumps(zs.Scene(BALL))


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ('[material]\ncoloring = "gausian-curvature"', 3, "did you mean gaussian-curvature"),
        ('[material]\nshininess = 3\n[material.coloring]\nby = "x + q"', 5, "unknown name q"),
        ('[material.coloring]\nby = "x"\nmap = "viridis"', 4, "lagoon is much like it"),
        ('[material.coloring]\nby = "x"\nrange = [2, 1]', 4, "begin below its end"),
        ('[material.coloring]\nby = "x"\nrnage = [1, 2]', 4, "did you mean range"),
        ("[material]\ncoloring = 3", 3, "coloring must be text"),
    ],
)
def test_mistakes_are_named_with_file_and_line(text: str, line: int, said: str) -> None:
    with pytest.raises(SceneFileError, match=said) as caught:
        loads('formula = "x^2 + y + z"\n' + text, "my.toml")
    assert caught.value.line == line


TWO = """[[surfaces]]
name = "ball"
formula = "x^2 + y^2 + z^2 = r"
params = {r = 1}
material = {coloring = "r*x"}
[[surfaces]]
formula = "z"
"""


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ('material = {coloring = "z"}', 8, "one coloring, and its surfaces have two"),
        ("[surfaces.material.coloring]\nby = 'r*x'\nmap = 'gray'", 9, "one coloring, and its surfaces have two"),
        ("[surfaces.material]\ncoloring = 'r*y +'", 9, "one coloring, and its surfaces have two"),
        ("material = {coloring = 'r*x'}", None, ""),
    ],
)
def test_mistakes_among_several_are_named_with_file_and_line(text: str, line: int | None, said: str) -> None:
    if line is None:
        assert loads(TWO + text).surface.surfaces[1].material == zs.Material(coloring=zs.Coloring("r*x"))
        return
    with pytest.raises(SceneFileError, match=said) as caught:
        loads(TWO + text, "my.toml")
    assert caught.value.line == line


def test_a_formula_that_means_nothing_is_named_with_its_line() -> None:
    with pytest.raises(SceneFileError, match="unknown name k") as caught:
        loads(TWO.replace("r*x", "k*x"), "my.toml")
    assert caught.value.line == 5
    assert "the surface's parameters: r" in str(caught.value)
