"""The job of the drawing thread: a picture for the window."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.rendering.image import Image
from zeroset.rendering.render import render
from zeroset.runtime import get_device
from zeroset.scene.camera import Camera
from zeroset.scene.scene import Scene
from zeroset.solve.method import Method
from zeroset.view.overlay import Legend, coloured
from zeroset.view.worker import GivenUp, Superseded

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

    @property
    def formulas(self) -> tuple[str, ...]:
        """What tells the formulas of its surfaces from others."""
        return tuple(surface.field.digest for surface in self.scene.surface.surfaces)


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
            "params": parameters(shot.scene),
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


def parameters(scene: Scene) -> dict[str, float]:
    """The values of all parameters; of several surfaces with the surface's number before each name.

    Example:
        >>> import zeroset as zs
        >>> ball = zs.surface("x^2 + y^2 + z^2 = r", {"r": 2.0})
        >>> parameters(Scene(ball)), parameters(Scene([ball, ball.with_params(r=3.0)]))
        ({'r': 2.0}, {'1.r': 2.0, '2.r': 3.0})
    """
    surfaces = scene.surface.surfaces
    if len(surfaces) == 1:
        return dict(surfaces[0].params)
    return {f"{i}.{name}": value for i, surface in enumerate(surfaces, 1) for name, value in surface.params.items()}


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
