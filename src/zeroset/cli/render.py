"""``zeroset render``: a formula, a gallery name or a scene file becomes a picture."""

from __future__ import annotations

import time

import click

from zeroset.cli.progress import Progress
from zeroset.cli.source import choose_camera, existing_folder, find_scene, read_size, surface_options


@click.command("render")
@surface_options
@click.option("-o", "--output", default="zeroset.png", show_default=True, help="Picture to write.")
@click.option("-s", "--size", default="1024", show_default=True, help="Pixels: 800 or 1280x720.")
@click.option("-t", "--tolerance", type=float, help="World length to which roots are found.")
@click.option("--eye", metavar="X,Y,Z", help="Where the camera is.")
@click.option("--target", metavar="X,Y,Z", help="What it looks at.")
@click.option("--fov", type=float, help="Opening angle in degrees.")
@click.option("--orbit", type=float, default=0.0, help="Turn the camera about z by so many degrees.")
@click.option("--save-scene", metavar="FILE", help="Write the scene as a .toml file too.")
def command(
    source: str,
    params: tuple[str, ...],
    bounds: str | None,
    method: str,
    device: str,
    output: str,
    size: str,
    tolerance: float | None,
    eye: str | None,
    target: str | None,
    fov: float | None,
    orbit: float,
    save_scene: str | None,
) -> None:
    """Draw SOURCE: a formula such as "x^2 + y^2 = z", a gallery name, or a scene file."""
    from zeroset.render.render import render

    path = existing_folder(output)
    scene = find_scene(source, params, bounds)
    camera = choose_camera(scene, eye, target, fov, orbit)
    begin = time.perf_counter()
    with Progress("drawing") as progress:
        image = render(scene, read_size(size), camera, method, device, tolerance, progress=progress)
    spent = time.perf_counter() - begin
    image.save(path)
    if save_scene is not None:
        import dataclasses

        from zeroset.scene.file import save

        save(dataclasses.replace(scene, camera=camera), save_scene)
    width, height = image.size
    notes = f", {image.unresolved} of them unresolved" if image.unresolved else ""
    click.echo(f"{path}: {width}x{height}, {image.hits} pixels of surface{notes}, {spent * 1e3:.0f} ms")
    if not image.hits:
        click.echo(_why_empty(scene.surface.fitted, image.certified), err=True)


def _why_empty(bounds: object, certified: bool) -> str:
    certain = "certified: " if certified else ""
    return f"{certain}no ray meets a zero of f inside {bounds}; the picture is empty. Try other --bounds, or another --eye."
