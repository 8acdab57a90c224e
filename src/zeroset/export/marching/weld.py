"""From the kernels' pieces to clean triangles: what is no triangle goes, and no hole comes of it.

Where f = 0 at a lattice point itself, the vertices of several edges lie there. They become one, and triangles that had
two of them vanish along with their edges: the triangles beside them meet instead.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
import numpy.typing as npt

from zeroset.export.marching.extract import Pieces
from zeroset.export.marching.lattice import MISSING
from zeroset.export.marching.roots import NO_ROOT, WITHIN

T = TypeVar("T", np.uint32, np.int64)
Indices = npt.NDArray[np.int64]


def torn(pieces: Pieces, capped: bool) -> bool:
    """Whether a triangle lacks a vertex that it should have.

    An open mesh may lack vertices of the bounds, whose triangles are left out anyway. All else would be rounding: f32
    sees a change of sign where an enclosure in f32 has seen that there is none.
    """
    found = np.flatnonzero(pieces.corners == MISSING) // 3
    if capped or not len(found):
        return bool(len(found))
    lacking = pieces.corners[found]
    there = lacking[lacking != MISSING]
    return bool((pieces.kinds[there] == WITHIN).any())


def weld(pieces: Pieces) -> Indices:
    """The triangles, (M, 3), with one vertex for each place; vertices that no triangle has any more stay listed."""
    corners = _without(pieces.corners, pieces.corners == MISSING).astype(np.int64)
    rootless = pieces.kinds == NO_ROOT
    if rootless.any():
        corners = _without(corners, rootless[corners])
    met = np.flatnonzero(pieces.at != MISSING)
    if not len(met):
        return corners
    # Of those at one point a root of f stands for all, where there is one.
    order = met[np.lexsort((pieces.kinds[met], pieces.at[met]))]
    _, first, where = np.unique(pieces.at[order], return_index=True, return_inverse=True)
    merged = np.arange(len(pieces.at))
    merged[order] = order[first][where]
    corners = merged[corners]
    a, b, c = corners.T
    corners = corners[(a != b) & (b != c) & (c != a)]
    touched = np.zeros(len(pieces.at), bool)
    touched[met] = True
    a, b, c = (touched[i] for i in corners.T)
    doubtful = (a & b) | (b & c) | (c & a)
    return np.concatenate([corners[~doubtful], without_opposites(corners[doubtful])])


def _without(corners: npt.NDArray[T], bad: npt.NDArray[np.bool_]) -> npt.NDArray[T]:
    """Triangles of which no corner is bad."""
    found = np.flatnonzero(bad) // 3
    return np.delete(corners, found, axis=0) if len(found) else corners


def without_opposites(corners: Indices) -> Indices:
    """Triangles without those pairs that lie on one another and look in opposite directions."""
    if not len(corners):
        return corners
    order = np.argsort(corners, axis=1)
    ordered = np.take_along_axis(corners, order, axis=1)
    # A rotation of (0, 1, 2) is even, all other orders are odd.
    even = (order[:, 1] - order[:, 0]) % 3 == 1
    _, group = np.unique(ordered, axis=0, return_inverse=True)
    group = group.ravel()
    sense = np.where(even, 1, -1)
    balance = np.bincount(group, sense)[group]
    # As many stay of each group as its balance says, all of the prevailing sense.
    prevailing = np.flatnonzero(sense * balance > 0)
    by_group = prevailing[np.argsort(group[prevailing], kind="stable")]
    starts = np.flatnonzero(np.diff(group[by_group], prepend=-1))
    sizes = np.diff(np.append(starts, len(by_group)))
    rank = np.arange(len(by_group)) - np.repeat(starts, sizes)
    return corners[np.sort(by_group[rank < np.abs(balance[by_group])])]


def compact(vertices: npt.NDArray[np.float32], corners: Indices) -> tuple[npt.NDArray[np.float32], Indices]:
    """Only the vertices that some triangle has, in their order."""
    used = np.zeros(len(vertices), bool)
    used[corners.ravel()] = True
    numbers = np.cumsum(used) - 1
    return vertices[used], numbers[corners]
