from __future__ import annotations

import math
from typing import Any

import pytest

import zeroset as zs
from zeroset.errors import ParameterError, ZerosetError
from zeroset.scene.scene import MOST_LIGHTS, as_scene


def test_numbers_become_floats() -> None:
    light = zs.Light(direction=[0, 1, 0], color=(1, 0, 0))  # type: ignore[arg-type]
    assert light.direction == (0.0, 1.0, 0.0)
    assert isinstance(zs.Material(ambient=1).ambient, float)


@pytest.mark.parametrize(
    ("kind", "wrong", "said"),
    [
        (zs.Light, {"direction": (0, 0, 0)}, "direction must not be zero"),
        (zs.Light, {"direction": (1, 2)}, "direction must be three numbers"),
        (zs.Light, {"direction": "up"}, "direction must be three numbers"),
        (zs.Light, {"color": (1, 1, math.nan)}, "colour must be finite"),
        (zs.Light, {"color": (-1, 1, 1)}, "colour must be three numbers, 0"),
        (zs.Material, {"front": 1.0}, "front colour"),
        (zs.Material, {"back": (1, 1, 1, 1)}, "back colour"),
        (zs.Material, {"ambient": -0.1}, "ambient"),
        (zs.Material, {"diffuse": "much"}, "diffuse must be a number"),
        (zs.Material, {"specular": math.inf}, "specular must be finite"),
        (zs.Material, {"shininess": 0}, "shininess"),
        (zs.Material, {"shininess": 1e5}, "shininess"),
    ],
)
def test_bad_lights_and_materials_are_refused(kind: Any, wrong: dict[str, Any], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        kind(**wrong)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"surface": "x"}, "surface"),
        ({"material": "gold"}, "Material"),
        ({"lights": (1,)}, "Lights"),
        ({"lights": "sun"}, "Lights"),
        ({"lights": (zs.Light(),) * (MOST_LIGHTS + 1)}, "at most"),
        ({"background": "white"}, "background"),
        ({"background": (1, 1)}, "background"),
        ({"background": (1, 1, math.nan)}, "background"),
    ],
)
def test_bad_scenes_are_refused(wrong: dict[str, Any], said: str) -> None:
    with pytest.raises(ParameterError, match=said):
        zs.Scene(**{"surface": zs.surface("x"), **wrong})


def test_what_can_be_drawn() -> None:
    plane = zs.surface("z")
    assert as_scene(plane).surface is plane
    assert as_scene("z").surface == plane
    scene = zs.Scene(plane, lights=[zs.Light()])  # type: ignore[arg-type]
    assert as_scene(scene) is scene
    assert scene.lights == (zs.Light(),)
    with pytest.raises(ZerosetError, match="of type int"):
        as_scene(3)  # type: ignore[arg-type]
