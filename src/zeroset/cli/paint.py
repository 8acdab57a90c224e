"""Options that say in which colours something is painted, and where its light comes from."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from zeroset.errors import ParameterError

if TYPE_CHECKING:
    from zeroset.scene.bounds import Vector
    from zeroset.scene.light import Color, Light
    from zeroset.scene.scene import Scene

OPTIONS = (
    click.option("--front", metavar="COLOR", help="Colour of the side where f > 0: a name, or #rrggbb."),
    click.option("--back", metavar="COLOR", help="Colour of the side where f < 0."),
    click.option("--background", metavar="COLOR", help="Colour where nothing is met."),
    click.option(
        "--light",
        metavar="X,Y,Z",
        multiple=True,
        help="Direction to a light far away, instead of lights that go with the camera; may be repeated.",
    ),
    click.option("--lamp", metavar="X,Y,Z", multiple=True, help="Place of a lamp, likewise; beside any --light."),
)


def read_color(text: str, option: str) -> Color:
    """A colour as people write it, in linear light.

    Example:
        >>> read_color("#ff0000", "--front"), read_color("white", "--front")
        ((1.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    """
    from PIL import ImageColor

    from zeroset.scene.encoding import linear

    try:
        red, green, blue = (linear(channel / 255) for channel in ImageColor.getrgb(text)[:3])
    except ValueError:
        hint = f"write {option} '#ff8800', or a name such as orange"
        raise ParameterError(f"cannot read the colour {text!r}", hint=hint) from None
    return red, green, blue


def sides(look: dict[str, Any]) -> dict[str, Color]:
    """What the options say of a material's two colours."""
    return {name: read_color(look[name], f"--{name}") for name in ("front", "back") if look[name] is not None}


def painted(scene: Scene, look: dict[str, Any]) -> Scene:
    """The scene with the background and the lights that the options ask for."""
    if look["background"] is not None:
        if scene.environment is not None:
            raise ParameterError("the surroundings hide the background", hint="leave out --environment or --background")
        scene = dataclasses.replace(scene, background=read_color(look["background"], "--background"))
    lights = _lights(look["light"], look["lamp"])
    return dataclasses.replace(scene, lights=lights) if lights else scene


def _lights(directions: Sequence[str], places: Sequence[str]) -> tuple[Light, ...]:
    """Lights that stay where they are: those far away, then those at a place."""
    from zeroset.scene.light import Light

    far = (Light(direction=_triple(text, "light"), headlight=False) for text in directions)
    near = (Light(position=_triple(text, "lamp"), headlight=False) for text in places)
    return (*far, *near)


def _triple(text: str, what: str) -> Vector:
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        hint = f"write three numbers: --{what}=-1,0.5,2"
        raise ParameterError(f"cannot read the {what} {text!r}", hint=hint) from None
    return x, y, z


def check_sides(scene: Scene, changes: dict[str, Color]) -> None:
    """Raise where nothing would be seen of the two colours."""
    if not changes:
        return
    if all(material.coloring is not None for material in scene.materials):
        raise ParameterError("--front and --back are not seen on a surface that is coloured by a quantity")
    if any(surface.isovalues for surface in scene.surface.surfaces):
        raise ParameterError("--front and --back are not seen where each isovalue has a colour of its own")
