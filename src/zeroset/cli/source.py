"""What users name on the command line: a formula, a gallery name or a scene file, and options of several commands."""

from __future__ import annotations

import contextlib
import dataclasses
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from zeroset.cli.words import check_no_file, spelled
from zeroset.errors import BoundsError, CameraError, ParameterError, ZerosetError
from zeroset.scene.bounds import Bounds, Box, parse_bounds
from zeroset.scene.camera import Camera, fit_camera
from zeroset.scene.scene import Scene
from zeroset.scene.several import Drawable, Several
from zeroset.scene.surface import surface

if TYPE_CHECKING:
    from zeroset.solve import Method

F = TypeVar("F", bound=Callable[..., Any])


def find_scene(source: str, params: tuple[str, ...] = (), bounds: str | None = None) -> Scene:
    """The scene that a user means: a ``.toml`` file, a gallery name, or else a formula."""
    values = read_parameters(params)
    limits = None if bounds is None else read_bounds(bounds)
    if source.endswith(".toml"):
        from zeroset.scene.file import load

        return _changed(load(source), values, limits)
    check_no_file(source)
    # A gallery name has only letters, digits and hyphens, and its first part two letters or a digit alone (4-bretzel).
    if (
        re.fullmatch(r"([a-z]{2,}[a-z0-9]*|\d+-[a-z]{2,})(-[a-z0-9.]+)*", source)
        and (named := _named(source, values)) is not None
    ):
        return _changed(named, values, limits)
    return Scene(surface(source, values, limits))


def _named(name: str, values: dict[str, Any]) -> Scene | None:
    """The gallery's surface; None for a word that may well be a formula (``xyz``, or ``ab-x`` with a value for ab)."""
    from zeroset.errors import UnknownSurfaceError
    from zeroset.shelf import gallery
    from zeroset.surfaces import solid_names

    if name in solid_names():
        return Scene(gallery.solids[name])
    try:
        return Scene(gallery[name])
    except UnknownSurfaceError:
        words = re.findall(r"[a-z]+", name)
        if all(word in values or spelled(word) for word in words):
            return None
        raise


def _changed(scene: Scene, values: dict[str, Any], limits: Bounds | None) -> Scene:
    return dataclasses.replace(scene, surface=_with(scene.surface, values, limits))


def _with(shown: Drawable, values: dict[str, Any], limits: Bounds | None) -> Drawable:
    """What is drawn with other values of parameters, inside other bounds."""
    changed = shown.with_params(**values) if values else shown
    if limits is None:
        return changed
    if isinstance(changed, Several):
        raise BoundsError("several surfaces have bounds of their own", hint="set them in the scene file")
    return changed.with_bounds(limits)


def with_isovalues(scene: Scene, text: str | None) -> Scene:
    """The scene with isovalues ``0,0.5,1`` of its surface; as it is where none were asked for."""
    if text is None:
        return scene
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        raise ParameterError(f"cannot read the isovalues {text!r}", hint="write numbers: 0,0.5,1") from None
    return dataclasses.replace(scene, surface=scene.plain("--isovalues").with_isovalues(values))


def read_parameter(text: str) -> tuple[str, Any]:
    """``name=number``, or ``name=1,2,3`` for an array."""
    name, equals, value = text.partition("=")
    try:
        if not equals:
            raise ValueError
        # An array of one number has a comma behind it.
        numbers = [read_number(part) for part in value.removesuffix(",").split(",")]
    except ValueError:
        raise ParameterError(
            f"cannot read the parameter {text!r}", hint="write name=number, or name=1,2,3 for an array"
        ) from None
    return name.strip(), numbers if "," in value else numbers[0]


def read_number(text: str) -> float:
    """A number, such as ``1.5`` or ``2pi/3``; raises ``ValueError``."""
    try:
        return float(text)
    except ValueError:
        from zeroset.export.film.path import read_number

        return read_number(text)


def read_parameters(texts: Iterable[str]) -> dict[str, Any]:
    """All of them by name; raises ``ParameterError`` where one is given twice."""
    values: dict[str, Any] = {}
    for name, value in map(read_parameter, texts):
        if name in values:
            raise ParameterError(f"the parameter {name} is given twice", hint=f"write -p {name}=... once")
        values[name] = value
    return values


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


def choose_camera(
    scene: Scene,
    eye: str | None,
    target: str | None,
    up: str | None,
    fov: float | None,
    height: float | None,
    orbit: float,
) -> Camera | None:
    """The scene's camera with what the user changed of it; None for one that is still to be fitted, unchanged."""
    if fov is not None and height is not None:
        raise CameraError(
            "a camera has either a fov or a height", hint="fov is for perspective, height for orthographic"
        )
    camera = scene.camera or scene.surface.camera
    if camera is None and not orbit and all(v is None for v in (eye, target, up, fov, height)):
        return None
    camera = camera or fit_camera(scene.surface.fitted)
    places = {"eye": eye, "target": target, "up": up}
    changes: dict[str, Any] = {k: read_triple(v, f"the {k}") for k, v in places.items() if v is not None}
    if fov is not None or height is not None:
        changes |= {"fov": fov, "height": height}
    camera = dataclasses.replace(camera, **changes)
    return camera.orbit(orbit) if orbit else camera


def read_size(text: str) -> tuple[int, int]:
    """``800`` or ``1280x720``."""
    found = re.fullmatch(r"(-?\d{1,9})(?:[x,](-?\d{1,9}))?", text.strip(), re.ASCII)
    if not found:
        raise ZerosetError(f"cannot read the size {text!r}", hint="write 800 or 1280x720")
    return int(found[1]), int(found[2] or found[1])


def read_method(text: str) -> Method:
    """A ray method, its options after a colon: ``marching-points:test=taylor,steps=200``."""
    from zeroset.errors import MethodError, did_you_mean
    from zeroset.solve import resolve_method

    name, _, rest = text.partition(":")
    plain = resolve_method(name)
    known = {field.name: getattr(plain, field.name) for field in dataclasses.fields(plain)}
    options: dict[str, Any] = {}
    for item in filter(None, rest.split(",")):
        key, _, value = item.partition("=")
        if key not in known:
            hints = (*did_you_mean(key, known), f"its options are {', '.join(known)}")
            raise MethodError(f"the method {name} has no option {key!r}", hints=hints)
        options[key] = _option_value(known[key], value)
    return dataclasses.replace(plain, **options)


def _option_value(default: Any, value: str) -> Any:
    """An option's text as what its default is; the method itself complains of what does not fit."""
    if isinstance(default, bool):
        return {"yes": True, "true": True, "no": False, "false": False}.get(value.lower(), value)
    if isinstance(default, (int, float)):
        with contextlib.suppress(ValueError):
            return float(value)
    return value


def surface_options(function: F) -> F:
    """The options that say which surface and how it is traced."""
    for option in reversed(
        (
            click.argument("source", metavar="FORMULA|NAME|FILE"),
            click.option("-p", "--param", "params", multiple=True, metavar="NAME=VALUE", help="Value of a parameter."),
            click.option("-b", "--bounds", metavar="R|X0,...,Z1", help="Ball radius, or x0,y0,z0,x1,y1,z1."),
            click.option(
                "-m",
                "--method",
                default="auto",
                show_default=True,
                help="Ray method; options after a colon: marching-points:test=taylor,steps=200.",
            ),
            click.option("-d", "--device", default="auto", show_default=True, help="Where to run."),
        )
    ):
        function = option(function)
    return function


class FormulaCommand(click.Command):
    """A command whose first argument is a formula, which may begin with a minus sign."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take ``-x^2 + y`` for a formula and not for options."""
        args = [arg[:2] + arg[3:] if re.match(r"-[a-z]=", arg) else arg for arg in args]
        letters = {name[1] for option in self.params for name in option.opts if re.fullmatch(r"-[a-z]", name)}
        if "--" not in args:
            formulas = [arg for arg in args if _negative_formula(arg, letters)]
            if len(formulas) == 1:
                args = [*(arg for arg in args if arg is not formulas[0]), "--", formulas[0]]
        return super().parse_args(ctx, args)


def _negative_formula(text: str, letters: set[str]) -> bool:
    """Whether an argument is a formula such as ``-x^2 + y``; ``-4,7,4`` and ``-o`` are none."""
    if re.match(r"-\s*[a-z]\w+\s*\(", text):
        return True
    return bool(re.match(r"-[^-]", text)) and text[1] not in letters and bool(re.search(r"[xyzw(|]", text))


def existing_folder(path: str) -> Path:
    """The path, if a file can be written there: found out before a long render rather than after it."""
    from zeroset.atomic import check_writable

    return check_writable(path)


def picture_path(path: str) -> Path:
    """The path, if it names a picture format and can be written."""
    from zeroset.rendering.image import picture_format

    picture_format(path)
    return existing_folder(path)
