"""``zeroset render``: a formula, a gallery name or a scene file becomes a picture."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from zeroset.cli.look import look_options, tracing, with_look
from zeroset.cli.progress import Progress
from zeroset.cli.source import (
    FormulaCommand,
    choose_camera,
    existing_folder,
    find_scene,
    picture_path,
    read_method,
    read_size,
    surface_options,
    with_isovalues,
)
from zeroset.errors import OutputError, ParameterError

if TYPE_CHECKING:
    from zeroset.rendering.image import Image
    from zeroset.scene.scene import Scene
    from zeroset.scene.several import Drawable


@click.command("render", cls=FormulaCommand)
@surface_options
@click.option("-o", "--output", default="zeroset.png", show_default=True, help="Picture to write.")
@click.option("-s", "--size", default="1024", show_default=True, help="Pixels: 800 or 1280x720.")
@click.option("--antialias", type=int, default=1, help="Rays of each pixel at an edge; 16 makes edges smooth.")
@click.option("--samples", type=int, default=1, help="Rays of every pixel, instead.")
@click.option("-t", "--tolerance", type=float, help="World length to which roots are found.")
@click.option("--eye", metavar="X,Y,Z", help="Where the camera is.")
@click.option("--target", metavar="X,Y,Z", help="What it looks at.")
@click.option("--up", metavar="X,Y,Z", help="What is upwards in the picture.")
@click.option("--fov", type=float, help="Opening angle in degrees, for perspective.")
@click.option("--height", type=float, help="World length across the picture, for an orthographic camera.")
@click.option("--orbit", type=float, default=0.0, help="Turn the camera about z by so many degrees.")
@click.option("--isovalues", metavar="V,V,...", help="Draw f = v for each of these values, instead of f = 0.")
@look_options
@click.option("--legend", is_flag=True, help="Draw a colour bar onto the picture; with --color-by.")
@click.option("--save-scene", metavar="FILE", help="Write the scene as a .toml file too.")
@click.option(
    "--save-outputs",
    metavar="FILE",
    help="Write depth, normal, status, steps, t, the value coloured by, and the part met as a NumPy .npz file too.",
)
def command(
    source: str,
    params: tuple[str, ...],
    bounds: str | None,
    method: str,
    device: str,
    output: str,
    size: str,
    antialias: int,
    samples: int,
    tolerance: float | None,
    eye: str | None,
    target: str | None,
    up: str | None,
    fov: float | None,
    height: float | None,
    orbit: float,
    isovalues: str | None,
    legend: bool,
    save_scene: str | None,
    save_outputs: str | None,
    **look: Any,
) -> None:
    """Draw SOURCE: a formula such as "x^2 + y^2 = z", a gallery name, or a scene file."""
    import dataclasses

    from zeroset.rendering.image import picture_format
    from zeroset.rendering.render import render
    from zeroset.runtime import twin

    path = picture_path(output)
    for extra, suffix in ((save_scene, ".toml"), (save_outputs, ".npz")):
        if extra is None:
            continue
        existing_folder(extra)
        if Path(extra).suffix.lower() != suffix:
            raise OutputError(f"{extra!r} would be a {suffix} file", hint=f"call it {Path(extra).stem}{suffix}")
    scene = with_isovalues(find_scene(source, params, bounds), isovalues)
    scene = with_look(scene, look)
    if legend and scene.coloring is None:
        raise ParameterError("there is nothing that a legend could explain", hint="try --color-by gaussian-curvature")
    scene = dataclasses.replace(scene, camera=choose_camera(scene, eye, target, up, fov, height, orbit))
    twin.allow()
    begin = time.perf_counter()
    with Progress("drawing", meanwhile=None if picture_format(path) == "PNG" else _load_formats) as progress:
        image = render(
            scene,
            read_size(size),
            None,
            read_method(method),
            device,
            tolerance,
            antialias=antialias,
            samples=samples,
            progress=progress,
            **tracing(look),
        )
    spent = time.perf_counter() - begin
    _save(image, scene, path, legend, save_scene, save_outputs)
    _tell(image, path, spent, scene.surface)


def _load_formats() -> None:
    """Load Pillow, and the formats that it loads before it writes a picture of any."""
    from PIL import Image as Pillow

    Pillow.preinit()


def _save(
    image: Image, scene: Scene, path: Path, legend: bool, save_scene: str | None, save_outputs: str | None
) -> None:
    image.save(path, legend)
    if save_scene is not None:
        from zeroset.scene.file import save

        save(scene, save_scene)
    if save_outputs is not None:
        import numpy as np

        from zeroset.atomic import replacing

        with replacing(save_outputs) as file:
            names = (name for name in image.outputs if name != "part" or len(scene.materials) > 1)
            outputs: dict[str, Any] = {name: image.aov(name) for name in names}
            np.savez_compressed(file, **outputs)


def _tell(image: Image, path: Path, spent: float, shown: Drawable) -> None:
    width, height = image.size
    notes = f", {image.unresolved} of them unresolved" if image.unresolved else ""
    click.echo(f"{path}: {width}x{height}, {image.hits} pixels of surface{notes}, {spent * 1e3:.0f} ms")
    if image.coloring is not None and image.range is not None:
        low, high = image.range
        click.echo(f"colours: {image.coloring.quantity.title} from {low:.4g} to {high:.4g}")
    if not image.hits:
        everywhere = all(surface.settled.field.continuous for surface in shown.surfaces)
        proof = "certified: " if image.certified and everywhere else ""
        beside = "" if everywhere else ", where f jumps or ends to have a value aside (for sqrt(g) = 0 write g = 0)"
        click.echo(
            f"{proof}no ray meets a zero of f inside {shown.fitted}{_guess(shown)}{beside}; the picture is empty. "
            "Try other --bounds, or another --eye.",
            err=True,
        )


def _guess(shown: Drawable) -> str:
    """What is to be said of bounds that were looked for where there was nothing that they could hold."""
    from zeroset.scene.fit import NOTHING, SEARCHED

    if shown.bounds is not None or shown.fitted != NOTHING:
        return ""
    return f" (a guess, for nothing was found up to {SEARCHED[-1]:.0f} from the origin)"
