"""What clipping calls free of roots, against exact polynomials along the ray."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest
from flint import fmpq, fmpq_poly

import zeroset as zs
from zeroset.arith import NotPolynomialError
from zeroset.kernel import BOOL, F32, U32, KernelBuilder, Value, constant, load, store
from zeroset.runtime import get_device
from zeroset.solve import clipping
from zeroset.solve.clipping import can_clip, clipped, looked_over
from zeroset.solve.field import Lowered, Ray
from zeroset.solve.problem import Problem

Array = np.ndarray[Any, Any]
FAR = 6.0
TOLERANCE = 1e-3
FORMULAS: dict[str, Callable[..., Any]] = {
    "plane": lambda x, y, z: 2 * x - 3 * y + z - 1,
    "ball": lambda x, y, z: x**2 + y**2 + z**2 - 1,
    "cubic": lambda x, y, z: x**3 - 3 * x * y**2 + z**2 - x + 1,
    "tangle": lambda x, y, z: x**4 - 5 * x**2 + y**4 - 5 * y**2 + z**4 - 5 * z**2 + 12,
    "quintic": lambda x, y, z: x**5 - y**4 + 3 * z**3 * x**2 - x * y * z + 1,
    "sextic": lambda x, y, z: (
        4 * (3 * x**2 - y**2) * (3 * y**2 - z**2) * (3 * z**2 - x**2) - 5 * (x**2 + y**2 + z**2 - 1) ** 2
    ),
    "double": lambda x, y, z: (x**2 + y**2 + z**2 - 1) ** 2,
}


Named = dict[str, Value]


def along(
    formula: Callable[..., Any] | str, origins: Array, directions: Array, ask: Callable[[Problem], Named]
) -> dict[str, Array]:
    """What is to be said of the stretch from 0 to FAR along each ray, by name."""
    surface = zs.surface(formula, bounds=10)
    count = len(origins)
    buffers: dict[str, Array] = {f"o{axis}": np.ascontiguousarray(origins[:, i]) for i, axis in enumerate("xyz")}
    buffers |= {f"d{axis}": np.ascontiguousarray(directions[:, i]) for i, axis in enumerate("xyz")}
    with KernelBuilder("along") as builder:
        lane = builder.index()
        o, d = (tuple(load(builder.buffer(f"{n}{axis}", F32), lane) for axis in "xyz") for n in "od")
        far, tolerance = constant(FAR, F32), constant(TOLERANCE, F32)
        problem = Problem(Lowered(surface.field, builder), Ray(o, d), constant(0.0, F32), far, tolerance, far)
        said = ask(problem)
        for name, value in said.items():
            store(builder.buffer(name, value.type, writable=True), lane, value)
            buffers[name] = np.zeros(count, value.type.dtype)
    get_device("cpu").compile(builder.kernel).run(count, {}, buffers)
    return {name: buffers[name] for name in said}


def clip(formula: Callable[..., Any] | str, origins: Array, directions: Array) -> tuple[Array, Array]:
    """Where a search may start along each ray from 0 to FAR, and whether it need not."""

    def ask(problem: Problem) -> Named:
        start = clipped(problem).t0
        return {"start": start, "none": (start >= FAR).convert(U32)}

    said = along(formula, origins, directions, ask)
    return said["start"].astype(float), said["none"] != 0


def look_over(formula: Callable[..., Any] | str, origins: Array, directions: Array) -> tuple[Array, Array]:
    """Whether there certainly is nothing along each ray from 0 to FAR, and whether there certainly is something."""

    def ask(problem: Problem) -> Named:
        rest, hidden = looked_over(problem, constant(True, BOOL))
        return {"none": (rest.t0 >= FAR).convert(U32), "hidden": hidden.convert(U32)}

    said = along(formula, origins, directions, ask)
    return said["none"] != 0, said["hidden"] != 0


def first_root(formula: Callable[..., Any], origin: Array, direction: Array) -> float:
    """The first root from 0 to FAR; infinity where there is none. The polynomial is exact."""
    t = fmpq_poly([0, 1])
    p = formula(*(fmpq_poly([_exact(o)]) + _exact(d) * t for o, d in zip(origin, direction, strict=True)))
    if p.degree() < 1:
        return np.inf if p != 0 else 0.0
    real = [float(root.real) for root, _ in p.complex_roots() if abs(float(root.imag)) < 1e-9]
    return min((r for r in real if 0 <= r <= FAR), default=np.inf)


def _exact(value: float) -> fmpq:
    exact = Fraction(float(value))
    return fmpq(exact.numerator, exact.denominator)


def rays(count: int, seed: int) -> tuple[Array, Array]:
    rng = np.random.default_rng(seed)
    origins = rng.normal(size=(count, 3)) * 1.5
    directions = rng.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return origins.astype(np.float32), directions.astype(np.float32)


@cache
def rays_and_roots(name: str, seed: int) -> tuple[Array, Array, Array]:
    """Rays and their first roots, found once for both ways to the coefficients."""
    origins, directions = rays(300, seed)
    roots = [first_root(FORMULAS[name], o, d) for o, d in zip(origins, directions, strict=True)]
    return origins, directions, np.array(roots)


@pytest.fixture(params=["quick", "careful"])
def how(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """The two ways to the polynomial's coefficients."""

    def refuse(*arguments: object) -> None:
        raise NotPolynomialError("no")

    if request.param == "careful":
        monkeypatch.setattr(clipping, "_quick_floor", refuse)
    return str(request.param)


@pytest.mark.usefixtures("how")
@pytest.mark.parametrize("name", FORMULAS)
def test_what_is_passed_over_holds_no_root(name: str) -> None:
    origins, directions, roots = rays_and_roots(name, 5)
    start, none = clip(FORMULAS[name], origins, directions)
    assert not np.any(none & np.isfinite(roots))
    assert np.all(start <= roots)
    # And it is worth its while: most rays without a root are known to have none, the others come close to theirs.
    assert np.mean(none[np.isinf(roots)]) > 0.85
    close = 40 if name != "double" else 100
    assert np.median(roots[np.isfinite(roots)] - start[np.isfinite(roots)]) < close * TOLERANCE


@pytest.mark.usefixtures("how")
@pytest.mark.parametrize("name", FORMULAS)
def test_what_is_seen_at_a_look_over_is_so(name: str) -> None:
    origins, directions, roots = rays_and_roots(name, 8)
    none, hidden = look_over(FORMULAS[name], origins, directions)
    assert not np.any(none & np.isfinite(roots))
    assert not np.any(hidden & np.isinf(roots))
    # A double root changes no sign, and is left to the search.
    assert np.mean((none | hidden)[np.isinf(roots)]) > 0.85
    assert np.mean(hidden[np.isfinite(roots)]) > (0.8 if name != "double" else -1)


def test_formulas_with_functions_of_parameters_are_clipped_too() -> None:
    surface = zs.surface("exp(a)*x^2 + y^2 + z^2 - 1", params={"a": 0.3}, bounds=2)
    image = zs.render(surface, 64, shadows=True, material=zs.Material(reflectance=0.5))
    assert image.hits > 500


@pytest.mark.usefixtures("how")
def test_rays_that_leave_a_surface_get_off_it() -> None:
    _, normals = rays(500, 6)
    _, directions = rays(500, 7)
    facing = np.sum(normals * directions, axis=1)
    directions = np.where((facing < 0)[:, None], -directions, directions)
    # From a little outside a ball nothing more is met; from a little inside, the far side is.
    outside = (normals * np.float32(1 + TOLERANCE)).astype(np.float32)
    _, none = clip(FORMULAS["ball"], outside, directions)
    assert np.mean(none) > 0.97
    inside = (normals * np.float32(1 - TOLERANCE)).astype(np.float32)
    start, none = clip(FORMULAS["ball"], inside, -directions)
    assert not none.any()
    roots = np.array([first_root(FORMULAS["ball"], o, -d) for o, d in zip(inside, directions, strict=True)])
    assert np.all(start <= roots)
    assert np.median((roots - start)[roots > 0.2]) < 40 * TOLERANCE


def test_what_is_no_polynomial_of_low_degree_is_left_alone() -> None:
    for formula in ("sin(x) + y - z", "x^9 - y", "min(x, y) - z"):
        with KernelBuilder("k") as builder:
            zero, one = constant(0.0, F32), constant(1.0, F32)
            lowered = Lowered(zs.surface(formula, bounds=1).field, builder)
            problem = Problem(lowered, Ray((zero,) * 3, (one,) * 3), zero, one, one, one)
            assert not can_clip(problem)
            assert clipped(problem) is problem


@pytest.mark.usefixtures("how")
def test_numbers_beyond_all_bounds_let_nothing_pass() -> None:
    origins = np.full((8, 3), 1e30, np.float32)
    directions = np.full((8, 3), -1e30, np.float32)
    origins[4:] = np.nan
    start, none = clip(FORMULAS["sextic"], origins, directions)
    assert not none.any()
    assert np.all(start <= 0.0)
    assert not np.any(look_over(FORMULAS["sextic"], origins, directions))
