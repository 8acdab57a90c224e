"""Draws scenes.png: isovalues, two solids, several surfaces, in a row. Run from the repository's root."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

import zeroset as zs

SIDE = 380
SUN = (zs.Light(direction=(-0.5, -0.45, 0.9), headlight=False), zs.Light((0.6, 0.1, 0.5), (0.2, 0.22, 0.27)))


def painted(red: float, green: float, blue: float, **more: float) -> zs.Material:
    """A material of one colour on both sides."""
    return zs.Material((red, green, blue), (red, green, blue), **more)


def shells() -> zs.Scene:
    """Three isovalues of the tangle, cut open by a box."""
    box = zs.Box((-3.2, -3.2, -3.2), (3.2, -1.5, 3.2))
    surface = zs.gallery["tangle"].with_isovalues((-5.0, 0.0, 12.0)).with_bounds(box)
    return zs.Scene(surface, zs.Camera(eye=(3, 9, 4), target=(0, -2, 0), fov=37))


def table() -> zs.Scene:
    """A ground that mirrors, a die with a hole, a glass ball and a torus."""
    ground = zs.surface("z + 1", bounds=zs.Box((-4, -4, -1.1), (4, 4, -0.9)))
    ground = ground.with_material(painted(0.55, 0.57, 0.6, reflectance=0.25, specular=0.0))
    cube = zs.surface("|x| = 0.8") & zs.surface("|y| = 0.8") & zs.surface("|z| = 0.8")
    ball = zs.surface("x^2 + y^2 + z^2 = 1.2").with_material(painted(0.75, 0.1, 0.1))
    hole = zs.surface("x^2 + y^2 = 0.16").with_material(painted(0.1, 0.25, 0.7))
    glass = zs.surface("(x - 2.2)^2 + (y + 0.4)^2 + z^2 = 1", bounds=zs.Ball(1.05, (2.2, -0.4, 0)))
    glass = glass.with_material(painted(0.3, 0.6, 0.4, opacity=0.15, ior=1.25, reflectance=0.08))
    torus = zs.surface(
        "((x + 2.2)^2 + (y - 0.4)^2 + z^2 + 0.18)^2 = 1.21((x + 2.2)^2 + z^2)", bounds=zs.Ball(1.05, (-2.2, 0.4, 0))
    ).with_material(painted(0.95, 0.6, 0.1))
    camera = zs.Camera(eye=(1, -9, 4), target=(0.2, 0, -0.3), fov=43)
    return zs.Scene([ground, (cube & ball) - hole, glass, torus], camera, lights=SUN, shadows=True, environment="sky")


if __name__ == "__main__":
    scenes = (shells(), zs.gallery.solids["icos-csg"], zs.gallery.solids["sesc-csg"], table())
    row = [np.asarray(zs.render(scene, SIDE, antialias=16, depth=6)) for scene in scenes]
    Image.fromarray(np.concatenate(row, axis=1)).save(Path(__file__).with_suffix(".png"), optimize=True)
