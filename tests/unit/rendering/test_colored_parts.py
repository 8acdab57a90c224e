"""Colours of a quantity on solids and several surfaces: each part's own values, one map, one range, one legend."""

from __future__ import annotations

import dataclasses

import numpy as np
import numpy.typing as npt
import pytest
from tests.gpus import needs_gpu
from tests.unit.rendering.test_coloring import FLAT, OBLIQUE, Cramped, bytes_of, colors, points

import zeroset as zs
from zeroset.errors import FormulaLimitError, ParameterError, UnknownNameError
from zeroset.rendering.frame import settle
from zeroset.runtime import get_device
from zeroset.scene.colormap import NEUTRAL
from zeroset.scene.encoding import srgb

DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]
SIZE = 64
BALL = zs.surface("x^2 + y^2 + z^2 = r^2", {"r": 1.0}, bounds=1.2)
BITE = zs.surface("s*((x - 0.6)^2 + (y + 0.6)^2 + (z - 0.6)^2) = s*q^2", {"q": 0.8, "s": 3.0}, bounds=2)
BITTEN = (BALL - BITE).with_bounds(1.2)
GROUND = zs.surface("5*(z + 1.1)", bounds=zs.Box((-2, -2, -1.2), (2, 2, -1)))
SHELLS = zs.surface("(x - 1)^2 + y^2 + z^2", bounds=zs.Box((0, 0, -1), (2, 1, 1))).with_isovalues((0.25, 0.5))
Floats = npt.NDArray[np.float64]


def drawn(thing: object, by: zs.Coloring | str | None, device: str = "cpu", **more: object) -> zs.Image:
    image = zs.render(thing, SIZE, camera=OBLIQUE, color_by=by, device=device, **more)  # type: ignore[arg-type]
    assert image.hits > 300
    return image


def values_of(image: zs.Image, part: int) -> Floats:
    """The values of a part, of which a good deal is seen."""
    seen = (image.aov("status") == zs.HIT) & (image.aov("part") == part)
    assert np.count_nonzero(seen) > 60
    return np.asarray(image.aov("value")[seen], float)


# ------------------------------------------------------------- each part's own


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize(
    ("by", "expected"),
    [
        ("mean-curvature", (1.0, -1 / 0.8)),
        ("gaussian-curvature", (1.0, 1 / 0.64)),
        ("gradient", (2.0, 3.0 * 2 * 0.8)),
    ],
)
def test_a_ball_without_a_ball(by: str, expected: tuple[float, float], device: str) -> None:
    """What is taken off is bent inwards, as seen from outside of the solid."""
    image = drawn(BITTEN, by, device, thin=False)
    for part, value in enumerate(expected):
        # On the GPU, in f32; the gradient is that at the hit, which is known to the tolerance.
        assert np.abs(values_of(image, part) - value).max() < 1e-3


@pytest.mark.parametrize("device", DEVICES)
def test_depth_steps_and_a_formula_are_those_of_what_was_met(device: str) -> None:
    for thing in (BITTEN, [GROUND, BITTEN, SHELLS]):
        image = drawn(thing, "depth", device)
        hit = image.aov("status") != zs.MISS
        assert image.aov("value")[hit] == pytest.approx(image.aov("depth")[hit], abs=1e-4)
        image = drawn(thing, "steps", device)
        assert np.array_equal(image.aov("value")[hit], image.aov("steps")[hit])
        image = drawn(thing, "z + y/8", device)
        _, y, z = points(image, OBLIQUE)
        assert np.nanmax(np.abs(image.aov("value") - z - y / 8)) < 1e-4
        assert np.array_equal(np.isnan(image.aov("value")), ~hit)


@pytest.mark.parametrize("device", DEVICES)
def test_each_of_several_surfaces_has_its_own_gradient(device: str) -> None:
    image = drawn([GROUND, BITTEN, SHELLS], "gradient", device, thin=False)
    for part, value in enumerate((5.0, 2.0, 4.8)):
        assert np.abs(values_of(image, part) - value).max() < 1e-3
    # |grad f| = 2 sqrt(v) where (x - 1)^2 + y^2 + z^2 = v.
    for part, level in ((3, 0.25), (4, 0.5)):
        assert np.abs(values_of(image, part) - 2 * level**0.5).max() < 1e-3


@pytest.mark.parametrize("device", DEVICES)
def test_a_formula_has_each_surfaces_own_parameters(device: str) -> None:
    one = zs.surface("x^2 + y^2 + z^2 = a^2 + sum(i, c[i])", {"a": 0.9, "c": [0.1, -0.1]}, bounds=1)
    other = zs.surface("(x - 1.8)^2 + y^2 + z^2 = a^2 + w + sum(i, c[i])", {"a": 0.7, "c": [0.2, -0.1, -0.1]}, bounds=3)
    for change in ({}, {"a": 0.6, "w": 0.04}):
        things = [
            surface.with_params(**{k: v for k, v in change.items() if k in surface.params}) for surface in (one, other)
        ]
        image = drawn(things, "z*a + 10*w + sum(i, c[i]*c[i])", device)
        _, _, z = points(image, OBLIQUE)
        for part, surface in enumerate(things):
            seen = (image.aov("status") == zs.HIT) & (image.aov("part") == part)
            own = 10 * surface.params.get("w", 0.0) + float((surface.arrays["c"] ** 2).sum())
            expected = z[seen] * surface.params["a"] + own
            assert np.abs(values_of(image, part) - expected).max() < 1e-4


def test_the_parts_of_a_solid_are_measured_on_the_level_that_is_drawn() -> None:
    """With the offset option what is met is f = 0.44: a ball of radius 1.2."""
    ball = zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5)
    image = drawn([ball, GROUND], "gaussian-curvature", method=zs.methods.Affine(offset=0.44))
    assert np.abs(values_of(image, 0) - 1 / 1.44).max() < 1e-4


@pytest.mark.parametrize("device", DEVICES)
def test_isovalues_among_several_surfaces(device: str) -> None:
    """What has no isovalues keeps its colours; the range is that of all that have."""
    more = zs.surface("x^2 + y^2 + (z - 0.5)^2", bounds=0.9).with_isovalues(1.0).with_bounds(zs.Ball(1.1, (0, 0, 0.5)))
    image = drawn([GROUND, more, SHELLS], "isovalue", device, material=FLAT)
    assert image.range == (0.25, 1.0)
    for part, level in ((1, 1.0), (2, 0.25), (3, 0.5)):
        assert np.abs(values_of(image, part) - level).max() < 0.01
    ground = image.aov("part") == 0
    assert np.all(np.isnan(image.aov("value")[ground]))
    plain = np.asarray(drawn([GROUND, more, SHELLS], None, device, material=FLAT))
    assert np.abs(np.asarray(image)[ground].astype(int) - plain[ground]).max() <= 1


# ------------------------------------------------------------- one coloured among others


@pytest.mark.parametrize("device", DEVICES)
def test_only_what_has_the_coloring_is_coloured(device: str) -> None:
    by = zs.Coloring("z", "ember")
    things = [
        GROUND,
        BITTEN.mapped(lambda s: s.with_material(dataclasses.replace(FLAT, coloring=by)) if s == BITE else s),
    ]
    image, plain = (
        zs.render(thing, SIZE, camera=OBLIQUE, material=FLAT, device=device) for thing in (things, [GROUND, BITTEN])
    )
    part, status = image.aov("part"), image.aov("status")
    assert np.array_equal(part, plain.aov("part"))
    others = part != 2
    assert np.array_equal(image.pixels[others], plain.pixels[others])
    values = image.aov("value")
    assert np.all(np.isnan(values[others]))
    bitten = (status != zs.MISS) & (part == 2)
    low, high = np.percentile(values[bitten], (2, 98))
    assert image.range == pytest.approx((low, high), abs=1e-5)
    expected = bytes_of(colors(values[bitten].astype(float), "ember", *image.range))
    assert np.abs(image.pixels[bitten] - expected).max() <= 2.0


def test_the_legend_tells_of_points_without_a_value_and_not_of_parts_without_colours() -> None:
    own = zs.Material(coloring=zs.Coloring("z", range=(-2, 2)))
    image = zs.render([BALL.with_material(own), GROUND], SIZE, device="cpu")
    whole = zs.render(BALL.with_material(own), SIZE, device="cpu")
    bar = image.legend()[:, SIZE:], whole.legend()[:, SIZE:]
    assert np.array_equal(*bar)
    log = zs.render([BALL, GROUND], SIZE, color_by=zs.Coloring("log(z)", range=(-2, 2)), material=FLAT, device="cpu")
    below = np.isnan(log.aov("value")) & (log.aov("status") == zs.HIT)
    assert np.count_nonzero(below) > 100
    assert np.abs(log.pixels[below].astype(int) - round(srgb(NEUTRAL) * 255)).max() <= 1


def test_what_a_formula_means_nothing_for_keeps_its_colours() -> None:
    image, plain = (drawn([GROUND, BALL], by, material=FLAT) for by in ("r + z", None))
    ground = image.aov("part") == 0
    assert np.array_equal(image.pixels[ground], plain.pixels[ground])
    assert np.nanmax(image.aov("value")) > 1.9


# ------------------------------------------------------------- where rays go on


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("by", ["mean-curvature", "z"])
def test_pictures_whose_rays_go_on_have_the_colours_of_plain_ones(by: str, device: str) -> None:
    """Surroundings that nothing mirrors; then glass far aside, which is only looked for."""
    coloring = zs.Coloring(by, range=(-1.5, 1.5))
    glass = zs.surface("(x - 9)^2 + y^2 + z^2 = 1").with_bounds(zs.Ball(1.0, (9, 0, 0)))
    glass = glass.with_material(dataclasses.replace(FLAT, opacity=0.5, reflectance=0.2))
    plain = drawn([GROUND, BITTEN, glass], coloring, device, material=FLAT, environment=None)
    around = drawn([GROUND, BITTEN], coloring, device, material=FLAT, environment="sky")
    alone = drawn([GROUND, BITTEN], coloring, device, material=FLAT)
    hit = alone.aov("status") != zs.MISS
    for image in (plain, around):
        apart = np.abs(image.pixels[hit].astype(int) - alone.pixels[hit])
        assert np.quantile(apart, 0.99) <= 1
        assert np.mean(apart > 1) < 0.01


@pytest.mark.parametrize("device", DEVICES)
def test_smooth_pictures_have_the_same_colours(device: str) -> None:
    coloring = zs.Coloring("mean-curvature", range=(-1.5, 1.5))
    one, many = (drawn([GROUND, BITTEN], coloring, device, material=FLAT, samples=n) for n in (1, 4))
    part = np.where(one.aov("status") == zs.MISS, 9, one.aov("part"))
    inner = np.ones_like(part, bool)
    for axis in (0, 1):
        for step in (1, -1):
            inner &= np.roll(part, step, axis) == part
    apart = np.abs(one.pixels.astype(int) - many.pixels)[inner]
    assert np.quantile(apart, 0.99) <= 2


@pytest.mark.parametrize("device", DEVICES)
def test_each_layer_has_the_colours_of_its_part(device: str) -> None:
    """A shell with its own colour, a coloured solid within, whose far side is what was taken off."""
    by = zs.Coloring("mean-curvature", "lagoon", (-4, 4))
    glass = dataclasses.replace(FLAT, opacity=0.25, coloring=by)
    outer = zs.surface("x^2 + y^2 + z^2 = 4", bounds=2.2)
    outer = outer.with_material(dataclasses.replace(FLAT, opacity=0.25, front=(0.5, 0.1, 0.2), back=(0.1, 0.6, 0.2)))
    shell = (zs.surface("x^2 + y^2 + z^2 = 1") - zs.surface("x^2 + y^2 + z^2 = 0.25")).with_bounds(1.1)
    image = zs.render([outer, shell], SIZE, material=glass, background=(0, 0, 0), device=device, depth=8)
    expected = np.zeros(3)
    own = {"front": np.array([0.5, 0.1, 0.2]), "back": np.array([0.1, 0.6, 0.2])}
    ball, hole = (colors(np.array(v), "lagoon", -4, 4) for v in (1.0, -2.0))
    for i, color in enumerate((own["front"], ball, hole, hole, ball, own["back"])):
        expected += 0.25 * 0.75**i * color
    assert image.pixels[SIZE // 2, SIZE // 2] == pytest.approx(bytes_of(expected), abs=1.5)


# ------------------------------------------------------------- devices, numbers, sizes


@needs_gpu
@pytest.mark.parametrize("by", ["gaussian-curvature", "mean-curvature", "gradient", "x*y", "depth"])
def test_the_gpu_agrees_with_the_cpu(by: str) -> None:
    things = [GROUND, BITTEN, SHELLS]
    cpu, gpu = (drawn(things, zs.Coloring(by, range=(-4, 4)), device) for device in ("cpu", "gpu"))
    same = (cpu.aov("status") == 1) & (gpu.aov("status") == 1) & (cpu.aov("part") == gpu.aov("part"))
    assert np.mean(same == (cpu.aov("status") > 0)) > 0.98
    apart = np.abs(cpu.aov("value")[same].astype(float) - gpu.aov("value")[same])
    assert np.nanmax(apart) < 2e-3
    assert np.mean(np.abs(cpu.pixels.astype(int) - gpu.pixels).max(axis=-1) <= 3) > 0.98


@pytest.mark.parametrize("by", ["gaussian-curvature", "r*z"])
def test_other_numbers_compile_nothing(by: str, monkeypatch: pytest.MonkeyPatch) -> None:
    device = get_device("cpu")
    things = [GROUND, BITTEN]
    first = zs.render(things, SIZE, color_by=by, device=device).aov("value").copy()
    settle()

    def refused(*args: object) -> None:
        raise AssertionError("a kernel was compiled")

    for name in ("compile", "compile_cached"):
        monkeypatch.setattr(type(device), name, refused)
    again = zs.render(
        [GROUND, BITTEN.with_params(r=1.1, q=0.7)], SIZE, color_by=zs.Coloring(by, "ember"), device=device
    )
    assert not np.array_equal(again.aov("value"), first, equal_nan=True)


def test_pictures_in_bands() -> None:
    by = zs.Coloring("mean-curvature", range=(-2, 2))
    scene = zs.Scene([GROUND, BALL.with_material(zs.Material(coloring=by))])
    whole, parts = (zs.render(scene, (200, 700), device=device) for device in ("cpu", Cramped()))
    assert parts.aov("value") == pytest.approx(whole.aov("value"), abs=1e-4, nan_ok=True)
    apart = np.abs(np.asarray(parts).astype(int) - np.asarray(whole))
    assert np.quantile(apart, 0.999) <= 3


def test_kernels_of_one_formula_do_not_ask_for_the_part() -> None:
    from zeroset.rendering.drawn import as_drawn
    from zeroset.rendering.measure import value_kernel
    from zeroset.rendering.tint import Tint

    def asked(thing: object, by: str) -> set[str]:
        scene = zs.Scene(thing, material=zs.Material(coloring=by))  # type: ignore[arg-type]
        assert scene.colored is not None
        tint = Tint.of(scene.colored, as_drawn(scene.surface), get_device("cpu"))
        return {buffer.name for buffer in value_kernel(False, tint).buffers}

    for by in ("depth", "steps", "x*y"):
        assert "part" not in asked([GROUND, BITTEN, SHELLS], by)
    for by in ("gradient", "r*z", "isovalue"):
        assert "part" in asked([GROUND, BITTEN, SHELLS], by)
    assert "part" not in asked(SHELLS, "gradient")


# ------------------------------------------------------------- what cannot be


def test_a_picture_has_one_coloring() -> None:
    one, other = (zs.Material(coloring=zs.Coloring("z", name)) for name in ("ember", "gray"))
    with pytest.raises(ParameterError, match=r"one coloring, and its surfaces have two: .*ember.*gray"):
        zs.render([BALL.with_material(one), GROUND.with_material(other)], 16)
    scene = zs.Scene([BALL.with_material(one), GROUND])
    assert scene.coloring == one.coloring
    assert zs.render(scene, 16, color_by="depth", material=other).coloring == zs.Coloring("depth")
    with pytest.raises(ParameterError, match="one coloring"):
        zs.render(scene, 16, material=other)


def test_what_means_nothing_for_any_surface() -> None:
    with pytest.raises(UnknownNameError, match="the surfaces' parameters: q, r, s"):
        zs.render([BITTEN, GROUND], 16, color_by="x + k")
    with pytest.raises(ParameterError, match="did you mean depth"):
        zs.render(BITTEN, 16, color_by="deepth")
    with pytest.raises(ParameterError, match="no isovalues"):
        zs.render(BITTEN, 16, color_by="isovalue")
    long = " + ".join(f"sin({i}*x + r)" for i in range(200))
    assert zs.Scene(BALL, material=zs.Material(coloring=long)).colored
    with pytest.raises(FormulaLimitError, match="taken for each of 3 surfaces"):
        zs.Scene([BALL.with_params(r=r) for r in (0.1, 0.2, 0.3)], material=zs.Material(coloring=long))
