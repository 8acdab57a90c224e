"""``zeroset animate``: a surface as its parameters, time or the camera move, as a movie or as numbered pictures."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from zeroset.cli.look import look_options, tracing, with_look
from zeroset.cli.progress import Progress
from zeroset.cli.source import FormulaCommand, find_scene, read_method, read_size, read_triple, surface_options
from zeroset.errors import CameraError, ParameterError, ZerosetError

if TYPE_CHECKING:
    from zeroset.export.animate import Movie
    from zeroset.export.film.named import Named
    from zeroset.scene.camera import Camera
    from zeroset.scene.scene import Scene


def _list(context: click.Context, option: click.Parameter, wanted: bool) -> None:
    """Print the named animations and be done; asked for before it is seen that a source is missing."""
    if not wanted:
        return
    from zeroset.export.film.named import find, names

    width = max(map(len, names()))
    for item in filter(None, map(find, names())):
        click.echo(f"{item.name:{width}}  {item.duration:g} s  {item.source:22}  {item.title}")
    click.echo(f"\n{len(names())} animations. Draw one: zeroset animate NAME -o out.mp4")
    context.exit()


@click.command("animate", cls=FormulaCommand)
@surface_options
@click.option(
    "-o", "--output", default="zeroset.mp4", show_default=True, help=".mp4, .gif, out-####.png or another picture's "
    "name with # for the frame's number, or folder/."
)  # fmt: skip
@click.option(
    "--vary", multiple=True, metavar="NAME=A:B[:HOW[:TIMES]]",
    help="Move a parameter from A to B: linear, loop, ping-pong or sine. w=0:2pi:loop",
)  # fmt: skip
@click.option("--orbit", type=float, help="Degrees by which the camera turns about z.")
@click.option(
    "--key", "keys", multiple=True, metavar="EYE[/TARGET[/FOV]]",
    help="A camera to pass through; give several: --key 3,-5,2 --key 5,3,2/0,0,1/30.",
)  # fmt: skip
@click.option("--frames", type=int, help="How many there are; otherwise duration times fps.")
@click.option("--duration", type=float, help="Seconds; 4 if nothing else says it.")
@click.option("--fps", type=float, default=30.0, show_default=True, help="Frames a second.")
@click.option("-s", "--size", default="640x480", show_default=True, help="Pixels: 800 or 1280x720.")
@click.option("-t", "--tolerance", type=float, help="World length to which roots are found.")
@look_options
@click.option("--antialias", type=int, default=1, help="Rays of each pixel at an edge; 16 makes edges smooth.")
@click.option("--quality", default="good", show_default=True, help="Of an MP4: small, good or best.")
@click.option("--dither", default="none", show_default=True, help="Of a GIF: none or diffused.")
@click.option("--restart", is_flag=True, help="Throw away frames of another animation that are in the way.")
@click.option("--keep", is_flag=True, help="Leave the folder of single frames there.")
@click.option(
    "--list", is_flag=True, is_eager=True, expose_value=False, callback=_list, help="List the named animations."
)
def command(
    source: str,
    params: tuple[str, ...],
    bounds: str | None,
    method: str,
    device: str,
    output: str,
    vary: tuple[str, ...],
    orbit: float | None,
    keys: tuple[str, ...],
    frames: int | None,
    duration: float | None,
    fps: float,
    size: str,
    tolerance: float | None,
    antialias: int,
    quality: str,
    dither: str,
    restart: bool,
    keep: bool,
    **look: Any,
) -> None:
    """Draw SOURCE as it changes: a formula, a gallery name, a scene file, or an animation of --list.

    An interrupted animation goes on where it stopped when it is asked for again.
    """
    from zeroset.export.animate import animate

    moving: dict[str, Any] = {}
    for name, how in map(_motion, vary):
        if name in moving:
            raise ParameterError(f"{name} is to move in two ways", hint="say --vary once for each name")
        moving[name] = how
    for name in moving.keys() & {text.partition("=")[0].strip() for text in params}:
        raise ParameterError(f"{name} has a value and is to move", hint=f"leave out -p {name}=... or --vary {name}=...")
    named, scene = _find(source, params, bounds, moving)
    scene = with_look(scene, look)
    if named is not None:
        moving = {**named.vary, **moving}
        orbit = named.orbit if orbit is None else orbit
        duration = named.duration if duration is None and frames is None else duration
    cameras = [_key(text, scene) for text in keys] or None
    begin = time.perf_counter()
    try:
        with Progress("drawing frames") as progress:
            movie = animate(
                scene, output, moving, None, cameras, orbit, frames, duration, fps, read_size(size),
                read_method(method), device, tolerance, None, antialias, quality, dither,
                restart=restart, keep=keep, progress=progress, **tracing(look),
            )  # fmt: skip
    except KeyboardInterrupt:
        _tell_kept(output)
        raise
    _tell(movie, time.perf_counter() - begin)


def _motion(text: str) -> tuple[str, str]:
    name, equals, motion = text.partition("=")
    if not equals:
        raise ParameterError(f"cannot read what moves in {text!r}", hint="write --vary a=1:5, or --vary w=0:2pi:loop")
    return name.strip(), motion


def _find(
    source: str, params: tuple[str, ...], bounds: str | None, moving: dict[str, Any]
) -> tuple[Named | None, Scene]:
    """The scene to begin with, and the named animation that it comes from."""
    import dataclasses

    from zeroset.cli.source import read_bounds, read_parameters
    from zeroset.export.film.named import find
    from zeroset.export.film.path import Moment
    from zeroset.export.film.storyboard import paths
    from zeroset.scene.surface import surface
    from zeroset.surfaces import names

    named = find(source)
    if named is not None:
        limits = None if bounds is None else read_bounds(bounds)
        shape = surface(named.scene.surface, read_parameters(params), limits)
        return named, dataclasses.replace(named.scene, surface=shape)
    # A formula's parameter that moves needs no other value; the gallery's and files' have one.
    given = {text.partition("=")[0].strip() for text in params}
    valued = source.endswith(".toml") or source in names()
    starts = {} if valued else {name: path.at(Moment(0, 1)) for name, path in paths(moving).items()}
    try:
        return None, find_scene(
            source, (*params, *(f"{name}={value!r}" for name, value in starts.items() if name not in given)), bounds
        )
    except ZerosetError as error:
        # The word is no formula and no surface: it may have been meant for an animation.
        raise _with_animations(source, error) from None


def _with_animations(source: str, error: ZerosetError) -> ZerosetError:
    from zeroset.errors import UnknownSurfaceError, did_you_mean
    from zeroset.export.film.named import names

    if not isinstance(error, UnknownSurfaceError):
        return error
    near = did_you_mean(source, names())
    hints = dict.fromkeys((*near, *error.hints, "zeroset animate --list has the animations"))
    return UnknownSurfaceError(error.message, hints=hints)


def _key(text: str, scene: Scene) -> Camera:
    """A camera of a path: its eye, and what it looks at and how widely if not as the scene's own."""
    import dataclasses

    from zeroset.scene.camera import fit_camera

    camera = scene.camera or scene.surface.camera or fit_camera(scene.surface.fitted)
    eye, *rest = text.split("/")
    camera = dataclasses.replace(camera, eye=read_triple(eye, "the eye"))
    try:
        if rest:
            camera = dataclasses.replace(camera, target=read_triple(rest[0], "the target"))
        if len(rest) > 1:
            camera = dataclasses.replace(camera, fov=float(rest[1]), height=None)
        if len(rest) > 2:
            raise ValueError
    except ValueError as error:
        if isinstance(error, CameraError):
            raise
        raise CameraError(f"cannot read the key {text!r}", hint="write EYE, EYE/TARGET or EYE/TARGET/FOV") from None
    return camera


def _tell(movie: Movie, spent: float) -> None:
    width, height = movie.size
    shown: Path | str = movie.path if len(movie.files) == 1 else f"{movie.files[0]} to {movie.files[-1].name}"
    again = f", {movie.frames - movie.drawn} of them drawn before" if movie.drawn < movie.frames else ""
    seconds = movie.frames / movie.fps
    click.echo(
        f"{shown}: {width}x{height}, {movie.frames} frames{again}, {seconds:.4g} s at {movie.fps:g} a second; "
        f"made in {spent:.1f} s"
    )


def _tell_kept(output: str) -> None:
    """Say what is left of an interrupted animation, and how it goes on."""
    from zeroset.export.film.target import read_target

    folder = read_target(output).folder
    count = len(list(folder.glob("[0-9]*.png")))
    if count:
        click.echo(f"{count} frames are kept in {folder}: the same command goes on from there", err=True)
