"""``zeroset view``: a formula, a gallery name or a scene file in a live window."""

from __future__ import annotations

import os
import sys
from dataclasses import replace

import click

from zeroset.cli.source import (
    FormulaCommand,
    find_scene,
    read_bounds,
    read_method,
    read_parameters,
    read_size,
    with_isovalues,
)
from zeroset.errors import UnknownNameError
from zeroset.scene.scene import Scene

FIRST = "barth-sextic"
"""What the window shows when nothing is asked for."""


@click.command("view", cls=FormulaCommand)
@click.argument("source", metavar="[FORMULA|NAME|FILE]", default=FIRST, required=False)
@click.option("-p", "--param", "params", multiple=True, metavar="NAME=VALUE", help="Value of a parameter.")
@click.option("-b", "--bounds", metavar="R|X0,...,Z1", help="Ball radius, or x0,y0,z0,x1,y1,z1.")
@click.option("-m", "--method", default="auto", show_default=True, help="Ray method, as for render.")
@click.option("-d", "--device", default="auto", show_default=True, help="Where to run.")
@click.option("-t", "--tolerance", type=float, help="World length to which roots are found.")
@click.option("--isovalues", metavar="V,V,...", help="Draw f = v for each of these values, instead of f = 0.")
@click.option("-s", "--size", default="1280x800", show_default=True, help="Size of the window.")
@click.option("--log", metavar="FILE", help="Write what happens to a file, one JSON object a line.")
def command(
    source: str,
    params: tuple[str, ...],
    bounds: str | None,
    method: str,
    device: str,
    tolerance: float | None,
    isovalues: str | None,
    size: str,
    log: str | None,
) -> None:
    """Show SOURCE in a window: turn it, change its formulas, move its parameters."""
    from zeroset.view.log import Log
    from zeroset.view.show import start, window

    scene, texts = _find(source, params, bounds)
    state = start(with_isovalues(scene, isovalues), texts, read_method(method), device, tolerance)
    if not window(state, read_size(size), Log(log)):
        # Something is still being compiled, which cannot be interrupted and which nobody waits for any more.
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(0)


def _find(source: str, params: tuple[str, ...], bounds: str | None) -> tuple[Scene, tuple[str, ...]]:
    """The scene, and the text for each formula box; single letters without a value become parameters."""
    from zeroset.view.show import scene_of
    from zeroset.view.state import BACKGROUND

    try:
        scene = find_scene(source, params, bounds)
    except UnknownNameError:
        from zeroset.view.formula import read

        limits = None if bounds is None else read_bounds(bounds)
        scene = Scene(read(source, read_parameters(params), bounds=limits).surface)
    scene, texts = scene_of(scene)
    if not (scene.surface.name or source.endswith(".toml")):
        # The formula as it was written.
        texts = (source,)
    # A scene file says what lies behind; a formula or a name leaves it to the window.
    return (scene if source.endswith(".toml") else replace(scene, background=BACKGROUND)), texts
