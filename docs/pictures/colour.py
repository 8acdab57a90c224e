"""Draws colour.png: surfaces by curvatures, gradient, steps and a formula. Run from the repository's root."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

import zeroset as zs

SIDE = 360
DULL = zs.Material(specular=0.12)
THIN = zs.Material(specular=0.12, opacity=0.6)
"""Seen through, as the Steiner surface in figure 6 of Knoll et al. 2009."""


def pictures() -> list[zs.Image]:
    """The six pictures."""
    torus = zs.surface("(sqrt(x^2 + y^2) - 1)^2 + z^2 = 0.16", bounds=1.5)
    wanted = [
        (torus, "gaussian-curvature", DULL),
        (zs.gallery["barth-sextic"], zs.Coloring("gaussian-curvature", range=(-3, 3)), DULL),
        (zs.gallery["blinn-blobby"], zs.Coloring("mean-curvature", "earth"), DULL),
        (zs.gallery["steiner"], zs.Coloring("gradient", "ember"), THIN),
        (zs.gallery["barth-decic"], "steps", DULL),
        (zs.gallery["klein-bottle"], zs.Coloring("atan2(y, x)", "wheel", (-np.pi, np.pi)), DULL),
    ]
    return [zs.render(s, SIDE, color_by=by, material=m, antialias=16) for s, by, m in wanted]


if __name__ == "__main__":
    tiles = [image.legend() for image in pictures()]
    rows = [np.concatenate(tiles[i : i + 3], axis=1) for i in (0, 3)]
    Image.fromarray(np.concatenate(rows)).save(Path(__file__).with_suffix(".png"), optimize=True)
