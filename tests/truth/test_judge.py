"""The judge itself: roots known by hand, exact and by balls; and that it catches a method that breaks its word."""

from __future__ import annotations

import math

import pytest

import zeroset as zs
from zeroset.methods import MarchingPoints

from .held import Trial, broken_promise
from .judge import Judge, Kind, Verdict

Point = tuple[float, float, float]

KNOWN = [
    ("x^2 + y^2 + z^2 - 1", (-3.0, 0.0, 0.0), (1.0, 0.0, 0.0), 2.0, Kind.CROSS),
    ("x^2 + y^2 + z^2 - 1", (-3.0, 1.0, 0.0), (0.5, 0.0, 0.0), 6.0, Kind.TOUCH),
    ("x^2 + y^2 - 5", (-3.0, 0.0, 0.0), (1.0, 0.0, 0.0), 3 - math.sqrt(5), Kind.CROSS),
    ("(x - sqrt(2))^2", (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), math.sqrt(2), Kind.TOUCH),
    ("(x - sqrt(2)) (x^2 - 2)", (-3.0, 0.0, 0.0), (1.0, 0.0, 0.0), 3 - math.sqrt(2), Kind.CROSS),
    ("(x - sqrt(2)) (x^2 - 2)", (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), math.sqrt(2), Kind.TOUCH),
    ("(1 + sqrt(5)) x^3 - y", (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), 1.0, Kind.CROSS),
    ("exp(x) - 2", (-3.0, 0.5, 0.0), (1.0, 0.0, 0.0), 3 + math.log(2), Kind.CROSS),
    ("|x| - pi/4", (-3.0, 0.5, 0.0), (2.0, 0.0, 0.0), (3 - math.pi / 4) / 2, Kind.CROSS),
    ("max(x, y) sin(x)", (-1.0, -2.0, 0.0), (1.0, 0.0, 0.0), 1.0, Kind.OPEN),
    ("sqrt(x) - 0.5", (-3.0, 0.0, 0.0), (1.0, 0.0, 0.0), 3.25, Kind.CROSS),
    ("floor(x) + 0.5", (-0.5, 0.0, 0.0), (1.0, 0.0, 0.0), 0.5, Kind.OPEN),
    ("if(x < 1, 2, x - 2)", (-3.0, 0.0, 0.0), (1.0, 0.0, 0.0), 4.0, Kind.OPEN),
    ("mod(x, 1) - 0.25", (0.5, 0.0, 0.0), (1.0, 0.0, 0.0), 0.5, Kind.OPEN),
]


@pytest.mark.parametrize(("formula", "origin", "direction", "t", "kind"), KNOWN)
def test_first_places_known_by_hand(formula: str, origin: Point, direction: Point, t: float, kind: Kind) -> None:
    verdict = Judge(zs.surface(formula, bounds=4.0)).first_root(origin, direction)
    first = verdict.events[0]
    assert first.kind is kind
    assert not first.edge
    assert first.a - 1e-9 <= t <= first.b + 1e-9
    assert first.b - first.a < 1e-8


def test_a_ray_within_the_surface_meets_it_at_once() -> None:
    verdict = Judge(zs.surface("x y", bounds=2.0)).first_root((-3.0, 0.0, 0.5), (1.0, 0.0, 0.0))
    assert [event.kind for event in verdict.events] == [Kind.LINE]
    assert verdict.root is not None
    assert broken_promise(verdict, zs.MISS, math.nan)
    assert broken_promise(verdict, zs.UNRESOLVED, 3.0)
    assert not broken_promise(verdict, zs.UNRESOLVED, 3 - math.sqrt(3.75))


def test_roots_outside_the_bounds_do_not_count_and_those_at_their_edge_are_free() -> None:
    verdict = Judge(zs.surface("x^2 + y^2 + z^2 - 1", bounds=0.5)).first_root((-3.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert verdict.events == ()
    edge = Judge(zs.surface("x - 0.5", bounds=0.5)).first_root((-3.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    assert [event.edge for event in edge.events] == [True]
    assert edge.root is None
    assert not broken_promise(edge, zs.MISS, math.nan)
    assert not broken_promise(edge, zs.HIT, 3.5)


def sphere(origin: Point) -> Verdict:
    return Judge(zs.surface("x^2 + y^2 + z^2 - 1", bounds=2.0)).first_root(origin, (1.0, 0.0, 0.0))


def test_what_breaks_a_promise() -> None:
    through, beside = sphere((-3.0, 0.0, 0.0)), sphere((-3.0, 1.5, 0.0))
    assert not broken_promise(through, zs.HIT, 2.0)
    assert broken_promise(through, zs.MISS, math.nan)
    assert broken_promise(through, zs.HIT, 2.01)
    assert broken_promise(through, zs.HIT, 1.99)
    assert not broken_promise(through, zs.UNRESOLVED, 1.99)
    assert broken_promise(through, zs.UNRESOLVED, 2.01)
    assert not broken_promise(beside, zs.MISS, math.nan)
    assert broken_promise(beside, zs.HIT, 3.0)
    assert not broken_promise(beside, zs.UNRESOLVED, 3.0)
    assert broken_promise(beside, zs.UNRESOLVED, 9.0)
    assert broken_promise(sphere((-3.0, 1.0, 0.0)), zs.HIT, 3.0)
    assert not broken_promise(sphere((-3.0, 1.0, 0.0)), zs.UNRESOLVED, 3.0)


def test_a_method_that_proves_nothing_is_caught() -> None:
    assert Trial(zs.gallery["barth-sextic"], 64).hold(MarchingPoints(steps=10)).broken
