"""What surrounds a scene: a sky and a room that need no file, or a picture all around.

All become one thing, a cube map: six square faces (+x -x +y -y +z -z, z upwards) of linear RGB, seen from the inside. A
picture is equirectangular, twice as wide as high, its middle towards +x and its top upwards, in a format that Pillow
reads, or ``.hdr`` (Radiance) for light beyond white.
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

Floats = npt.NDArray[np.float64]
SIDE = 256
"""Texels along a face of the built-in surroundings."""
LARGEST_SIDE = 1024
BUILT_IN = ("sky", "room")


@dataclass(frozen=True)
class Environment:
    """The surroundings of a scene.

    Attributes:
        source: ``"sky"``, ``"room"``, or the path of an equirectangular picture.
        strength: factor of its light.

    Example:
        >>> Environment("sky").texels().shape
        (1179648,)
    """

    source: str
    strength: float = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "source", os.fspath(self.source))
        if not (isinstance(self.strength, (int, float)) and math.isfinite(self.strength) and self.strength >= 0):
            raise ParameterError(f"an environment's strength must be a number from 0, not {self.strength!r}")
        if self.source not in BUILT_IN and not Path(self.source).suffix:
            raise ParameterError(
                f"there is no environment {self.source!r}",
                hints=(*did_you_mean(self.source, BUILT_IN), "there are sky and room, or give a picture's file name"),
            )

    def texels(self) -> npt.NDArray[np.float32]:
        """The cube map, flat: faces, rows from the top, columns, RGB.

        Raises:
            ParameterError: the picture cannot be read.
        """
        return _texels(self.source, float(self.strength))


def as_environment(value: Any) -> Environment | None:
    """An Environment from what users write; raises ``ParameterError`` for anything else."""
    if value is None or isinstance(value, Environment):
        return value
    if isinstance(value, (str, os.PathLike)):
        return Environment(os.fspath(value))
    raise ParameterError(f"an environment must be sky, room or a picture's file name, not {value!r}")


@lru_cache(maxsize=4)
def _texels(source: str, strength: float) -> npt.NDArray[np.float32]:
    if source == "sky":
        colors = sky(_directions(SIDE))
    elif source == "room":
        colors = room(_directions(SIDE))
    else:
        picture = _read(source)
        side = min(max(picture.shape[0] // 2, 16), LARGEST_SIDE)
        colors = _looked_up(picture, _directions(side))
    return np.ascontiguousarray((colors * strength).reshape(-1), np.float32)


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


def _looked_up(picture: Floats, direction: Floats) -> Floats:
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


def _read(path: str) -> Floats:
    """A picture file in linear RGB, (height, width, 3)."""
    from PIL import Image as Pillow

    try:
        if path.lower().endswith(".hdr"):
            return radiance(Path(path).read_bytes(), path)
        with Pillow.open(path) as opened:
            encoded = np.asarray(opened.convert("RGB"), np.float64) / 255
    except OSError as error:
        raise ParameterError(
            f"cannot read the environment {path!r}: {error.strerror or error}", hint="sky and room need no file"
        ) from None
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def radiance(data: bytes, path: str = "picture.hdr") -> Floats:
    """A Radiance picture (RGBE, run lengths or plain) in linear RGB; raises ``ParameterError`` where it is none."""
    wrong = ParameterError(f"{path!r} is no Radiance picture", hint="it begins with #?RADIANCE and has rows -Y by +X")
    head, _, body = data.partition(b"\n\n")
    size, _, pixels = body.partition(b"\n")
    words = size.split()
    if not head.startswith(b"#?") or len(words) != 4 or words[0] != b"-Y" or words[2] != b"+X":
        raise wrong
    try:
        height, width = int(words[1]), int(words[3])
        rgbe = _rows(pixels, height, width)
    except (ValueError, IndexError):
        raise wrong from None
    scale = np.where(rgbe[..., 3:] > 0, np.ldexp(1.0, rgbe[..., 3:].astype(int) - 136), 0.0)
    return rgbe[..., :3].astype(np.float64) * scale


def _rows(pixels: bytes, height: int, width: int) -> npt.NDArray[np.uint8]:
    if pixels[:2] != b"\x02\x02":
        return np.frombuffer(pixels, np.uint8, height * width * 4).reshape(height, width, 4)
    made = np.zeros((height, 4, width), np.uint8)
    at = 0
    for row in made:
        at += 4
        for channel in row:
            x = 0
            while x < width:
                count = pixels[at]
                run = count > 128
                count -= 128 * run
                if not 0 < count <= width - x:
                    raise ValueError("a run leaves its row")
                values = pixels[at + 1 : at + 2] * count if run else pixels[at + 1 : at + 1 + count]
                channel[x : x + count] = np.frombuffer(values, np.uint8)
                at += 2 if run else 1 + count
                x += count
    return made.transpose(0, 2, 1)
