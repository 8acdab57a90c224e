"""Small pictures of the gallery's surfaces: drawn by zeroset itself when there is nothing else to do, kept on disk.

They are drawn twice as large and averaged, with nothing behind the surface, and kept as PNG files beside the compiled
code (``ZEROSET_CACHE_DIR``; none with ``ZEROSET_CACHE=0``).
"""

from __future__ import annotations

import contextlib
import os
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt

from zeroset import __version__
from zeroset.atomic import replacing
from zeroset.errors import ZerosetError
from zeroset.hashes import hexdigest
from zeroset.surfaces import entry

Pixels = npt.NDArray[np.uint8]

SIDE = 112
"""Pixels along a side."""
LATELY = 0.5
"""Seconds before the newest wish in which others count as wished for now."""


def draw(name: str, device: str = "auto") -> Pixels:
    """A surface of the gallery, (112, 112, 4), clear where nothing is hit.

    Example:
        >>> draw("sphere").shape
        (112, 112, 4)
    """
    from zeroset.rendering.render import render
    from zeroset.shelf import gallery

    image = render(gallery[name], 2 * SIDE, device=device)
    alpha = (image.aov("status") != 0).astype(np.float32)[..., None]
    colors = np.concatenate([image.pixels * alpha, 255.0 * alpha], axis=-1)
    mean = colors.reshape(SIDE, 2, SIDE, 2, 4).mean(axis=(1, 3))
    # Averaged with weights: clear pixels have no colour to give.
    share = np.maximum(mean[..., 3:] / 255.0, 1e-6)
    return np.concatenate([mean[..., :3] / share, mean[..., 3:]], axis=-1).round().clip(0, 255).astype(np.uint8)


def folder() -> Path | None:
    """Where they are kept, or None."""
    if os.environ.get("ZEROSET_CACHE") == "0":
        return None
    from zeroset.runtime.cache import cache_folder

    try:
        return cache_folder() / "thumbnails"
    except RuntimeError:
        return None


def _path(name: str) -> Path | None:
    place = folder()
    if place is None:
        return None
    # What decides the picture decides the name: a changed entry gets a new one.
    key = f"{__version__} {SIDE} {entry(name)!r}"
    return place / f"{name}-{hexdigest(key)[:16]}.png"


def load(name: str) -> Pixels | None:
    """The picture from the disk, if it is there and whole."""
    path = _path(name)
    if path is None or not path.is_file():
        return None
    from PIL import Image

    try:
        with Image.open(path) as file:
            pixels = np.asarray(file.convert("RGBA"))
    except (OSError, ValueError, SyntaxError):
        return None
    return pixels if pixels.shape == (SIDE, SIDE, 4) else None


def keep(name: str, pixels: Pixels) -> None:
    """Put the picture on the disk; where that cannot be it is drawn again next time."""
    path = _path(name)
    if path is None:
        return
    from PIL import Image

    with contextlib.suppress(OSError, ZerosetError):
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with replacing(path) as file:
            Image.fromarray(pixels).save(file, "PNG")


class Thumbnails:
    """One thread that draws what is asked for, whenever the window is at rest.

    Args:
        device: the name of the device that draws.
        resting: whether nothing else is being drawn.
        wake: called when there is a new one.
    """

    def __init__(self, device: str, resting: Callable[[], bool], wake: Callable[[], object]) -> None:
        self._device = device
        self._resting = resting
        self._wake = wake
        self._changed = threading.Condition()
        self._wanted: dict[str, float] = {}
        self._known: set[str] = set()
        self._made: list[tuple[str, Pixels]] = []
        self._closed = False
        self._thread = threading.Thread(target=self._live, name="zeroset-thumbnails", daemon=True)
        self._thread.start()

    def want(self, name: str) -> None:
        """Ask for one; again and again for as long as it is looked for, since those come first."""
        with self._changed:
            if name not in self._known:
                self._wanted[name] = time.monotonic()
                self._changed.notify()

    def made(self) -> list[tuple[str, Pixels]]:
        """Those that have come since the last call."""
        with self._changed:
            found, self._made = self._made, []
            return found

    def close(self, timeout: float = 1.0) -> bool:
        """End the thread after the picture that it is at; gives whether it has ended within the time."""
        with self._changed:
            self._closed = True
            self._changed.notify()
        self._thread.join(timeout)
        return not self._thread.is_alive()

    def _live(self) -> None:
        while (name := self._next()) is not None:
            pixels = load(name)
            if pixels is None:
                pixels = self._drawn(name)
            if pixels is not None and not self._closed:
                with self._changed:
                    self._made.append((name, pixels))
                self._wake()

    def _next(self) -> str | None:
        with self._changed:
            self._changed.wait_for(lambda: self._wanted or self._closed)
            if self._closed:
                return None
            newest = max(self._wanted.values())
            name = next(name for name, asked in self._wanted.items() if asked > newest - LATELY)
            del self._wanted[name]
            self._known.add(name)
            return name

    def _drawn(self, name: str) -> Pixels | None:
        """Draw one, once nothing else is being drawn; None where it cannot be drawn."""
        with self._changed:
            while not self._closed and not self._resting():
                self._changed.wait(0.1)
            if self._closed:
                return None
        try:
            pixels = draw(name, self._device)
        except ZerosetError:
            return None
        keep(name, pixels)
        return pixels
