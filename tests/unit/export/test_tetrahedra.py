from __future__ import annotations

from collections import Counter
from itertools import product

import numpy as np

from zeroset.export.marching.tetrahedra import CODES, corner, edge_code, paths, table, triangles


def test_the_tetrahedra_fill_the_cell() -> None:
    volumes = []
    for path in paths():
        a, b, c, d = (np.array(corner(i)) for i in path)
        volumes.append(abs(np.linalg.det(np.stack([b - a, c - a, d - a]))) / 6)
    assert np.allclose(volumes, 1 / 6)
    assert len({frozenset(path) for path in paths()}) == 6


def test_neighbouring_cells_split_their_face_alike() -> None:
    def diagonals(axis: int, side: int) -> set[tuple[tuple[int, ...], ...]]:
        """Edges of tetrahedra in a face, by the other two coordinates."""
        found = set()
        for path in paths():
            for a, b in product(path, path):
                p, q = corner(a), corner(b)
                if a < b and p[axis] == q[axis] == side:
                    found.add(tuple(tuple(v for i, v in enumerate(c) if i != axis) for c in (p, q)))
        return found

    for axis in range(3):
        assert diagonals(axis, 0) == diagonals(axis, 1)


def test_every_case_cuts_the_crossing_edges_and_closes_inside_the_cell() -> None:
    for inside in range(256):
        found = triangles(inside)
        used = {edge for triangle in found for edge in triangle}
        every = {(min(a, b), max(a, b)) for path in paths() for a in path for b in path if a != b}
        assert used == {(a, b) for a, b in every if (inside >> a & 1) != (inside >> b & 1)}
        sides: Counter[tuple[object, object]] = Counter()
        for t in found:
            sides.update([(t[0], t[1]), (t[1], t[2]), (t[2], t[0])])
        assert set(sides.values()) <= {1}
        for a, b in sides:
            # A side of one triangle only lies in a face of the cell.
            if (b, a) not in sides:
                shared = [axis for axis in range(3) if len({corner(c)[axis] for edge in (a, b) for c in edge}) == 1]
                assert shared, (inside, a, b)


def test_triangles_look_away_from_the_corners_inside() -> None:
    for inside in range(1, 255):
        for triangle in triangles(inside):
            p, q, r = (np.add(corner(a), corner(b)) * 0.5 for a, b in triangle)
            normal = np.cross(q - p, r - p)
            for a, b in triangle:
                outward = np.subtract(corner(b), corner(a)) * (1 if inside >> a & 1 else -1)
                assert normal @ outward > 0


def test_the_table_says_the_same() -> None:
    flat = table()
    for case in (0, 1, 0b10010110, 255):
        found = triangles(case)
        assert flat[256 * CODES + case] == len(found)
        codes = [edge_code(edge) for triangle in found for edge in triangle]
        assert flat[case * CODES : case * CODES + len(codes)].tolist() == codes
