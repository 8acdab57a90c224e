"""Marching tetrahedra as a table: a cell's eight signs to triangles on the edges of its six tetrahedra.

The cell is split as Freudenthal and Kuhn did: each tetrahedron is a path from corner 000 to corner 111 along the axes,
in one of their six orders. Neighbouring cells split their common face alike, so the tetrahedra fill space without gaps.
Every edge goes from a corner to one that has all its bits and more: there are seven edges a point.
"""

from __future__ import annotations

from functools import lru_cache
from itertools import permutations
from operator import add, mul, sub

import numpy as np
import numpy.typing as npt

MOST = 12
"""Triangles of one cell: two a tetrahedron."""
CODES = 3 * MOST
"""Entries of the table for one case."""

Edge = tuple[int, int]
"""Two corners, the first one's bits among the second one's."""


def corner(number: int) -> tuple[int, int, int]:
    """A corner's place in its cell: bit 0 is x, bit 1 is y, bit 2 is z."""
    return number & 1, number >> 1 & 1, number >> 2 & 1


def paths() -> list[tuple[int, int, int, int]]:
    """The corners of the six tetrahedra."""
    return [(0, 1 << a, 1 << a | 1 << b, 7) for a, b, _ in permutations(range(3))]


def edge_code(edge: Edge) -> int:
    """An edge as kernels read it: the first corner, and the bits that the second has more."""
    first, second = edge
    return first | (first ^ second) << 3


def triangles(inside: int) -> list[tuple[Edge, Edge, Edge]]:
    """The triangles of a cell whose corners with a bit in ``inside`` have f <= 0; seen from f > 0 they turn left."""
    found: list[tuple[Edge, Edge, Edge]] = []
    for path in paths():
        found += [_turned(t, inside) for t in _split(path, inside)]
    return found


def _split(path: tuple[int, int, int, int], inside: int) -> list[tuple[Edge, Edge, Edge]]:
    """The triangles of one tetrahedron, turned anyhow."""
    within = [c for c in path if inside >> c & 1]
    without = [c for c in path if c not in within]
    # Around the cut: edges that follow one another share a corner of the tetrahedron.
    if len(within) == 2:
        (a, b), (c, d) = within, without
        q = [_edge(a, c), _edge(a, d), _edge(b, d), _edge(b, c)]
        return [(q[0], q[1], q[2]), (q[0], q[2], q[3])]
    if len(within) in (1, 3):
        (one,), three = (within, without) if len(within) == 1 else (without, within)
        return [(_edge(one, three[0]), _edge(one, three[1]), _edge(one, three[2]))]
    return []


def _edge(a: int, b: int) -> Edge:
    return min(a, b), max(a, b)


def _turned(triangle: tuple[Edge, Edge, Edge], inside: int) -> tuple[Edge, Edge, Edge]:
    """The triangle or its mirror image, whichever looks away from the corners inside."""
    # Twice the middles of the edges: whole numbers.
    p, q, r = (tuple(map(add, corner(a), corner(b))) for a, b in triangle)
    (ux, uy, uz), (vx, vy, vz) = tuple(map(sub, q, p)), tuple(map(sub, r, p))
    normal = (uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx)
    a, b = triangle[0]
    outward = map(sub, corner(b), corner(a)) if inside >> a & 1 else map(sub, corner(a), corner(b))
    return triangle if sum(map(mul, normal, outward)) > 0 else (triangle[0], triangle[2], triangle[1])


@lru_cache(maxsize=1)
def table() -> npt.NDArray[np.uint32]:
    """Edge codes of every case, ``CODES`` a case, and behind them the number of triangles of every case."""
    codes, counts = np.zeros((256, CODES), np.uint32), np.zeros(256, np.uint32)
    for case in range(256):
        flat = [edge_code(edge) for triangle in triangles(case) for edge in triangle]
        codes[case, : len(flat)] = flat
        counts[case] = len(flat) // 3
    return np.concatenate([codes.ravel(), counts])
