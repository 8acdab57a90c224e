"""The jobs of the drawing threads: a picture for the window, and the first picture of a new formula."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.rendering.image import Image
from zeroset.rendering.render import render
from zeroset.runtime import get_device
from zeroset.scene.bounds import Bounds
from zeroset.scene.camera import Camera, fit_camera
from zeroset.scene.scene import Scene
from zeroset.scene.surface import Surface
from zeroset.solve.method import Method
from zeroset.view import formula
from zeroset.view.orbit import refitted
from zeroset.view.overlay import Legend, coloured
from zeroset.view.state import dressed
from zeroset.view.worker import GivenUp, Superseded

FIRST = 320
"""Longer side of the first picture of a formula: it is there as soon as the formula is compiled."""

DRAFT_DEPTH = 2
"""Surfaces that a ray may meet after the first while something moves: into glass and out again."""


@dataclass(frozen=True)
class Shot:
    """A picture that is wanted.

    Attributes:
        moving: whether it is one of many in a row; at rest thin parts are drawn too, and there is time.
        antialias: rays of each pixel at an edge, at rest.
        asked: when it was asked for.
    """

    scene: Scene
    size: tuple[int, int]
    method: Method
    device: str
    tolerance: float | None
    overlay: str
    moving: bool
    antialias: int = 1
    asked: float = field(default_factory=time.perf_counter, compare=False)


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture that is there.

    Attributes:
        pixels: (height, width, 4) uint8.
        depth: (height, width) float32, inf where nothing is hit.
        milliseconds: how long it took to draw.
        device: the name of the device that drew it.
    """

    shot: Shot
    pixels: npt.NDArray[np.uint8]
    depth: npt.NDArray[np.float32]
    legend: Legend | None
    milliseconds: float
    hits: int
    unresolved: int
    certified: bool
    device: str

    @property
    def facts(self) -> dict[str, Any]:
        """What a log tells of it; ``waited`` is what passed since it was asked for, drawing aside."""
        shot = self.shot
        return {
            "size": list(shot.size),
            "milliseconds": round(self.milliseconds, 2),
            "waited": round((time.perf_counter() - shot.asked) * 1e3 - self.milliseconds, 2),
            "params": dict(shot.scene.plain("the window").params),
            "hits": self.hits,
            "unresolved": self.unresolved,
            "certified": self.certified,
            "overlay": shot.overlay,
            "antialias": 1 if shot.moving else shot.antialias,
            "method": shot.method.name,
            "device": self.device,
        }

    @property
    def camera(self) -> Camera:
        """The camera that it was taken with."""
        camera = self.shot.scene.camera
        assert camera is not None
        return camera


def paint(shot: Shot, superseded: Superseded) -> Picture:
    """Draw a picture; one that is drawn at rest gives up when something else is wanted."""

    def look_up(share: float) -> None:
        if superseded():
            raise GivenUp

    begin = time.perf_counter()
    image = render(
        shot.scene,
        shot.size,
        method=shot.method,
        device=shot.device,
        tolerance=shot.tolerance,
        draft=shot.moving,
        depth=DRAFT_DEPTH if shot.moving else None,
        antialias=1 if shot.moving else shot.antialias,
        progress=None if shot.moving else look_up,
    )
    spent = (time.perf_counter() - begin) * 1e3
    return _kept(shot, image, spent)


def _kept(shot: Shot, image: Image, milliseconds: float) -> Picture:
    """All that the window wants of an image, copied: the image itself would be copied at the next draw."""
    colours, legend = coloured(image, shot.overlay)
    pixels = np.full((*colours.shape[:2], 4), 255, np.uint8)
    pixels[..., :3] = colours
    depth, device = image.aov("depth"), get_device(shot.device).name
    return Picture(shot, pixels, depth, legend, milliseconds, image.hits, image.unresolved, image.certified, device)


@dataclass(frozen=True)
class Wish:
    """A formula, or a surface from the gallery, that is to be shown.

    Attributes:
        source: text that has been read, or a scene with everything that comes with it.
        bounds: the bounds to keep if the surface is seen in them; None fits it.
        seen: bounds of what is shown now: the camera follows from them to new ones.
        shot: how the picture is drawn.
    """

    source: formula.Reading | Scene
    bounds: Bounds | None
    seen: Bounds
    shot: Shot


@dataclass(frozen=True, eq=False)
class Shown:
    """A formula that has been compiled, with its first picture.

    Attributes:
        refit: whether its bounds were fitted.
    """

    wish: Wish
    surface: Surface
    camera: Camera
    refit: bool
    fresh: tuple[str, ...]
    picture: Picture


def compile_and_show(wish: Wish, superseded: Superseded) -> Shown:
    """Make the surface, compile it, and draw it small."""
    if isinstance(wish.source, Scene):
        return _show_scene(wish, wish.source)
    reading = replace(wish.source, surface=replace(wish.source.surface, bounds=wish.bounds))
    shown = _show(wish, reading, wish.bounds is None)
    if wish.bounds is not None and not shown.picture.hits and not superseded():
        # Nothing of it lies in the old bounds: look where it is.
        shown = _show(wish, replace(reading, surface=replace(reading.surface, bounds=None)), True)
    return shown


def _show_scene(wish: Wish, scene: Scene) -> Shown:
    shape = scene.plain("the window")
    refit = shape.bounds is None
    surface = shape.with_bounds(shape.fitted)
    camera = scene.camera or surface.camera or fit_camera(surface.fitted)
    return Shown(wish, surface, camera, refit, (), _first(wish.shot, surface, camera))


def _show(wish: Wish, reading: formula.Reading, refit: bool) -> Shown:
    surface = reading.surface.with_bounds(reading.surface.fitted)
    camera = wish.shot.scene.camera
    assert camera is not None
    if not _alike(wish.seen, surface.fitted):
        camera = refitted(camera, wish.seen, surface.fitted)
    return Shown(wish, surface, camera, refit, reading.fresh, _first(wish.shot, surface, camera))


def _first(shot: Shot, surface: Surface, camera: Camera) -> Picture:
    width, height = shot.size
    scale = min(1.0, FIRST / max(width, height))
    size = max(1, round(width * scale)), max(1, round(height * scale))
    scene = replace(shot.scene, surface=surface, camera=camera, material=dressed(shot.scene.material, surface))
    return paint(replace(shot, scene=scene, size=size, moving=True), lambda: False)


def _alike(before: Bounds, after: Bounds) -> bool:
    """Whether bounds are so alike that the camera may stay where it is."""
    apart = math.dist(before.center, after.center)
    return apart < 0.15 * before.reach and 0.8 < after.reach / before.reach < 1.25
