"""What users name on the command line, a formula, a gallery name or a scene file, and options that several commands share."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from zeroset.errors import BoundsError, CameraError, ParameterError
from zeroset.scene.bounds import Bounds, Box, parse_bounds
from zeroset.scene.camera import Camera, fit_camera
from zeroset.scene.scene import Scene
from zeroset.scene.surface import surface

F = TypeVar("F", bound=Callable[..., Any])


def find_scene(source: str, params: tuple[str, ...] = (), bounds: str | None = None) -> Scene:
    """The scene that a user means: a ``.toml`` file, a gallery name, or else a formula."""
    values = dict(_parameter(text) for text in params)
    limits = None if bounds is None else read_bounds(bounds)
    if source.endswith(".toml"):
        from zeroset.scene.file import load

        return _changed(load(source), values, limits)
    # A gallery name has only letters, digits and hyphens, and begins with two letters: hardly a formula.
    if re.fullmatch(r"[a-z]{2,}[a-z0-9]*(-[a-z0-9.]+)*", source) and (named := _named(source)) is not None:
        return _changed(named, values, limits)
    return Scene(surface(source, values, limits))


def _named(name: str) -> Scene | None:
    from zeroset.errors import UnknownSurfaceError, nearest_names
    from zeroset.shelf import gallery

    try:
        return Scene(gallery[name])
    except UnknownSurfaceError:
        if "-" in name or nearest_names(name, gallery):
            raise
        return None


def _changed(scene: Scene, values: dict[str, Any], limits: Bounds | None) -> Scene:
    return dataclasses.replace(scene, surface=surface(scene.surface, values, limits))


def _parameter(text: str) -> tuple[str, Any]:
    name, equals, value = text.partition("=")
    try:
        if not equals:
            raise ValueError
        numbers = [float(part) for part in value.split(",")]
    except ValueError:
        raise ParameterError(f"cannot read the parameter {text!r}", hint="write name=number, or name=1,2,3 for an array") from None
    return name.strip(), numbers if "," in value else numbers[0]


def read_bounds(text: str) -> Bounds:
    """``R`` (a ball) or ``x0,y0,z0,x1,y1,z1`` (a box)."""
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) == 1:
        parsed = parse_bounds(numbers[0])
        assert parsed is not None
        return parsed
    if len(numbers) == 6:
        x0, y0, z0, x1, y1, z1 = numbers
        return Box((x0, y0, z0), (x1, y1, z1))
    raise BoundsError(f"cannot read the bounds {text!r}", hint="write a radius, or six numbers: x0,y0,z0,x1,y1,z1")


def read_triple(text: str, what: str) -> tuple[float, float, float]:
    """Three numbers with commas between them."""
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise CameraError(f"cannot read {what} {text!r}", hint="write three numbers: 3,-5,2") from None
    return x, y, z


def choose_camera(scene: Scene, eye: str | None, target: str | None, fov: float | None, orbit: float) -> Camera:
    """The scene's camera with what the user changed of it."""
    camera = scene.camera or scene.surface.camera or fit_camera(scene.surface.fitted)
    if eye is not None:
        camera = dataclasses.replace(camera, eye=read_triple(eye, "the eye"))
    if target is not None:
        camera = dataclasses.replace(camera, target=read_triple(target, "the target"))
    if fov is not None:
        camera = dataclasses.replace(camera, fov=fov, height=None)
    return camera.orbit(orbit) if orbit else camera


def read_size(text: str) -> tuple[int, int]:
    """``800`` or ``1280x720``."""
    found = re.fullmatch(r"(\d{1,6})(?:[x,](\d{1,6}))?", text.strip())
    if not found:
        raise click.UsageError(f"cannot read the size {text!r}: write 800 or 1280x720")
    return int(found[1]), int(found[2] or found[1])


def surface_options(function: F) -> F:
    """The options that say which surface and how it is traced."""
    for option in reversed(
        (
            click.argument("source", metavar="FORMULA|NAME|FILE"),
            click.option("-p", "--param", "params", multiple=True, metavar="NAME=VALUE", help="Value of a parameter."),
            click.option("-b", "--bounds", metavar="R|BOX", help="Ball radius, or x0,y0,z0,x1,y1,z1."),
            click.option("-m", "--method", default="auto", show_default=True, help="Ray method."),
            click.option("-d", "--device", default="auto", show_default=True, help="Where to run."),
        )
    ):
        function = option(function)
    return function


def existing_folder(path: str) -> Path:
    """The path, if its folder is there: found out before a long render rather than after it."""
    from zeroset.errors import OutputError

    target = Path(path)
    if target.is_dir():
        raise OutputError(f"cannot write {path!r}: it is a folder", hint="give a file name inside it")
    if not target.parent.is_dir():
        raise OutputError(f"cannot write {path!r}: the folder {str(target.parent)!r} does not exist")
    return target
