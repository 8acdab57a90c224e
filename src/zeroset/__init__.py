"""zeroset draws the surface f(x, y, z) = 0 of any formula, ray by ray, with certified answers.

    import zeroset as zs

    s = zs.surface("x^2 + y^2 + z^2 + sin(4x) - cos(4y) + sin(4z) = 1")
    zs.render(s).save("blobby.png")
    hits = zs.cast(s, origins, directions)

The public names are loaded on first use, so that importing the package costs next to nothing.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from zeroset import errors, methods
    from zeroset.errors import ZerosetError
    from zeroset.export.animate import animate
    from zeroset.export.mesh import mesh
    from zeroset.export.triangles import Mesh
    from zeroset.rendering.cast import Hits, cast
    from zeroset.rendering.image import Image
    from zeroset.rendering.render import render
    from zeroset.scene.bounds import Ball, Box
    from zeroset.scene.camera import Camera
    from zeroset.scene.coloring import Coloring
    from zeroset.scene.environment import Environment
    from zeroset.scene.file import load, save
    from zeroset.scene.light import Light, Material
    from zeroset.scene.scene import Scene
    from zeroset.scene.solid import Solid
    from zeroset.scene.surface import Surface, surface
    from zeroset.shelf import gallery
    from zeroset.view.show import show

MISS: int = 0
HIT: int = 1
UNRESOLVED: int = 2

__version__ = "0.1.0"

__all__ = [
    "HIT",
    "MISS",
    "UNRESOLVED",
    "Ball",
    "Box",
    "Camera",
    "Coloring",
    "Environment",
    "Hits",
    "Image",
    "Light",
    "Material",
    "Mesh",
    "Scene",
    "Solid",
    "Surface",
    "ZerosetError",
    "__version__",
    "animate",
    "cast",
    "errors",
    "gallery",
    "load",
    "mesh",
    "methods",
    "render",
    "save",
    "show",
    "surface",
]

_HOMES = {
    "Ball": "zeroset.scene.bounds",
    "Box": "zeroset.scene.bounds",
    "Camera": "zeroset.scene.camera",
    "Coloring": "zeroset.scene.coloring",
    "Environment": "zeroset.scene.environment",
    "Hits": "zeroset.rendering.cast",
    "Image": "zeroset.rendering.image",
    "Light": "zeroset.scene.light",
    "Material": "zeroset.scene.light",
    "Mesh": "zeroset.export.triangles",
    "Scene": "zeroset.scene.scene",
    "Solid": "zeroset.scene.solid",
    "Surface": "zeroset.scene.surface",
    "ZerosetError": "zeroset.errors",
    "animate": "zeroset.export.animate",
    "cast": "zeroset.rendering.cast",
    "gallery": "zeroset.shelf",
    "load": "zeroset.scene.file",
    "mesh": "zeroset.export.mesh",
    "render": "zeroset.rendering.render",
    "save": "zeroset.scene.file",
    "show": "zeroset.view.show",
    "surface": "zeroset.scene.surface",
}


def __getattr__(name: str) -> Any:
    if name in ("errors", "methods"):
        return importlib.import_module(f"zeroset.{name}")
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"module 'zeroset' has no attribute {name!r}")
    value = getattr(importlib.import_module(home), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
