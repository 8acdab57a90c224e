from __future__ import annotations

import math
from fractions import Fraction

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from zeroset.expr import constant, degree, node, parse, polynomial, rational, variable


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("x", 1),
        ("x^2 + y^3 z - 1", 4),
        ("(x^2 + y z)^3", 6),
        ("T(30, x) + T(7, y)", 30),
        ("a*x + sin(a)*y^2", 2),
        ("w^9 + x", 1),
        ("x/3 + y/(a^2 + 1)", 1),
        ("sum(i, (x - r[i])^4)", 4),
        ("-(x y z)^2", 6),
        ("sin(w)^2 x + |a|", 1),
        ("(x+y)(x-y)", 2),
        ("w", 0),
        ("sin(x)", None),
        ("1/x", None),
        ("|x|", None),
        ("x^y", None),
        ("x^a", None),
        ("x^0.5", None),
        ("if(x < 1, x, y)", None),
        ("x^2 + sqrt(y)", None),
        ("a^x", None),
        ("mod(x, 2)", None),
        ("min(x, y)", None),
        ("sum(i, 1/(x - r[i]))", None),
    ],
)
def test_degree(written, value):
    f = parse(written, params=["a"], arrays=["r"])
    assert degree(f) == value
    assert (polynomial(f) is None) == (value is None)


def test_degree_is_cheap_where_expansion_is_not():
    f = parse("(x + y + z + 1)^500 (x y + 2)^500")
    assert degree(f) == 1500
    assert polynomial(f) is None


def test_degrees_beyond_all_bounds():
    f = variable("x")
    for _ in range(40):
        f = node("sqr", (node("add", (f, constant(1))),))
    assert degree(f) is None


def test_coefficients_are_exact():
    view = polynomial(parse("(x/3 - y)^2 - z"))
    assert {at: rational(value) for at, value in view.coefficients.items()} == {
        (2, 0, 0): Fraction(1, 9),
        (1, 1, 0): Fraction(-2, 3),
        (0, 2, 0): Fraction(1),
        (0, 0, 1): Fraction(-1),
    }
    assert view.degree == 2
    assert view.degrees == (2, 2, 1)
    assert rational(view.coefficient(1, 1, 0)) == Fraction(-2, 3)
    assert rational(view.coefficient(5, 5, 5)) == 0


def test_cancelled_terms_are_gone():
    view = polynomial(parse("(x + y)^3 - x^3 - 3x^2 y - 3 x y^2 - y^3 + z"))
    assert set(view.coefficients) == {(0, 0, 1)}
    assert polynomial(parse("(x+1)^2 - x^2 - 2x - 1")).degree == 0


def test_parameters_and_w_belong_to_the_coefficients():
    view = polynomial(parse("(x + a)^2 w + sin(a)*y/(1 + a^2) + phi*z - z*phi", params=["a"]))
    assert {at: str(value) for at, value in view.coefficients.items()} == {
        (2, 0, 0): "w",
        (1, 0, 0): "2*a*w",
        (0, 0, 0): "a^2*w",
        (0, 1, 0): "sin(a)/(1 + a^2)",
    }


def test_sums_over_arrays_are_taken_term_by_term(at):
    f = parse("sum(i, s[i]*(x - r[i])^2)", arrays=["r", "s"])
    view = polynomial(f)
    assert {exponents: str(value) for exponents, value in view.coefficients.items()} == {
        (2, 0, 0): "sum(i, s[i] + 0*r[i])",
        (1, 0, 0): "sum(i, -2*s[i]*r[i])",
        (0, 0, 0): "sum(i, s[i]*r[i]^2)",
    }


@pytest.mark.parametrize("order", [2, 3, 5, 6, 7, 9, 11, 14, 18, 22, 30, 31])
def test_chebyshev_expands_to_the_textbook_polynomial(order):
    view = polynomial(parse(f"T({order}, x)"))
    expected = sympy.Poly(sympy.chebyshevt(order, sympy.Symbol("x")))
    assert {exponents[0]: rational(value) for exponents, value in view.coefficients.items()} == {
        power: Fraction(int(value)) for (power,), value in expected.terms()
    }


BARTH_DECIC = (
    "8(x^2 - phi^4 y^2)(y^2 - phi^4 z^2)(z^2 - phi^4 x^2)(x^4 + y^4 + z^4 - 2x^2y^2 - 2x^2z^2 - 2y^2z^2)"
    " + (3 + 5phi)(x^2 + y^2 + z^2 - 1)^2 (x^2 + y^2 + z^2 - 2 + phi)^2"
)


def test_a_surface_of_degree_ten(at):
    f = parse(BARTH_DECIC)
    view = polynomial(f)
    assert view.degree == 10
    point = (0.3, -0.7, 1.1)
    total = math.fsum(
        at(value) * point[0] ** i * point[1] ** j * point[2] ** k for (i, j, k), value in view.coefficients.items()
    )
    assert total == pytest.approx(at(f, x=0.3, y=-0.7, z=1.1), rel=1e-9)


_POLYNOMIALS = st.recursive(
    st.one_of(st.sampled_from(["x", "y", "z", "a"]), st.integers(-5, 5).map(str), st.sampled_from(["0.5", "2/3"])),
    lambda parts: st.one_of(
        st.builds("({} + {})".format, parts, parts),
        st.builds("({} - {})".format, parts, parts),
        st.builds("({})*({})".format, parts, parts),
        st.builds("(-{})".format, parts),
        st.builds("({})^{}".format, parts, st.integers(2, 4)),
        st.builds("({})/3".format, parts),
    ),
    max_leaves=8,
)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(written=_POLYNOMIALS)
def test_expansion_agrees_with_sympy(written):
    view = polynomial(parse(f"{written} + 11*x^17", params=["a"]))
    names = sympy.symbols("x y z a")
    expected = sympy.Poly(sympy.sympify(f"{written} + 11*x^17".replace("^", "**"), rational=True), *names[:3])
    found = sum(
        sympy.sympify(str(value).replace("^", "**"), rational=True) * names[0] ** i * names[1] ** j * names[2] ** k
        for (i, j, k), value in view.coefficients.items()
    )
    assert sympy.expand(found - expected.as_expr()) == 0
    assert view.degree >= max(map(sum, expected.monoms()))
    assert degree(parse(f"{written} + 11*x^17", params=["a"])) >= view.degree
