"""What tests measure of meshes: distances in f64, edges, components."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

import zeroset as zs
from zeroset.arith import F64, DualSystem, RealSystem

Array = npt.NDArray[Any]


class Points:
    """Leaves of f at many points at once, with derivatives along x, y and z."""

    def __init__(self, surface: zs.Surface, system: Any, points: Array) -> None:
        self._surface = surface
        self._system = system
        columns = points.astype(np.float64).T
        self._axes = {
            n: system.variable(system.inner.exact(c), i) for i, (n, c) in enumerate(zip("xyz", columns, strict=True))
        }

    def variable(self, name: str) -> Any:
        known = self._axes.get(name)
        return known if known is not None else self.parameter(name)

    def parameter(self, name: str) -> Any:
        return self._system.constant(self._surface.params[name], self._surface.params[name])

    def sum(self, system: Any, arrays: tuple[str, ...], body: Callable[[Mapping[str, Any]], Any]) -> Any:
        total = system.constant(0.0, 0.0)
        for values in zip(*(self._surface.arrays[name] for name in arrays), strict=True):
            total = total + body({n: system.constant(float(v), float(v)) for n, v in zip(arrays, values, strict=True)})
        return total


def slope(surface: zs.Surface, points: Array) -> tuple[Array, Array]:
    """f and its gradient at points, in f64."""
    system = DualSystem(RealSystem(F64), 3)
    with np.errstate(all="ignore"):
        f = surface.field.evaluate(system, Points(surface, system, points))
    full = [
        np.broadcast_to(np.asarray(v, np.float64), len(points))
        for v in (f.value.value, *(f.derivative(i).value for i in range(3)))
    ]
    return full[0], np.stack(full[1:], 1)


def distance(surface: zs.Surface, points: Array) -> Array:
    """How far points are from the surface, to first order."""
    f, gradient = slope(surface, points)
    length = np.linalg.norm(gradient, axis=1)
    return np.divide(np.abs(f), length, out=np.where(f == 0, 0.0, np.inf), where=length > 0)


def edges(mesh: zs.Mesh) -> Array:
    """The directed edges of all triangles."""
    return np.concatenate([mesh.faces[:, [i, (i + 1) % 3]] for i in range(3)]).astype(np.int64)


def edge_uses(mesh: zs.Mesh) -> Array:
    """How many triangles each edge has."""
    return np.unique(np.sort(edges(mesh), axis=1), axis=0, return_counts=True)[1]


def euler(mesh: zs.Mesh) -> int:
    """Vertices less edges plus triangles."""
    return len(mesh.vertices) - len(edge_uses(mesh)) + len(mesh.faces)


def components(mesh: zs.Mesh) -> int:
    """Pieces that hang together."""
    label = np.arange(len(mesh.vertices))
    pairs = edges(mesh)
    while True:
        lower = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
        new = label.copy()
        np.minimum.at(new, pairs[:, 0], lower)
        np.minimum.at(new, pairs[:, 1], lower)
        new = new[new]
        if np.array_equal(new, label):
            return len(np.unique(label))
        label = new


def face_normals(mesh: zs.Mesh) -> Array:
    """Normals of the triangles, as they turn."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]].astype(np.float64) for i in range(3))
    normals = np.cross(b - a, c - a)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def rim(mesh: zs.Mesh) -> Array:
    """The vertices of edges that have one triangle."""
    pairs, count = np.unique(np.sort(edges(mesh), axis=1), axis=0, return_counts=True)
    return mesh.vertices[np.unique(pairs[count == 1])]
