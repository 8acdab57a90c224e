"""What surrounds a scene: a sky and a room that need no file, or pictures all around.

All become one thing, a cube map: six square faces (+x -x +y -y +z -z, z upwards) of linear RGB, seen from the inside.
Pictures are read in any format that Pillow knows, or as ``.hdr`` (Radiance) for light beyond white, and they are

- equirectangular: twice as wide as high, the middle towards +x, the left quarter towards +y, the top upwards;
- or a cube map, in six files or in one (a cross or a strip): right is +x, front is +y, top is +z (``cubemap``).
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.errors import ParameterError, did_you_mean
from zeroset.scene import cubemap
from zeroset.scene.light import BRIGHTEST
from zeroset.scene.pictures import picture_size, read_picture

Floats = npt.NDArray[np.float64]
SIDE = 256
"""Texels along a face of the built-in surroundings."""
LARGEST_SIDE = 1024
BUILT_IN = ("sky", "room")
SHAPES = "it is twice as wide as high, or six faces as a cross (4:3 or 3:4) or a strip (6:1 or 1:6)"


@dataclass(frozen=True)
class Environment:
    """The surroundings of a scene.

    Attributes:
        source: ``"sky"``, ``"room"``, or pictures: the path of an equirectangular picture or of a cube map in one
            picture (a cross or a strip, told by its shape); a path with ``{face}`` in it, which stands for right,
            left, top, bottom, front and back (or posx, negx ... or px, nx ...); or six paths, in that order or named
            so. Right is +x, front is +y, top is +z.
        strength: factor of its light.

    Example:
        >>> Environment("sky").texels().shape
        (1179648,)
    """

    source: str | tuple[str, ...]
    strength: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "source", _as_source(self.source))
        strength = self.strength
        known = isinstance(strength, (int, float)) and not isinstance(strength, bool)
        if not (known and math.isfinite(strength) and 0 <= strength <= BRIGHTEST):
            raise ParameterError(f"an environment's strength must be a number from 0, not {strength!r}")
        object.__setattr__(self, "strength", float(strength))
        if isinstance(self.source, tuple):
            if len(self.source) != 6:
                cubemap.face_files(self.source)
        elif self.source not in BUILT_IN and not Path(self.source).suffix:
            raise ParameterError(
                f"there is no environment {self.source!r}",
                hints=(*did_you_mean(self.source, BUILT_IN), "there are sky and room, or give a picture's file name"),
            )

    def texels(self) -> npt.NDArray[np.float32]:
        """The cube map, flat: faces, rows from the top, columns, RGB.

        Raises:
            ParameterError: a picture cannot be read, or has no shape that surroundings have.
        """
        return _texels(self.source, float(self.strength), tuple(map(_stamp, self.files())))

    def files(self) -> tuple[str, ...]:
        """The files of its pictures: none, one or six; raises ``ParameterError`` where faces are missing."""
        if self.source in BUILT_IN:
            return ()
        if isinstance(self.source, tuple) or cubemap.PLACE in self.source:
            return cubemap.face_files(self.source)
        return (self.source,)

    def check(self) -> None:
        """Raise ``ParameterError`` where the pictures are not there or do not fit, as far as their heads tell."""
        files = self.files()
        if len(files) == 6:
            cubemap.check_faces(files)
        elif files:
            _check_shape(files[0], *picture_size(files[0]))


def as_environment(value: Any) -> Environment | None:
    """An Environment from what users write; raises ``ParameterError`` for anything else."""
    if value is None or isinstance(value, Environment):
        return value
    if isinstance(value, (str, os.PathLike, list, tuple)):
        return Environment(value)  # type: ignore[arg-type] # it is what makes one of these
    raise ParameterError(f"an environment must be sky, room or a picture's file name, not {value!r}")


def _as_source(value: Any) -> str | tuple[str, ...]:
    """A path, or several; raises ``ParameterError``."""
    if isinstance(value, (list, tuple)):
        for one in value:
            if not isinstance(one, (str, os.PathLike)):
                raise ParameterError(f"a face of an environment must be a picture's file name, not {one!r}")
        return tuple(map(os.fspath, value))
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    raise ParameterError(f"an environment must be sky, room or a picture's file name, not {value!r}")


def _stamp(path: str) -> int:
    """When a file was changed, so that it is read again after that; 0 where it cannot be told."""
    try:
        return os.stat(path).st_mtime_ns
    except (OSError, ValueError):
        return 0


@lru_cache(maxsize=4)
def _texels(source: str | tuple[str, ...], strength: float, stamps: tuple[int, ...]) -> npt.NDArray[np.float32]:
    if source == "sky":
        colors: Any = sky(_directions(SIDE))
    elif source == "room":
        colors = room(_directions(SIDE))
    else:
        colors = _pictured(source)
    return np.ascontiguousarray(np.minimum(colors * strength, BRIGHTEST).reshape(-1), np.float32)


def _pictured(source: str | tuple[str, ...]) -> Any:
    """The faces that pictures show."""
    if isinstance(source, tuple) or cubemap.PLACE in source:
        faces = cubemap.read_faces(cubemap.face_files(source))
        return cubemap.as_texels(faces, LARGEST_SIDE)
    picture = read_picture(source)
    height, width = picture.shape[:2]
    _check_shape(source, width, height)
    if cubemap.layout_of(width, height) is not None:
        return cubemap.as_texels(cubemap.in_one(picture), LARGEST_SIDE)
    side = min(max(height // 2, 16), LARGEST_SIDE)
    return _looked_up(picture, _directions(side))


def _check_shape(path: str, width: int, height: int) -> None:
    """Raise where a single picture is neither a cube map nor, to a twentieth, twice as wide as high."""
    if cubemap.layout_of(width, height) is None and abs(width / height - 2) > 0.1:
        raise ParameterError(
            f"the picture {path!r} of {width} by {height} pixels has no shape of surroundings", hint=SHAPES
        )


def _directions(side: int) -> Floats:
    """The unit direction of each texel: (6, side, side, 3)."""
    ticks = (np.arange(side) + 0.5) * 2 / side - 1
    u, v = np.meshgrid(ticks, -ticks)
    one = np.ones_like(u)
    faces = [
        (sign * one, u, v) if axis == 0 else (u, sign * one, v) if axis == 1 else (u, v, sign * one)
        for axis in range(3)
        for sign in (1.0, -1.0)
    ]
    made = np.stack([np.stack(face, axis=-1) for face in faces])
    unit: Floats = made / np.linalg.norm(made, axis=-1, keepdims=True)
    return unit


def _mix(a: Floats, b: Floats, share: Floats) -> Floats:
    return a + (b - a) * share[..., None]


def sky(direction: Floats) -> Floats:
    """A clear day: blue above, pale at the horizon, warm ground below, and a sun."""
    height = direction[..., 2]
    above = _mix(np.array((0.78, 0.86, 0.95)), np.array((0.16, 0.36, 0.78)), np.clip(height, 0, 1) ** 0.55)
    below = _mix(np.array((0.50, 0.46, 0.42)), np.array((0.16, 0.13, 0.11)), np.clip(-height, 0, 1) ** 0.4)
    color = np.where((height > 0)[..., None], above, below)
    sun = np.array((0.48, -0.60, 0.64))
    cosine = np.clip(direction @ (sun / np.linalg.norm(sun)), 0, 1)
    glow = 0.35 * cosine**40 + 6.0 * (cosine > 0.9985)
    lit: Floats = color + glow[..., None] * np.array((1.0, 0.9, 0.7))
    return lit


def room(direction: Floats) -> Floats:
    """A room: tiled floor, two coloured walls, and a lamp in the ceiling."""
    size = 1.0 / np.max(np.abs(direction), axis=-1)
    x, y, z = np.moveaxis(direction * size[..., None], -1, 0)
    wall = np.full((*x.shape, 3), 0.72)
    wall[x < -0.9999] = (0.75, 0.24, 0.18)
    wall[x > 0.9999] = (0.18, 0.42, 0.70)
    tiles = (np.floor(x * 4) + np.floor(y * 4)) % 2
    wall = np.where((z < -0.9999)[..., None], 0.22 + 0.45 * tiles[..., None], wall)
    lamp = (z > 0.9999) & (np.abs(x) < 0.45) & (np.abs(y) < 0.45)
    shade = 0.55 + 0.45 * np.clip((z + 1) / 2, 0, 1)
    return np.where(lamp[..., None], 5.0, wall * shade[..., None])


def _looked_up(picture: npt.NDArray[np.float32], direction: Floats) -> Floats:
    """Bilinear samples of an equirectangular picture."""
    height, width = picture.shape[:2]
    x, y, z = np.moveaxis(direction, -1, 0)
    column = (0.5 - np.arctan2(y, x) / (2 * np.pi)) * width - 0.5
    row = np.clip(np.arccos(np.clip(z, -1, 1)) / np.pi * height - 0.5, 0, height - 1)
    left, top = np.floor(column).astype(int), np.floor(row).astype(int)
    fx, fy = (column - left)[..., None], (row - top)[..., None]
    right, bottom, left = (left + 1) % width, np.minimum(top + 1, height - 1), left % width
    upper = picture[top, left] * (1 - fx) + picture[top, right] * fx
    lower = picture[bottom, left] * (1 - fx) + picture[bottom, right] * fx
    mixed: Floats = upper * (1 - fy) + lower * fy
    return mixed
