"""``zs.gallery``: the named surfaces as a mapping, each made into a Surface when it is asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from zeroset.errors import UnknownSurfaceError
from zeroset.scene.bounds import Ball, Bounds, Box
from zeroset.scene.camera import Camera
from zeroset.scene.surface import Surface, surface
from zeroset.surfaces import BallBounds, GalleryEntry, entry, names


class Gallery(Mapping[str, Surface]):
    """Surfaces by name; Chmutov surfaces of every order from 2 to 512 are there, listed or not.

    Example:
        >>> import zeroset as zs
        >>> zs.gallery["barth-sextic"].field.degree
        6
    """

    def __getitem__(self, name: str) -> Surface:
        """The surface of that name.

        Raises:
            UnknownSurfaceError: there is none; the message has the nearest names.
        """
        if not isinstance(name, str):
            raise UnknownSurfaceError(f"surfaces have names, so the gallery has no {name!r}")
        return from_entry(entry(name))

    def __iter__(self) -> Iterator[str]:
        return iter(names())

    def __len__(self) -> int:
        return len(names())

    def __repr__(self) -> str:
        return f"<zeroset.gallery of {len(self)} surfaces>"


def from_entry(item: GalleryEntry) -> Surface:
    """The surface of a gallery entry, with its bounds and camera."""
    limits: Bounds
    if isinstance(item.bounds, BallBounds):
        limits = Ball(item.bounds.radius, item.bounds.center)
    else:
        limits = Box(item.bounds.min, item.bounds.max)
    view = item.camera
    camera = Camera(view.eye, view.target, view.up, view.fov)
    return surface(item.formula, dict(item.params) | dict(item.arrays), limits, camera, item.name)


gallery = Gallery()
