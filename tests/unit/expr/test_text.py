from __future__ import annotations

from fractions import Fraction

import pytest

from zeroset.errors import FormulaLimitError
from zeroset.expr import constant, node, parse, text, trace, variable

x, y = variable("x"), variable("y")


@pytest.mark.parametrize(
    "written",
    [
        "x + y - z",
        "x - (y - z)",
        "x - (y + z)",
        "x + (y - z)",
        "x*y*z",
        "x*(y*z)",
        "x/y/z",
        "x/(y/z)",
        "x/(y*z)",
        "x*y/z",
        "-x*y",
        "-(x*y)",
        "-(x + y)",
        "(x + y)^2",
        "x^2^x",
        "(x^y)^z",
        "x^-y",
        "(-x)^y",
        "-x^y",
        "2*x^2",
        "(2*x)^2",
        "x^(1/3)",
        "(x/y)^(5/2)",
        "1/3*x",
        "x/3 + 1/7",
        "-1/3*x",
        "-0.5 - x",
        "2^x",
        "x^(-2/3)",
        "x^y^z",
        "sqrt(x)^3",
        "sin(x)^2",
        "|x|^3",
        "min(x, max(y, -2))",
        "if(x < 1 and (y < 2 or z <= 3), x, if(not (x < 1 and y < 1), y, -z))",
        "if(x < 1 or y < 1 and z < 1, x, y)",
        "sum(i, (x - r[i])^2) - a*sum(i, r[i]*s[i])",
        "sum(i, sum(j, r[i]*s[j]*x))",
        "e^x + e - pi*phi*x",
        "2pi x/3",
        "sqrt(2)x/y",
        "0*sqrt(x) + y",
        "0*(x/sqrt(y)) + z",
        "x/(0*sqrt(y))",
        "1e-30x + 1e30y",
        "x*1e-90",
        "mod(x, y) - atan2(y, x)",
        "T(7, x) - y",
        "x - -1",
        "(x + 1)*(y - 1)*2*(3)",
        "log10(x) + cot(y)",
        "x*(0.5 - y)/pi",
        "-(2*pi)*x",
        "x - 2pi*y",
        "x - sqrt(3)*(y - 1)",
    ],
)
def test_text_parses_back_to_the_identical_node(written):
    options = {"params": ["a"], "arrays": ["r", "s"]}
    f = parse(written, **options)
    assert parse(text(f), **options) is f
    assert text(parse(text(f), **options)) == text(f)


@pytest.mark.parametrize(
    ("written", "shown"),
    [
        ("x^2 + y^2 = 1", "x^2 + y^2 - 1"),
        ("3x^2y", "3*x^2*y"),
        ("2 pi x", "2*pi*x"),
        ("phi^2 x", "phi^2*x"),
        ("e^1 x", "e*x"),
        ("x/4", "0.25*x"),
        ("x/3", "1/3*x"),
        ("x y/3", "1/3*x*y"),
        ("1 - x", "1 - x"),
        ("|x|", "abs(x)"),
        ("if(x > 1, x, 2)", "if(1 < x, x, 2)"),
        ("x - y/2", "x - 0.5*y"),
    ],
)
def test_text_reads_well(written, shown):
    assert text(parse(written)) == shown


def test_constants_whose_name_a_parameter_has_taken():
    f = trace(lambda x, y, z, pi=1.0, e=2.0, phi=3.0: pi * x + e * y + phi * z).expr
    f = f + parse("pi x + e y + phi z + e^2")
    shown = text(f)
    assert "acos(-1)" in shown
    assert parse(shown, params=["pi", "e", "phi"]) is f


def test_doubles_are_written_exactly():
    for value in (0.1, 1 / 3, 2.0**-60, 1e22, 123.456):
        f = x + value
        assert parse(text(f)) is f


def test_a_sum_that_has_lost_an_array_keeps_its_length():
    f = node("sum", (node("add", (x, constant(1))),), ("i", "r"))
    assert text(f) == "sum(i, x + 1 + 0*r[i])"
    assert parse(text(f), arrays=["r"]) is f


def test_what_is_shared_too_often_is_refused_not_written():
    f = x
    for _ in range(200):
        f = node("sin", (node("add", (node("cos", (f,)), node("exp", (f,)))),))
    with pytest.raises(FormulaLimitError, match="written out"):
        text(f)
    assert "distinct operations" in repr(f)
    with pytest.raises(FormulaLimitError):
        text(x + constant(Fraction(10**200)), limit=50)


def test_long_sums_are_written_in_linear_memory():
    f = parse("+".join(f"sin({i}x)" for i in range(2, 7_000)))
    assert parse(text(f)) is f
