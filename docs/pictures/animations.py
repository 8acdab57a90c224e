"""Draws docs/pictures/animations.gif: the papers' moving surfaces side by side.

Run it in the repository: .venv/bin/python docs/pictures/animations.py
"""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np

import zeroset as zs
from zeroset.export.film.gif import write_gif
from zeroset.export.film.named import find, names
from zeroset.export.film.storyboard import storyboard

CELL, COLUMNS, FRAMES = 128, 3, 24


def main() -> None:
    """Draw the six of them in two rows."""
    movies = []
    for item in filter(None, map(find, names())):
        scenes = storyboard(item.scene, FRAMES, item.vary, orbit=item.orbit)
        movies.append(np.stack([zs.render(scene, CELL, antialias=16).pixels for scene in scenes]))
    rows = [np.concatenate(movies[i : i + COLUMNS], axis=2) for i in range(0, len(movies), COLUMNS)]
    frames = list(np.concatenate(rows, axis=1))
    write_gif(Path(__file__).with_name("animations.gif"), frames, Fraction(10), "none", lambda _: None)


if __name__ == "__main__":
    main()
