from __future__ import annotations

from fractions import Fraction

import pytest

from zeroset.errors import FormulaError, FormulaLimitError
from zeroset.expr import build, constant, node, parse, rational, text, variable
from zeroset.expr.build import shared

x = variable("x")


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("x + 0", "x"),
        ("0 + x", "x"),
        ("x - 0", "x"),
        ("0 - x", "-x"),
        ("x*1", "x"),
        ("x*0 + y", "y"),
        ("x - x + y", "y"),
        ("--x", "x"),
        ("x + x", "2x"),
        ("3x - x", "2x"),
        ("x - 3x", "-2x"),
        ("x/4", "0.25x"),
        ("x + 1 + 2", "x + 3"),
        ("(1 - x) + 2", "3 - x"),
        ("x - (-2)", "x + 2"),
        ("x + -y", "x - y"),
        ("-(x - y)", "y - x"),
        ("x - -3y", "x + 3y"),
        ("2(3x)", "6x"),
        ("2x * 3y", "6 x y"),
        ("-x * -y", "x y"),
        ("x*x", "x^2"),
        ("x*y*x", "x^2 y"),
        ("x*x*x", "x^3"),
        ("x^2 * x^3", "x^5"),
        ("(x y)(x y)", "(x y)^2"),
        ("(x^2)^2", "x^4"),
        ("(-x)^2", "x^2"),
        ("(-x)^3", "-x^3"),
        ("|x|^2", "x^2"),
        ("|x|^6", "x^6"),
        ("(-2x)^3", "-(2x)^3"),
        ("x^1", "x"),
        ("x^0 + y", "1 + y"),
        ("x^-2", "1/x^2"),
        ("(1/x)^2", "1/x^2"),
        ("x^0.5", "sqrt(x)"),
        ("x^-0.5", "1/sqrt(x)"),
        ("sqrt(x^2)", "|x|"),
        ("sqrt(x^4)", "x^2"),
        ("sqrt(x^6)", "|x|^3"),
        ("(x^2)^1.5", "|x|^3"),
        ("(x^4)^0.25", "|x|"),
        ("sqrt(x)^0.5", "x^0.25"),
        ("cbrt(x^3)", "x"),
        ("cbrt(x)^3", "x"),
        ("cbrt(-x)", "-cbrt(x)"),
        ("sqrt(|x|)^2", "|x|"),
        ("||x||", "|x|"),
        ("|x^2|", "x^2"),
        ("|-x|", "|x|"),
        ("sin(-x)", "-sin(x)"),
        ("cos(-x)", "cos(x)"),
        ("cos(|x|)", "cos(x)"),
        ("sin(-2x)", "-sin(2x)"),
        ("cosh(-3x)", "cosh(3x)"),
        ("floor(floor(x))", "floor(x)"),
        ("sign(sign(x))", "sign(x)"),
        ("exp(log(2)) x", "2x"),
        ("log(exp(x))", "x"),
        ("exp(x)^2", "exp(2x)"),
        ("exp(x)^y", "exp(x y)"),
        ("sqrt(exp(x))", "exp(x/2)"),
        ("min(x, x)", "x"),
        ("max(2, 3) x", "3x"),
        ("mod(7, 4) x", "3x"),
        ("sqrt(9/4) x", "1.5x"),
        ("8^(1/3) x", "2x"),
        ("2^10 x", "1024x"),
        ("sin(0) + x", "x"),
        ("cos(0) x", "x"),
        ("if(1 < 2, x, y)", "x"),
        ("if(2 <= 1, x, y)", "y"),
        ("if(x < 1, y, y)", "y"),
        ("if(not x < 1, x, y)", "if(1 <= x, x, y)"),
        ("if(x < 1 and 1 < 2, x, y)", "if(x < 1, x, y)"),
        ("if(x < 1 or 1 < 2, x, y)", "x"),
        ("2 pi x", "x*(2pi)"),
        ("x*pi*2", "2pi x"),
        ("x/(2y)", "0.5*(x/y)"),
        ("2/(4x)", "0.5/x"),
        ("x*(1/y)", "x/y"),
        ("0.1x", "x/10"),
        ("x/y/z", "x/(y z)"),
        ("2/x/x", "2/x^2"),
        ("1.50x", "3/2 x"),
        ("(x^2+1)/(x^2+1) + y", "1 + y"),
    ],
)
def test_the_two_are_one_node(written, meant):
    assert parse(written) is parse(meant)


@pytest.mark.parametrize(
    ("written", "kept"),
    [
        ("0*sqrt(x)", "0*sqrt(x)"),
        ("sqrt(x) - sqrt(x)", "0*sqrt(x)"),
        ("x/x", "x/x"),
        ("x^2/x", "x^2/x"),
        ("sqrt(x)^2", "sqrt(x)^2"),
        ("sqrt(x)^4", "sqrt(x)^4"),
        ("exp(log(x))", "exp(log(x))"),
        ("log(x)^0", "0*log(x) + 1"),
        ("1/(1/x)", "1/(1/x)"),
        ("(x^(1/3))^3", "(x^(1/3))^3"),
        ("asin(sin(x))", "asin(sin(x))"),
        ("if(x < 1, sqrt(x), sqrt(x))", "sqrt(x)"),
        ("if(sqrt(x) < 1, y, y)", "if(sqrt(x) < 1, y, y)"),
        ("(x+y)*(x-y)", "(x + y)*(x - y)"),
        ("x*(y+z)", "x*(y + z)"),
        ("z + y + x", "z + y + x"),
        ("x^2.5", "x^(5/2)"),
        ("x^(2/4)", "sqrt(x)"),
        ("x^y", "x^y"),
        ("2^x", "exp(log(2)*x)"),
    ],
)
def test_the_function_and_its_domain_are_kept(written, kept):
    assert text(parse(written)) == kept


def test_an_even_power_is_one_node_of_its_exponent():
    f = parse("(x*x)*(x*x)*((x^2)^2)")
    assert (f.op, f.args, f.data) == ("powi", (x,), (8,))
    assert parse("x^2").op == "sqr"
    assert parse("|x|^2.5").data == (5, 2)


def test_exponents_too_long_for_powr_stay_real_powers():
    f = parse("x^3.14159265")
    assert f.op == "pow"
    assert rational(f.args[1]) == Fraction("3.14159265")


def test_equal_terms_written_in_another_order_are_shared():
    f = parse("sin(x + y)*cos(y + x) + x*y - y*x*2")
    assert f.size == parse("sin(x + y)*cos(x + y) + x*y - x*y*2").size
    assert f is shared(f)


def test_constants_fold_exactly_and_only_while_short():
    assert rational(parse("x + (1/3 + 1/6)*2/7").args[1]) == Fraction(1, 7)
    huge = build("mul", (build("powi", (constant(10**200),), (4,)), build("powi", (constant(10**200),), (4,))))
    assert rational(huge) is None
    assert huge.is_constant


@pytest.mark.parametrize(
    "text_", ["x^4097", "(x^100)^100", "x^(10^9)", "x^-5000", "2^10^10 x", "x^2000 * x^2097", "x^(0-10^9)"]
)
def test_powers_past_the_limit_are_errors(text_):
    with pytest.raises(FormulaLimitError, match="4096"):
        parse(text_)


@pytest.mark.parametrize(
    ("op", "values"),
    [
        ("sqrt", [-1]),
        ("log", [0]),
        ("asin", [2]),
        ("acos", [Fraction(-3, 2)]),
        ("div", [1, 0]),
        ("mod", [1, 0]),
        ("atan2", [0, 0]),
        ("pow", [-8, Fraction(1, 3)]),
    ],
)
def test_constants_outside_a_domain_are_errors(op, values):
    with pytest.raises(FormulaError):
        build(op, tuple(map(constant, values)))


def test_building_a_long_product_stays_linear():
    # Each factor is new, so nothing can be joined; searching all factors each time would be quadratic.
    f = x
    for number in range(3_000):
        f = f * build("sin", (x + number,))
    assert f.size > 6_000


def test_facts():
    def fact(text_):
        f = parse(text_)
        return f.is_total, f.is_nonnegative, f.is_positive

    assert fact("x^2 + 1") == (True, True, True)
    assert fact("x^2 + y^2") == (True, True, False)
    assert fact("exp(x)") == (True, True, True)
    assert fact("1/(x^2 + 1)") == (True, True, True)
    assert fact("1/x^2")[0] is False
    assert fact("sqrt(x)") == (False, True, False)
    assert fact("sqrt(x^2 + 1)") == (True, True, True)
    assert fact("log(cosh(x))")[0] is True
    assert fact("x^3") == (True, False, False)
    assert fact("max(x, 1)") == (True, True, True)
    assert fact("min(x, 1)") == (True, False, False)
    assert fact("acos(x/9)") == (False, True, False)
    assert fact("mod(x, 2)") == (True, True, False)
    assert fact("if(x < 1, x^2, |y|)") == (True, True, False)


def test_a_sum_needs_an_array():
    with pytest.raises(FormulaError, match="no array"):
        build("sum", (x,), ("i",))
    assert rational(build("sum", (constant(0),), ("i", "r"))) == 0
    assert build("sum", (constant(2),), ("i", "r")) is node("sum", (constant(2),), ("i", "r"))
