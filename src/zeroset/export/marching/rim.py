"""The rim: where a ball cuts the surface, the mesh gets an edge that lies on both.

Where a triangle has vertices within the ball and others beyond, each of its edges from one to the other gets a new
vertex, which moves to where f and the ball's function g vanish together. Without a cap what lies beyond goes, and the
mesh ends in the rim. With a cap those vertices are the ball's own, and the rim is the crease, which marching tetrahedra
on max(f, g) had rounded off.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from zeroset.export.marching.lattice import Lattice
from zeroset.export.marching.programs import Programs
from zeroset.export.marching.weld import Indices
from zeroset.kernel import F32

Vertices = npt.NDArray[np.float32]


def cut_at_rim(
    programs: Programs, lattice: Lattice, vertices: Vertices, beyond: npt.NDArray[np.bool_], corners: Indices
) -> tuple[Vertices, Indices]:
    """The mesh with its rim, and with its cap if it is to have one.

    Args:
        programs: of the surface.
        lattice: that it was sampled on.
        vertices: (N, 6) positions and normals.
        beyond: (N,) which vertices lie outside the ball, or are the ball's own.
        corners: (M, 3) the triangles.

    Returns:
        Vertices, those of the rim last, and triangles.
    """
    if not beyond.any():
        return vertices, corners
    a, b, c = (beyond[i] for i in corners.T)
    some, every = a | b | c, a & b & c
    mixed = np.compress(some & ~every, corners, axis=0)
    whole = np.compress(~some | every if programs.capped else ~some, corners, axis=0)
    if not len(mixed):
        return vertices, whole
    one, two, three, alone = _rotated(mixed, beyond[mixed])
    # The two edges that the rim crosses, each from within.
    crossed = [np.stack([np.where(alone, other, one), np.where(alone, one, other)], 1) for other in (two, three)]
    pairs, where = np.unique(np.concatenate(crossed), axis=0, return_inverse=True)
    made = _rim_vertices(programs, lattice, vertices, pairs)
    near, far = _numbers(vertices, made, pairs, programs.uniforms(lattice)["snap"])[where.ravel()].reshape(2, -1)
    keep = np.ones(len(one), bool)
    tip, base = (keep, keep) if programs.capped else (~alone, alone)
    parts = [
        np.stack([a, b, c], 1)[kept & (a != b) & (b != c) & (c != a)]
        for (a, b, c), kept in (((one, near, far), tip), ((near, two, three), base), ((near, three, far), base))
    ]
    return np.concatenate([vertices, made]), np.concatenate([whole, *parts])


def _numbers(vertices: Vertices, made: Vertices, pairs: Indices, grain: float) -> Indices:
    """Numbers of the rim's vertices: their own, or that of another at the same place.

    Where the rim has a corner several go there, and a vertex of the surface may have lain on the ball already.
    """
    old = np.unique(pairs)
    names = np.concatenate([old, np.arange(len(made)) + len(vertices)])
    places = np.concatenate([vertices[old, :3], made[:, :3]]).astype(np.float64) / grain
    _, first, group = np.unique(np.rint(places), axis=0, return_index=True, return_inverse=True)
    return names[first[group.ravel()[len(old) :]]]


def _rotated(corners: Indices, sides: npt.NDArray[np.bool_]) -> tuple[Indices, Indices, Indices, npt.NDArray[np.bool_]]:
    """Each triangle from the vertex that is alone on its side, and whether that one is beyond."""
    alone = sides.sum(axis=1) == 1
    first = np.argmax(sides == alone[:, None], axis=1)
    rows = np.arange(len(corners))
    one, two, three = (corners[rows, (first + i) % 3] for i in range(3))
    return one, two, three, alone


def _rim_vertices(programs: Programs, lattice: Lattice, vertices: Vertices, pairs: Indices) -> Vertices:
    """A vertex of the rim between each two, one within and one beyond."""
    device = programs.device
    made = device.allocate(F32, 6 * len(pairs))
    ends = programs.put(vertices[pairs, :3].ravel(), F32)
    buffers = {"ends": ends, "vertices": made, **programs.arrays()}
    programs.run("rim", len(pairs), programs.uniforms(lattice), buffers)
    result: Vertices = device.read(made).reshape(-1, 6)
    return result
