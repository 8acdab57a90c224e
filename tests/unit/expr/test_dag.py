from __future__ import annotations

import copy
import gc
import pickle
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest

from zeroset.errors import FormulaError
from zeroset.expr import Expr, constant, node, parse, postorder, variable
from zeroset.expr import dag as dag_module

x, y, z = map(variable, "xyz")


def test_equal_formulas_are_one_object():
    assert x + y is x + y
    assert parse("(x+1)^2 * y") is (x + 1) ** 2 * y


def test_names_are_told_apart():
    f = parse("x*a + sum(i, r[i]*y*b)", params=["a", "b"], arrays=["r"])
    assert f.variables == {"x", "y"}
    assert f.parameters == {"a", "b"}
    assert f.arrays == {"r"}
    assert f.indices == frozenset()


def test_an_index_is_free_until_its_sum():
    element = node("element", (), ("r", "i"))
    assert (element * x).indices == {"i"}
    assert not constant(2).symbols


@pytest.mark.parametrize(
    ("made", "text"),
    [
        (lambda: 1 + x, "1 + x"),
        (lambda: 1 - x, "1 - x"),
        (lambda: 2 * x, "2*x"),
        (lambda: 1 / x, "1/x"),
        (lambda: x**3, "x^3"),
        (lambda: 2**x, "exp(log(2)*x)"),
        (lambda: -x, "-x"),
        (lambda: +x, "x"),
        (lambda: abs(x), "abs(x)"),
        (lambda: x % 2, "mod(x, 2)"),
        (lambda: 5 % x, "mod(5, x)"),
        (lambda: x // 2, "floor(0.5*x)"),
        (lambda: 3 // x, "floor(3/x)"),
        (lambda: x / 2, "0.5*x"),
        (lambda: x < y, "x < y"),
        (lambda: x >= 1, "1 <= x"),
        (lambda: (x > 0) & (y <= 1) | ~(z < 1), "0 < x and y <= 1 or 1 <= z"),
        (lambda: (x > 0) * 2, "2*if(0 < x, 1, 0)"),
        (lambda: np.float64(0.5) * x, "0.5*x"),
        (lambda: x + np.int32(7), "x + 7"),
        (lambda: x * Fraction(1, 3), "1/3*x"),
    ],
)
def test_python_operators(made, text):
    assert str(made()) == text


def test_a_float_means_itself_exactly():
    assert (x + 0.1).args[1].data[0] == Fraction(0.1)


@pytest.mark.parametrize("foreign", ["a", None, [1], object(), True])
def test_foreign_types_are_refused_by_python(foreign):
    with pytest.raises(TypeError):
        x + foreign


@pytest.mark.parametrize("value", [float("nan"), float("inf"), np.float32("-inf")])
def test_numbers_that_are_not_finite_are_refused(value):
    with pytest.raises(FormulaError, match="not finite"):
        x * value


@pytest.mark.parametrize("use", [bool, float, int, round, list, lambda f: min(f, 1), lambda f: [1, 2][f]])
def test_what_only_numbers_can_do_says_what_to_write(use):
    with pytest.raises(FormulaError) as caught:
        use(x)
    assert caught.value.hints


def test_conditions_and_numbers_do_not_mix():
    with pytest.raises(FormulaError, match="number stands where a condition"):
        node("and", (x, y))
    with pytest.raises(FormulaError, match="condition stands where a number"):
        node("add", (x < 1, y))


def test_copies_are_the_node_itself():
    f = parse("sin(x) + y")
    assert copy.copy(f) is f
    assert copy.deepcopy([f])[0] is f
    assert pickle.loads(pickle.dumps(f)) is f


def test_digest_is_of_the_content_and_the_same_in_every_process():
    code = "from zeroset.expr import parse; print(parse('sin(x)*a + y^2 - 0.5', params=['a']).digest)"
    run = [sys.executable, "-c", code]
    elsewhere = {subprocess.run(run, capture_output=True, text=True, check=True).stdout.strip() for _ in range(2)}
    assert elsewhere == {parse("sin(x)*a + y^2 - 0.5", params=["a"]).digest}
    assert len({parse(text).digest for text in ("x+y", "x-y", "x*y", "x+z", "x+1", "x+2", "x^3", "x^4")}) == 8


def test_nodes_die_with_their_last_user():
    f = parse("sin(x + 12345) * cos(y - 54321)")
    gc.collect()
    before = len(dag_module._nodes)
    del f
    gc.collect()
    assert len(dag_module._nodes) < before


def test_depth_costs_no_recursion():
    f: Expr = x
    for _ in range(50_000):
        f = node("sin", (f,))
    assert f.size == 50_001
    assert len(f.digest) == 32
    assert pickle.loads(pickle.dumps(f)) is f
    assert "50001" in repr(f)
    del f
    gc.collect()


def test_postorder_has_arguments_first_and_each_node_once():
    f = (x + y) * (x + y + z) - (x + y)
    order = list(postorder(f))
    assert len(order) == len(set(order)) == f.size
    seen = set()
    for part in order:
        assert all(arg in seen for arg in part.args)
        seen.add(part)
    assert order[-1] is f
