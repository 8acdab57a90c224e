"""Options that say how a surface looks: lights and shadows, surroundings, its material, what it is coloured by."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from zeroset.cli import paint
from zeroset.errors import ParameterError

if TYPE_CHECKING:
    from zeroset.scene.coloring import Coloring
    from zeroset.scene.light import Material
    from zeroset.scene.scene import Scene
    from zeroset.scene.surface import Surface

F = TypeVar("F", bound=Callable[..., Any])
MATERIAL = ("opacity", "reflectance", "ior")
TRACING = ("depth", "shadow_tolerance")
OPTIONS = (
    *paint.OPTIONS,
    click.option("--shadows/--no-shadows", default=None, help="Whether lights throw shadows."),
    click.option("--shadow-tolerance", type=float, help="World length to which shadows are found."),
    click.option("--environment", metavar="sky|room|FILE", help="What is seen all around. Six FILEs: sky_{face}.png"),
    click.option("--opacity", type=float, help="1 for solid; below, what lies behind is seen through it."),
    click.option("--last-solid", is_flag=True, help="Seen through only where another surface lies behind."),
    click.option("--reflectance", type=float, help="Share of the light that is mirrored, 0 to 1."),
    click.option("--ior", type=float, help="Index of refraction of the inside; with an opacity below 1."),
    click.option("--depth", type=int, help="Surfaces that a ray may meet after its first: behind glass, in mirrors."),
    click.option(
        "--color-by",
        metavar="QUANTITY|FORMULA",
        help="gaussian-curvature, mean-curvature, gradient, steps, depth, isovalue, or a formula in x, y, z and the "
        "parameters.",
    ),
    click.option("--map", "color_map", help="Its colours: lagoon, ember, gray, coolwarm, earth or wheel."),
    click.option("--range", "color_range", metavar="LOW,HIGH", help="Values of the first and the last colour."),
)


def look_options(function: F) -> F:
    """The options of this file; a command takes them as ``**look``, and hands ``TRACING`` of them to the picture."""
    for option in reversed(OPTIONS):
        function = option(function)
    return function


def with_look(scene: Scene, look: dict[str, Any]) -> Scene:
    """The scene with what the options say; what they leave out stays as it is."""
    colors = paint.sides(look)
    changes = {name: look[name] for name in MATERIAL if look[name] is not None} | colors
    if look["last_solid"]:
        changes["last_solid"] = True
    colors_alone = look["color_by"] is None and (look["color_map"], look["color_range"]) != (None, None)
    if colors_alone and scene.coloring is None:
        raise ParameterError(
            "there is a colour map or a range, but nothing to colour by", hint="try --color-by gaussian-curvature"
        )

    def dressed(material: Material) -> Material:
        return dataclasses.replace(material, **changes, coloring=_coloring(material.coloring, look))

    def changed(surface: Surface) -> Surface:
        return surface if surface.material is None else surface.with_material(dressed(surface.material))

    material, shown = dressed(scene.material), scene.surface.mapped(changed)
    materials = [material, *(surface.material for surface in shown.surfaces if surface.material is not None)]
    if (look["last_solid"] or look["ior"] is not None) and all(each.opacity >= 1 for each in materials):
        raise ParameterError(
            "--ior and --last-solid are about what is seen through a surface, and none is transparent",
            hint="try --opacity 0.3",
        )
    around = look["environment"] or scene.environment
    shadows = scene.shadows if look["shadows"] is None else look["shadows"]
    scene = dataclasses.replace(scene, surface=shown, material=material, environment=around, shadows=shadows)
    paint.check_sides(scene, colors)
    _check_tracing(scene, look)
    return paint.painted(scene, look)


def tracing(look: dict[str, Any]) -> dict[str, Any]:
    """Those of the options that are no part of a scene, as ``render`` and ``animate`` take them."""
    return {name: look[name] for name in TRACING}


def _check_tracing(scene: Scene, look: dict[str, Any]) -> None:
    """Raise where such an option would do nothing."""
    if look["shadow_tolerance"] is not None and not scene.shadows:
        raise ParameterError("there is a --shadow-tolerance, and there are no shadows", hint="add --shadows")
    if look["depth"] is not None and all(each.opacity >= 1 and each.reflectance <= 0 for each in scene.materials):
        raise ParameterError(
            "--depth is about rays that go on, and none does: nothing mirrors or is transparent",
            hint="try --reflectance 0.5 or --opacity 0.3",
        )


def _coloring(coloring: Coloring | None, look: dict[str, Any]) -> Coloring | None:
    """What a surface is coloured by, with what the options say of it; one that nothing colours stays so."""
    if look["color_by"] is not None:
        from zeroset.scene.coloring import Coloring

        coloring = Coloring(look["color_by"])
    changes: dict[str, Any] = {}
    if look["color_map"] is not None:
        changes["map"] = look["color_map"]
    if look["color_range"] is not None:
        changes["range"] = _range(look["color_range"])
    return coloring if coloring is None else dataclasses.replace(coloring, **changes)


def _range(text: str) -> tuple[float, float]:
    try:
        low, high = (float(part) for part in text.split(","))
    except ValueError:
        raise ParameterError(f"cannot read the range {text!r}", hint="write two numbers: --range=-2,2") from None
    return low, high
