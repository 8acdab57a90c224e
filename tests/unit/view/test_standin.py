"""The CPU draws until the GPU's compiler is done, and goes on where it fails."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

import zeroset as zs
from zeroset.errors import DeviceError
from zeroset.scene.scene import Scene
from zeroset.view import standin
from zeroset.view.painting import Shot
from zeroset.view.standin import StandIn, structure

SURFACE = zs.surface("x^2 + y^2 + a*z^2 = 1", {"a": 1.0}, bounds=1.5)
SHOT = Shot(Scene(SURFACE), (40, 30), zs.methods.Auto(), "gpu", None, "none", moving=True)


@pytest.fixture(autouse=True)
def slow(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(standin, "slow_to_compile", lambda device: device == "gpu")


def wait(done: Callable[[], object]) -> None:
    end = time.monotonic() + 30
    while not done():
        assert time.monotonic() < end
        time.sleep(0.002)


def test_the_gpu_takes_over_when_it_is_ready() -> None:
    gate, warmed = threading.Event(), []

    def warm(shot: Shot, superseded: object) -> None:
        warmed.append(shot)
        assert gate.wait(30)

    stand_in = StandIn(lambda: None, warm)
    assert stand_in.placed(SHOT).device == "cpu"
    assert stand_in.placed(SHOT).device == "cpu"
    gate.set()
    wait(lambda: stand_in.placed(SHOT).device == "gpu")
    assert len(warmed) == 1
    # Other numbers are the same kernels, another method is not.
    moved = replace(SHOT, scene=Scene(SURFACE.with_params(a=2.0)), size=(80, 60), moving=False)
    assert stand_in.placed(moved).device == "gpu"
    assert stand_in.placed(replace(SHOT, method=zs.methods.Affine()), compile=False).device == "cpu"
    assert stand_in.trouble == ""
    assert stand_in.close(30)


@pytest.mark.parametrize(
    "changes",
    [
        {"shadows": True},
        {"environment": zs.Environment("sky")},
        {"material": zs.Material(opacity=0.5)},
        {"material": zs.Material(reflectance=0.5)},
        {"lights": (zs.Light(position=(0, 0, 3)), zs.Light())},
    ],
    ids=lambda changes: "-".join(map(str, changes)),
)
def test_other_light_is_other_kernels(changes: dict[str, Any]) -> None:
    assert structure(replace(SHOT, scene=replace(SHOT.scene, **changes))) != structure(SHOT)
    assert structure(replace(SHOT, antialias=4)) != structure(SHOT)
    # More of it, and whether it moves, are numbers.
    shot = replace(SHOT, scene=Scene(SURFACE, material=zs.Material(opacity=0.5)), antialias=4)
    other = replace(shot, scene=Scene(SURFACE, material=zs.Material(opacity=0.25)), antialias=16, moving=False)
    assert structure(other) == structure(shot)


def test_other_surfaces_are_other_kernels_and_other_isovalues_are_not() -> None:
    def of(*surfaces: zs.Surface) -> standin.Structure:
        return structure(replace(SHOT, scene=Scene(surfaces)))

    assert of(SURFACE, SURFACE) != of(SURFACE)
    assert of(SURFACE, SURFACE.with_params(a=2.0)) == of(SURFACE, SURFACE)
    assert of(SURFACE, SURFACE.with_bounds(zs.Box((-1, -1, -1), (1, 1, 1)))) != of(SURFACE, SURFACE)
    assert of(SURFACE.with_isovalues((0, 1))) != of(SURFACE)
    assert of(SURFACE.with_isovalues((0, 1))) == of(SURFACE.with_isovalues((2, 3)))
    assert of(SURFACE.with_isovalues((0, 1))) != of(SURFACE.with_isovalues((0, 1, 2)))


def test_a_gpu_is_made_ready_for_pictures_that_move_and_that_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    painted = []
    monkeypatch.setattr(standin, "paint", lambda shot, superseded: painted.append(shot))
    standin.compiled(replace(SHOT, antialias=4), lambda: False)
    assert sorted((shot.moving, shot.antialias) for shot in painted) == [(False, 4), (True, 4)]


def test_where_the_gpu_cannot_the_cpu_goes_on_and_says_why() -> None:
    def warm(shot: Shot, superseded: object) -> None:
        raise DeviceError("too long a shader")

    stand_in = StandIn(lambda: None, warm)
    stand_in.placed(SHOT)
    wait(lambda: stand_in.placed(SHOT) and stand_in.trouble)
    assert "too long a shader" in stand_in.trouble
    assert stand_in.placed(SHOT).device == "cpu"
    assert stand_in.placed(replace(SHOT, device="cpu")).device == "cpu"
    assert stand_in.trouble == ""
    assert stand_in.close(30)


def test_nothing_stands_in_for_the_cpu() -> None:
    def warm(shot: Shot, superseded: object) -> None:
        raise AssertionError

    stand_in = StandIn(lambda: None, warm)
    shot = replace(SHOT, device="cpu")
    assert stand_in.placed(shot) is shot
    assert stand_in.close(30)


def test_warming_draws_a_small_picture() -> None:
    standin.compiled(replace(SHOT, device="cpu"), lambda: False)


def test_another_quantity_is_another_picture_to_compile() -> None:
    def by(coloring: zs.Coloring) -> Shot:
        return replace(SHOT, scene=replace(SHOT.scene, material=zs.Material(coloring=coloring)))

    curved = standin.structure(by(zs.Coloring("gaussian-curvature")))
    assert curved != standin.structure(SHOT)
    assert curved != standin.structure(by(zs.Coloring("a*x")))
    assert curved == standin.structure(by(zs.Coloring("gaussian-curvature", "earth", (0, 1))))


def test_another_surface_that_is_coloured_is_another_picture_to_compile() -> None:
    own = SURFACE.with_material(zs.Material(coloring=zs.Coloring("z")))
    one, other = (replace(SHOT, scene=Scene(things)) for things in ([SURFACE, own], [own, SURFACE]))
    assert standin.structure(one) != standin.structure(other)
