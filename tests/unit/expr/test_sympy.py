from __future__ import annotations

import subprocess
import sys
from fractions import Fraction

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import Abs, Eq, Max, Min, Mod, Piecewise, Rational, cbrt, exp, log, pi, real_root, sqrt

from zeroset.errors import FormulaError, ParameterError, UnknownNameError
from zeroset.expr import OPS, from_sympy, is_sympy, parse
from zeroset.expr.derived import DERIVED

x, y, z, w, a = sympy.symbols("x y z w a")
f = sympy.Function


@pytest.mark.parametrize(
    ("expression", "written"),
    [
        (x**2 + y**2 - 1, "x^2 + y^2 - 1"),
        (Eq(x**2, y), "x^2 = y"),
        (x / y, "x/y"),
        (Rational(1, 3) * x, "x/3"),
        (pi * x, "pi*x"),
        (sympy.GoldenRatio * x, "phi*x"),
        (sympy.E * x, "e*x"),
        (sqrt(x), "sqrt(x)"),
        (cbrt(x), "x^(1/3)"),
        (x ** Rational(5, 2), "x^2.5"),
        (x**-2, "1/x^2"),
        (x**y, "x^y"),
        (2**x, "2^x"),
        (exp(x), "e^x"),
        (log(x), "ln(x)"),
        (Abs(x), "|x|"),
        (sympy.sign(x), "sign(x)"),
        (Min(x, 1), "min(1, x)"),
        (Max(x, y), "max(x, y)"),
        (Mod(x, 2), "mod(x, 2)"),
        (sympy.floor(x), "floor(x)"),
        (sympy.ceiling(x), "ceil(x)"),
        (sympy.atan2(y, x), "atan2(y, x)"),
        (sympy.sec(x) + sympy.cot(y), "cot(y) + sec(x)"),
        (sympy.acosh(x), "acosh(x)"),
        (sympy.chebyshevt(5, x, evaluate=False), "T(5, x)"),
        (real_root(x, 3), "|x|^(1/3)*sign(x)"),
        (sympy.re(x) + sympy.im(y), "x"),
        (Piecewise((x, x < 1), (y, y >= 2), (z, True)), "if(x < 1, x, if(y >= 2, y, z))"),
        (Piecewise((x, (x < 1) & ~(y > 2)), (y, True)), "if(y <= 2 and x < 1, x, y)"),
        (Piecewise((x, (x < 1) | (y > 2)), (y, True)), "if(2 < y or x < 1, x, y)"),
        (Piecewise((x, Eq(x, y)), (y, True)), "if(x <= y and y <= x, x, y)"),
        (a * x + sympy.Symbol("b_1"), "b_1 + a*x"),
    ],
)
def test_expressions_are_the_formulas_they_mean(expression, written):
    assert from_sympy(expression) is parse(written, params=["a", "b_1"])


def test_floats_are_exact():
    node = from_sympy(0.1 * x)
    assert node.args[0].data[0] == Fraction(0.1)
    assert from_sympy(sympy.Float("0.1", 50) * x).args[0].data[0] != Fraction(0.1)


@pytest.mark.parametrize("name", sorted({name for row in OPS.values() for name in row.sympy}))
def test_every_class_of_the_table_exists_in_sympy(name):
    assert hasattr(sympy, name)


@pytest.mark.parametrize("name", sorted(set(DERIVED) & set(dir(sympy)) - {"T", "E"}))
def test_derived_functions_that_sympy_has(name):
    assert from_sympy(getattr(sympy, name)(x)).variables == {"x"}


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        (sympy.gamma(x), "gamma"),
        (f("g")(x), "g has no meaning"),
        (sympy.I * x, "ImaginaryUnit"),
        (sympy.oo + sympy.Symbol("x") * sympy.I, "I"),
        (sympy.Sum(x, (a, 1, 3)), "Sum"),
        (sympy.Integral(x, x), "Integral"),
        (sympy.Derivative(f("g")(x), x), "Derivative"),
        (Piecewise((x, x < 1)), "Piecewise"),
        (sympy.Matrix([x]), "Matrix"),
        (sympy.Integer(3), "none of the variables"),
        (x < 1, "inequality"),
        (sympy.zoo, "ComplexInfinity"),
        (sympy.nan, "NaN"),
        (sympy.EulerGamma * x, "EulerGamma"),
        (sympy.Heaviside(x), "Heaviside"),
        (x**5000, "too large"),
        (sqrt(-pi + x * 0) + x, "Imaginary"),
        ("x + y", "str"),
        ([x], "list"),
    ],
)
def test_what_has_no_meaning_is_named(expression, message):
    with pytest.raises(FormulaError, match=message):
        from_sympy(expression)


def test_symbols_are_parameters_unless_told_otherwise():
    assert from_sympy(a * x).parameters == {"a"}
    assert from_sympy(a * x, params=["a"]).parameters == {"a"}
    with pytest.raises(UnknownNameError, match="unknown symbol a"):
        from_sympy(a * x, params=["b"])
    with pytest.raises(ParameterError):
        from_sympy(sympy.Symbol("two words") * x)


def test_large_and_deep_expressions():
    deep = x
    for _ in range(300):
        deep = sympy.sin(deep, evaluate=False)
    assert from_sympy(deep).size == 301
    assert from_sympy(sympy.Add(*[sympy.sin(k * x) for k in range(1, 2_000)])).size > 4_000


def test_sympy_objects_are_told_without_importing_sympy():
    assert is_sympy(x + 1)
    assert is_sympy(f("g"))
    assert not any(map(is_sympy, ["x", 1, None, lambda: 0, parse("x")]))
    code = "import sys; from zeroset.expr import is_sympy; is_sympy(3); assert 'sympy' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


_EXPRESSIONS = st.recursive(
    st.sampled_from([x, y, z, a, sympy.Integer(2), Rational(-3, 4), pi]),
    lambda parts: st.one_of(
        st.builds(lambda p, q: p + q, parts, parts),
        st.builds(lambda p, q: p * q, parts, parts),
        st.builds(lambda p, n: p**n, parts, st.integers(2, 5)),
        st.builds(lambda g, p: g(p), st.sampled_from([sympy.sin, sympy.cos, exp, sympy.atan, sympy.tanh, Abs]), parts),
        st.builds(lambda p, q: Max(p, q), parts, parts),
    ),
    max_leaves=7,
)


@settings(max_examples=80, deadline=None, derandomize=True)
@given(expression=_EXPRESSIONS)
def test_values_agree_with_sympy(expression, at):
    values = {"x": 0.3, "y": -0.7, "z": 1.1, "a": 0.6}
    node = from_sympy(expression + 7 * x)
    expected = (expression + 7 * x).evalf(
        30, subs={sympy.Symbol(name): Rational(value) for name, value in values.items()}
    )
    assert at(node, **values) == pytest.approx(float(expected), rel=1e-9, abs=1e-9)
