"""Colours that show a quantity: values against closed forms, colours against the map, on every device."""

from __future__ import annotations

import dataclasses

import numpy as np
import numpy.typing as npt
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.errors import ParameterError, UnknownNameError, ZerosetError
from zeroset.rendering.drawn import as_drawn
from zeroset.rendering.frame import settle
from zeroset.rendering.shading import Lighting, Smooth
from zeroset.rendering.tint import found_range
from zeroset.runtime import get_device
from zeroset.runtime.cpu import CpuDevice
from zeroset.scene.colormap import NEUTRAL, table
from zeroset.scene.encoding import srgb

DEVICES = ["cpu", pytest.param("gpu", marks=needs_gpu)]
SIZE = 64
FLAT = zs.Material(ambient=1.0, diffuse=0.0, specular=0.0)
BALL = zs.surface("x^2 + y^2 + z^2 = 4", bounds=2.2)
RING = zs.surface("(sqrt(x^2 + y^2) - R)^2 + z^2 = r^2", {"R": 1.0, "r": 0.4}, bounds=1.5)
SADDLE = zs.surface("z - x^2 + y^2", bounds=1.2)
OBLIQUE = zs.Camera(eye=(3, -4, 5), target=(0, 0, 0), fov=30)
Floats = npt.NDArray[np.float64]


def points(image: zs.Image, camera: zs.Camera) -> tuple[Floats, Floats, Floats]:
    """Where each pixel's ray has met something; nan elsewhere."""
    width, height = image.size
    eye, right0, up0, forward, right, up = (np.asarray(v) for v in camera.rays(width, height))
    scale = 2 / max(width, height)
    u = ((np.arange(width) + 0.5) - width / 2)[None, :, None] * scale
    v = (height / 2 - (np.arange(height) + 0.5))[:, None, None] * scale
    t = image.aov("t").astype(float)[..., None]
    where = eye + u * right0 + v * up0 + t * (forward + u * right + v * up)
    return where[..., 0], where[..., 1], where[..., 2]


def drawn(surface: zs.Surface, by: str, device: str, **more: object) -> tuple[Floats, zs.Image]:
    """The values, and the picture."""
    image = zs.render(surface, SIZE, camera=OBLIQUE, color_by=by, device=device, **more)  # type: ignore[arg-type]
    assert image.hits > 300
    return image.aov("value").astype(float), image


def agree(values: Floats, expected: Floats, tolerance: float) -> None:
    """Equal where something is seen, and nowhere else."""
    assert np.array_equal(np.isnan(values), np.isnan(expected))
    apart = np.abs(values - expected)
    assert np.nanmax(apart) <= tolerance, np.nanmax(apart)


# ------------------------------------------------------------- quantities


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("sign", [1, -1])
def test_a_ball_is_curved_alike_everywhere(device: str, sign: int) -> None:
    ball = zs.surface(f"{sign}*(x^2 + y^2 + z^2 - 4)", bounds=2.2)
    for by, expected in (("gaussian-curvature", 0.25), ("mean-curvature", sign * 0.5), ("gradient", 4.0)):
        values, image = drawn(ball, by, device)
        agree(values, np.where(image.aov("status") > 0, expected, np.nan), 2e-5)


@pytest.mark.parametrize("device", DEVICES)
def test_a_cylinder_is_curved_in_one_direction(device: str) -> None:
    tube = zs.surface("x^2 + y^2 = 0.25", bounds=1.5)
    for by, expected in (("gaussian-curvature", 0.0), ("mean-curvature", 1.0)):
        values, image = drawn(tube, by, device)
        agree(values, np.where(image.aov("status") > 0, expected, np.nan), 2e-5)


@pytest.mark.parametrize("device", DEVICES)
def test_a_torus(device: str) -> None:
    values, image = drawn(RING, "gaussian-curvature", device)
    x, y, _ = points(image, OBLIQUE)
    axis = np.hypot(x, y)
    cos_v = (axis - 1.0) / 0.4
    # The point itself is known to the tolerance alone.
    agree(values, cos_v / (0.4 * axis), 1e-2)
    assert np.nanmin(values) < -2
    assert np.nanmax(values) > 1.5
    bend, _ = drawn(RING, "mean-curvature", device)
    agree(bend, (1.0 + 2 * 0.4 * cos_v) / (2 * 0.4 * axis), 5e-3)


@pytest.mark.parametrize("device", DEVICES)
def test_a_saddle(device: str) -> None:
    values, image = drawn(SADDLE, "gaussian-curvature", device)
    x, y, _ = points(image, OBLIQUE)
    w = 1 + 4 * x * x + 4 * y * y
    agree(values, -4 / w**2, 5e-3)
    bend, _ = drawn(SADDLE, "mean-curvature", device)
    agree(bend, -(2 * (1 + 4 * y * y) - 2 * (1 + 4 * x * x)) / (2 * w**1.5), 5e-3)


@pytest.mark.parametrize("device", DEVICES)
def test_a_formula_with_parameters_arrays_and_time(device: str) -> None:
    blobs = zs.surface("sum(i, a/((x - c[i])^2 + y^2 + z^2)) = 1", {"a": 0.3, "c": [-0.5, 0.6]}, bounds=1.6)
    values, image = drawn(blobs, "x*a + z^2 + w + sum(i, c[i]) + 0.1", device)
    x, _, z = points(image, OBLIQUE)
    agree(values, x * 0.3 + z * z + 0.2, 1e-4)
    again, image = drawn(blobs.with_params(a=0.25), "x*a + z^2 + w + sum(i, c[i]) + 0.1", device)
    x, _, z = points(image, OBLIQUE)
    agree(again, x * 0.25 + z * z + 0.2, 1e-4)


@pytest.mark.parametrize("device", DEVICES)
def test_steps_and_depth_are_those_of_the_rays(device: str) -> None:
    values, image = drawn(RING, "steps", device)
    hit = image.aov("status") > 0
    assert np.array_equal(values[hit], image.aov("steps")[hit])
    values, image = drawn(RING, "depth", device)
    assert values[hit] == pytest.approx(image.aov("depth")[hit], abs=1e-4)


def test_a_level_set_is_measured_where_it_is_drawn() -> None:
    """With the offset option the surface is f = 1: a ball of twice the radius."""
    ball = zs.surface("(x^2 + y^2 + z^2)/4 - 1/4", bounds=2.5)
    method = zs.methods.Affine(offset=0.75)
    image = zs.render(ball, SIZE, camera=OBLIQUE, color_by="gaussian-curvature", method=method)
    assert np.nanmax(np.abs(image.aov("value") - 0.25)) < 1e-4


def test_f64_keeps_high_degrees_apart_from_rounding() -> None:
    """A ball to the tenth power: its curvature is the ball's, although its derivatives are huge and cancel."""
    steep = zs.surface("(x^2 + y^2 + z^2)^10 = 1048576", bounds=2.2)
    values, image = drawn(steep, "gaussian-curvature", "cpu")
    agree(values, np.where(image.aov("status") > 0, 0.25, np.nan), 1e-6)


@pytest.mark.parametrize("device", DEVICES)
def test_where_the_gradient_vanishes_there_is_no_curvature(device: str) -> None:
    double = zs.surface("(x^2 + y^2 + z^2 - 1)^2", bounds=1.2)
    # Thin parts are drawn where the ray passes beside the surface: there f has a gradient.
    values, image = drawn(double, "mean-curvature", device, material=FLAT, thin=False)
    assert np.all(np.isnan(values))
    grey = round(srgb(NEUTRAL) * 255)
    seen = np.asarray(image)[image.aov("status") > 0].astype(int)
    assert np.abs(seen - grey).max() <= 1
    assert image.range == (-1.0, 1.0)


# ------------------------------------------------------------- colours


def colors(values: Floats, name: str, low: float, high: float) -> Floats:
    """What the map says, linear."""
    place = np.clip((values - low) / (high - low), 0, 1) * 255
    return np.stack([np.interp(place, np.arange(256), channel) for channel in table(name).T], axis=-1)


def bytes_of(linear: Floats) -> Floats:
    return np.asarray(np.vectorize(srgb)(np.clip(linear, 0, 1)) * 255)


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("name", ["lagoon", "coolwarm"])
def test_a_pixel_has_the_colour_of_its_value(device: str, name: str) -> None:
    by = zs.Coloring("x", name, (-0.5, 0.75))
    image = zs.render(RING, SIZE, material=dataclasses.replace(FLAT, coloring=by), device=device)
    hit = image.aov("status") > 0
    expected = bytes_of(colors(image.aov("value")[hit].astype(float), name, -0.5, 0.75))
    assert np.abs(np.asarray(image)[hit] - expected).max() <= 1.5


@pytest.mark.parametrize("device", DEVICES)
def test_a_cyclic_map_begins_again(device: str) -> None:
    both = [
        zs.render(RING, SIZE, material=FLAT, color_by=zs.Coloring(by, "wheel", (0, 1)), device=device)
        for by in ("x + 10", "x - 3")
    ]
    first, second = (np.asarray(image).astype(int) for image in both)
    assert np.abs(first - second).max() <= 2
    assert len(np.unique(first.reshape(-1, 3), axis=0)) > 50


def test_both_sides_have_the_colour_and_light_still_falls_on_it() -> None:
    by = zs.Coloring("x/1000", "ember", (-1, 1))
    lit = zs.render(SADDLE, SIZE, color_by=by, material=zs.Material(specular=0.0))
    seen = np.asarray(lit)[lit.aov("status") > 0].astype(float)
    base = bytes_of(colors(np.zeros(1), "ember", -1, 1))[0]
    assert np.ptp(seen.sum(axis=-1)) > 100
    assert np.all(seen[:, 0] > seen[:, 2])
    assert base[0] > base[2]


@pytest.mark.parametrize("device", DEVICES)
def test_what_lies_behind_has_its_own_colour(device: str) -> None:
    """Shells seen through each other: each of the four layers has the colour of its own radius."""
    shells = zs.surface("(r2 - 1)(r2 - 2)(r2 - 3)".replace("r2", "(x^2+y^2+z^2)"), bounds=2.0)
    by = zs.Coloring("x^2 + y^2 + z^2", "lagoon", (0, 4))
    glass = dataclasses.replace(FLAT, opacity=0.3, coloring=by)
    image = zs.render(shells, SIZE, material=glass, background=(0, 0, 0), device=device)
    expected = np.zeros(3)
    for i, square in enumerate((3.0, 2.0, 1.0, 1.0)):
        expected += 0.3 * 0.7**i * colors(np.array(square), "lagoon", 0, 4)
    assert np.asarray(image)[SIZE // 2, SIZE // 2] == pytest.approx(bytes_of(expected), abs=1.5)


@pytest.mark.parametrize("device", DEVICES)
def test_a_mirror_shows_coloured_surfaces(device: str) -> None:
    """A slanted mirror shows a floor in the floor's colours: both are parts of one surface, told apart by z."""
    room = zs.surface("z (y - 1)", bounds=zs.Box((-3, -4, -0.2), (3, 1.5, 2.5)))
    by = zs.Coloring("y", "lagoon", (-4, 2))
    mirror = dataclasses.replace(FLAT, reflectance=1.0, coloring=by)
    half = dataclasses.replace(mirror, reflectance=0.5)
    camera = zs.Camera(eye=(0, -3, 1.4), target=(0, 1, 1.0), fov=40)
    image = zs.render(room, SIZE, camera=camera, material=half, background=(0, 0, 0), depth=1, device=device)
    x, y, z = points(image, camera)
    wall = (image.aov("status") > 0) & (y > 0.99) & (z < 0.8) & (z > 0.3) & (np.abs(x) < 1)
    assert np.count_nonzero(wall) > 100
    # The way of the mirrored ray from the wall down to the floor.
    eye = np.array(camera.eye)
    d = np.stack([x, y, z], axis=-1) - eye
    reach = z / -d[..., 2]
    floor = 1.0 - d[..., 1] * reach
    seen = wall & (d[..., 2] < -0.1) & (floor > -3.9)
    assert np.count_nonzero(seen) > 50
    expected = 0.5 * colors(y[seen], "lagoon", -4, 2) + 0.25 * colors(floor[seen], "lagoon", -4, 2)
    apart = np.abs(np.asarray(image)[seen] - bytes_of(expected))
    assert np.quantile(apart, 0.98) <= 3


@pytest.mark.parametrize("device", DEVICES)
def test_antialiasing_shades_the_same_colours(device: str) -> None:
    by = zs.Coloring("gaussian-curvature", range=(-3, 2))
    one, many = (
        np.asarray(zs.render(RING, SIZE, material=FLAT, color_by=by, samples=n, device=device)).astype(int)
        for n in (1, 4)
    )
    status = zs.render(RING, SIZE).aov("status") > 0
    inner = status.copy()
    for axis in (0, 1):
        for step in (1, -1):
            inner &= np.roll(status, step, axis)
    assert np.median(np.abs(one - many)[inner]) <= 2
    assert np.quantile(np.abs(one - many)[inner], 0.9) <= 12


def test_devices_agree() -> None:
    for by in ("gaussian-curvature", "mean-curvature", "gradient", "x*y"):
        values = [drawn(RING, by, device)[0] for device in ("cpu", "interp")]
        agree(*values, tolerance=1e-3)


@needs_gpu
def test_the_gpu_agrees_with_the_cpu() -> None:
    sextic = zs.gallery["barth-sextic"]
    by = zs.Coloring("gaussian-curvature", range=(-4, 4))
    cpu, gpu = (zs.render(sextic, SIZE, color_by=by, device=device) for device in ("cpu", "gpu"))
    both = (cpu.aov("status") == 1) & (gpu.aov("status") == 1)
    a, b = (image.aov("value")[both].astype(float) for image in (cpu, gpu))
    apart = np.abs(a - b) / (1 + np.abs(a))
    # f32 against f64: beside a node the curvature is only known as well as the point.
    assert np.nanquantile(apart, 0.95) < 2e-3
    assert np.mean(np.abs(np.asarray(cpu).astype(int) - np.asarray(gpu)).max(axis=-1) <= 3) > 0.97


# ------------------------------------------------------------- ranges, and what is compiled


def test_ranges_that_are_found() -> None:
    ramp = np.linspace(-1, 3, 1001, dtype=np.float32)
    assert found_range(ramp, False) == pytest.approx((-0.92, 2.92))
    assert found_range(ramp * 1e-11, True) == (-1.0, 1.0)
    low, high = found_range(ramp, True)
    assert low == -high
    assert high == pytest.approx(2.8, abs=0.01)
    wild = np.append(ramp, np.float32(1e9))
    assert found_range(wild, False) == pytest.approx((-0.92, 2.92), abs=0.01)
    assert found_range(np.full(9, 5.0, np.float32), False) == (2.5, 7.5)
    assert found_range(np.zeros(9, np.float32), True) == (-1.0, 1.0)
    assert found_range(np.zeros(0, np.float32), False) == (0.0, 1.0)


def test_the_range_is_that_of_what_is_seen() -> None:
    image = zs.render(BALL, SIZE, camera=OBLIQUE, color_by="z")
    values = image.aov("value")
    assert image.range == pytest.approx(np.percentile(values[~np.isnan(values)], (2, 98)), rel=1e-5)
    assert zs.render(BALL, SIZE, color_by="gaussian-curvature").range == pytest.approx((-0.25, 0.25))
    assert zs.render(BALL, SIZE, color_by=zs.Coloring("z", range=(0, 5))).range == (0, 5)


def test_another_map_or_range_compiles_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    device = get_device("cpu")
    first = np.asarray(zs.render(RING, SIZE, color_by=zs.Coloring("x*y"), device=device)).copy()
    settle()

    def refused(*args: object) -> None:
        raise AssertionError("a kernel was compiled")

    for name in ("compile", "compile_cached"):
        monkeypatch.setattr(type(device), name, refused)
    for by in (zs.Coloring("x*y", "ember"), zs.Coloring("x*y", range=(-1, 0)), zs.Coloring("x*y", "wheel", (0, 0.1))):
        again = np.asarray(zs.render(RING.with_params(r=0.4), SIZE, color_by=by, device=device))
        assert not np.array_equal(again, first)
    with pytest.raises(AssertionError, match="was compiled"):
        zs.render(RING, SIZE, color_by="x*y + 1", device=device)


def test_plain_pictures_have_nothing_of_it() -> None:
    from zeroset.rendering.paths import path_kernel, sample_kernel
    from zeroset.rendering.shade import shade_kernel
    from zeroset.rendering.shading import Optics

    scene = zs.Scene(RING)
    optics = Optics(True, False, False, True, False, False, False)
    kernels = [
        shade_kernel(Lighting.of(scene, Smooth())),
        path_kernel(as_drawn(RING).shape, False, optics),
        sample_kernel(as_drawn(RING).shape, False, optics, True),
    ]
    for kernel in kernels:
        assert not {"value", "colors"} & {buffer.name for buffer in kernel.buffers}
        assert not any(uniform.name.startswith("color_") for uniform in kernel.uniforms)
        assert not any(str(uniform.type) == "f64" for uniform in kernel.uniforms)


class Cramped(CpuDevice):
    """A CPU that says that its buffers hold 160 tiles."""

    largest = 160 * 8 * 8 * 4


def test_pictures_in_bands_have_one_range() -> None:
    whole = zs.render(RING, (200, 700), color_by="depth", device="cpu")
    low, high = whole.range or (0, 0)
    found = zs.render(RING, (200, 700), color_by="depth", device=Cramped()).range or (0, 0)
    # It is that of a smaller picture, which sees less of the silhouette.
    assert np.abs(np.subtract(found, (low, high))).max() < 0.03 * (high - low)
    parts = zs.render(RING, (200, 700), color_by=zs.Coloring("depth", range=(low, high)), device=Cramped())
    assert parts.range == whole.range
    assert parts.aov("value") == pytest.approx(whole.aov("value"), abs=1e-4, nan_ok=True)
    apart = np.abs(np.asarray(parts).astype(int) - np.asarray(whole))
    assert np.quantile(apart, 0.999) <= 3


# ------------------------------------------------------------- what cannot be


def test_values_are_asked_for_in_vain() -> None:
    image = zs.render(BALL, 16)
    with pytest.raises(ZerosetError, match="not coloured by any"):
        image.aov("value")
    with pytest.raises(ZerosetError, match="not coloured by anything"):
        image.legend()
    assert image.range is None
    assert "value" not in image.outputs


@pytest.mark.parametrize(
    ("by", "kind", "said"),
    [
        ("gausian-curvature", ParameterError, "did you mean gaussian-curvature"),
        ("mean curvature", ParameterError, "did you mean mean-curvature"),
        ("x + q", UnknownNameError, "the surface's parameters: R, r"),
        ("", ParameterError, "there are gaussian-curvature"),
        (3, ParameterError, "a coloring must be"),
    ],
)
def test_what_nothing_can_be_coloured_by(by: str, kind: type[Exception], said: str) -> None:
    with pytest.raises(kind, match=said):
        zs.render(RING, 16, color_by=by)


def test_a_material_of_its_own_is_coloured_too() -> None:
    own = RING.with_material(zs.Material(ambient=0.5))
    image = zs.render(own, 32, color_by="x", device="cpu")
    plain = zs.render(RING, 32, color_by="x", material=zs.Material(ambient=0.5), device="cpu")
    assert np.array_equal(image.pixels, plain.pixels)
    assert image.range == plain.range


@pytest.mark.parametrize("where", ["cpu", pytest.param("gpu", marks=needs_gpu)])
def test_isovalues_have_their_own_colours_from_the_map(where: str) -> None:
    shells = zs.surface("x^2 + y^2 + z^2", bounds=zs.Box((-2, 0, -2), (2, 2, 2))).with_isovalues((0.25, 1.0, 2.25))
    into = zs.Camera(eye=(0.0, -6.0, 0.0), height=3.5)
    image = zs.render(shells, 64, camera=into, color_by="isovalue", device=where)
    values, parts = image.aov("value"), image.aov("part")
    seen = image.aov("status") != zs.MISS
    assert image.range == (0.25, 2.25)
    assert set(parts[seen].tolist()) == {0, 1, 2}
    assert np.abs(values[seen] - np.array([0.25, 1.0, 2.25])[parts[seen]]).max() < 0.01
    assert zs.render(shells.with_isovalues(1.0), 16, color_by="isovalue").range == (0.0, 2.0)


def test_isovalues_are_coloured_by_other_quantities_too() -> None:
    shells = zs.surface("x^2 + y^2 + z^2", bounds=2).with_isovalues((0.25, 1.0))
    curved = zs.render(shells, 48, color_by="gaussian-curvature").aov("value")
    assert np.nanmax(np.abs(curved - 1.0)) < 1e-3
    with pytest.raises(ParameterError, match="no isovalues"):
        zs.render(BALL, 16, color_by="isovalue")
