"""Where the camera is in each frame: on a circle around what it looks at, or on a smooth way through given cameras.

Between cameras the place looked at, the distance, the opening and the directions to the eye and upwards are
interpolated each by itself, so that the camera goes around the surface and not through it. The curve is Catmull and
Rom's, written as Barry and Goldman do, as straight interpolations of straight interpolations: with arcs of great
circles in their place it works for directions as well.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.errors import CameraError
from zeroset.export.film.path import Moment
from zeroset.scene.camera import Camera

Array = npt.NDArray[np.float64]
Mix = Callable[[Array, Array, float], Array]

NEARLY_OPPOSITE = math.radians(179.0)
"""Between directions farther apart there is no telling which way round to go."""


def lerp(a: Array, b: Array, share: float) -> Array:
    """The straight line through two points."""
    return a + (b - a) * share


def slerp(a: Array, b: Array, share: float) -> Array:
    """The great circle through two directions of length 1.

    Example:
        >>> slerp(np.array([1.0, 0.0]), np.array([0.0, 1.0]), 1 / 3).round(6).tolist()
        [0.866025, 0.5]
    """
    across = b - a * float(a @ b)
    sine = float(np.linalg.norm(across))
    if sine < 1e-12:
        return a
    angle = math.atan2(sine, float(a @ b)) * share
    return a * math.cos(angle) + across * (math.sin(angle) / sine)


def curve(points: Sequence[Array], position: float, closed: bool, mix: Mix) -> Array:
    """A smooth curve through points, the n-th at ``position`` n."""
    count = len(points)
    part = math.floor(position) if closed else min(math.floor(position), count - 2)
    t = position - part

    def point(i: int) -> Array:
        if closed or 0 <= i < count:
            return points[i % count]
        # Beyond an end the curve goes on as it came.
        return mix(points[0], points[1], -1.0) if i < 0 else mix(points[-2], points[-1], 2.0)

    level = [point(part + i) for i in (-1, 0, 1, 2)]
    spans = ((-1.0, 0.0), (0.0, 1.0), (1.0, 2.0)), ((-1.0, 1.0), (0.0, 2.0)), ((0.0, 1.0),)
    for span in spans:
        level = [mix(level[i], level[i + 1], (t - low) / (high - low)) for i, (low, high) in enumerate(span)]
    return level[0]


class Keys:
    """A camera that passes through others, evenly in time; one that is given first and last makes the way closed.

    Example:
        >>> way = Keys([Camera((0, -4, 0)), Camera((4, 0, 0))])
        >>> [round(v, 6) for v in way.at(Moment(1, 3)).eye]
        [2.828427, -2.828427, 0.0]
    """

    def __init__(self, cameras: Sequence[Camera]) -> None:
        if not isinstance(cameras, (list, tuple)):
            raise CameraError(f"the camera must be a Camera, a list of them, or a function, not {cameras!r}")
        for item in cameras:
            if not isinstance(item, Camera):
                raise CameraError(f"a camera path is made of Cameras, not of {item!r}")
        if len(cameras) < 2:
            raise CameraError("a camera path needs at least two cameras", hint="give more keys")
        if len({item.height is None for item in cameras}) > 1:
            raise CameraError("a camera path cannot go from perspective to orthographic")
        self.closed = len(cameras) > 2 and cameras[0] == cameras[-1]
        self._keys = tuple(cameras[:-1]) if self.closed else tuple(cameras)
        offsets = [np.subtract(item.eye, item.target) for item in self._keys]
        self._targets = [np.array(item.target) for item in self._keys]
        self._towards = _directions(offsets, "eyes", self.closed)
        self._up = _directions([np.array(item.up) for item in self._keys], "up", self.closed)
        # Distances and widths as logarithms: they stay positive, and zooming is even.
        self._sizes = [
            np.log([float(np.linalg.norm(offset)), item.height or math.tan(math.radians(item.fov or 0.0) / 2)])
            for offset, item in zip(offsets, self._keys, strict=True)
        ]

    def at(self, moment: Moment) -> Camera:
        """The camera in a frame."""
        position = moment.share(self.closed) * (len(self._keys) - (not self.closed))

        def on(points: Sequence[Array], mix: Mix) -> Array:
            return curve(points, position, self.closed, mix)

        distance, width = np.exp(on(self._sizes, lerp))
        target = on(self._targets, lerp)
        eye = target + distance * on(self._towards, slerp)
        up = on(self._up, slerp)
        opening: dict[str, Any] = {"fov": math.degrees(2 * math.atan(width))}
        if self._keys[0].height is not None:
            opening = {"fov": None, "height": float(width)}
        return Camera(_triple(eye), _triple(target), _triple(up), **opening)


def _triple(values: Array) -> tuple[float, float, float]:
    x, y, z = (float(v) for v in values)
    return x, y, z


def _directions(vectors: Sequence[Array], what: str, closed: bool) -> list[Array]:
    """Vectors with length 1; raises ``CameraError`` where it is open which way leads from one to the next."""
    unit = [vector / np.linalg.norm(vector) for vector in vectors]
    pairs = itertools.pairwise([*unit, unit[0]] if closed else unit)
    for i, (a, b) in enumerate(pairs, 1):
        if math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b)) > NEARLY_OPPOSITE:
            raise CameraError(
                f"the {what} of cameras {i} and {i % len(unit) + 1} are on opposite sides",
                hint="put a camera between them that says which way to go",
            )
    return unit


def turned(camera: Camera, degrees: float, moment: Moment) -> Camera:
    """A camera turned about z as far as it is by now; whole turns are closed, others end where they were to end."""
    angle = degrees * moment.share(closed=degrees % 360.0 == 0.0)
    return camera.orbit(angle) if angle else camera
