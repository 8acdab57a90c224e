"""Mesh files: STL, OBJ, PLY and glTF, written by trimesh."""

from __future__ import annotations

import os
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zeroset.errors import OutputError, did_you_mean

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

FORMATS = {".stl": "stl", ".obj": "obj", ".ply": "ply", ".glb": "glb"}
"""Mesh formats by suffix."""


def mesh_format(path: str | os.PathLike[str]) -> str:
    """The mesh format that a file name asks for, if it can be written here; raises ``OutputError``.

    Example:
        >>> mesh_format("ball.STL")
        'stl'
    """
    suffix = Path(path).suffix
    kind = FORMATS.get(suffix.lower())
    if kind is None:
        what = f"the suffix {suffix!r}" if suffix else "a file name without a suffix"
        hints = (*did_you_mean(suffix, FORMATS), f"use {', '.join(FORMATS)}")
        raise OutputError(f"cannot tell a mesh format from {what} in {os.fspath(path)!r}", hints=hints)
    if find_spec("trimesh") is None:
        raise OutputError(
            "mesh files are written by trimesh, which is not installed", hint="pip install 'zeroset[export]'"
        )
    return kind


def encode(
    vertices: npt.NDArray[np.floating], faces: npt.NDArray[np.uint32], normals: npt.NDArray[np.floating], kind: str
) -> bytes:
    """The bytes of a mesh file.

    Args:
        vertices: (N, 3), points of the mesh.
        faces: (M, 3), vertices of each triangle.
        normals: (N, 3), one at each vertex.
        kind: a format as ``mesh_format`` gives it.
    """
    import trimesh

    if kind == "glb":
        # What is upwards here is z, and y in glTF.
        vertices, normals = (v[:, (0, 2, 1)] * (1.0, 1.0, -1.0) for v in (vertices, normals))
    # As it is: trimesh would merge and reorder vertices.
    shape = trimesh.Trimesh(vertices, faces, vertex_normals=normals, process=False)
    options: dict[str, Any] = {} if kind == "stl" else {"include_normals": True}
    if kind == "ply":
        options = {"vertex_normal": True}
    data = shape.export(file_type=kind, **options)
    return data.encode() if isinstance(data, str) else bytes(data)
