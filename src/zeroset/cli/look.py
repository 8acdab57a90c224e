"""Options that say how a surface looks: shadows, surroundings, and what its material does with light."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from zeroset.scene.scene import Scene

F = TypeVar("F", bound=Callable[..., Any])
MATERIAL = ("opacity", "reflectance", "ior")
OPTIONS = (
    click.option("--shadows", is_flag=True, help="Lights throw shadows."),
    click.option("--environment", metavar="sky|room|FILE", help="What is seen all around. Six FILEs: sky_{face}.png"),
    click.option("--opacity", type=float, help="1 for solid; below, what lies behind is seen through it."),
    click.option("--reflectance", type=float, help="Share of the light that is mirrored, 0 to 1."),
    click.option("--ior", type=float, help="Index of refraction of the inside; with an opacity below 1."),
)


def look_options(function: F) -> F:
    """The options of this file; a command takes them as ``**look``."""
    for option in reversed(OPTIONS):
        function = option(function)
    return function


def with_look(scene: Scene, look: dict[str, Any]) -> Scene:
    """The scene with what the options say; what they leave out stays as it is."""
    changes = {name: look[name] for name in MATERIAL if look[name] is not None}
    material = dataclasses.replace(scene.material, **changes)
    around = look["environment"] or scene.environment
    return dataclasses.replace(scene, material=material, environment=around, shadows=look["shadows"] or scene.shadows)
