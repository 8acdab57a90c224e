"""A formula as a fraction: its numerator is 0 wherever f is, and never 0 only because f has a pole."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.gpus import needs_gpu

import zeroset as zs
from zeroset.expr import fraction, parse, postorder, text

FRACTIONS = {
    "1/x^2 + 1": "1 + x^2",
    "1/x = y": "1 - y*x",
    "x/(y - 1) + z/(y - 1)": "x + z",
    "(x/y)^3": "x^3",
    "tan(x) = y": "sin(x) - y*cos(x)",
    "1/(1/x + 1)": "x",
    "|x/y| - 1": "abs(x) - abs(y)",
}


@pytest.mark.parametrize("formula", FRACTIONS)
def test_fractions_are_multiplied_out(formula: str) -> None:
    parts = fraction(parse(formula))
    assert parts is not None
    assert text(parts[0]) == FRACTIONS[formula]


@pytest.mark.parametrize("formula", ["x^2 + y^2 + z^2 = 1", "x/3 + y", "sqrt(1/x) + y", "sum(i, 1/(x - c[i])) + y"])
def test_what_divides_by_nothing_has_none(formula: str) -> None:
    assert fraction(parse(formula, arrays={"c"} if "c[" in formula else set())) is None


def test_it_is_hardly_longer_than_f() -> None:
    f = parse(" + ".join(f"1/(x - {i})" for i in range(60)))
    parts = fraction(f)
    assert parts is not None
    assert len(list(postorder(parts[0]))) < 1.5 * len(list(postorder(f)))


@pytest.mark.parametrize("formula", ["1/x + 1/y - z", "(x + 1)/(y - 2) * tan(z) - x/y", "-(1/x - 2)^2 / (z + 3) + y"])
def test_it_vanishes_with_f(formula: str) -> None:
    f, parts = parse(formula), fraction(parse(formula))
    assert parts is not None
    top, bottom = parts
    random = np.random.default_rng(5)
    ratio = []
    for point in random.uniform(0.2, 1.4, (40, 3)):
        names = dict(zip("xyz", point.tolist(), strict=True)) | {"tan": math.tan, "sin": math.sin, "cos": math.cos}
        above, under, whole = (eval(text(e).replace("^", "**"), {}, names) for e in (top, bottom, f))
        assert above / under == pytest.approx(whole, rel=1e-9)
        ratio.append(above / whole)
    # N/f is the denominator: a number that is neither 0 nor without end.
    assert np.all(np.isfinite(ratio))
    assert np.abs(ratio).min() > 1e-6


@pytest.mark.parametrize(
    "formula",
    [
        "|x/y| + z",
        "(x/y)^2 - |1/z|",
        "(x/y)^3/(z - 3)",
        "-(x/(y + 2)) * |z/x|",
        "tan(x)/y - 1/|z|",
        "1/(1/x - 1/y) + z",
    ],
)
def test_it_is_zero_at_every_zero_of_f(formula: str) -> None:
    # Every point is a zero of f less f's value there; points on all sides of all axes.
    random = np.random.default_rng(6)
    functions = {"tan": math.tan, "sin": math.sin, "cos": math.cos, "abs": abs}
    for point in random.uniform(-1.4, 1.4, (60, 3)):
        names = dict(zip("xyz", point.tolist(), strict=True)) | functions
        value = eval(text(parse(formula)).replace("^", "**"), {}, names)
        parts = fraction(parse(f"{formula} - ({value!r})"))
        assert parts is not None
        terms = text(parts[0]).replace("^", "**")
        beside = eval(terms, {}, names | {"z": names["z"] + 1e-3, "x": names["x"] + 1e-3})
        assert abs(eval(terms, {}, names)) < 1e-9 * max(1.0, abs(value)) + 1e-6 * abs(beside)


def test_a_root_on_either_side_of_a_pole_is_kept() -> None:
    # |x/y| = 1 at y = x and y = -x, with the pole between them: nearer to it than a first look is wide.
    offset = -np.array([1e-1, 1e-2, 3e-3])
    origins = np.stack([offset, np.full(3, -1.9), np.full(3, 0.1)], axis=1)
    hits = zs.cast(zs.surface("|x/y| - 1", bounds=2), origins, [0, 1, 0], max_hits=3)
    assert np.all(hits.status[:, :2] != zs.MISS)
    assert hits.t[:, 0] == pytest.approx(1.9 + offset, abs=1e-3)
    assert hits.t[:, 1] == pytest.approx(1.9 - offset, abs=1e-3)


@pytest.mark.parametrize("method", ["auto", "affine", "interval"])
@pytest.mark.parametrize(
    ("formula", "same"),
    [
        ("1/x^2 = -1", None),
        ("1/x + 1/y = 1", "x + y = x y"),
        ("(x^2 + y^2 + z^2 - 0.3)/(x^2 + y^2 + z^2 - 0.6)", "x^2 + y^2 + z^2 = 0.3"),
        ("tan(x) = y", "sin(x) = y cos(x)"),
    ],
)
def test_poles_are_no_surface(formula: str, same: str | None, method: str) -> None:
    image = zs.render(zs.surface(formula, bounds=1.9), 64, method=method, device="cpu")
    if same is None:
        assert image.hits == 0
        return
    other = zs.render(zs.surface(same, bounds=1.9), 64, method=method, device="cpu")
    seen, true = (picture.aov("status") != zs.MISS for picture in (image, other))
    # 1/x + 1/y = 1 is not defined along x = y = 0, where x + y = x y holds.
    assert np.count_nonzero(seen != true) <= 0.01 * np.count_nonzero(true)
    assert image.unresolved <= 10


@needs_gpu
def test_poles_are_no_surface_on_a_gpu_either() -> None:
    surface = zs.surface("(x^2 + y^2 + z^2 - 0.3)/(x^2 + y^2 + z^2 - 0.6)", bounds=1)
    cpu, gpu = (zs.render(surface, 64, device=device) for device in ("cpu", "gpu"))
    assert gpu.unresolved == 0
    assert np.count_nonzero(cpu.aov("status") != gpu.aov("status")) <= 1


def test_behind_a_pole_roots_are_found_with_their_signs() -> None:
    hits = zs.cast(zs.surface("(x - 1)/(x + 1) - 3 + y", bounds=4), [-4, 0, 0], [1, 0, 0], max_hits=3)
    # (x - 1) = 3 (x + 1) at x = -2; the pole at -1 and the rest of the way hold nothing.
    assert hits.status[0].tolist() == [zs.HIT, zs.MISS, zs.MISS]
    assert hits.t[0, 0] == pytest.approx(2.0, abs=1e-3)
    double = zs.cast(zs.surface("1/x - 4x", bounds=2), [-2, 0.1, 0.2], [1, 0, 0], max_hits=4)
    assert double.status[0].tolist() == [zs.HIT, zs.HIT, zs.MISS, zs.MISS]
    assert double.t[0, :2] == pytest.approx([1.5, 2.5], abs=1e-3)


METHODS = {
    "auto": zs.methods.Auto,
    "affine": zs.methods.Affine,
    "interval": zs.methods.Interval,
    "mitchell": zs.methods.Mitchell,
}


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("formula", ["1/x + y", "tan(2x) + z", "1/(x^2 + y^2 - 1/2) - z"])
def test_poles_are_no_isosurface_either(formula: str, method: str) -> None:
    f = zs.surface(formula, bounds=1.5)
    values = (0.0, 0.5)
    offset = zs.render(f, 100, method=METHODS[method](offset=0.5), device="cpu")
    assert offset.unresolved == 0
    alone = [zs.render(zs.surface(f"{formula} - {v}", bounds=1.5), 100, device="cpu") for v in values]
    assert np.count_nonzero((offset.aov("status") != 0) != (alone[1].aov("status") != 0)) <= 2
    if method == "mitchell":
        return
    both = zs.render(f.with_isovalues(values), 100, method=method, device="cpu")
    assert both.unresolved == 0
    nearest = np.minimum(*(image.aov("depth") for image in alone))
    assert np.count_nonzero(~np.isclose(both.aov("depth"), nearest, rtol=1e-3)) <= 4


@pytest.mark.parametrize("method", ["auto", "affine", "interval"])
@pytest.mark.parametrize(
    ("formula", "same"),
    [
        ("1/sign(z - 0.1)", "sign(z - 0.1)"),
        ("1/if(z < 0.3, -1, 1)", "if(z < 0.3, -1, 1)"),
        ("1/(floor(z + 0.2) + 0.5)", "floor(z + 0.2) + 0.5"),
        ("x/if(z < 0.3, -1, 1) - 0.3", "if(z < 0.3, -x, x) - 0.3"),
    ],
)
def test_a_jump_of_the_denominator_is_a_wall(formula: str, same: str, method: str) -> None:
    origins = np.array([[0.5, 0.2, -2], [-0.4, -0.1, -2]])
    walls, others = (zs.cast(zs.surface(f, bounds=1.5), origins, [0, 0, 1], method=method) for f in (formula, same))
    assert np.any(others.status == zs.UNRESOLVED)
    assert np.array_equal(walls.status, others.status)


@pytest.mark.parametrize("device", ["cpu", pytest.param("gpu", marks=needs_gpu)])
@pytest.mark.parametrize(
    "formula", ["tan(x) + tan(y) + tan(z) = 0.5", "1/x + 1/y + 1/z = 1", "tan(x) * tan(y) = tan(z)"]
)
def test_sheets_that_run_through_poles_have_no_pinholes(formula: str, device: str) -> None:
    """Where a ray passes a zero and a pole at once f has the same sign on either side: N and D both change theirs."""
    surface, size = zs.surface(formula, bounds=3.5), 300
    camera = zs.Camera(eye=(5.0, -9.0, 5.0), fov=40)
    status = zs.render(surface, size, camera, device=device).aov("status")
    found = np.pad(status != zs.MISS, 1)
    around = sum(np.roll(found, shift, (0, 1)) for shift in [(-1, 0), (1, 0), (0, -1), (0, 1)])
    assert found.sum() > 20000
    rows, columns = np.nonzero((~found & (around == 4))[1:-1, 1:-1])
    if not len(rows):
        return
    eye, _, _, forward, right, up = map(np.array, camera.rays(size, size))
    u, v = ((columns + 0.5) * 2 / size - 1)[:, None], (1 - (rows + 0.5) * 2 / size)[:, None]
    assert not np.any(zs.cast(surface, eye, forward + u * right + v * up, device=device).status)
