"""``animate``: a surface over time, its parameters or its camera becomes a movie."""

from __future__ import annotations

import base64
import dataclasses
import os
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from zeroset.atomic import replacing
from zeroset.errors import OutputError, ParameterError, did_you_mean
from zeroset.export.film.claim import claimed
from zeroset.export.film.frames import Frames, Pixels
from zeroset.export.film.gif import DITHERS, FASTEST, write_gif
from zeroset.export.film.movie import QUALITIES, write_mp4
from zeroset.export.film.named import find
from zeroset.export.film.storyboard import CameraPath, Params, digest, paths, source_scene, storyboard, timing
from zeroset.export.film.target import Target, read_target
from zeroset.rendering.image import encode
from zeroset.rendering.render import render
from zeroset.runtime import Device, get_device
from zeroset.scene.scene import Scene
from zeroset.scene.surface import Surface
from zeroset.solve import Method, resolve_method

Progress = Callable[[float], None]
DRAWING = 0.7
"""The share of the work that drawing is reckoned to be; the rest is putting frames together."""
SHOWN = 64_000_000
"""Bytes of a movie that a notebook is given."""


@dataclass(frozen=True)
class Movie:
    """An animation that has been written.

    Attributes:
        path: the file, or what the files of single frames were named after.
        files: all files.
        frames: how many frames there are.
        fps: frames a second.
        size: width and height in pixels.
        drawn: how many frames were drawn; the others were there from before an interruption.
    """

    path: Path
    files: tuple[Path, ...]
    frames: int
    fps: float
    size: tuple[int, int]
    drawn: int

    def _repr_html_(self) -> str:
        """What a notebook shows: the movie itself, or its first frame."""
        file = self.files[0]
        kind = file.suffix[1:].lower()
        if file.stat().st_size > SHOWN:
            return f"<code>{file}</code>"
        data = base64.b64encode(file.read_bytes()).decode()
        if kind == "mp4":
            return f'<video controls autoplay loop muted src="data:video/mp4;base64,{data}"></video>'
        return f'<img src="data:image/{kind};base64,{data}">'


def animate(
    surface: Surface | Scene | str,
    path: str | os.PathLike[str],
    vary: Mapping[str, Any] | None = None,
    params: Params | None = None,
    camera: CameraPath = None,
    orbit: float | None = None,
    frames: int | None = None,
    duration: float | None = None,
    fps: float = 30.0,
    size: tuple[int, int] | int = (640, 480),
    method: str | Method = "auto",
    device: str | Device = "auto",
    tolerance: float | None = None,
    shadows: bool | None = None,
    antialias: int = 1,
    quality: str = "good",
    dither: str = "none",
    closed: bool = False,
    restart: bool = False,
    keep: bool = False,
    progress: Progress | None = None,
    shadow_tolerance: float | None = None,
    depth: int | None = None,
) -> Movie:
    """Draw a surface as it changes, into a movie or numbered pictures.

    Frames are kept as whole PNG files in a folder beside the output (``out.mp4.frames``) until all are there; after an
    interruption the same call goes on where it stopped. Nothing is compiled again from frame to frame.

    Args:
        surface: a Surface, a Scene, a formula as text, or the name of an animation (``zeroset animate --list``).
        path: ``.mp4``, ``.gif``, a picture's name with ``#`` for the frame's number, or a folder that ends in ``/``.
        vary: what moves: ``{"a": (1, 5)}``, ``{"w": "0:2pi:loop"}``; a motion is ``linear``, or one of ``loop``,
            ``ping-pong`` and ``sine``, which come back to where they began; ``"1:5:sine:3"`` does it three times.
        params: parameters' values, arrays among them, by how far the animation is: ``lambda s: {"r": [s, 1 - s]}``.
        camera: a Camera, several to pass through, or a function of how far the animation is.
        orbit: degrees by which the camera turns about z meanwhile.
        frames: how many there are; None takes ``duration * fps``.
        duration: seconds; None takes 4, or the named animation's own.
        fps: frames a second.
        size: width and height in pixels; one number for a square. MP4 adds a row or column to odd ones.
        method: as in ``render``.
        device: as in ``render``.
        tolerance: as in ``render``.
        shadows: as in ``render``.
        antialias: as in ``render``: rays of each pixel at an edge; 16 makes edges smooth.
        quality: of an MP4: ``"small"``, ``"good"`` or ``"best"``.
        dither: of a GIF: ``"none"`` or ``"diffused"``.
        closed: whether functions of how far the animation is give the same at 1 as at 0; they are then called with
            values below 1, so that the movie repeats without a jump.
        restart: throw away frames of another animation that are in the way, and begin anew.
        keep: leave the folder of frames there.
        progress: called now and then with the share that is done, from 0 to 1.
        shadow_tolerance: as in ``render``.
        depth: as in ``render``: how many surfaces a ray may meet after the first one.

    Raises:
        ZerosetError: and its kinds, before anything is drawn: for what does not move, what cannot be drawn and what
            cannot be written.

    Example:
        >>> import os, tempfile
        >>> import zeroset as zs
        >>> path = os.path.join(tempfile.mkdtemp(), "ball.gif")
        >>> movie = zs.animate("x^2 + y^2 + z^2 = r", path, {"r": (1, 2)}, frames=3, size=32)
        >>> movie.frames, movie.drawn, os.listdir(os.path.dirname(path))
        (3, 3, ['ball.gif'])
    """
    moving, named = paths(vary), find(surface) if isinstance(surface, str) else None
    if named is not None:
        surface, moving = named.scene, {**named.vary, **moving}
        orbit = named.orbit if orbit is None else orbit
        duration = named.duration if duration is None and frames is None else duration
    count, rate = timing(frames, duration, fps)
    target = read_target(path)
    target.check_room(count)
    _check_style(target, rate, quality, dither)
    scene = source_scene(surface, moving, params)
    if shadows is not None:
        scene = dataclasses.replace(scene, shadows=shadows)
    scenes = storyboard(scene, count, moving, params, camera, orbit or 0.0, closed)
    chosen, where = resolve_method(method), get_device(device)
    pixels = render_size(size)
    options: dict[str, Any] = {
        "tolerance": tolerance,
        "antialias": antialias,
        "shadow_tolerance": shadow_tolerance,
        "depth": depth,
    }
    kept = Frames(target.folder, _asked(scenes, pixels, chosen, options), count)

    def draw(one: Scene) -> bytes:
        return render(one, pixels, method=chosen, device=where, **options).png()

    with claimed(target.folder):
        kept.open(restart)
        try:
            drawn = _draw(kept, scenes, draw, _part(progress, 0.0, DRAWING))
            files = _assemble(target, kept, rate, quality, dither, _part(progress, DRAWING, 1.0))
        except BaseException:
            if not kept.kept():
                kept.close()
            raise
        if not keep:
            kept.close()
    return Movie(Path(path), files, count, float(rate), pixels, drawn)


def render_size(size: tuple[int, int] | int) -> tuple[int, int]:
    """Width and height of a size as ``render`` takes it."""
    pair = tuple(size) if isinstance(size, (tuple, list)) else (size, size)
    if len(pair) != 2 or any(isinstance(v, bool) or not isinstance(v, int) or v < 1 for v in pair):
        raise ParameterError(f"the size must be width and height in whole pixels, not {size!r}")
    return pair[0], pair[1]


def _asked(
    scenes: Sequence[Scene], size: tuple[int, int], method: Method, options: Mapping[str, Any]
) -> dict[str, Any]:
    """All that a frame depends on; what it is called is what a user is told has changed."""
    from zeroset import __version__

    return {
        "formula": "; ".join(surface.formula for surface in scenes[0].surface.surfaces),
        "frames": len(scenes),
        "size": f"{size[0]}x{size[1]}",
        "method": repr(method),
        **options,
        "version": __version__,
        "values": digest(scenes),
    }


def _check_style(target: Target, rate: Fraction, quality: str, dither: str) -> None:
    for what, value, known in (("quality", quality, QUALITIES), ("dither", dither, DITHERS)):
        if value not in known:
            hints = (*did_you_mean(str(value), known), f"there are {', '.join(known)}")
            raise ParameterError(f"there is no {what} {value!r}", hints=hints)
    for what, asked, kind in (("quality", quality != "good", "mp4"), ("dither", dither != "none", "gif")):
        if asked and target.kind != kind:
            raise ParameterError(f"the {what} is that of {kind.upper()} files, and {target.path.name} is none")
    if target.kind == "gif" and rate > FASTEST:
        raise ParameterError(f"a GIF shows at most {FASTEST} frames a second, not {float(rate):g}", hint="write .mp4")


def _part(progress: Progress | None, low: float, high: float) -> Progress:
    """The progress of a part of the work as that of the whole."""
    return (lambda _: None) if progress is None else lambda share: progress(low + (high - low) * share)


def _draw(kept: Frames, scenes: Sequence[Scene], draw: Callable[[Scene], bytes], progress: Progress) -> int:
    """Draw the frames that are not there; gives how many."""
    drawn = 0
    for i, scene in enumerate(scenes):
        progress(i / len(scenes))
        if not kept.has(i):
            kept.put(i, draw(scene))
            drawn += 1
    return drawn


def _assemble(
    target: Target, kept: Frames, rate: Fraction, quality: str, dither: str, progress: Progress
) -> tuple[Path, ...]:
    """Put all frames together; gives the files."""
    if not target.movie:
        return tuple(_stills(target, kept, progress))
    # Made among the frames, where nobody else sees it and nothing of it is left, and copied to where it shall be.
    scratch = kept.folder / f"movie-{os.getpid()}.{target.kind}"
    if target.kind == "mp4":
        write_mp4(scratch, kept, rate, quality, progress)
    else:
        write_gif(scratch, kept, rate, dither, progress)
    with replacing(target.path) as file, open(scratch, "rb") as made:
        shutil.copyfileobj(made, file)
    return (target.path,)


def _stills(target: Target, kept: Frames, progress: Progress) -> Iterator[Path]:
    try:
        target.still(0, len(kept)).parent.mkdir(exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the folder {str(target.path)!r}: {error.strerror or error}") from None
    for i in range(len(kept)):
        progress(i / len(kept))
        path = target.still(i, len(kept))
        pixels: Pixels | None = None if target.kind == "PNG" else kept[i]
        with replacing(path) as file:
            file.write(kept.png(i) if pixels is None else encode(pixels, target.kind))
        yield path
