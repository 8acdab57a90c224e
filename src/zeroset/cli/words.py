"""What a word on the command line may have been meant for, where it is no gallery name and no scene file."""

from __future__ import annotations

import os
import re

from zeroset.errors import SceneFileError

PICTURES = ("png", "jpg", "jpeg", "webp", "tif", "tiff", "bmp", "ppm", "gif", "mp4", "hdr", "exr", "npz", "npy")
MESHES = ("stl", "obj", "ply", "glb", "gltf", "off", "vtk")
TEXTS = ("json", "yaml", "yml", "txt", "csv", "md", "py", "ipynb", "hf", "frep", "pov", "scad", "sur")
OTHER_FILES = frozenset((*PICTURES, *MESHES, *TEXTS))
"""Suffixes of files that people may take for scenes."""


def check_no_file(source: str) -> None:
    """Raise ``SceneFileError`` for the name of a file that is no scene file, and no formula either."""
    found = re.search(r"\.([A-Za-z]\w*)$", source)
    if found is None and not source.startswith(("./", "../", "/")):
        return
    if (found is not None and found[1].lower() in OTHER_FILES) or os.path.isfile(source):
        raise SceneFileError(
            f"{source!r} is neither a formula nor a scene file",
            hints=("scene files are text, and end in .toml", "or give a formula, or a name that zeroset gallery lists"),
        )


def spelled(word: str) -> bool:
    """Whether a word is made of what formulas are made of; that it is wrong there is for formulas to tell.

    Example:
        >>> spelled("xyz"), spelled("pi"), spelled("sinx"), spelled("heart")
        (True, True, True, False)
    """
    from zeroset.expr.derived import CONSTANTS, DERIVED
    from zeroset.expr.names import VARIABLES
    from zeroset.expr.ops import FUNCTIONS

    return bool(re.fullmatch(f"(?:{'|'.join([*VARIABLES, *CONSTANTS, *DERIVED, *FUNCTIONS])})+", word))
