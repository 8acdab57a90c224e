"""From a panel's settings to a scene, a method and a tolerance: what ``render`` is given."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from zeroset.export.film.named import find as find_animation
from zeroset.export.film.path import Moment
from zeroset.scene.camera import Camera, fit_camera
from zeroset.scene.coloring import Coloring
from zeroset.scene.light import DEFAULT_BACKGROUND, DEFAULT_LIGHTS, Light, Material
from zeroset.scene.scene import Scene
from zeroset.scene.several import Drawable
from zeroset.scene.solid import Solid
from zeroset.scene.surface import Surface, surface
from zeroset.shelf import gallery
from zeroset.solve import METHODS, Method

MOMENTS = 100_000
"""Parts into which an animation is divided to say how far it is."""


def scene_of(settings: Mapping[str, Any]) -> Scene:
    """The scene of a panel.

    Args:
        settings: as ``entry.SETTINGS`` lists them.
    """
    shape = _shape(settings)
    return Scene(
        shape,
        _camera(shape, settings),
        _material(settings.get("material", {})),
        tuple(Light(**_tuples(light)) for light in settings["lights"]) if "lights" in settings else DEFAULT_LIGHTS,
        tuple(settings.get("background", DEFAULT_BACKGROUND)),
        settings.get("shadows", False),
        settings.get("environment"),
    )


def method_of(settings: Mapping[str, Any]) -> Method:
    """The ray method of a panel, ``auto`` where it names none."""
    options = dict(settings.get("method", {"name": "auto"}))
    return METHODS[options.pop("name")](**options)


def tolerance_of(settings: Mapping[str, Any], shape: Drawable) -> float | None:
    """World length to which a panel's roots are found; None for the usual one.

    K09 (section 6.1.2) gives precision as a part of the ray's stretch inside the bounds; here it is that part of their
    extent, the longest such stretch.
    """
    return None if "bits" not in settings else shape.fitted.extent * 2.0 ** -settings["bits"]


def _shape(settings: Mapping[str, Any]) -> Surface | Solid:
    if "solid" in settings:
        return gallery.solids[settings["solid"]]
    shape = _surface(settings)
    return shape.with_isovalues(settings["isovalues"], settings.get("colors")) if "isovalues" in settings else shape


def _surface(settings: Mapping[str, Any]) -> Surface:
    params, bounds = settings.get("params", {}), settings.get("bounds")
    if "animation" in settings:
        named = find_animation(settings["animation"])
        assert named is not None, settings["animation"]
        moment = Moment(round(settings.get("at", 0.0) * MOMENTS), MOMENTS)
        params = {name: path.at(moment) for name, path in named.vary.items()} | params
        return surface(named.scene.plain("an animation"), params, bounds)
    if "surface" not in settings:
        return surface(settings["formula"], params, bounds)
    shape = surface(gallery[settings["surface"]], params, bounds)
    return surface(settings["formula"], params, shape.bounds, shape.camera) if "formula" in settings else shape


def _camera(shape: Surface | Solid, settings: Mapping[str, Any]) -> Camera:
    camera = shape.camera or fit_camera(shape.fitted)
    changes = _tuples(settings.get("camera", {}))
    camera = dataclasses.replace(camera, **changes)
    return camera.orbit(settings["orbit"]) if "orbit" in settings else camera


def _material(values: Mapping[str, Any]) -> Material:
    coloring = values.get("coloring")
    if isinstance(coloring, Mapping):
        coloring = Coloring(**_tuples(coloring))
    return Material(**{**_tuples(values), "coloring": coloring})


def _tuples(values: Mapping[str, Any]) -> dict[str, Any]:
    """The values with lists, which TOML has for vectors, as tuples."""
    return {key: tuple(value) if isinstance(value, list) else value for key, value in values.items()}
