"""Each surface that is known for its nodes has them all: f and its gradient vanish there.

A representative of each orbit is enough, since the surfaces are symmetric; the orbits must add up to the known
number. The points were found by Newton's method on the gradient from random starts.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

PHI = (1 + 5**0.5) / 2
Array = np.ndarray[Any, np.dtype[Any]]


def _turn(axis: tuple[float, float, float], angle: float) -> Array:
    a = np.array(axis) / np.linalg.norm(axis)
    cross = np.cross(np.eye(3), a)
    turned: Array = np.eye(3) - np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return turned


def _flip(*signs: int) -> Array:
    return np.diag(signs).astype(float)


CYCLE = np.roll(np.eye(3), 1, axis=1)
SWAP = np.eye(3)[[1, 0, 2]]
ICOSAHEDRAL = (CYCLE, _flip(-1, 1, 1), _turn((0, PHI, 1), 2 * np.pi / 5))
Z_AXIS = (0.0, 0.0, 1.0)
OCTAGONAL = (_turn(Z_AXIS, np.pi / 4), _flip(1, -1, 1), _flip(1, 1, -1))

ROOT = 2**-0.5
SARTI_NODE = np.array([0.0, 1.0, 1.0, 1.0])
# name: (symmetries, representatives, number of all finite nodes)
KNOWN: dict[str, tuple[tuple[Array, ...], list[tuple[float, float, float]], int]] = {
    "ding-dong": ((), [(0, 0, 0)], 1),
    "cayley": ((CYCLE, SWAP), [(0, 0, 0), (0, 0, 0.4)], 4),
    "kummer": ((CYCLE, SWAP, _flip(-1, 1, 1)), [(0, 1, 1)], 12),
    "tooth": ((), [(0, 0, 0)], 1),
    "nordstrand": (
        (CYCLE, SWAP),
        [(0, 0, 0), (0, 0, 0.4), (0, 0, -0.4), (0.4, 0.4, 0.4), (2 / 15, -2 / 15, 2 / 15)],
        11,
    ),
    "dervish": (
        (_turn(Z_AXIS, 2 * np.pi / 5), _flip(1, -1, 1)),
        [
            (0, 0, -0.37174803446018456),
            (1.358570173636287, 0, 1.2626144793138032),
            (1, 0.7265425280053608, 1.8587401723009223),
            (1, 0.7265425280053608, -1.8587401723009223),
            (2 * PHI, 0, 3.521247923410736),
            (2 * PHI, 0, -3.521247923410736),
            (PHI**4, 4.979796569765561, -3.521247923410736),
        ],
        31,
    ),
    "barth-sextic": (ICOSAHEDRAL, [(0, 0, 1), (1, 1, 1)], 50),
    "labs": (
        (_turn(Z_AXIS, 2 * np.pi / 7), _flip(1, -1, 1)),
        [
            (0, 0, -1),
            (0.336590687263076, 1.4747001558858237, 0.336590687263076),
            (2.99394653284858, 0, 0.8307574877195546),
            (2.7990961367478446, 0, 1.7452078956844599),
            (0.8920327096855127, 3.9082506611370085, 3.6117667056667333),
            (11.75032056333613, 0, 10.524103214536959),
            (0.4208060111467823, 0, -0.5872953525298265),
            (0.5314295817170667, 0, -0.47880150860948945),
            (0.8310694179172158, 0, -0.184930343057469),
            (0.13153345441226338, 0.5762857175378445, -0.3685485494384934),
            (0.11086616019763923, 0.48573638520822743, -0.5597540785881414),
            (0.6611765935715763, 0, -0.5956995269937634),
            (0.2643624328935932, 1.1582474968887952, -0.7407270766537348),
            (4.264122666118312, 0, -0.9488565581689361),
            (5.472497924550621, 0, -2.1943012974054006),
        ],
        99,
    ),
    "endrass": (
        OCTAGONAL,
        [
            (0, ROOT, 0),
            (1 - ROOT, ROOT, ROOT - 0.5),
            (0, (2 * (2**0.5 - 1)) ** 0.5, 0.5),
            (0.5, 0.5 + ROOT, 0),
            (1, 2**0.5 - 1, 0.5),
            (0, 2**0.5, 0.5),
            (2**0.5 - 1, 1, 2**0.5 - 0.5),
            (2**0.5, 0, 1.5),
            (1, 1 + 2**0.5, 1.5),
            (1 + 2**0.5, 1, 1.5 + 2**0.5),
        ],
        144,
    ),
    "endrass-conjugate": (
        OCTAGONAL,
        [
            (ROOT - 0.5, 0.5, 0),
            (0, ROOT, 0),
            (1, 2**0.5 - 1, 1.5 - 2**0.5),
            (0, 2**0.5, 0.5),
            (2**0.5 - 1, 1, 1.5),
            (2**0.5, 0, 1.5),
            (ROOT, 1 + ROOT, 0.5 + ROOT),
            (1, 1 + 2**0.5, 0.5),
            (1, 1 + 2**0.5, 0.5 + 2**0.5),
        ],
        128,
    ),
    "barth-decic": (
        ICOSAHEDRAL,
        [
            (0, 0, 1 / PHI),
            (0, 0, 1),
            (0.5720614028176843, 0.21850801222441057, 0.08346263385554702),
            (ROOT, 0.16692526771109456, 0),
            (0, ROOT, ROOT),
            (1.851229586821916, 0.437016024448821, 0),
        ],
        300,
    ),
}


def _orbit(points: Any, symmetries: tuple[Array, ...]) -> Array:
    """All images of the points (rows) under the group that the matrices generate."""
    found = np.asarray(points, dtype=float)
    while symmetries:
        images = np.concatenate([found, *(found @ matrix.T for matrix in symmetries)])
        _, first = np.unique(np.round(images, 6) + 0.0, axis=0, return_index=True)
        if len(first) == len(found):
            break
        found = images[first]
        assert len(found) < 5000, "the matrices generate no finite group"
    return found


def _vanishes(f: Any, points: Array) -> None:
    scale = f.scale(points)
    assert np.all(np.abs(f(points)) < 1e-11 * scale)
    assert np.all(np.abs(f.gradient(points)).max(axis=1) < 1e-9 * scale)


@pytest.mark.parametrize("name", KNOWN)
def test_all_nodes(name: str, formula: Callable[[str], Any]) -> None:
    symmetries, representatives, count = KNOWN[name]
    nodes = _orbit(representatives, symmetries)
    assert len(nodes) == count
    _vanishes(formula(name), nodes)


@pytest.mark.parametrize("name", KNOWN)
def test_symmetry(name: str, formula: Callable[[str], Any]) -> None:
    f = formula(name)
    points = np.random.default_rng(5).normal(size=(20, 3))
    for matrix in KNOWN[name][0]:
        assert np.allclose(f(points @ matrix.T), f(points), rtol=1e-8, atol=1e-9 * np.abs(f(points)).max())


def test_sarti_has_600_nodes_that_icosians_permute(formula: Callable[[str], Any]) -> None:
    """The group acts on (x, y, z, 1) as a quaternion, by unit icosians from the left and from the right."""
    f = formula("sarti-dodecic")
    units = np.array([[PHI, 1, 0, 1 / PHI], [1, 1 / PHI, 0, PHI], [0, 0, 2, 0]]) / 2
    symmetries = tuple(_product_matrix(unit, left) for unit in units for left in (True, False))
    start = SARTI_NODE / np.linalg.norm(SARTI_NODE)
    nodes = _orbit([start, -start], symmetries)
    assert len(nodes) == 2 * 600
    finite = nodes[nodes[:, 3] > 1e-6]
    assert len(finite) == 560
    _vanishes(f, finite[:, :3] / finite[:, 3:])


def _product_matrix(unit: Array, left: bool) -> Array:
    return np.stack([_quaternion(unit, e) if left else _quaternion(e, unit) for e in np.eye(4)], axis=1)


def _quaternion(a: Array, b: Array) -> Array:
    real = a[0] * b[0] - a[1:] @ b[1:]
    return np.array([real, *(a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:]))])


@pytest.mark.parametrize("order", [3, 5, 7, 9])
def test_chmutov_of_odd_order_has_a_node_where_critical_values_sum_to_minus_one(
    order: int, formula: Callable[[str], Any]
) -> None:
    critical = np.cos(np.pi * np.arange(1, order) / order)
    value = (-1.0) ** np.arange(1, order)
    nodes = [
        (critical[i], critical[j], critical[k])
        for i, j, k in itertools.product(range(order - 1), repeat=3)
        if value[i] + value[j] + value[k] == -1
    ]
    assert len(nodes) == 3 * ((order - 1) // 2) ** 3
    _vanishes(formula(f"chmutov-{order}"), np.array(nodes))


@pytest.mark.parametrize("order", [2, 6, 8])
def test_chmutov_of_even_order_is_smooth(order: int, formula: Callable[[str], Any]) -> None:
    critical = np.cos(np.pi * np.arange(1, order) / order)
    points = np.array(list(itertools.product(critical, repeat=3)))
    f = formula(f"chmutov-{order}")
    assert np.abs(f.gradient(points)).max() < 1e-9
    assert np.abs(f(points)).min() > 0.5
