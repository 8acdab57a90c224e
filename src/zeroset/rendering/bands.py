"""Pictures too large for a device's buffers: drawn as bands of rows one after the other, put together on the host.

A camera's rays are affine in the frame's coordinates, so the rays of a band are those of a camera with other vectors,
and a band is a frame like any other: the same kernels, the same programs, in buffers that fit.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from zeroset.kernel.types import F32
from zeroset.rendering.buffers import VALUE, fields
from zeroset.rendering.frame import GBuffer
from zeroset.rendering.layout import TILE, Layout
from zeroset.runtime import Device
from zeroset.scene.camera import Rays

if TYPE_CHECKING:
    from zeroset.rendering.tint import Palette


class Band(NamedTuple):
    """Some rows of a picture.

    Attributes:
        top: the first row.
        layout: of the band alone.
    """

    top: int
    layout: Layout

    def rays(self, whole: Layout, rays: Rays) -> Rays:
        """The rays of the whole picture as they are in the band's own coordinates."""
        # One pixel is as wide in both; the band's middle lies somewhere above or below the picture's.
        scale = max(self.layout.width, self.layout.height) / max(whole.width, whole.height)
        middle = (whole.height - 2 * self.top - self.layout.height) / max(whole.width, whole.height)
        eye, right_origin, up_origin, forward, right, up = (np.asarray(v, np.float64) for v in rays)
        vectors = (eye + middle * up_origin, right_origin * scale, up_origin * scale)
        directions = (forward + middle * up, right * scale, up * scale)
        return Rays(*[(float(v[0]), float(v[1]), float(v[2])) for v in (*vectors, *directions)])


ELEMENT = 4
"""Bytes of one pixel in each of a frame's buffers."""


def fits(layout: Layout, device: Device) -> bool:
    """Whether a device has buffers for a picture of this size."""
    return layout.lanes * ELEMENT <= device.largest


def bands(layout: Layout, device: Device) -> Iterator[Band]:
    """The bands of a picture, from the top, as many rows in each as the device has room for."""
    row_of_tiles = layout.columns * TILE * TILE * ELEMENT
    height = max(device.largest // row_of_tiles, 1) * TILE
    for top in range(0, layout.height, height):
        yield Band(top, Layout(layout.width, min(height, layout.height - top)))


class Assembled:
    """The outputs of all bands of a picture, on the host; what ``GBuffer`` is to a picture drawn at once.

    Attributes:
        range: values of the first and the last colour, where a value gives the colour.
    """

    def __init__(self, layout: Layout, parts: int = 1, palette: Palette | None = None) -> None:
        self.range = None if palette is None else palette.range
        kept = fields(parts) if palette is None else {**fields(parts), VALUE: F32}
        shape = (layout.height, layout.width)
        self._rows = {name: np.zeros(shape, type_.dtype) for name, type_ in kept.items()}
        self._picture = np.zeros((*shape, 4), np.uint8)

    def add(self, band: Band, outputs: GBuffer) -> None:
        """Put a band in its place."""
        place = slice(band.top, band.top + band.layout.height)
        for name, rows in self._rows.items():
            rows[place] = outputs.rows(name)
        self._picture[place] = outputs.picture()

    def has(self, name: str) -> bool:
        """Whether there is such an output."""
        return name in self._rows

    def rows(self, name: str) -> npt.NDArray[Any]:
        """One output in rows."""
        return self._rows[name]

    def picture(self) -> npt.NDArray[np.uint8]:
        """The picture, (height, width, 4)."""
        return self._picture
