from __future__ import annotations

import tomllib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from zeroset.expr import polynomial
from zeroset.surfaces import BallBounds, GalleryEntry, entry, names
from zeroset.surfaces.load import DATA, FAMILIES

NAMES = names()
GRID = 48


def _middle_and_half(item: GalleryEntry) -> tuple[Any, Any]:
    bounds = item.bounds
    if isinstance(bounds, BallBounds):
        return np.array(bounds.center), np.full(3, bounds.radius)
    low, high = np.array(bounds.min), np.array(bounds.max)
    return (low + high) / 2, (high - low) / 2


@pytest.mark.parametrize("which", FAMILIES)
def test_tables_have_all_fields_and_no_others(which: str) -> None:
    needed = {"title", "formula", "degree", "bounds", "camera", "source", "note"}
    for table in tomllib.loads((DATA / f"{which}.toml").read_text(encoding="utf-8")).values():
        assert needed <= table.keys() <= needed | {"params", "arrays"}
        assert table["camera"].keys() == {"eye", "target", "up", "fov"}
        assert all(source.keys() == {"paper", "where", "figures"} for source in table["source"])
        if isinstance(table["bounds"], dict):
            assert set(table["bounds"]) in ({"center", "radius"}, {"min", "max"})


@pytest.mark.parametrize("name", NAMES)
def test_entry_is_complete(name: str) -> None:
    item = entry(name)
    assert item.title
    assert "\n" not in item.formula + item.note
    assert item.source
    assert {source.paper for source in item.source} <= {"SN10", "K09"}
    assert all(source.where for source in item.source)
    assert len({len(values) for values in item.arrays.values()}) <= 1
    hash(item.bounds), hash(item.camera)


@pytest.mark.parametrize("name", NAMES)
def test_camera_looks_at_the_middle_and_sees_the_whole(name: str) -> None:
    item = entry(name)
    middle, half = _middle_and_half(item)
    eye, up = np.array(item.camera.eye), np.array(item.camera.up)
    away = eye - middle
    distance = float(np.linalg.norm(away))
    assert np.allclose(item.camera.target, middle, atol=1e-6)
    assert np.linalg.norm(np.cross(up, away)) > 0.1 * distance
    radius = float(half.max() if isinstance(item.bounds, BallBounds) else np.linalg.norm(half))
    assert distance > 1.2 * radius
    seen = np.degrees(2 * np.arcsin(radius / distance))
    assert 0.75 * item.camera.fov < seen < 1.4 * item.camera.fov


@pytest.mark.parametrize("name", NAMES)
def test_formula_uses_just_what_the_entry_gives(name: str, formula: Callable[[str], Any]) -> None:
    expr, item = formula(name).expr, entry(name)
    assert expr.parameters == set(item.params)
    assert expr.arrays == set(item.arrays)
    assert {"x", "y", "z"} <= expr.variables


@pytest.mark.parametrize("name", NAMES)
def test_degree_is_that_of_the_polynomial(name: str, formula: Callable[[str], Any]) -> None:
    """Far out f grows as the distance to the power of its degree."""
    f, degree = formula(name), entry(name).degree
    if degree == 0:
        assert polynomial(f.expr) is None
        return
    direction = np.random.default_rng(3).normal(size=(1, 3))
    near, far = 2.0**20, 2.0**21
    assert np.log2(abs(f(far * direction) / f(near * direction))) == pytest.approx(degree, abs=1e-3)


@pytest.mark.parametrize("name", NAMES)
def test_surface_passes_through_its_bounds(name: str, formula: Callable[[str], Any]) -> None:
    item = entry(name)
    middle, half = _middle_and_half(item)
    axis = (np.arange(GRID) + 0.5) / GRID * 2 - 1
    grid = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    if isinstance(item.bounds, BallBounds):
        grid = grid[np.einsum("ij,ij->i", grid, grid) < 1]
    with np.errstate(over="ignore"):
        inside = formula(name)(middle + half * grid).real < 0
    assert 0.0005 < inside.mean() < 0.9995


COMPACT = (
    *("torus", "cushion", "goursat", "miter", "cross-cap", "piriform", "tooth", "steiner", "hunt", "klein-bottle"),
    *("heart", "heart-nordstrand", "chmutov-6", "chmutov-14", "chmutov-30", "torus-root", "blinn-blobby"),
    *("blinn-blobby-30", "blobby", "superquadric", "superquadric-half", "superquadric-three-quarters"),
    *("superquadric-three-halves", "superquadric-5", "superquadric-20", "sphere", "knoll-steiner", "mitchell"),
    *("4-bretzel", "tangle", "decocube", "knoll-superquadric"),
)


@pytest.mark.parametrize("name", COMPACT)
def test_bounds_hold_the_whole_of_a_compact_surface(name: str, formula: Callable[[str], Any]) -> None:
    """f keeps one sign between the bounds and twice their size."""
    item = entry(name)
    middle, half = _middle_and_half(item)
    directions = np.random.default_rng(4).normal(size=(20_000, 3))
    if isinstance(item.bounds, BallBounds):
        directions /= np.linalg.norm(directions, axis=1)[:, None]
    else:
        directions /= np.abs(directions).max(axis=1)[:, None]
    with np.errstate(over="ignore"):
        outside = [formula(name)(middle + scale * half * directions).real for scale in (1.0, 1.02, 1.1, 1.4, 2.0)]
    signs = np.sign(np.concatenate(outside))
    assert set(signs) in ({1.0}, {-1.0})
