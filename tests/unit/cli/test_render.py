from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import zeroset as zs

Run = Callable[..., object]
BALL = "x^2 + y^2 + z^2 = 1"


def picture(path: Path) -> np.ndarray:  # type: ignore[type-arg]
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"))


def test_a_formula_becomes_a_picture(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("render", BALL, "-o", "ball.png", "-s", "40x30", "-b", "1.5")
    assert (ran.status, ran.err) == (0, "")
    assert ran.out.startswith("ball.png: 40x30, ")
    expected = zs.render(zs.surface(BALL, bounds=1.5), (40, 30))
    assert np.array_equal(picture(tmp_path / "ball.png"), expected.pixels)
    assert f"{expected.hits} pixels of surface" in ran.out
    assert list(tmp_path.iterdir()) == [tmp_path / "ball.png"]


def test_a_gallery_name_a_scene_file_and_what_changes_them(zeroset: Run, tmp_path: Path) -> None:
    assert zeroset("render", "clebsch", "-o", "a.png", "-s", "24", "--save-scene", "a.toml").status == 0
    assert zeroset("render", "a.toml", "-o", "b.png", "-s", "24").status == 0
    assert np.array_equal(picture(tmp_path / "a.png"), picture(tmp_path / "b.png"))
    assert zeroset("render", "a.toml", "-o", "c.png", "-s", "24", "--orbit", "30").status == 0
    assert not np.array_equal(picture(tmp_path / "a.png"), picture(tmp_path / "c.png"))
    assert zs.load(tmp_path / "a.toml").camera == zs.gallery["clebsch"].camera


def test_parameters_and_the_camera(zeroset: Run, tmp_path: Path) -> None:
    view = ("--eye", "0,-5,0", "--target", "0,0,0.5", "--up", "0,0,1", "--fov", "30")
    ran = zeroset(
        "render", "x^2 + y^2 + z^2 = a", "-p", "a=0.25", *view, "-o", "a.png", "-s", "24", "--save-scene", "s.toml"
    )
    assert ran.status == 0
    scene = zs.load(tmp_path / "s.toml")
    assert scene.surface.params["a"] == 0.25
    assert scene.camera == zs.Camera((0, -5, 0), (0, 0, 0.5), (0, 0, 1), 30)
    assert zeroset("render", "s.toml", "--height", "2", "-o", "b.png", "-s", "8", "--save-scene", "t.toml").status == 0
    assert zs.load(tmp_path / "t.toml").camera == zs.Camera((0, -5, 0), (0, 0, 0.5), (0, 0, 1), None, 2.0)
    blobs = "sum(i, 1/((x - c[i])^2 + y^2 + z^2)) = 4"
    ran = zeroset(
        "render", blobs, "-p", "c=-0.5,0.5", "-b", "-2,-2,-2,2,2,2", "-o", "c.png", "-s", "16", "--save-scene", "u.toml"
    )
    assert ran.status == 0
    assert zs.load(tmp_path / "u.toml").surface.arrays["c"].tolist() == [-0.5, 0.5]


def test_formulas_may_begin_with_a_minus_sign(zeroset: Run) -> None:
    for formula in ("-x^2 + y", "-(x + y)", "-sin(x) + y", "-2x + y", "- z + x"):
        ran = zeroset("render", formula, "-o", "a.png", "-s", "8", "-b", "2", "--eye", "-3,-4,2")
        assert ran.status == 0, formula
    assert zeroset("render", "-o", "a.png", "-s", "8", "-b", "2", "--", "-x + y").status == 0


def test_words_of_variables_are_formulas(zeroset: Run) -> None:
    assert zeroset("render", "xyz", "-o", "a.png", "-s", "8", "-b", "2").status == 0
    assert zeroset("render", "ab-x", "-p", "ab=0.5", "-o", "a.png", "-s", "8", "-b", "2").status == 0


def test_the_outputs_as_numbers(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("render", BALL, "-b", "1.5", "-o", "a.png", "-s", "16", "--save-outputs", "a.npz")
    assert ran.status == 0
    with np.load(tmp_path / "a.npz") as outputs:
        assert set(outputs) == {"depth", "normal", "status", "steps", "t"}
        assert outputs["normal"].shape == (16, 16, 3)


def test_an_empty_picture_says_so(zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("render", "x^2 + y^2 + z^2 + 1", "-o", "a.png", "-s", "16")
    assert ran.status == 0
    assert "certified: no ray meets a zero of f" in ran.err
    assert np.all(picture(tmp_path / "a.png") == 255)
    ran = zeroset("render", "x^2 + y^2 + z^2 + 1", "-m", "marching-points", "-o", "a.png", "-s", "16")
    assert "no ray meets" in ran.err
    assert "certified" not in ran.err
    # 0 where it ends to have a value: that is no certain emptiness.
    ran = zeroset("render", "sqrt(1 - x^2 - y^2 - z^2)", "-o", "a.png", "-s", "16")
    assert "no ray meets" in ran.err
    assert "write g = 0" in ran.err
    assert "certified" not in ran.err


def test_methods_have_options(zeroset: Run) -> None:
    ran = zeroset("render", BALL, "-m", "marching-points:test=taylor,steps=30", "-o", "a.png", "-s", "8", "-b", "1.5")
    assert ran.status == 0
    for method, said in (
        ("marching-points:tset=sign", "did you mean test"),
        ("marching-points:steps=many", "steps must be a finite number"),
        ("marching-points:test=gut", "test must be"),
        ("adaptive-marching-points:silhouettes=maybe", "silhouettes"),
        ("autoo", "did you mean 'auto'"),
    ):
        ran = zeroset("render", BALL, "-m", method, "-o", "b.png", "-s", "8", "-b", "1.5")
        assert ran.status == 2, method
        assert said in ran.err


BAD = [
    (["x^2 + "], ["a value is missing", "  x^2 + \n", "^", "hint:"]),
    (["sinn(x)"], ["unknown function sinn", "did you mean sin"]),
    (["a*x + y"], ["unknown name a", "-p a=1"]),
    (["sum(i, x - c[i])"], ["-p c=1.0,2.0"]),
    (["3"], ["none of the variables"]),
    (["x^(10^9)"], ["exponent", "too large"]),
    (["(" * 100_000 + "x" + ")" * 100_000], ["at most"]),
    (["(" * 20_000 + "x" + ")" * 20_000], ["nested too deeply"]),
    (["+".join(["x"] * 1_000_000)], ["at most"]),
    (["+".join(f"sin({i}x)" for i in range(2000))], ["too many operations"]),
    (["barth-sextik"], ["did you mean barth-sextic"]),
    (["foo"], ['the gallery has no surface "foo"']),
    (["sinx"], ["unknown name sinx", "  sinx\n", "^", "did you mean sin(x)?"]),
    (["sinx / pi"], ["unknown name sinx", "did you mean sin(x)?"]),
    (["cos2x-y"], ["unknown name cos2x", "did you mean cos(2x)?"]),
    (["pi"], ["none of the variables"]),
    (["foo.png"], ["'foo.png' is neither a formula nor a scene file", "end in .toml", "zeroset gallery"]),
    (["models/Cup.HF"], ["'models/Cup.HF' is neither", "end in .toml"]),
    ([__file__], ["is neither a formula nor a scene file"]),
    (["x.y"], ["the character . cannot stand here"]),
    (["none.toml"], ["No such file", "in none.toml"]),
    ([BALL, "-o", "none/a.png"], ["cannot write 'none/a.png'", "no folder"]),
    ([BALL, "-o", "."], ["cannot"]),
    ([BALL, "-o", "a.xyz"], ["cannot tell a picture format", ".png"]),
    ([BALL, "--save-scene", "none/a.toml"], ["no folder"]),
    ([BALL, "--save-scene", "a.txt"], ["would be a .toml file", "call it a.toml"]),
    ([BALL, "--save-outputs", "a.txt"], ["would be a .npz file", "call it a.npz"]),
    ([BALL, "-s", "0"], ["size must be from 1"]),
    ([BALL, "-s", "-1"], ["size must be from 1"]),
    ([BALL, "-s", "99999"], ["size must be from 1"]),
    ([BALL, "-s", "16384"], ["more than"]),
    ([BALL, "-s", "big"], ["cannot read the size"]),
    ([BALL, "-b", "0"], ["radius"]),
    ([BALL, "-b", "nan"], ["finite"]),
    ([BALL, "-b", "1e15"], ["at least 1e-15 and below 1e+15"]),
    ([BALL, "-b", "1,2"], ["cannot read the bounds"]),
    ([BALL, "-b", "0,0,0,1,1,0"], ["empty"]),
    ([BALL, "-t", "-1"], ["tolerance"]),
    ([BALL, "-t", "fine"], ["fine"]),
    ([BALL, "-d", "cpuu"], ["no device 'cpuu'", "did you mean cpu"]),
    ([BALL, "-p", "a=1"], ["no parameter 'a'"]),
    (["x = a", "-p", "a=pie"], ["cannot read the parameter"]),
    (["x = a", "-p", "a=pi/0"], ["cannot read the parameter 'a=pi/0'"]),
    (["x = a", "-p", "a=1,2/0.0"], ["cannot read the parameter"]),
    ([BALL, "-p", "a"], ["cannot read the parameter", "name=number"]),
    ([BALL, "-p", "a=1", "-p", "a=2"], ["the parameter a is given twice"]),
    ([BALL, "--ior", "1.3"], ["none is transparent", "--opacity"]),
    ([BALL, "--last-solid"], ["none is transparent", "--opacity"]),
    ([BALL, "--front", "oranje"], ["cannot read the colour 'oranje'", "#ff8800"]),
    ([BALL, "--background", "#12"], ["cannot read the colour '#12'", "--background"]),
    ([BALL, "--background", "red", "--environment", "sky"], ["hide the background"]),
    ([BALL, "--front", "red", "--color-by", "z"], ["not seen", "coloured by a quantity"]),
    ([BALL, "--back", "red", "--isovalues", "0,0.1"], ["not seen", "isovalue"]),
    ([BALL, "--light", "1,2"], ["cannot read the light '1,2'", "--light"]),
    ([BALL, "--light", "0,0,0"], ["direction must not be zero"]),
    ([BALL, "--lamp", "1,2"], ["cannot read the lamp '1,2'", "--lamp=-1,0.5,2"]),
    ([BALL, "--lamp", "1,2,nan"], ["a light's position", "finite"]),
    ([BALL, *["--lamp=1,2,3"] * 33], ["at most 32 lights"]),
    ([BALL, "--depth", "3"], ["nothing mirrors or is transparent", "--reflectance"]),
    ([BALL, "--depth", "33", "--reflectance", "0.5"], ["from 0 to 32"]),
    ([BALL, "--depth", "many", "--reflectance", "0.5"], ["many"]),
    ([BALL, "--shadow-tolerance", "0.1"], ["there are no shadows", "add --shadows"]),
    ([BALL, "--shadow-tolerance", "-1", "--shadows"], ["the shadow tolerance must be at least"]),
    ([BALL, "--samples", "0"], ["samples"]),
    ([BALL, "--samples", "4", "--antialias", "4"], ["antialias"]),
    (["x + a", "-p", "a=inf"], ["finite"]),
    ([BALL, "--eye", "1,2"], ["cannot read the eye"]),
    ([BALL, "--eye", "0,0,0"], ["its own place"]),
    ([BALL, "--eye", "1,nan,0"], ["finite"]),
    ([BALL, "--up", "0,0,0"], ["up must not be zero"]),
    ([BALL, "--fov", "180"], ["fov"]),
    ([BALL, "--fov", "30", "--height", "1"], ["either a fov or a height"]),
    ([BALL, "--orbit", "nan"], ["finite"]),
    ([BALL, "--color-by", "gausian-curvature"], ["did you mean gaussian-curvature", "mean-curvature, gradient, steps"]),
    ([BALL, "--color-by", "x +"], ["a value is missing", "  x +\n", "^"]),
    ([BALL, "--color-by", "x + q"], ["unknown name q", "the surface's parameters: none"]),
    ([BALL, "--color-by", "x", "--map", "viridis"], ["no colour map 'viridis'", "lagoon is much like it"]),
    ([BALL, "--color-by", "x", "--range", "1"], ["cannot read the range", "--range=-2,2"]),
    ([BALL, "--color-by", "x", "--range", "2,1"], ["begin below its end"]),
    ([BALL, "--map", "ember"], ["nothing to colour by", "--color-by"]),
    ([BALL, "--legend"], ["nothing that a legend could explain"]),
    ([BALL, "--frobnicate"], ["No such option"]),
    ([BALL, "x"], ["unexpected extra argument"]),
    ([], ["Missing argument"]),
]


@pytest.mark.parametrize(("args", "said"), BAD, ids=[f"{' '.join(args)[:40]}" for args, _ in BAD])
def test_a_mistake_gets_one_clear_message(args: list[str], said: list[str], zeroset: Run, tmp_path: Path) -> None:
    ran = zeroset("render", *args, *([] if "-o" in args else ["-o", "out.png"]))
    assert ran.status == 2
    assert ran.out == ""
    for part in said:
        assert part in ran.err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("formula = ", "in s.toml:1"),
        ('formula = "x^2"\nbunds = 3', "in s.toml:2"),
        ('formula = "x^2 +"', "in s.toml:1"),
        ('formula = "x"\n[camera]\nfov = 300', "in s.toml:3"),
    ],
)
def test_a_mistake_in_a_scene_file_has_file_and_line(text: str, said: str, zeroset: Run, tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(text)
    ran = zeroset("render", "s.toml", "-o", "out.png")
    assert ran.status == 2
    assert said in ran.err
    assert not (tmp_path / "out.png").exists()


def test_a_scene_file_may_begin_with_a_byte_order_mark(zeroset: Run, tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_bytes(b'\xef\xbb\xbfformula = "x"\nbounds = 2.0\n')
    assert zeroset("render", "s.toml", "-s", "16", "-o", "a.png").status == 0
    (tmp_path / "s.toml").write_bytes(b'\xef\xbb\xbfformula = "x"\nbounds = -2.0\n')
    ran = zeroset("render", "s.toml", "-o", "a.png")
    assert ran.status == 2
    assert "s.toml:2" in ran.err


def test_a_scene_file_without_its_suffix_is_no_formula(zeroset: Run, tmp_path: Path) -> None:
    for name in ("scene.txt2", "scene"):
        (tmp_path / name).write_text('formula = "x"')
        ran = zeroset("render", name if "." in name else f"./{name}", "-o", "a.png")
        assert ran.status == 2
        assert "is neither a formula nor a scene file" in ran.err


def test_light_and_edges(zeroset: Run, tmp_path: Path) -> None:
    looks = {
        "plain": (),
        "shadows": ("--shadows",),
        "sky": ("--environment", "sky"),
        "glass": ("--opacity", "0.2", "--ior", "1.4", "--reflectance", "0.1"),
        "layers": ("--opacity", "0.3"),
        "solid": ("--opacity", "0.3", "--last-solid"),
        "smooth": ("--antialias", "8"),
        "all": ("--samples", "4"),
        "front": ("--front", "tomato"),
        "paper": ("--background", "black"),
        "sun": ("--light=1,-1,2", "--light=-1,0,0", "--back=#ff0000"),
    }
    drawn = {}
    for name, options in looks.items():
        ran = zeroset("render", "tangle", "-o", f"{name}.png", "-s", "48", "--save-scene", f"{name}.toml", *options)
        assert (ran.status, ran.err) == (0, "")
        drawn[name] = picture(tmp_path / f"{name}.png")
    for name in looks:
        assert name == "plain" or not np.array_equal(drawn["plain"], drawn[name])
    glass = zs.load(tmp_path / "glass.toml").material
    assert (glass.opacity, glass.ior, glass.reflectance) == (0.2, 1.4, 0.1)
    assert not np.array_equal(drawn["layers"], drawn["solid"])
    assert zs.load(tmp_path / "solid.toml").material.last_solid
    assert zs.load(tmp_path / "shadows.toml").shadows
    assert (drawn["paper"][0, 0] == 0).all()
    assert zs.load(tmp_path / "front.toml").material.front[0] == 1.0
    sunny = zs.load(tmp_path / "sun.toml")
    assert sunny.material.back == (1.0, 0.0, 0.0)
    assert [(light.direction, light.headlight) for light in sunny.lights] == [((1, -1, 2), False), ((-1, 0, 0), False)]
    assert zs.load(tmp_path / "sky.toml").environment is not None


def test_lamps_depth_and_coarse_shadows(zeroset: Run, tmp_path: Path) -> None:
    looks = {
        "a": ("--light=1,-1,2", "--lamp", "0,-4,5", "--lamp=-3,0,1", "--shadows"),
        "b": ("--light=1,-1,2", "--lamp", "0,-4,5", "--lamp=-3,0,1", "--shadows", "--shadow-tolerance", "0.3"),
        "c": ("--reflectance", "0.5", "--environment", "room"),
        "d": ("--reflectance", "0.5", "--environment", "room", "--depth", "0"),
    }
    drawn = {}
    for name, options in looks.items():
        ran = zeroset("render", "tangle", "-o", f"{name}.png", "-s", "48", "--save-scene", f"{name}.toml", *options)
        assert (ran.status, ran.err) == (0, "")
        drawn[name] = picture(tmp_path / f"{name}.png")
    lights = zs.load(tmp_path / "a.toml").lights
    assert [(light.direction, light.position, light.headlight) for light in lights[:1]] == [((1, -1, 2), None, False)]
    assert [(light.position, light.headlight) for light in lights[1:]] == [((0, -4, 5), False), ((-3, 0, 1), False)]
    room = zs.load(tmp_path / "c.toml")
    assert np.array_equal(drawn["a"], zs.render(zs.load(tmp_path / "a.toml"), 48).pixels)
    assert np.array_equal(drawn["b"], zs.render(zs.load(tmp_path / "b.toml"), 48, shadow_tolerance=0.3).pixels)
    assert np.array_equal(drawn["d"], zs.render(room, 48, depth=0).pixels)
    assert not np.array_equal(drawn["a"], drawn["b"])
    assert not np.array_equal(drawn["c"], drawn["d"])


def test_shadows_of_a_scene_file_can_be_left_out(zeroset: Run, tmp_path: Path) -> None:
    more = ("-s", "16", "-o", "a.png", "--save-scene")
    assert zeroset("render", "tangle", "--shadows", *more, "a.toml").status == 0
    assert zeroset("render", "a.toml", *more, "b.toml").status == 0
    assert zeroset("render", "a.toml", "--no-shadows", *more, "c.toml").status == 0
    assert [zs.load(tmp_path / f"{name}.toml").shadows for name in "abc"] == [True, True, False]


def test_numbers_as_people_write_them(zeroset: Run, tmp_path: Path) -> None:
    more = ("-s", "16", "-o", "a.png", "--save-scene", "a.toml")
    ran = zeroset("render", "x^2 + y^2 + z^2 = a", "-p", "a=2pi/3", "-b=-2,-2,-2,2,2,2", *more)
    assert (ran.status, ran.err) == (0, "")
    scene = zs.load(tmp_path / "a.toml")
    assert scene.surface.params["a"] == 2 * np.pi / 3
    assert scene.surface.bounds == zs.Box((-2, -2, -2), (2, 2, 2))
    assert zeroset("render", "x^2 + y^2 + sum(i, r[i] z^2) = 1", "-p", "r=1,", "-b", "2", *more).status == 0
    assert zs.load(tmp_path / "a.toml").surface.arrays["r"].tolist() == [1.0]


def test_where_nothing_is_found_the_bounds_are_a_guess(zeroset: Run) -> None:
    ran = zeroset("render", "x^2 + y^2 + z^2 = 1e20", "-s", "16", "-o", "a.png")
    assert "a guess, for nothing was found up to 262144" in ran.err
    assert "a guess" not in zeroset("render", BALL, "-b", "0.1", "-s", "16", "-o", "a.png").err


def test_colours_and_their_legend(zeroset: Run, tmp_path: Path) -> None:
    by = ("--color-by", "gaussian-curvature", "--map", "earth", "--range", "-2,2")
    more = ("--save-scene", "t.toml", "--save-outputs", "t.npz")
    ran = zeroset("render", "torus", "-s", "160", "-o", "t.png", *by, *more)
    assert (ran.status, ran.err) == (0, "")
    assert "colours: Gaussian curvature from -2 to 2" in ran.out
    assert zs.load(tmp_path / "t.toml").material.coloring == zs.Coloring("gaussian-curvature", "earth", (-2, 2))
    with np.load(tmp_path / "t.npz") as outputs:
        assert np.array_equal(np.isnan(outputs["value"]), outputs["status"] == 0)
    again = zeroset("render", "t.toml", "-s", "160", "-o", "again.png", "--legend")
    assert again.status == 0
    assert not np.array_equal(picture(tmp_path / "t.png"), picture(tmp_path / "again.png"))
    assert np.array_equal(picture(tmp_path / "t.png")[:, :70], picture(tmp_path / "again.png")[:, :70])
    found = zeroset("render", "t.toml", "-s", "48", "-o", "found.png", "--color-by", "z")
    assert found.status == 0
    assert "colours: z from" in found.out


TWO = """
[[surfaces]]
formula = "x^2 + y^2 + z^2 = 1"
material = {coloring = "z"}
[[surfaces]]
formula = "z + 1"
bounds = 2
"""


def test_one_coloured_surface_among_several(zeroset: Run, tmp_path: Path) -> None:
    (tmp_path / "two.toml").write_text(TWO)
    size = ("-s", "160", "-o", "t.png", "--legend", "--save-scene", "t.toml")
    ran = zeroset("render", "two.toml", *size, "--map", "ember", "--range=-1,1", "--front", "red")
    assert (ran.status, ran.err) == (0, "")
    assert "colours: z from -1 to 1" in ran.out
    scene = zs.load(tmp_path / "t.toml")
    assert scene.coloring == zs.Coloring("z", "ember", (-1, 1))
    assert scene.colored is not None
    assert scene.colored.shown == (True, False)
    seen = picture(tmp_path / "t.png")
    red = (seen[..., 0] > 100) & (seen[..., 1] < 60) & (seen[..., 2] < 60)
    assert np.count_nonzero(red) > 1000
    ran = zeroset("render", "two.toml", *size, "--color-by", "mean-curvature")
    assert (ran.status, ran.err) == (0, "")
    scene = zs.load(tmp_path / "t.toml")
    assert scene.colored is not None
    assert scene.colored.shown == (True, True)


@pytest.mark.parametrize(
    ("option", "value", "wrong"),
    [("--opacity", "2", "opacity"), ("--environment", "rom", "did you mean room"), ("--antialias", "0", "antialias")],
)
def test_light_that_cannot_be(zeroset: Run, tmp_path: Path, option: str, value: str, wrong: str) -> None:
    ran = zeroset("render", "tangle", "-o", "a.png", "-s", "16", option, value)
    assert ran.status != 0
    assert wrong in ran.err
    assert "Traceback" not in ran.err
    assert list(tmp_path.iterdir()) == []


def test_a_gallery_name_that_begins_with_a_digit(zeroset: Run, tmp_path: Path) -> None:
    assert zeroset("render", "4-bretzel", "-o", "a.png", "-s", "24").status == 0
    assert zeroset("render", "4-x^2-y^2-z^2", "-o", "b.png", "-s", "24").status == 0
