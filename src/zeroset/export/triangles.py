"""A mesh: triangles with shared vertices, what can be measured of them, and the way to a file."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.atomic import replacing


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles on a surface.

    Attributes:
        vertices: (N, 3) float32, points of the surface.
        faces: (M, 3) uint32, vertices of each triangle, turning left as seen from where f > 0.
        normals: (N, 3) float32, unit gradient of f, towards growing f; on a cap its own outward normal.

    Example:
        >>> import zeroset as zs
        >>> ball = zs.mesh(zs.surface("x^2 + y^2 + z^2 = 1", bounds=1.5), resolution=32)
        >>> ball.watertight, round(ball.volume, 1), round(ball.area)
        (True, 4.2, 13)
    """

    vertices: npt.NDArray[np.float32]
    faces: npt.NDArray[np.uint32]
    normals: npt.NDArray[np.float32]

    @cached_property
    def watertight(self) -> bool:
        """Whether every edge is passed as often in one direction as in the other: the mesh has no boundary."""
        there = self.faces.astype(np.int64).ravel()
        back = np.roll(self.faces, -1, axis=1).astype(np.int64).ravel()
        count = len(self.vertices)
        return np.array_equal(np.sort(there * count + back), np.sort(back * count + there))

    @property
    def area(self) -> float:
        """Area of all triangles."""
        return float(0.5 * np.linalg.norm(self._doubled(), axis=1).sum())

    @property
    def volume(self) -> float:
        """Volume of what the mesh encloses; negative where f > 0 inside. Of no meaning where it is not watertight."""
        # From the middle of the mesh, so that a solid far from the origin loses nothing.
        corner = self.vertices[self.faces[:, 0]].astype(np.float64) - self.vertices.mean(axis=0, dtype=np.float64)
        return float(np.einsum("ij,ij->", corner, self._doubled()) / 6.0)

    def _doubled(self) -> npt.NDArray[np.float64]:
        """The triangles' normals, twice their areas long."""
        return doubled_normals(self.vertices, self.faces)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the mesh, in the format of the suffix (.stl, .obj, .ply, .glb), whole or not at all.

        Raises:
            OutputError: the suffix names no mesh format, trimesh is not installed, or the file cannot be written.
        """
        from zeroset.export.mesh_files import encode, mesh_format

        target = Path(path)
        data = encode(self.vertices, self.faces, self.normals, mesh_format(target))
        with replacing(target) as file:
            file.write(data)
        return target

    def __repr__(self) -> str:
        return f"<zeroset.Mesh {len(self.vertices):,} vertices, {len(self.faces):,} triangles>"


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Several meshes as one, whose parts share no vertices; one alone as it is."""
    if len(meshes) == 1:
        return meshes[0]
    first = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    faces = [mesh.faces + np.uint32(start) for mesh, start in zip(meshes, first[:-1], strict=True)]
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate(faces),
        np.concatenate([mesh.normals for mesh in meshes]),
    )


def doubled_normals(points: npt.NDArray[np.float32], corners: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """The normals of triangles, twice their areas long."""
    a, b, c = (points[corners[:, i]].astype(np.float64) for i in range(3))
    return np.cross(b - a, c - a)
