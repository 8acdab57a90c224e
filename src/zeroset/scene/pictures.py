"""Pictures that surround a scene, read into linear light: whatever Pillow reads, and ``.hdr`` for light beyond white.

Every mistake names the file: it is missing, it is no picture, it stops in the middle, or it is too large.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import numpy.typing as npt

from zeroset.errors import ParameterError
from zeroset.scene.radiance import radiance, radiance_size

Floats = npt.NDArray[np.float32]

MOST_PIXELS = 2**26
"""Pixels of a picture: 11500 by 5800, or a cube map with faces of 3300."""
_SRGB = np.arange(256) / 255
_LINEAR: Floats = np.where(_SRGB <= 0.04045, _SRGB / 12.92, ((_SRGB + 0.055) / 1.055) ** 2.4).astype(np.float32)
"""The linear light of each byte of an sRGB picture."""
HEAD = 65536
"""Bytes in which the head of a Radiance picture ends."""


def picture_size(path: str) -> tuple[int, int]:
    """Width and height of a picture file, from its head alone.

    Raises:
        ParameterError: there is no such file, it is no picture, or it is too large.
    """
    size = _size(path)
    if size[0] * size[1] > MOST_PIXELS:
        raise ParameterError(
            f"the picture {path!r} is too large: {size[0]} by {size[1]} pixels",
            hint=f"at most {MOST_PIXELS:,} pixels; no more than 4096 by 2048 are made use of",
        )
    return size


def read_picture(path: str) -> Floats:
    """A picture file in linear RGB, (height, width, 3), 1 for white.

    Raises:
        ParameterError: as ``picture_size``, or the file stops in the middle.
    """
    picture_size(path)
    try:
        if _is_radiance(path):
            return radiance(Path(path).read_bytes(), path)
        from PIL import Image as Pillow

        with Pillow.open(path) as opened:
            linear: Floats = _LINEAR[np.asarray(opened.convert("RGB"))]
            return linear
    except (OSError, ValueError, SyntaxError) as error:
        raise _unreadable(path, error) from None


def picture_bytes(path: str) -> bytes:
    """The whole of a picture file as it is; raises ``ParameterError`` where it cannot be read."""
    try:
        return Path(path).read_bytes()
    except (OSError, ValueError) as error:
        raise _unreadable(path, error) from None


def _is_radiance(path: str) -> bool:
    return path.lower().endswith(".hdr")


def _size(path: str) -> tuple[int, int]:
    from PIL import Image as Pillow

    try:
        if _is_radiance(path):
            with open(path, "rb") as file:
                return radiance_size(file.read(HEAD), path)
        with Pillow.open(path) as opened:
            width, height = opened.size
            return width, height
    except ParameterError:
        raise
    except (OSError, ValueError, SyntaxError, Pillow.DecompressionBombError) as error:
        raise _unreadable(path, error) from None


def _unreadable(path: str, error: Exception) -> ParameterError:
    if isinstance(error, FileNotFoundError):
        shown = os.path.abspath(path)
        return ParameterError(f"there is no picture {path!r}", hints=(f"it was looked for as {shown}", NO_FILE))
    reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
    return ParameterError(f"cannot read the picture {path!r}: {reason}", hints=(WHOLE, NO_FILE))


WHOLE = "a whole .png, .jpg, .hdr or another picture that Pillow reads is wanted"
NO_FILE = "the environments sky and room need no file"
