"""How large a formula's parts may get, before a kernel calculates them."""

from __future__ import annotations

import math

import pytest

from zeroset.expr import Magnitude, parse

SIZES = {"x": 3.0, "y": 4.0, "z": 5.0, "a": 1e20}


def largest(formula: str, **arrays: tuple[float, int]) -> float:
    return Magnitude(parse(formula, ["a"], list(arrays))).largest(SIZES, arrays)


@pytest.mark.parametrize(
    ("formula", "expected"),
    [
        ("x*y - z", 17.0),
        ("x^9", 3.0**9),
        ("a^2 x", 3e40),
        ("sin(1e40 x)", 3e40),
        ("max(x, a) + 1", 1e20),
        ("if(x < y, a y, z)", 4e20),
        ("sum(i, r[i] x)", 3e4),
        ("abs(x - 1e35)", 1e35),
        ("exp(70) x", 3 * math.exp(70)),
        ("x/sqrt(2e-66)", 3 / 2e-66**0.5),
    ],
)
def test_the_largest_part_counts(formula: str, expected: float) -> None:
    arrays = {"r": (100.0, 100)} if "r[" in formula else {}
    assert largest(formula, **arrays) == pytest.approx(expected, rel=1e-6)


def test_what_floats_do_not_hold_is_infinite() -> None:
    assert largest("(a x)^20") == math.inf


@pytest.mark.parametrize("formula", ["exp(x) - 1e10", "1e10/x", "x^2.5 tan(y) + 1e10"])
def test_functions_that_kernels_watch_do_not_count(formula: str) -> None:
    assert largest(formula) <= 2e10
