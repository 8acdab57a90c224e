from fractions import Fraction

import numpy as np
import pytest

from zeroset.arith import F32
from zeroset.arith import rounding as r

from .scalars import Flushed, Fused, plain
from .truth import awkward

KINDS = pytest.mark.parametrize("kind", [np.asarray, Fused, Flushed], ids=["plain", "fused", "flushed"])


@KINDS
@pytest.mark.parametrize("operation", ["add", "mul"])
def test_one_operation_is_enclosed_and_tight(kind, operation):
    values = awkward("float32")
    values = values[abs(values) < 1e15]
    if kind is Flushed:
        values = values[(abs(values) >= F32.quantum) | (values == 0)]
    a, b = (x.ravel() for x in np.meshgrid(values[::3], values[::4]))
    x, y = kind(a), kind(b)
    result = x + y if operation == "add" else x * y
    low, high = plain(r.lower(F32, result)), plain(r.upper(F32, result))
    for p, q, lo, hi in zip(a.tolist(), b.tolist(), low.tolist(), high.tolist(), strict=True):
        exact = Fraction(p) + Fraction(q) if operation == "add" else Fraction(p) * Fraction(q)
        assert Fraction(lo) <= exact <= Fraction(hi)
        assert Fraction(hi) - Fraction(lo) <= 9 * Fraction(F32.eps) * abs(exact) + 3 * Fraction(F32.tiny)


@KINDS
def test_bounds_of_nonnegative_numbers(kind):
    a = abs(awkward("float32"))
    a = a[a < 1e15]
    square = kind(a) * kind(a)
    low, high = plain(r.lower_nonnegative(F32, square)), plain(r.upper_nonnegative(F32, square))
    assert (low >= 0).all()
    for x, lo, hi in zip(a.tolist(), low.tolist(), high.tolist(), strict=True):
        assert Fraction(lo) <= Fraction(x) ** 2 <= Fraction(hi)


def test_literals_become_numbers_of_the_format():
    third = 1 / 3
    low, high = r.lower(F32, third), r.upper(F32, third)
    assert F32.exact(low)
    assert F32.exact(high)
    assert low < third < high


def test_clamp_removes_infinities():
    with np.errstate(over="ignore"):
        x = np.float32([np.inf, -np.inf, 1.0])
    assert r.clamp(F32, x).tolist() == [F32.big, -F32.big, 1.0]
