"""Each surface is the one its name says: parametrisations, sections, lines, symmetries, values at points."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

Array = np.ndarray[Any, np.dtype[Any]]
Formulas = Callable[[str], Any]
U, V = (grid.ravel() for grid in np.meshgrid(np.linspace(0.1, 6.2, 25), np.linspace(0.15, 3.0, 15)))


def _points(x: Any, y: Any, z: Any) -> Array:
    return np.stack(np.broadcast_arrays(x, y, z), axis=1)


def _on(f: Any, points: Array) -> None:
    assert np.all(np.abs(f(points)) < 1e-11 * f.scale(points))


@pytest.mark.parametrize(("name", "power"), [("ding-dong", 1), ("kiss", 2)])
def test_pinched_surfaces_of_revolution(name: str, power: int, formula: Formulas) -> None:
    """The radius at height z is |z|^power sqrt(1 - z), which is 0 at the pinch and at the top."""
    height = np.cos(V)
    radius = np.abs(height) ** power * np.sqrt(1 - height)
    _on(formula(name), _points(radius * np.cos(U), radius * np.sin(U), height))


@pytest.mark.parametrize("name", ["torus", "torus-root"])
def test_torus(name: str, formula: Formulas) -> None:
    ring = 1.0 + 0.4 * np.cos(U)
    _on(formula(name), _points(ring * np.cos(V), ring * np.sin(V), 0.4 * np.sin(U)))


@pytest.mark.parametrize(("name", "size"), [("steiner", 2.0), ("knoll-steiner", -1.0)])
def test_roman_surface_is_the_image_of_the_sphere(name: str, size: float, formula: Formulas) -> None:
    a, b, c = np.cos(U) * np.sin(V), np.sin(U) * np.sin(V), np.cos(V)
    f = formula(name)
    _on(f, size * _points(b * c, c * a, a * b))
    axes = np.concatenate([np.linspace(-2, 2, 9)[:, None] * axis for axis in np.eye(3)])
    assert np.abs(f(axes)).max() == 0
    assert np.abs(f.gradient(axes)).max() == 0


def test_cassini_stacks_ovals(formula: Formulas) -> None:
    """At height z the product of the distances from (1, 0) and (-1, 0) is z^2."""
    x, y = 2 * np.cos(U) * np.sin(V), 2 * np.sin(U) * np.sin(V)
    height = np.sqrt(np.hypot(x - 1, y) * np.hypot(x + 1, y))
    f = formula("cassini")
    _on(f, _points(x, y, height))
    _on(f, _points(x, y, -height))


@pytest.mark.parametrize("name", ["miter", "cross-cap"])
def test_handle_is_a_double_line(name: str, formula: Formulas) -> None:
    axis = np.linspace(-2, 2, 9)[:, None] * np.eye(3)[2]
    f = formula(name)
    assert np.abs(f(axis)).max() == 0
    assert np.abs(f.gradient(axis)).max() == 0


def test_cross_cap(formula: Formulas) -> None:
    """The section by a plane through the z-axis is that axis, twice, and an ellipse."""
    c, s = np.cos(U) ** 2, np.sin(U) ** 2
    height = (s + c / 2) * np.cos(V) - c / 2
    _on(formula("cross-cap"), _points(np.cos(U) * np.sin(V) / 2, np.sin(U) * np.sin(V), height))


def test_miter(formula: Formulas) -> None:
    """As the cross cap: in the plane y = k x lies the ellipse x = k sin t/(2 + k^2), z = k cos t/sqrt(4 + k^2)."""
    x, z = U * np.sin(V) / (2 + U**2), U * np.cos(V) / np.sqrt(4 + U**2)
    _on(formula("miter"), _points(x, U * x, z))


def test_klein_bottle_crosses_itself_in_a_circle(formula: Formulas) -> None:
    circle = _points(2**0.5 * np.cos(U), 1 + 2**0.5 * np.sin(U), 0 * U)
    f = formula("klein-bottle")
    _on(f, circle)
    assert np.abs(f.gradient(circle)).max() < 1e-12


def test_klein_bottle_is_the_projection_of_lawsons(formula: Formulas) -> None:
    """Lawson's Klein bottle in the unit sphere of R^4, seen by stereographic projection."""
    p, q = -np.sin(V) * np.sin(2 * U), np.cos(V) * np.cos(U)
    east, up = np.sin(V) * np.cos(2 * U), np.cos(V) * np.sin(U)
    pole, north = (p + q) / 2**0.5, (p - q) / 2**0.5
    _on(formula("klein-bottle"), _points(east, north, up) / (1 - pole)[:, None])


def test_hunt_is_the_envelope_of_confocal_quadrics(formula: Formulas) -> None:
    """Where t^3 + (r^2 - 13) t + (3x^2 + y^2 - 4z^2 - 12) has a double root t."""
    t, z = (grid.ravel() for grid in np.meshgrid(np.linspace(-2, 2, 41), np.linspace(-1.9, 1.9, 21)))
    sum1 = 13 - 3 * t**2 - z**2
    sum3 = 12 + 4 * z**2 + 2 * t**3
    x2, y2 = (sum3 - sum1) / 2, (3 * sum1 - sum3) / 2
    real = (x2 > 0) & (y2 > 0)
    assert real.sum() > 50
    _on(formula("hunt"), _points(np.sqrt(x2[real]), np.sqrt(y2[real]), z[real]))


def test_clebsch_has_27_real_lines(formula: Formulas) -> None:
    """Newton's method on lines (a, b, 0) + t (c, d, 1), turned at random so that none is horizontal.

    The surface is symmetric, so lines found in one place give those of the permuted coordinates too.
    """
    f = formula("clebsch")
    rng = np.random.default_rng(6)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    lines = rng.standard_cauchy(size=(1500, 4)).astype(complex)
    times = np.array([-1.0, 0.0, 1.0, 2.0])

    def residual(line: Array) -> Array:
        a, b, c, d = (line[:, k, None] for k in range(4))
        points = np.stack([a + c * times, b + d * times, times + 0 * a], axis=-1)
        return np.reshape(f((points @ turn.T).reshape(-1, 3)), (len(line), 4))

    for _ in range(50):
        jacobian = np.stack([residual(lines + 1e-30j * unit).imag / 1e-30 for unit in np.eye(4)], axis=2)
        step = np.linalg.solve(jacobian + 1e-12 * np.eye(4), residual(lines).real[..., None])[..., 0]
        lines = lines - step * np.minimum(1, 1 / np.linalg.norm(step, axis=1))[:, None]
    a, b, c, d = lines.real[np.abs(residual(lines)).max(axis=1) < 1e-8].T
    assert len(a) > 500
    start, along = _points(a, b, 0) @ turn.T, _points(c, d, 1) @ turn.T
    orders = [list(order) for order in itertools.permutations(range(3))]
    assert len(set().union(*(_line_keys(start[:, order], along[:, order]) for order in orders))) == 27


def _line_keys(start: Array, along: Array) -> set[tuple[float, ...]]:
    """Each line once, by its direction and its point nearest to (0.3, 0.2, 0.1)."""
    along = along / np.linalg.norm(along, axis=1)[:, None]
    along = along * np.sign(along @ (1.0, 0.7, 0.4))[:, None]
    offset = start - (0.3, 0.2, 0.1)
    nearest = offset - (offset * along).sum(axis=1)[:, None] * along
    return {tuple(key) for key in np.round(np.concatenate([along, nearest], axis=1), 4) + 0.0}


@pytest.mark.parametrize("name", ["piriform", "teardrop"])
def test_surfaces_of_revolution_about_x(name: str, formula: Formulas) -> None:
    x = np.linspace(-0.99, -0.01, 30) if name == "teardrop" else np.linspace(0.01, 0.99, 30)
    squared = (x**5 + x**4) / 2 if name == "teardrop" else x**3 - x**4
    _on(formula(name), _points(x, np.sqrt(squared) * 0.6, np.sqrt(squared) * 0.8))


def test_scherk_is_a_graph(formula: Formulas) -> None:
    x, y = 1.4 * np.cos(U) * np.sin(V), 1.4 * np.sin(U) * np.sin(V)
    _on(formula("scherk"), _points(x, y, np.log(np.cos(x) / np.cos(y))))


def test_diamond_is_a_sine_and_a_product(formula: Formulas) -> None:
    points = np.random.default_rng(7).uniform(-4, 4, size=(50, 3))
    expected = np.sin(points.sum(axis=1)) + 2 * np.prod(np.sin(points), axis=1)
    assert formula("diamond")(points) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("name", ["blinn-blobby", "blinn-blobby-30"])
def test_blobby_adds_one_term_a_sphere(name: str, formula: Formulas) -> None:
    f = formula(name)
    arrays, epsilon = f.entry.arrays, f.entry.params["epsilon"]
    assert len(arrays["r"]) == (30 if name.endswith("30") else 5)
    centres = np.stack([arrays["cx"], arrays["cy"], arrays["cz"]], axis=1)
    points = np.random.default_rng(8).normal(size=(40, 3))
    distance2 = ((points[:, None] - centres) ** 2).sum(axis=2)
    expected = (np.array(arrays["r"]) ** 2 / (distance2 + epsilon)).sum(axis=1) - 1
    assert f(points) == pytest.approx(expected, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("name", ["cloth", "water"])
@pytest.mark.parametrize("w", [0.0, 1.3, 4.0])
def test_sheets_stay_inside_their_boxes_at_all_times(name: str, w: float, formula: Formulas) -> None:
    f = formula(name)
    high = f.entry.bounds.max
    x, z = high[0] * np.cos(U), high[2] * np.sin(3 * V)
    top, bottom = f(_points(x, high[1], z), w), f(_points(x, -high[1], z), w)
    assert np.all(np.sign(top) == -np.sign(bottom))


EXPONENTS = {
    "superquadric": 2.5,
    "superquadric-half": 0.5,
    "superquadric-three-quarters": 0.75,
    "superquadric-three-halves": 1.5,
    "superquadric-5": 5.0,
    "superquadric-20": 20.0,
}


@pytest.mark.parametrize(("name", "m"), EXPONENTS.items())
def test_superquadrics(name: str, m: float, formula: Formulas) -> None:
    corner = 3 ** (-1 / m)
    signs = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
    _on(formula(name), np.concatenate([corner * signs, np.eye(3), -np.eye(3)]))


SYMMETRIC = ("clebsch", "cayley", "nordstrand", "goursat", "kummer", "tooth", "steiner", "chmutov-7", "chmutov-18")


@pytest.mark.parametrize("name", [*SYMMETRIC, "knoll-steiner", "decocube", "diamond", "superquadric-half", "tangle"])
def test_coordinates_may_be_permuted(name: str, formula: Formulas) -> None:
    points = np.random.default_rng(9).uniform(-1, 1, size=(30, 3))
    expected = formula(name)(points)
    for order in itertools.permutations(range(3)):
        assert formula(name)(points[:, order]) == pytest.approx(expected, rel=1e-10, abs=1e-10)


VALUES = [
    ("clebsch", (0, 0, 0), 1),
    ("cushion", (0, 1, 0), 0),
    ("cushion", (0, 0, 1), -1),
    ("cushion", (0, 1, 1), 0),
    ("cushion", (1, 1, 1), -1),
    ("cushion", (2**-0.5, 0.5, 0), 0.1875),
    ("goursat", (0, 0, 1), 0),
    ("peninsula", (0, 0, 1), 0),
    ("peninsula", (3, -2, 0), 0),
    ("peninsula", (0, 1, 0), 0),
    ("dervish", (1, 0, (5 - 5**0.5) ** 0.5 / 2), 0),
    ("heart", (0, 0, -1), 0),
    ("heart", (0, 8**-0.25, 1), 0),
    ("heart-nordstrand", (0, 1, 1), 0),
    ("heart-nordstrand", (0, 0, 1), 0),
    ("blobby", (0, 0, 0), -2),
    ("sphere", (0.6, 0, -0.8), 0),
    ("mitchell", (((20 - 128**0.5) / 8) ** 0.5, 0, 0), 0),
    ("mitchell", (1, 1, 0), 2),
    ("4-bretzel", (0, 0, 30**-0.5), 0),
    ("4-bretzel", (1.1, 0, 30**-0.5), 0),
    ("4-bretzel", (0, 1, 0), 8),
    ("tangle", (0, 0, 0), 11.8),
    ("tangle", (1, 1, 1), -0.2),
    ("decocube", (0.8, 0, 1), -0.02),
    ("decocube", (0, 1, -0.8), -0.02),
    ("knoll-superquadric", (1, 0, 0), 0),
    ("knoll-superquadric", (0, -(2 ** (1 / 35)), 0), 0),
    ("knoll-superquadric", (0, 0, 2**0.25), 0),
    ("sin-blob", (0, 0, 0), -1),
]


@pytest.mark.parametrize(("name", "point", "value"), VALUES)
def test_values(name: str, point: tuple[float, float, float], value: float, formula: Formulas) -> None:
    assert formula(name)(np.array([point]))[0] == pytest.approx(value, abs=1e-11)
