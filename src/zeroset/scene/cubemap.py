"""Cube maps: six square pictures, or one with all six in a cross or a strip, as they surround a scene.

Pictures of cube maps are made for y upwards and z forwards; here z is upwards. So x stays, their y becomes z and their
z becomes y:

    right  posx px   +x        top     posy py   +z (upwards)      front  posz pz   +y
    left   negx nx   -x        bottom  negy ny   -z                back   negz nz   -y

The four sides are upright as seen from the inside; above the front, the top goes on, and below it the bottom. That is
how OpenGL, and nearly every program since, lays its faces out.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from zeroset.errors import ParameterError
from zeroset.scene.pictures import picture_size, read_picture

Floats = npt.NDArray[np.float32]

PLACE = "{face}"
"""Stands for a face's name in the name of its file."""
FACES = ("right", "left", "top", "bottom", "front", "back")
NAMES = (FACES, ("posx", "negx", "posy", "negy", "posz", "negz"), ("px", "nx", "py", "ny", "pz", "nz"))
"""What the six faces are called, in the same order: by place, or by their own programs' axes."""
LAYOUTS = {
    (4, 3): ((2, 1), (0, 1), (1, 0), (1, 2), (1, 1), (3, 1)),
    (3, 4): ((2, 1), (0, 1), (1, 0), (1, 2), (1, 1), (1, 3)),
    (6, 1): tuple((i, 0) for i in range(6)),
    (1, 6): tuple((0, i) for i in range(6)),
}
"""Column and row of each face in a single picture, by its shape in faces. In a cross that stands, the back hangs upside
down below the bottom."""


def layout_of(width: int, height: int) -> tuple[int, int] | None:
    """The shape in faces of a picture with a whole cube map, or None for another picture.

    Example:
        >>> layout_of(1024, 768), layout_of(1024, 512)
        ((4, 3), None)
    """
    return next(((a, b) for a, b in LAYOUTS if width % a == 0 and width // a * b == height), None)


def in_one(picture: Floats) -> list[Floats]:
    """The six faces of a cross or a strip, in the order of ``FACES``, each upright."""
    shape = layout_of(picture.shape[1], picture.shape[0])
    assert shape is not None
    side = picture.shape[1] // shape[0]
    faces = [picture[row * side : (row + 1) * side, c * side : (c + 1) * side] for c, row in LAYOUTS[shape]]
    if shape == (3, 4):
        faces[5] = faces[5][::-1, ::-1]
    return faces


def face_files(source: str | Sequence[str]) -> tuple[str, ...]:
    """The six files of a cube map, in the order of ``FACES``.

    Args:
        source: a name with ``{face}`` in it, or six names: in that order, or in any if the names say which is which.

    Raises:
        ParameterError: there are not six, or some are not there; the message names those.
    """
    return _of_pattern(source) if isinstance(source, str) else _in_order(tuple(source))


def _of_pattern(pattern: str) -> tuple[str, ...]:
    made = [tuple(pattern.replace(PLACE, face) for face in names) for names in NAMES]
    files = max(made, key=lambda paths: sum(map(os.path.isfile, paths)))
    missing = [path for path in files if not os.path.isfile(path)]
    if len(missing) == 6:
        tried = ", ".join(Path(paths[0]).name for paths in made)
        raise ParameterError(
            f"there is no picture {pattern!r}",
            hint=f"{{face}} is right, left, top, bottom, front and back, or posx ... or px ...: {tried}",
        )
    if missing:
        raise _lacking(missing)
    return files


def _lacking(missing: Sequence[str]) -> ParameterError:
    names = ", ".join(map(repr, missing))
    return ParameterError(f"the cube map lacks {names}", hint=f"its six faces are {', '.join(FACES)}")


def _in_order(files: tuple[str, ...]) -> tuple[str, ...]:
    named = {face: path for path in files if (face := _face_of(path)) is not None}
    missing = [face for face in FACES if face not in named]
    if len(files) != 6:
        lacks = f": it lacks {', '.join(missing)}" if len(named) == len(files) and missing else ""
        raise ParameterError(
            f"a cube map has six pictures, not {len(files)}{lacks}", hint=f"in the order {', '.join(FACES)}"
        )
    return files if missing else tuple(named[face] for face in FACES)


def _face_of(path: str) -> str | None:
    """Which face a file's name says it is: ``sky_posx.png`` is the right one."""
    stem = Path(path).stem.lower()
    for names in NAMES:
        for face, name in zip(FACES, names, strict=True):
            before = stem.removesuffix(name)
            # A whole word: harpy.png is no py.
            if before != stem and not before[-1:].isalpha():
                return face
    return None


def check_faces(files: Sequence[str]) -> int:
    """The side of six faces, from the heads of their files; raises ``ParameterError`` where they do not fit."""
    sizes = [picture_size(path) for path in files]
    for path, (width, height) in zip(files, sizes, strict=True):
        if width != height:
            raise ParameterError(
                f"the face {path!r} is not square: {width} by {height} pixels",
                hint="a cube map's six pictures are as wide as high",
            )
        if width != sizes[0][0]:
            raise ParameterError(
                f"the faces are of different sizes: {files[0]!r} is {sizes[0][0]} pixels wide, {path!r} {width}",
                hint="scale them all to the same size",
            )
    return sizes[0][0]


def read_faces(files: Sequence[str]) -> list[Floats]:
    """Six files in linear RGB; raises ``ParameterError``."""
    check_faces(files)
    return [read_picture(path) for path in files]


def as_texels(faces: Sequence[Floats], side: int) -> Floats:
    """Faces as they are drawn from: (6, side, side, 3), in the order +x -x +y -y +z -z.

    There, columns go up y, x, x and rows down z, z, y, whatever side they are seen from.
    """
    right, left, top, bottom, front, back = (shrunk(face, side) for face in faces)
    return np.stack([right[:, ::-1], left, front, back[:, ::-1], top[::-1], bottom])


def shrunk(face: Floats, side: int) -> Floats:
    """A face with at most ``side`` texels along each side, each the mean of what it covers."""
    for axis in (0, 1):
        if face.shape[axis] > side:
            face = np.moveaxis(_means(np.moveaxis(face, axis, 0), side), 0, axis)
    return face


def _means(rows: Floats, count: int) -> Floats:
    """The mean rows of equal stretches, which may begin and end within a row."""
    sums = np.concatenate([np.zeros_like(rows[:1], np.float64), np.cumsum(rows, axis=0, dtype=np.float64)])
    ends = np.linspace(0, len(rows), count + 1)
    whole = np.minimum(ends.astype(int), len(rows) - 1)
    part = (ends - whole).reshape(-1, *[1] * (rows.ndim - 1))
    at = sums[whole] * (1 - part) + sums[whole + 1] * part
    means: Floats = (np.diff(at, axis=0) * (count / len(rows))).astype(np.float32)
    return means
