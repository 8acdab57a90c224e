"""The picture: what ``render`` gives back."""

from __future__ import annotations

import io
import os
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.atomic import replacing
from zeroset.errors import OutputError, ZerosetError, did_you_mean
from zeroset.render.frame import GBuffer
from zeroset.render.gbuffer import NORMAL
from zeroset.solve.problem import MISS, UNRESOLVED

AOVS = ("depth", "normal", "status", "steps", "t")


class Image:
    """An RGB picture with the frame's G-buffer behind it.

    Attributes:
        pixels: (height, width, 3) uint8, sRGB.
        certified: whether the method proves its answers.

    Example:
        >>> import zeroset as zs
        >>> image = zs.render(zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.2), size=(64, 48))
        >>> np.asarray(image).shape
        (48, 64, 3)
        >>> image.aov("status").max()
        np.uint32(1)
    """

    def __init__(self, rgba: npt.NDArray[np.uint8], outputs: GBuffer, certified: bool) -> None:
        self.pixels = rgba[..., :3]
        self.certified = certified
        self._outputs = outputs

    @cached_property
    def hits(self) -> int:
        """How many pixels show the surface, unresolved ones included."""
        return int(np.count_nonzero(self.aov("status")))

    @cached_property
    def unresolved(self) -> int:
        """How many pixels could be neither proven nor excluded; they are drawn as hits."""
        return int(np.count_nonzero(self.aov("status") == UNRESOLVED))

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.pixels.shape[1], self.pixels.shape[0]

    def aov(self, name: str) -> npt.NDArray[Any]:
        """One output of the G-buffer, in rows.

        Args:
            name: ``depth`` (distance along the viewing direction, inf where nothing is hit), ``t`` (nan there),
                ``normal`` (height, width, 3), ``status`` (0 miss, 1 hit, 2 unresolved) or ``steps``.
        """
        if name not in AOVS:
            raise ZerosetError(f"there is no output {name!r}", hints=(*did_you_mean(name, AOVS), f"there are {', '.join(AOVS)}"))
        if name == "normal":
            return np.stack([self._outputs.rows(axis) for axis in NORMAL], axis=-1)
        if name in ("t", "depth"):
            missing = np.float32(np.nan if name == "t" else np.inf)
            return np.where(self._outputs.rows("status") == MISS, missing, self._outputs.rows("t"))
        return self._outputs.rows(name)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        if dtype is None or np.dtype(dtype) == np.uint8:
            return self.pixels.copy() if copy else self.pixels
        return self.pixels.astype(dtype)

    def png(self) -> bytes:
        """The picture as a PNG file's bytes."""
        from PIL import Image as Pillow

        out = io.BytesIO()
        # Level 1 is four times faster than the default and the files are hardly larger.
        Pillow.fromarray(np.ascontiguousarray(self.pixels)).save(out, "PNG", compress_level=1)
        return out.getvalue()

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the picture, in the format of the suffix (.png, .jpg, .webp, .tif, .bmp ...), whole or not at all."""
        target = Path(path)
        suffix = target.suffix.lower()
        if suffix == ".png":
            data = self.png()
        else:
            data = self._encoded(target, suffix)
        with replacing(target) as file:
            file.write(data)
        return target

    def _encoded(self, target: Path, suffix: str) -> bytes:
        from PIL import Image as Pillow

        Pillow.init()
        kind = Pillow.EXTENSION.get(suffix)
        if kind is None or kind not in Pillow.SAVE:
            what = f"the suffix {suffix!r}" if suffix else "a file name without a suffix"
            raise OutputError(f"cannot tell a picture format from {what} in {str(target)!r}", hint="use .png, .jpg, .webp or .tif")
        out = io.BytesIO()
        Pillow.fromarray(np.ascontiguousarray(self.pixels)).save(out, kind)
        return out.getvalue()

    def _repr_png_(self) -> bytes:
        return self.png()

    def __repr__(self) -> str:
        width, height = self.size
        return f"<zeroset.Image {width}x{height}, {self.hits} hits, {self.unresolved} unresolved>"
