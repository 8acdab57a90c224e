"""Small pictures of well-known surfaces, looked at once by a person and compared ever after.

``python -m tests.golden`` draws them anew; then look at each before it is kept.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageFilter

import zeroset as zs

FOLDER = Path(__file__).parent
SIZE = 96
BLUR = 1.0
"""Radius in pixels: edges may move by a part of a pixel, and shading by a byte's step or two."""
MEAN, MOST = 0.6, 26.0
"""Largest mean and largest single difference of the blurred pictures, in bytes."""


@dataclass(frozen=True)
class Golden:
    """One picture: what is drawn and how."""

    name: str
    scene: zs.Scene
    method: str = "auto"

    @property
    def path(self) -> Path:
        return FOLDER / f"{self.name}.png"

    def draw(self) -> zs.Image:
        return zs.render(self.scene, SIZE, method=self.method)


def _own() -> zs.Scene:
    """A formula with everything that a scene can say: box, orthographic camera, colours, lights, background."""
    waves = zs.surface("z = a*sin(4x)*cos(3y)", {"a": 0.3}, zs.Box((-1.5, -1.5, -1), (1.5, 1.5, 1)))
    return zs.Scene(
        waves,
        zs.Camera(eye=(3, -5, 4), height=4.2),
        zs.Material(front=(0.2, 0.7, 0.3), back=(0.8, 0.2, 0.5), specular=0.6, shininess=80),
        (zs.Light((1.0, -1.0, 1.5), headlight=False), zs.Light((-1.0, 0.2, 0.3), (0.1, 0.1, 0.3))),
        (0.02, 0.03, 0.06),
    )


def goldens() -> list[Golden]:
    """All pictures."""
    names = ("ding-dong", "clebsch", "steiner", "tangle", "barth-sextic", "chmutov-8", "blinn-blobby", "klein-bottle")
    known = [name for name in names if name in zs.gallery]
    drawn = [Golden(name, zs.Scene(zs.gallery[name])) for name in known]
    return [
        *drawn,
        Golden("waves", _own()),
        Golden("cayley-sampled", zs.Scene(zs.gallery["cayley"]), "marching-points"),
    ]


def blurred(pixels: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """A picture as eyes compare it."""
    return np.asarray(Image.fromarray(pixels).filter(ImageFilter.GaussianBlur(BLUR)), np.float64)
