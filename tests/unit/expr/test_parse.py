from __future__ import annotations

import math

import pytest

from zeroset.errors import FormulaError, FormulaLimitError, ParameterError, UnknownNameError
from zeroset.expr import limits, parse, variable
from zeroset.expr.derived import DERIVED
from zeroset.expr.ops import FUNCTIONS

POINT = {"x": 0.7, "y": -1.3, "z": 2.1, "w": 0.4, "a": 1.7, "b": -0.6, "r": [0.5, 1.5, -2.0], "s": [1.0, 2.0, 3.0]}
X, Y, Z, W, A, B = (POINT[name] for name in "xyzwab")
R, S = POINT["r"], POINT["s"]
PHI = (1 + math.sqrt(5)) / 2


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("x + y - z", X + Y - Z),
        ("x - y - z", X - Y - Z),
        ("x/y/z", X / Y / Z),
        ("x - (y - z)", X - (Y - Z)),
        ("-x^2", -(X**2)),
        ("(-x)^2", X * X),
        ("2^3^2 x", 512 * X),
        ("2**3 x", 8 * X),
        ("x^-2", X**-2),
        ("-x^-2", -(X**-2)),
        ("2x", 2 * X),
        ("2(x+1)", 2 * (X + 1)),
        ("(x+1)(y-1)", (X + 1) * (Y - 1)),
        ("2 sin(x)", 2 * math.sin(X)),
        ("x sin(y)", X * math.sin(Y)),
        ("sin(x)cos(y)", math.sin(X) * math.cos(Y)),
        ("x y", X * Y),
        ("xyz", X * Y * Z),
        ("2pi x", 2 * math.pi * X),
        ("x^2y^2", X * X * Y * Y),
        ("3x^2y", 3 * X * X * Y),
        ("xy^2", X * Y * Y),
        ("1/2x", X / 2),
        ("2x/3y", 2 * X / 3 * Y),
        ("x(y+1)", X * (Y + 1)),
        ("a(x+1)b", A * (X + 1) * B),
        ("2e x", 2 * math.e * X),
        ("2e3x", 2000 * X),
        ("2e-1x", 0.2 * X),
        (".5x", 0.5 * X),
        ("1.x", X),
        ("x*-y", X * -Y),
        ("x - -y", X + Y),
        ("+x", X),
        ("|x|", abs(X)),
        ("||x|-1|", abs(abs(X) - 1)),
        ("2|y|", 2 * abs(Y)),
        ("|x|y|z|", X * Y * Z),
        ("|x y|z", abs(X * Y) * Z),
        ("|x|-|y|", abs(X) - abs(Y)),
        ("||x||", abs(X)),
        ("|(|x|+1)|", abs(X) + 1),
        ("|sin(|y|)|", abs(math.sin(abs(Y)))),
        ("x²", X * X),
        ("½x", X / 2),
        ("x^⅔", X ** (2 / 3)),
        ("x²y³", X**2 * Y**3),
        ("x¹⁰", X**10),
        ("x⁻²", X**-2),
        ("2·x×y", 2 * X * Y),
        ("x−y", X - Y),
        ("2πx", 2 * math.pi * X),
        ("φx", PHI * X),
        ("√(x+1)", math.sqrt(X + 1)),
        ("√2x", math.sqrt(2) * X),
        ("x÷2", X / 2),
        ("x ⋅ y", X * Y),
        ("phi*x", PHI * X),
        ("e^x", math.exp(X)),
        ("pi + x", math.pi + X),
        ("x = y", X - Y),
        ("x^2 + y^2 = z", X * X + Y * Y - Z),
        ("x", X),
        ("w x", W * X),
        ("ln(z)", math.log(Z)),
        ("log(z)", math.log(Z)),
        ("arcsin(x)", math.asin(X)),
        ("sqr(y)", Y * Y),
        ("pow(z, x)", Z**X),
        ("pow(y, 3)", Y**3),
        ("hypot(x, y)", math.hypot(X, Y)),
        ("min(x, y, z)", Y),
        ("max(x, y, z, 9)", 9),
        ("mod(y, 1)", Y % 1),
        ("floor(y)", -2),
        ("ceil(y)", -1),
        ("sec(x)", 1 / math.cos(X)),
        ("csc(x)", 1 / math.sin(X)),
        ("cot(x)", 1 / math.tan(X)),
        ("sgn(y)", -1),
        ("sign(x)", 1),
        ("cbrt(y)", -((-Y) ** (1 / 3))),
        ("atan2(y, x)", math.atan2(Y, X)),
        ("log2(z)", math.log2(Z)),
        ("log10(z)", math.log10(Z)),
        ("exp2(y)", 2**Y),
        ("asinh(y)", math.asinh(Y)),
        ("acosh(z)", math.acosh(Z)),
        ("atanh(x)", math.atanh(X)),
        ("x^(1/3)", X ** (1 / 3)),
        ("z^1.5", Z**1.5),
        ("z^y", Z**Y),
        ("if(x < 1, y, z)", Y),
        ("if(x > 1, y, z)", Z),
        ("if(x <= y, 1, 2) x", 2 * X),
        ("if(x ≥ y, 1, 2) x", X),
        ("if(x ≤ y, 1, 2) x", 2 * X),
        ("if(0 < x < 1, y, z)", Y),
        ("if(0 < x < 0.5, y, z)", Z),
        ("if(x < 1 and y > 0, x, z)", Z),
        ("if(x < 1 or y > 0, x, z)", X),
        ("if(not (x < 1 or y > 0), x, z)", Z),
        ("if((x < 1), y, z)", Y),
        ("if(x > 1 or x > 0 and y < 0, 1, 2)x", X),
        ("sum(i, r[i] x)", sum(R) * X),
        ("sum(i, (x - r[i])^2 s[i])", sum((X - r) ** 2 * s for r, s in zip(R, S, strict=True))),
        ("sum(i, sum(j, r[i]*s[j]*x))", sum(R) * sum(S) * X),
        ("sum(i, r[i]) + sum(i, s[i]) + x", sum(R) + sum(S) + X),
        ("sum(i, r[i]*sum(i, s[i]))x", sum(R) * sum(S) * X),
        ("sum(i, 0*r[i] + s[i])x", sum(S) * X),
        ("sum(i, r[i]^0)x", 3 * X),
        ("sum(i, sum(j, 2 + 0*r[i] s[j]))x", 18 * X),
        ("x\n+\ty", X + Y),
    ],
)
def test_the_language(text, value, at):
    f = parse(text, params=["a", "b"], arrays=["r", "s"])
    assert at(f, **POINT) == pytest.approx(value, rel=1e-13)


def test_decimals_are_exact():
    assert parse("0.1x") is parse("x/10")
    assert parse("2e-3x") is parse("x/500")


def test_parameters_win_over_constants_but_not_over_functions():
    assert parse("e*x", params=["e"]).parameters == {"e"}
    assert parse("φx", params=["phi"]).parameters == {"phi"}
    assert parse("pi x").parameters == frozenset()
    assert parse("T + T(2, x)", params=["T"]).parameters == {"T"}
    assert parse("xy + z", params=["xy"]).variables == {"z"}
    assert parse("not x", params=["not"]).parameters == {"not"}


def test_letters_of_other_scripts_are_names():
    assert parse("α x + größe", params=["α", "größe"]).parameters == {"α", "größe"}


def test_open_takes_unknown_names_for_parameters():
    f = parse("foo*x + b(y+1) - sum(i, q[i])", open=True)
    assert f.parameters == {"foo", "b"}
    assert f.arrays == {"q"}
    with pytest.raises(UnknownNameError):
        parse("foo(x)", open=True)


@pytest.mark.parametrize("name", [*FUNCTIONS, *DERIVED])
def test_every_function_of_the_table_can_be_called(name, at):
    arity = FUNCTIONS[name].arity if name in FUNCTIONS else DERIVED[name].arity
    arguments = {"if": "x < 1, x, y", "T": "3, x"}.get(name, ", ".join("xyz"[:arity]))
    assert parse(f"{name}({arguments}) + z").variables >= {"x", "z"}


@pytest.mark.parametrize("order", [*range(33), 47, 64, 97, 127, 256, 509, 512])
def test_chebyshev(order, at):
    f = parse(f"T({order}, x) + y")
    for x in (-1.0, -0.8, -0.1, 0.0, 0.3, 0.99, 1.0):
        assert at(f, x=x, y=0.0) == pytest.approx(math.cos(order * math.acos(x)), abs=1e-16 * max(64, order**2))
    if order < 40:
        assert at(f, x=1.5, y=0.0) == pytest.approx(math.cosh(order * math.acosh(1.5)), rel=1e-12)


BAD = [
    ("", 0, "empty"),
    ("   ", 0, "empty"),
    ("x+", 2, "missing"),
    ("x + ", 3, "missing"),
    ("x+*y", 2, "missing"),
    ("*x", 0, "missing"),
    ("(x+1", 0, "never closed"),
    ("sin(cos(x)", 3, "never closed"),
    ("x+1)", 3, "closes nothing"),
    ("x+1]", 3, "closes nothing"),
    ("|x+1", 0, "never closed"),
    ("|x|y||", 6, "missing"),
    ("(|x)", 3, "before the |"),
    ("(x]", 2, "before the ("),
    ("x2+1", 0, "unknown name x2"),
    ("x 2", 2, "follows a value"),
    ("(x)2", 3, "follows a value"),
    ("2 3x", 2, "follows a value"),
    ("1.2.3x", 3, "follows"),
    ("sin x", 0, "no argument"),
    ("2sin^2(x)", 1, "no argument"),
    ("x + sin", 4, "no argument"),
    ("xsin(y)", 0, "unknown function"),
    ("1 + foo(x)", 4, "unknown function"),
    ("x + a", 4, "unknown name a"),
    ("axy", 0, "unknown name"),
    ("X + y", 0, "unknown name X"),
    ("x%2", 1, "character %"),
    ("x!", 1, "character !"),
    ("x & y", 2, "character &"),
    ("{x}", 0, "character {"),
    ("x;y", 1, "character ;"),
    ("x..2", 1, "character ."),
    ("∂x", 0, "character ∂"),
    ("x\x00", 1, "U+0000"),
    ("x[1]", 2, "index"),
    ("(x)[1]", 3, "character ["),
    ("x==1", 2, "missing"),
    ("x=1=2", 3, "second ="),
    ("(x=1)", 2, "inside brackets"),
    ("=x", 0, "missing"),
    ("x=", 2, "missing"),
    ("x<1", 1, "inequality"),
    ("x <= 1", 2, "inequality"),
    ("0 < x < 1", 2, "inequality"),
    ("x<=>1", 3, "missing"),
    ("x + min(x)", 4, "2 arguments or more"),
    ("sin(x,y)", 0, "one argument"),
    ("if(x<1,2)", 0, "3 arguments"),
    ("sin()", 4, "nothing between"),
    ("x,y", 1, "comma"),
    ("1,5x", 1, "comma"),
    ("(x,y)", 2, "comma"),
    ("min(x,,y)", 6, "missing"),
    ("min(x,)", 6, "missing"),
    ("x + sqrt(-1)", 4, "sqrt is undefined at (-1)"),
    ("x/0", 1, "zero"),
    ("x/(1-1)", 1, "zero"),
    ("log(-pi)+x", 0, "undefined"),
    ("x + tan(pi/2)", 4, "zero"),
    ("asin(2)x", 0, "asin"),
    ("x + (-8)^(1/3)", 8, "real power"),
    ("(-2)^x", 4, "negative constant"),
    ("T(x,2)", 0, "order"),
    ("T(1.5,x)", 0, "order"),
    ("T(-1,x)", 0, "order"),
    ("1+2", 0, "none of the variables"),
    ("e+pi", 0, "none of"),
    ("x - x", 0, "none of"),
    ("x + r[i]", 6, "no sum"),
    ("sum(i,x)", 0, "no array"),
    ("sum(x,r[x])", 4, "variable"),
    ("sum(2,x)", 4, "index"),
    ("r[0]+x", 2, "index"),
    ("sum(i,r[i]*i)", 11, "unknown name i"),
    ("q[i]", 0, "not an array"),
    ("r + x", 0, "unknown name r"),
    ("(x<1)+2", 5, "condition stands"),
    ("if(x,1,2)", 0, "number stands"),
    ("x and y", 2, "number stands"),
    ("not", 3, "missing"),
    ("and x", 0, "missing"),
    ("x^^2", 2, "missing"),
    ("2**", 3, "missing"),
    ("x < y < z + 1 < 2", 2, "inequality"),
    ("x not y", 2, "cannot stand"),
    ("exp(1000)x", 0, "range"),
]


@pytest.mark.parametrize(("text", "position", "message"), BAD)
def test_bad_input_names_the_place_and_the_cure(text, position, message):
    with pytest.raises(FormulaError) as caught:
        parse(text, arrays=["r"])
    error = caught.value
    assert message in error.message
    assert error.position == position
    assert error.hints
    shown = str(error).splitlines()
    # Nothing has no place.
    assert not text.strip() or shown[2].index("^") == 2 + position
    assert "\n" not in error.message


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("x2", "x^2"),
        ("xsin(y)", "x*sin"),
        ("sinn(x)", "sin"),
        ("2sin^2(x)", "sin(x)^2"),
        ("a*x", "params={'a': 1.0}"),
        ("foo", "params={'foo': 1.0}"),
        ("x==1", "single ="),
        ("x%2", "mod(x, y)"),
        ("x^^2", "**"),
        ("1,5x", "0.5"),
        ("bx", "b*x"),
        ("pix", "pi*x"),
        ("X", "did you mean x"),
        ("alpah*x", "did you mean alpha"),
        ("sum(i,r[i]*i)", "r[i]"),
        ("x\\y", "LaTeX"),
        ("(-8)^(1/3)x", "cbrt"),
        ("1/0x", "zero"),
    ],
)
def test_the_likely_cure_is_among_the_hints(text, hint):
    with pytest.raises(FormulaError) as caught:
        parse(text, params=["b", "alpha"], arrays=["r"])
    assert any(hint in line for line in caught.value.hints)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("(" * 100_000 + "x" + ")" * 100_000, "characters"),
        ("(" * 40_000 + "x" + ")" * 40_000, "nested too deeply"),
        ("|" * 40_000 + "x" + "|" * 40_000, "nested too deeply"),
        ("sin(" * 1_001 + "x" + ")" * 1_001, "nested too deeply"),
        ("(" * 90_000, "nested too deeply"),
        ("+".join(["x"] * 1_000_000), "characters"),
        ("+".join(f"T(509,x+{i})" for i in range(5_000)), "distinct operations"),
        ("9" * 2_000 + "x", "too long"),
        ("1e999999999x", "too long"),
        ("x^(10^9)", "too large"),
        ("2^10^10 x", "too large"),
        ("9^9^9^9 x", "too large"),
        ("x²²²²²²²²²²²²²²²²²²²²²²²²", "too large"),
        ("T(513, x)", "order"),
        ("1e400 x", "range"),
        ("sum(i, " * 9 + "r[i]x" + ")" * 9, "sums"),
        ("*".join(["x"] * 5_000), "too large"),
    ],
)
def test_limits_are_errors(text, message):
    with pytest.raises(FormulaLimitError, match=message):
        parse(text, arrays=["r"])


def test_too_many_operations_are_an_error(monkeypatch):
    monkeypatch.setattr(limits, "NODES", 50)
    assert parse("+".join(f"sin({i}x)" for i in range(1, 10))).size < 50
    with pytest.raises(FormulaLimitError, match="distinct operations"):
        parse("+".join(f"sin({i}x)" for i in range(1, 30)))


def test_long_and_deep_formulas_within_the_limits():
    assert parse("(" * 999 + "x" + ")" * 999) is variable("x")
    assert parse("-" * 20_001 + "x") is -variable("x")
    assert parse("+".join(["x"] * 20_000)) is 20_000 * variable("x")
    assert parse("x" + "^x" * 5_000).size == 5_001
    assert parse("+".join(f"{i}x^2 y" for i in range(1, 5_000))) is parse(f"{sum(range(5_000))} x^2 y")


@pytest.mark.parametrize("name", ["x", "w", "2a", "a b", "", "a-b"])
def test_names_that_no_parameter_can_have(name):
    with pytest.raises(ParameterError):
        parse("x", params=[name])
