"""The scenes of an animation, frame by frame: all are made, and so checked, before the first is drawn.

Every scene has the same formula, method, kind of bounds and lights, so that all run on the same compiled kernels and in
the same buffers.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from zeroset.errors import CameraError, ParameterError, ZerosetError, did_you_mean
from zeroset.export.film.camera_path import Keys, turned
from zeroset.export.film.path import Moment, Path, as_path
from zeroset.hashes import SIZE, blake2b
from zeroset.scene.bounds import Ball, Bounds, number
from zeroset.scene.camera import Camera, fit_camera
from zeroset.scene.pictures import picture_bytes
from zeroset.scene.scene import Scene, as_scene
from zeroset.scene.several import Drawable, Several
from zeroset.scene.surface import Surface, surface

MOST_FRAMES = 100_000
"""Frames of an animation: an hour at 25 a second, and more."""
FASTEST = 240.0
"""Frames a second."""
SECONDS = 4.0
"""How long an animation takes that nobody gave a length."""
FITTED = 9
"""Moments at which bounds are fitted where none are given."""

Params = Callable[[float], Mapping[str, Any]]
CameraPath = Camera | Sequence[Camera] | Callable[[float], Camera] | None


def timing(frames: int | None, duration: float | None, fps: float) -> tuple[int, Fraction]:
    """How many frames there are, and how many a second.

    Example:
        >>> timing(None, 2.0, 25)
        (50, Fraction(25, 1))
    """
    rate = number(fps, "the frame rate", ParameterError)
    if not 0.01 <= rate <= FASTEST:
        raise ParameterError(f"the frame rate must be from 0.01 to {FASTEST:g} frames a second, not {fps!r}")
    if frames is not None and duration is not None:
        raise ParameterError("an animation has either a number of frames or a duration", hint="leave out one of them")
    if frames is None:
        length = number(SECONDS if duration is None else duration, "the duration", ParameterError)
        if not length > 0:
            raise ParameterError(f"the duration must be more than 0 seconds, not {duration!r}")
        frames = max(1, round(min(length * rate, 1e9)))
    if isinstance(frames, bool) or not isinstance(frames, int) or frames < 1:
        raise ParameterError(f"there must be a whole number of frames, at least one, not {frames!r}")
    if frames > MOST_FRAMES:
        raise ParameterError(f"{frames:,} frames are more than {MOST_FRAMES:,}", hint="draw it in parts")
    return frames, Fraction(rate).limit_denominator(1001)


def source_scene(source: Surface | Scene | str, vary: Mapping[str, Path], params: Params | None) -> Scene:
    """The scene to begin with; parameters of a formula given as text take the values of the beginning."""
    if not isinstance(source, str):
        return as_scene(source)
    values: dict[str, Any] = {name: path.at(Moment(0, 1)) for name, path in vary.items()}
    return Scene(surface(source, values | (dict(params(0.0)) if params is not None else {})))


def paths(vary: Mapping[str, Any] | None) -> dict[str, Path]:
    """What moves, each as a path."""
    if vary is not None and not isinstance(vary, Mapping):
        raise ParameterError(f"vary must be a mapping of names to motions, not {vary!r}", hint="try vary={'a': (1, 5)}")
    return {str(name): as_path(str(name), value) for name, value in (vary or {}).items()}


def storyboard(
    scene: Scene,
    count: int,
    vary: Mapping[str, Path],
    params: Params | None = None,
    camera: CameraPath = None,
    orbit: float = 0.0,
    closed: bool = False,
) -> list[Scene]:
    """The scene of every frame.

    Args:
        scene: what is common to all frames.
        count: how many frames there are.
        vary: motions of parameters.
        params: parameters' values by how far the animation is, from 0 to 1.
        camera: one for all frames, several to pass through, or a function as ``params``.
        orbit: degrees by which the camera turns about z on top of that.
        closed: whether the functions' values at 1 are those at 0 again, and are left to the next round.

    Raises:
        ZerosetError: nothing moves, or something moves that the surface has not, or to where it cannot.
    """
    degrees = number(orbit, "the orbit's angle", CameraError)
    _check_moves(scene.surface, vary, params, camera, degrees)
    moments = [Moment(i, count) for i in range(count)]
    shapes = [_shape(scene.surface, vary, params, moment, closed) for moment in moments]
    if scene.surface.bounds is None:
        limits = common_bounds([shapes[i] for i in sorted({round(i) for i in np.linspace(0, count - 1, FITTED)})])
        # Each of several surfaces keeps to bounds of its own.
        shapes = [shape if isinstance(shape, Several) else shape.with_bounds(limits) for shape in shapes]
    ways = _cameras(scene, shapes[0].fitted, camera, closed)
    return [
        dataclasses.replace(scene, surface=shape, camera=turned(ways(moment), degrees, moment))
        for shape, moment in zip(shapes, moments, strict=True)
    ]


def _check_moves(shape: Drawable, vary: Mapping[str, Path], params: Params | None, camera: Any, degrees: float) -> None:
    arrays = {name for surface in shape.surfaces for name in surface.field.arrays}
    known = sorted({name for surface in shape.surfaces for name in surface.field.parameters} | arrays)
    for name, path in vary.items():
        if name not in known:
            near = (
                *did_you_mean(name, known),
                f"it has {', '.join(known)}" if known else "it has none that could move",
            )
            raise ParameterError(f"the surface has no parameter {name!r}", hints=near)
        if (name in arrays) != (np.ndim(path.at(Moment(0, 1))) > 0):
            kind = "an array" if name in arrays else "a number"
            raise ParameterError(
                f"{name} is {kind}, and moves as one", hint="arrays move by a function: params=lambda s: {...}"
            )
    if not vary and params is None and not degrees and (camera is None or isinstance(camera, Camera)):
        hints = ["turn it once around: orbit=360"]
        hints += [f"move a parameter: vary={{'{known[0]}': (0, 1)}}; it has {', '.join(known)}"] if known else []
        raise ZerosetError("nothing moves in this animation", hints=hints)


def _shape(shape: Drawable, vary: Mapping[str, Path], params: Params | None, moment: Moment, closed: bool) -> Drawable:
    values: dict[str, Any] = {name: path.at(moment) for name, path in vary.items()}
    if params is not None:
        given = params(moment.share(closed))
        if not isinstance(given, Mapping):
            raise ParameterError(f"params must give a mapping of names to values, not {given!r}")
        values |= given
    return shape.with_params(**values)


def _cameras(scene: Scene, limits: Bounds, camera: CameraPath, closed: bool) -> Callable[[Moment], Camera]:
    if camera is None:
        fixed = scene.camera or scene.surface.camera or fit_camera(limits)
        return lambda _: fixed
    if isinstance(camera, Camera):
        return lambda _: camera
    if callable(camera):
        way = camera
        return lambda moment: _a_camera(way(moment.share(closed)))
    return Keys(camera).at


def _a_camera(value: object) -> Camera:
    if not isinstance(value, Camera):
        raise CameraError(f"the camera must be a Camera, several, or a function that gives one, not {value!r}")
    return value


def common_bounds(shapes: Sequence[Drawable]) -> Bounds:
    """A ball that holds the surfaces at several moments, each fitted."""
    each = [shape.fitted for shape in shapes]
    low = np.min([np.subtract(one.center, one.reach) for one in each], axis=0)
    high = np.max([np.add(one.center, one.reach) for one in each], axis=0)
    x, y, z = (float(v) for v in 0.5 * (low + high))
    return Ball(max(math.dist((x, y, z), one.center) + one.reach for one in each), (x, y, z))


def digest(scenes: Sequence[Scene]) -> str:
    """A hash of everything that a storyboard shows."""
    from zeroset.scene.file import dumps

    # The first scene in full holds what is common to all; the others differ in values and cameras alone.
    made = blake2b(dumps(scenes[0]).encode(errors="surrogateescape"), digest_size=SIZE)
    # The scene names its pictures; frames depend on what is in them.
    around = scenes[0].environment
    for path in () if around is None else around.files():
        made.update(picture_bytes(path))
    for scene in scenes:
        for shape in scene.surface.surfaces:
            arrays = [(name, shape.arrays[name].tolist()) for name in sorted(shape.arrays)]
            values = sorted(shape.params.items()), arrays
            made.update(repr((values, shape.bounds)).encode())
        made.update(repr((scene.surface.bounds, scene.camera)).encode())
    return made.hexdigest()
