"""Draws light.png: shadows, a mirror, glass and layers, in a row. Run from the repository's root."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

import zeroset as zs

SIDE = 380
SUN = (zs.Light(direction=(0.55, -0.35, 0.9), headlight=False), zs.Light(color=(0.25, 0.27, 0.3)))
GLASS = zs.Material((0.9, 0.95, 1.0), (0.9, 0.95, 1.0), ambient=0.1, opacity=0.1, reflectance=0.08, ior=1.3)


def pictures() -> list[zs.Image]:
    """The four pictures."""
    tangle, decocube = zs.gallery["tangle"], zs.gallery["decocube"]
    common = {"size": SIDE, "antialias": 16}
    return [
        zs.render(decocube, lights=SUN, shadows=True, **common),
        zs.render(tangle, material=zs.Material(reflectance=0.55), environment="sky", **common),
        zs.render(tangle, material=GLASS, environment="room", **common),
        zs.render(zs.gallery["klein-bottle"], material=zs.Material(opacity=0.35), **common),
    ]


if __name__ == "__main__":
    row = np.concatenate([np.asarray(image) for image in pictures()], axis=1)
    Image.fromarray(row).save(Path(__file__).with_suffix(".png"), optimize=True)
