"""What scene files draw: isovalues, solids, several surfaces; written back the same, and wrong ones named."""

from __future__ import annotations

from pathlib import Path

import pytest

import zeroset as zs
from zeroset.errors import SceneFileError
from zeroset.scene.file import dumps, loads
from zeroset.scene.several import Several
from zeroset.scene.solid import Solid

BALL = zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 1.5}, name="ball")
TUBE = zs.surface("x^2 + y^2 = 0.2", name="a-tube")
NAMELESS = zs.surface("x + y = 0.1", bounds=2.0)
ROW = zs.surface("sum(i, 1/((x - c[i])^2 + y^2 + z^2)) = 4", {"c": [-0.5, 0.5]}, bounds=zs.Box((-2, -1, -1), (2, 1, 1)))
RED = zs.Material(front=(1, 0, 0), reflectance=0.25)
SCENES = {
    "isovalues": zs.Scene(BALL.with_isovalues((2, -1), ((1, 0, 0), (0, 1, 0)))),
    "a material": zs.Scene(BALL.with_material(RED)),
    "a solid": zs.Scene(BALL - TUBE),
    "a solid with all": zs.Scene(
        Solid("and", (BALL.with_material(RED) - TUBE, ~NAMELESS | ROW), zs.Ball(2.0, (0, 0, 1)), None, "hull"),
        zs.Camera(eye=(1, 2, 9)),
        shadows=True,
    ),
    "several": zs.Scene([BALL, NAMELESS, ROW.with_isovalues((0.0, 1.0)).with_material(RED)], background=(0, 0, 0)),
    "several solids": zs.Scene([BALL - TUBE, (TUBE & NAMELESS).with_bounds(1.0), BALL, NAMELESS]),
}


@pytest.mark.parametrize("name", SCENES)
def test_what_is_written_is_read_back_the_same(name: str, tmp_path: Path) -> None:
    scene = SCENES[name]
    again = zs.load(zs.save(scene, tmp_path / "scene.toml"))
    assert dumps(again) == dumps(scene)
    if name != "several solids":
        assert again == scene
    else:
        # The ball is drawn and is part of a solid as well: there it has lost its name, and nothing else.
        things, before = again.surface, scene.surface
        assert isinstance(things, Several)
        assert isinstance(before, Several)
        assert [thing.name for thing in things] == [thing.name for thing in before]
        assert [s.field.digest for s in things.surfaces] == [s.field.digest for s in before.surfaces]


def test_a_gallery_solid_comes_back(tmp_path: Path) -> None:
    solid = zs.gallery.solids["icos-csg"]
    scene = zs.load(zs.save(solid, tmp_path / "icos.toml"))
    assert scene.camera == solid.camera
    assert isinstance(scene.surface, Solid)
    assert scene.materials == solid.materials(zs.Material())
    assert scene.surface.surfaces == solid.surfaces
    assert scene.surface.bounds == solid.bounds


FILE = """
shadows = true
solid = "(ball & cube) - 'the hole'"
bounds = 1.3
material = {shininess = 9}

[[surfaces]]
name = "ball"
formula = "x^2 + y^2 + z^2 = r^2"
params = {r = 1.25}
material = {front = [1, 0, 0]}

[[surfaces]]
name = "x side"
formula = "|x| = 1"

[[surfaces]]
name = "y side"
formula = "|y| = 1"

[[surfaces]]
name = "cube"
solid = "'x side' & 'y side'"

[[surfaces]]
name = "the hole"
formula = "x^2 + y^2 = 0.2"
"""


def test_a_solid_of_solids() -> None:
    scene = loads(FILE)
    assert isinstance(scene.surface, Solid)
    assert [surface.name for surface in scene.surface.surfaces] == ["ball", "x side", "y side", "the hole"]
    assert scene.surface.bounds == zs.Ball(1.3)
    assert [material.shininess for material in scene.materials] == [40.0, 9.0, 9.0, 9.0]
    hits = zs.cast(scene, [-5, 0.8, 0.1], [1, 0, 0], device="cpu")
    # Beside the ball's edge: (0.8, 0.1) is 0.955 in from the ball's middle, and the cube begins at -1.
    assert hits.part.tolist() == [0]
    assert abs(float(hits.t[0]) - (5 - (1.25**2 - 0.65) ** 0.5)) < 1e-3


def test_what_no_solid_uses_is_drawn_by_itself() -> None:
    text = FILE.replace("solid = \"(ball & cube) - 'the hole'\"\nbounds = 1.3\n", "")
    scene = loads(text)
    assert isinstance(scene.surface, Several)
    assert [thing.name for thing in scene.surface] == ["ball", "cube", "the hole"]


def test_solids_may_share_surfaces_and_be_drawn_beside_each_other() -> None:
    text = TWO + '[[surfaces]]\nsolid = "a - b"\n[[surfaces]]\nsolid = "a & b"\n[[surfaces]]\nformula = "z"\n'
    drawn = loads(text).surface
    assert isinstance(drawn, Several)
    assert len(drawn) == 3


ONE = '[[surfaces]]\nname = "a"\nformula = "x"\n'
TWO = ONE + '[[surfaces]]\nname = "b"\nformula = "y"\n'
CIRCLE = '[[surfaces]]\nname = "s"\n\nsolid = "a - t"\n[[surfaces]]\nname = "t"\nsolid = "a | s"\n'


def test_a_name_that_several_have_is_kept_by_the_first() -> None:
    ball = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5, name="ball")
    again = loads(dumps([ball, ball.with_bounds(2.0), (ball & zs.surface("x", name="half"))]))
    assert isinstance(again.surface, Several)
    first, second, solid = again.surface
    assert [first.name, second.name, solid.name] == ["ball", "", ""]
    assert [part.formula for part in solid.surfaces] == [ball.formula, "x"]


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("surfaces = 3", 1, "list of tables"),
        ("surfaces = []", 1, "nothing to draw"),
        ('formula = "x"\n' + ONE, 1, "not both"),
        ('formula = "x"\nsolid = "a"', 1, "not both"),
        ('solid = ""\n' + ONE, 1, "empty"),
        ('solid = "a & c"\n' + ONE, 1, "no surface named 'c'"),
        ('solid = "a + b"\n' + TWO, 1, "cannot be part"),
        ('solid = "a"\n' + TWO, 1, "'b' is no part"),
        ("solid = 3\n" + ONE, 1, "solid must be text"),
        ('solid = "~a"\nbounds = -1\n' + ONE, 2, "radius"),
        ('solid = "~a"\nparams = {r = 1}\n' + ONE, 2, "no params of its own"),
        ("bounds = 2\n" + TWO, 1, "belongs to one surface"),
        (ONE + ONE, 5, "two surfaces named 'a'"),
        (ONE + '[[surfaces]]\nname = "b"\n', 4, "a formula or a solid"),
        (ONE + '[[surfaces]]\nname = "b"\nformula = "x +"\n', 6, "value is missing"),
        (ONE + '[[surfaces]]\nname = "b"\nformula = "x"\nbounds = 0\n', 7, "radius"),
        (ONE + '[[surfaces]]\nname = "b"\nformula = "x"\nsize = 0\n', 7, "surface has no 'size'"),
        (ONE + '[[surfaces]]\nname = "s"\nsolid = "a - s"\n', 6, "'s' would be part of itself"),
        (
            ONE + '[[surfaces]]\nname = "s"\nsolid = "a - t"\n' + ONE.replace('"a"', '"t"'),
            6,
            r"'t' stands after this solid(.|\n)*put it before",
        ),
        (ONE + CIRCLE, 7, r"'s' would be part of itself, by way of 't'(.|\n)*leave it out"),
        ('[[surfaces]]\nsolid = "a - u"\n' + ONE, 2, "'a' stands after this solid"),
        (ONE + '[[surfaces]]\nname = "s"\nsolid = "a - u"\n' + ONE.replace('"a"', '"t"'), 6, "no surface named 'u'"),
        (ONE + '[[surfaces]]\nname = "s"\nsolid = "a - ("\n', 6, "this is no solid"),
        (ONE + '[[surfaces]]\nsolid = "~a"\nmaterial = {ior = 2}\n', 6, "no material of its own"),
        ('formula = "x"\nisovalues = [1, 1]', 2, "twice"),
        ('formula = "x"\nisovalues = "a"', 2, "isovalue"),
        ('formula = "x"\ncolors = [[1, 0, 0]]', 2, "colors are those of isovalues"),
        ('formula = "x"\nisovalues = [1]\ncolors = [[1, 0]]', 3, "three numbers"),
        ('solid = "a - b"\n' + TWO + "isovalues = [1, 2]\n", 1, "isovalues"),
        ("\n".join(f'[[surfaces]]\nformula = "x = {i}"' for i in range(33)), 1, "at most 32"),
    ],
)
def test_mistakes_are_named_with_file_and_line(text: str, line: int | None, said: str) -> None:
    with pytest.raises(SceneFileError, match=said) as caught:
        loads(text, "my.toml")
    assert caught.value.path == "my.toml"
    assert caught.value.line == line
