"""The gallery's small pictures in one texture, drawn into panels as they come."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from zeroset.surfaces import names
from zeroset.view.thumbnails import SIDE, Thumbnails

COLUMNS = 8


class Atlas:
    """Places of thumbnails in a texture.

    Args:
        device: a wgpu device.
        register: makes a texture view known to the panels.
        thumbnails: draws them.
    """

    def __init__(self, device: Any, register: Callable[[Any], Any], thumbnails: Thumbnails) -> None:
        import wgpu

        self._queue = device.queue
        self._thumbnails = thumbnails
        self._places = {name: (i % COLUMNS, i // COLUMNS) for i, name in enumerate(names())}
        self._rows = -(-len(self._places) // COLUMNS)
        size = (COLUMNS * SIDE, self._rows * SIDE, 1)
        usage = wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST
        self._texture = device.create_texture(size=size, format="rgba8unorm", usage=usage)
        self._view = self._texture.create_view()
        self._reference = register(self._view)
        self._there: set[str] = set()

    def update(self) -> None:
        """Take those that have been drawn."""
        for name, pixels in self._thumbnails.made():
            column, row = self._places[name]
            target = {"texture": self._texture, "origin": (column * SIDE, row * SIDE, 0)}
            layout = {"bytes_per_row": 4 * SIDE, "rows_per_image": SIDE}
            self._queue.write_texture(target, pixels, layout, (SIDE, SIDE, 1))
            self._there.add(name)

    def draw(self, pen: Any, name: str, corner: tuple[float, float], side: float) -> None:
        """Draw one with a pen of the panels, or ask for it."""
        if name not in self._there:
            self._thumbnails.want(name)
            return
        column, row = self._places[name]
        low = column / COLUMNS, row / self._rows
        high = (column + 1) / COLUMNS, (row + 1) / self._rows
        pen.add_image(self._reference, corner, (corner[0] + side, corner[1] + side), low, high)
