"""``zs.gallery``: the named surfaces as a mapping, each made into a Surface when it is asked for; and the solids."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping

from zeroset.errors import UnknownSurfaceError, did_you_mean
from zeroset.scene.bounds import Ball, Bounds, Box
from zeroset.scene.camera import Camera
from zeroset.scene.light import Material
from zeroset.scene.solid import Solid
from zeroset.scene.solid_text import parse_solid
from zeroset.scene.surface import Surface, surface
from zeroset.surfaces import BallBounds, BoxBounds, GalleryEntry, SolidEntry, View, entry, names, solid_names, solids


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

    @property
    def solids(self) -> Mapping[str, Solid]:
        """The solids by name: K09's two CSG objects."""
        return _Solids()

    def find(self, name: str) -> Surface | Solid:
        """The surface or the solid of that name; raises ``UnknownSurfaceError`` where there is none."""
        return self.solids[name] if name in solid_names() else self[name]

    def __repr__(self) -> str:
        return f"<zeroset.gallery of {len(self)} surfaces>"


def from_entry(item: GalleryEntry) -> Surface:
    """The surface of a gallery entry, with its bounds and camera."""
    limits, camera = _limits(item.bounds), _camera(item.camera)
    return surface(item.formula, dict(item.params) | dict(item.arrays), limits, camera, item.name)


class _Solids(Mapping[str, Solid]):
    """Solids by name."""

    def __getitem__(self, name: str) -> Solid:
        found = solids().get(name)
        if found is None:
            raise UnknownSurfaceError(
                f"the gallery has no solid {name!r}", hints=(*did_you_mean(str(name), solid_names()), *_listed())
            )
        return from_solid(found)

    def __iter__(self) -> Iterator[str]:
        return iter(solid_names())

    def __len__(self) -> int:
        return len(solid_names())


def _listed() -> tuple[str, ...]:
    return (f"it has {', '.join(solid_names())}",)


def from_solid(item: SolidEntry) -> Solid:
    """The solid of a gallery entry, with its materials, bounds and camera."""
    parts = {
        name: surface(part.formula, part.params, name=name).with_material(Material(part.front, part.back))
        for name, part in item.parts.items()
    }
    made = parse_solid(item.solid, parts)
    assert isinstance(made, Solid)
    return dataclasses.replace(made, bounds=_limits(item.bounds), camera=_camera(item.camera), name=item.name)


def _limits(bounds: BallBounds | BoxBounds) -> Bounds:
    return Ball(bounds.radius, bounds.center) if isinstance(bounds, BallBounds) else Box(bounds.min, bounds.max)


def _camera(view: View) -> Camera:
    return Camera(view.eye, view.target, view.up, view.fov)


gallery = Gallery()
