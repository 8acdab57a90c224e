"""The picture: what ``render`` gives back."""

from __future__ import annotations

import io
import os
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from zeroset.atomic import replacing
from zeroset.errors import OutputError, ZerosetError, did_you_mean
from zeroset.rendering import png
from zeroset.rendering.bands import Assembled
from zeroset.rendering.buffers import NORMAL, PART, VALUE
from zeroset.rendering.frame import GBuffer
from zeroset.shade.colormap import LARGEST
from zeroset.solve.status import MISS, UNRESOLVED

if TYPE_CHECKING:
    from zeroset.scene.coloring import Coloring

AOVS = ("depth", "normal", "part", "status", "steps", "t")
_COLOR = 'say by what: render(..., color_by="gaussian-curvature")'


FORMATS = {
    ".png": "PNG",
    ".jpg": "JPEG",
    ".jpeg": "JPEG",
    ".webp": "WEBP",
    ".tif": "TIFF",
    ".tiff": "TIFF",
    ".bmp": "BMP",
    ".ppm": "PPM",
}
"""Picture formats by suffix, as Pillow calls them."""


def picture_format(path: str | os.PathLike[str]) -> str:
    """The picture format that a file name asks for; raises ``OutputError`` where it asks for none."""
    suffix = Path(path).suffix
    kind = FORMATS.get(suffix.lower())
    if kind is None:
        what = f"the suffix {suffix!r}" if suffix else "a file name without a suffix"
        raise OutputError(
            f"cannot tell a picture format from {what} in {os.fspath(path)!r}", hint=f"use {', '.join(FORMATS)}"
        )
    return kind


def encode(pixels: npt.NDArray[np.uint8], kind: str) -> bytes:
    """The bytes of a picture file.

    Args:
        pixels: (height, width, 3), sRGB.
        kind: a format as ``picture_format`` gives it.

    Raises:
        OutputError: the format cannot hold a picture of this size.
    """
    if kind == "PNG":
        return png.encode(pixels)
    from PIL import Image as Pillow

    options = {"JPEG": {"quality": 92}, "WEBP": {"quality": 92}}
    out = io.BytesIO()
    try:
        Pillow.fromarray(np.ascontiguousarray(pixels)).save(out, kind, **options.get(kind, {}))
    except (ValueError, OSError) as error:
        raise OutputError(f"cannot write this picture as {kind}: {error}", hint="use .png") from None
    return out.getvalue()


class Image:
    """An RGB picture with the frame's G-buffer behind it.

    Attributes:
        size: width and height in pixels.
        pixels: (height, width, 3) uint8, sRGB.
        certified: whether the method proves its answers.
        coloring: what the surface is coloured by; None for nothing.
        values: the values of what it is coloured by, where there are a few alone: isovalues.

    Example:
        >>> import zeroset as zs
        >>> image = zs.render(zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.2), size=(64, 48))
        >>> np.asarray(image).shape
        (48, 64, 3)
        >>> image.aov("status").max()
        np.uint32(1)
    """

    def __init__(
        self,
        size: tuple[int, int],
        outputs: GBuffer | Assembled,
        certified: bool,
        coloring: Coloring | None = None,
        values: tuple[float, ...] = (),
    ) -> None:
        self.size = size
        self.certified = certified
        self.coloring = coloring
        self.values = values
        self._outputs = outputs

    @cached_property
    def pixels(self) -> npt.NDArray[np.uint8]:
        """The colours; fetched from the device when first asked for."""
        return self._outputs.picture()[..., :3]

    @cached_property
    def hits(self) -> int:
        """How many pixels show the surface, unresolved ones included."""
        return int(np.count_nonzero(self.aov("status")))

    @cached_property
    def unresolved(self) -> int:
        """How many pixels could be neither proven nor excluded; they are drawn as hits."""
        return int(np.count_nonzero(self.aov("status") == UNRESOLVED))

    @property
    def range(self) -> tuple[float, float] | None:
        """Values of the first and the last colour; None where the surface is not coloured by anything."""
        return self._outputs.range

    @property
    def outputs(self) -> tuple[str, ...]:
        """What ``aov`` can give."""
        return AOVS if self.coloring is None else (*AOVS, VALUE)

    def aov(self, name: str) -> npt.NDArray[Any]:
        """One output of the G-buffer, in rows.

        Args:
            name: ``depth`` (distance along the viewing direction, inf where nothing is hit), ``t`` (nan there),
                ``normal`` (height, width, 3), ``status`` (0 miss, 1 hit, 2 unresolved), ``steps``, ``part`` (which of
                several surfaces, isovalues or surfaces of a solid; 0 where there is one alone), or ``value``, the
                quantity that the part is coloured by (nan where there is none).
        """
        if isinstance(name, str) and name == VALUE and self.coloring is None:
            raise ZerosetError("there is no value: the surface is not coloured by any", hint=_COLOR)
        known = self.outputs
        if not isinstance(name, str) or name not in known:
            hints = (*did_you_mean(str(name), known), f"there are {', '.join(known)}")
            raise ZerosetError(f"there is no output {name!r}", hints=hints)
        if name == VALUE:
            values = self._outputs.rows(VALUE)
            return np.where(np.abs(values) <= LARGEST, values, np.float32(np.nan))
        if name == "normal":
            return np.stack([self._outputs.rows(axis) for axis in NORMAL], axis=-1)
        if name in ("t", "depth"):
            missing = np.float32(np.nan if name == "t" else np.inf)
            return np.where(self._outputs.rows("status") == MISS, missing, self._outputs.rows("t"))
        if name == "part" and not self._outputs.has(PART):
            return np.zeros(self.size[::-1], np.uint32)
        return self._outputs.rows(name)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        if dtype is None or np.dtype(dtype) == np.uint8:
            return self.pixels.copy() if copy else self.pixels
        return self.pixels.astype(dtype)

    def png(self) -> bytes:
        """The picture as a PNG file's bytes."""
        return encode(self.pixels, "PNG")

    def legend(self) -> npt.NDArray[np.uint8]:
        """The picture with a colour bar, (height, width, 3): what the colours mean.

        Raises:
            ZerosetError: the surface is not coloured by anything.
        """
        from zeroset.rendering.legend import Key, with_legend

        if self.coloring is None or self.range is None:
            raise ZerosetError("there is no legend: the surface is not coloured by anything", hint=_COLOR)
        values = self._outputs.rows(VALUE)[self.aov("status") != MISS]
        known = values[np.abs(values) <= LARGEST]
        low, high = self.range
        # What rounding puts beyond an end is no more than that; a cyclic map has no ends.
        hair = np.inf if self.coloring.cyclic else 1e-5 * (high - low)
        below, above = bool(np.any(known < low - hair)), bool(np.any(known > high + hair))
        # Parts that keep their own colours lack nothing.
        missing = bool(np.any(values > LARGEST))
        if self.values:
            # Each has a block, which shows what colour it has beyond an end.
            below = above = False
        title, map_ = self.coloring.quantity.title, self.coloring.chosen_map
        key = Key(title, map_, (low, high), below, above, missing, self.values)
        return with_legend(self.pixels, key)

    def save(self, path: str | os.PathLike[str], legend: bool = False) -> Path:
        """Write the picture, in the format of the suffix (.png, .jpg, .webp, .tif, .bmp), whole or not at all.

        Args:
            path: where.
            legend: whether to draw a colour bar onto it.

        Raises:
            OutputError: the suffix names no picture format, or the file cannot be written.
            ZerosetError: there is to be a legend, but the surface is not coloured by anything.
        """
        try:
            target = Path(path)
        except TypeError:
            raise OutputError(f"a picture's file must be a path, not {path!r}") from None
        data = encode(self.legend() if legend else self.pixels, picture_format(target))
        with replacing(target) as file:
            file.write(data)
        return target

    def _repr_png_(self) -> bytes:
        return self.png()

    def __repr__(self) -> str:
        width, height = self.size
        return f"<zeroset.Image {width}x{height}, {self.hits} hits, {self.unresolved} unresolved>"
