"""Radiance pictures (``.hdr``): three bytes of colour and one for its power of two, so that light may be beyond white.

Pillow does not read them, and they are the usual form of what surrounds a scene.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from zeroset.errors import ParameterError

Floats = npt.NDArray[np.float32]


def radiance(data: bytes, path: str = "picture.hdr") -> Floats:
    """A Radiance picture (RGBE, run lengths or plain) in linear RGB, (height, width, 3).

    Raises:
        ParameterError: it is no such picture, or stops in the middle.
    """
    width, height = radiance_size(data, path)
    pixels = data.partition(b"\n\n")[2].partition(b"\n")[2]
    try:
        rgbe = _rows(pixels, height, width)
    except (ValueError, IndexError):
        raise _wrong(path) from None
    scale = np.where(rgbe[..., 3:] > 0, np.ldexp(1.0, rgbe[..., 3:].astype(np.int32) - 136), 0.0)
    return rgbe[..., :3].astype(np.float32) * scale.astype(np.float32)


def radiance_size(data: bytes, path: str = "picture.hdr") -> tuple[int, int]:
    """Width and height, from the beginning of a Radiance picture; raises ``ParameterError`` where it is none."""
    head, _, body = data.partition(b"\n\n")
    words = body.partition(b"\n")[0].split()
    if not head.startswith(b"#?") or len(words) != 4 or words[0] != b"-Y" or words[2] != b"+X":
        raise _wrong(path)
    try:
        height, width = int(words[1]), int(words[3])
    except ValueError:
        raise _wrong(path) from None
    if height < 1 or width < 1:
        raise _wrong(path)
    return width, height


def _wrong(path: str) -> ParameterError:
    return ParameterError(
        f"{path!r} is no Radiance picture, or not a whole one", hint="it begins with #?RADIANCE and has rows -Y by +X"
    )


def _rows(pixels: bytes, height: int, width: int) -> npt.NDArray[np.uint8]:
    if pixels[:2] != b"\x02\x02":
        return np.frombuffer(pixels, np.uint8, height * width * 4).reshape(height, width, 4)
    # Each channel of a row takes two bytes at the very least: a head that promises too much is found out here.
    if len(pixels) < 12 * height:
        raise ValueError("too short")
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
