from __future__ import annotations

import math
from fractions import Fraction

import flint
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from zeroset.errors import FormulaError, FormulaLimitError
from zeroset.expr import PI, constant, enclose, node, parse
from zeroset.expr.balls import Balls
from zeroset.expr.constants import check_constants
from zeroset.expr.decimals import Decimals
from zeroset.expr.series import SLACK, arctangent, pi, sine_cosine


@pytest.fixture(autouse=True)
def _precise():
    """Arb's precision is one for the whole process: other tests have theirs."""
    with flint.ctx.workprec(3_000):
        yield


def ball(value):
    """An Arb ball of a rational."""
    return flint.arb(flint.fmpq(value.numerator, value.denominator))


def holds(lo, hi, truth):
    return flint.arb(lo) <= truth <= flint.arb(hi)


def written(text):
    """The constant that a text means."""
    return parse(f"atan2(x, {text})").args[1]


ARB = {
    "sqrt": lambda a: a.sqrt(),
    "exp": lambda a: a.exp(),
    "log": lambda a: a.log(),
    "sin": lambda a: a.sin(),
    "cos": lambda a: a.cos(),
    "tan": lambda a: a.tan(),
    "asin": lambda a: a.asin(),
    "acos": lambda a: a.acos(),
    "atan": lambda a: a.atan(),
    "sinh": lambda a: a.sinh(),
    "cosh": lambda a: a.cosh(),
    "tanh": lambda a: a.tanh(),
    "cbrt": lambda a: a.root(3) if a > 0 else -(-a).root(3),
}
DOMAIN = {
    "sqrt": (0, None),
    "log": (0, None),
    "asin": (-1, 1),
    "acos": (-1, 1),
    "exp": (-700, 700),
    "sinh": (-700, 700),
    "cosh": (-700, 700),
}


@settings(max_examples=300, deadline=None, derandomize=True)
@given(op=st.sampled_from(sorted(ARB)), data=st.data())
def test_functions_of_rationals_hold_the_value_between_neighbouring_doubles(op, data):
    low, high = DOMAIN.get(op, (None, None))
    value = data.draw(st.one_of(st.fractions(low, high, max_denominator=1000), st.fractions(low, high)))
    if op == "log" and value == 0:
        value = Fraction(1, 7)
    lo, hi = enclose(node(op, (constant(value),)))
    truth = ARB[op](ball(value)) if not (op == "cbrt" and value == 0) else flint.arb(0)
    assert not (truth < flint.arb(lo))
    assert not (truth > flint.arb(hi))
    assert hi <= math.nextafter(math.nextafter(lo, math.inf), math.inf) or abs(lo) < 1e-40


@pytest.mark.parametrize(
    "value", ["1e30", "1e300", "355", "-1e18", "1e-30", "-1e-300", "3.14159265358979", "22/7", "1e999", "-1e999"]
)
@pytest.mark.parametrize("op", ["sin", "cos", "tan", "atan"])
def test_huge_and_tiny_arguments(op, value):
    exact = Fraction(value)
    lo, hi = enclose(node(op, (constant(exact),)))
    truth = ARB[op](ball(exact))
    assert not (truth < flint.arb(lo))
    assert not (truth > flint.arb(hi))
    assert hi - lo <= 2 * math.ulp(max(abs(lo), abs(hi)))


@pytest.mark.parametrize(
    ("text", "truth"),
    [
        ("pi", lambda: flint.arb.pi()),
        ("phi", lambda: (1 + flint.arb(5).sqrt()) / 2),
        ("e", lambda: flint.arb(1).exp()),
        ("2^pi", lambda: flint.arb(2) ** flint.arb.pi()),
        ("pi^0.3", lambda: flint.arb.pi() ** ball(Fraction(3, 10))),
        ("5^(3/7)", lambda: flint.arb(5) ** ball(Fraction(3, 7))),
        ("sqrt(2)*sqrt(3) - sqrt(6) + 1", lambda: flint.arb(1)),
        ("(1+phi)^4096/10^1700", lambda: ((3 + flint.arb(5).sqrt()) / 2) ** 4096 / flint.arb(10) ** 1700),
        ("atan2(1, -2)", lambda: flint.arb.pi() - ball(Fraction(1, 2)).atan()),
        ("atan2(-1, -2)", lambda: ball(Fraction(1, 2)).atan() - flint.arb.pi()),
        ("atan2(0, -1)", lambda: flint.arb.pi()),
        ("atan2(3, 0)", lambda: flint.arb.pi() / 2),
        ("atan2(-3, 0)", lambda: -flint.arb.pi() / 2),
        ("atan2(1, 2)", lambda: ball(Fraction(1, 2)).atan()),
        ("mod(pi, 1)", lambda: flint.arb.pi() - 3),
        ("mod(-pi, 2)", lambda: 4 - flint.arb.pi()),
        ("floor(10 pi)", lambda: flint.arb(31)),
        ("ceil(-10 pi)", lambda: flint.arb(-31)),
        ("sign(-pi)", lambda: flint.arb(-1)),
        ("|1 - pi|", lambda: flint.arb.pi() - 1),
        ("min(pi, e)", lambda: flint.arb(1).exp()),
        ("max(pi, e)", lambda: flint.arb.pi()),
        ("if(pi < e, 1, 2)", lambda: flint.arb(2)),
        ("if(not pi <= e and e < 3, pi, 2)", lambda: flint.arb.pi()),
        ("if(pi < e or pi < 3, 1, 2)", lambda: flint.arb(2)),
        ("(1-pi)^3", lambda: (1 - flint.arb.pi()) ** 3),
        ("(1-pi)^6", lambda: (1 - flint.arb.pi()) ** 6),
        ("tanh(300)", lambda: flint.arb(300).tanh()),
        ("tanh(-9999)", lambda: flint.arb(-9999).tanh()),
        ("exp(-2000)", lambda: flint.arb(-2000).exp()),
        ("sinh(1e-30)", lambda: ball(Fraction(1, 10**30)).sinh()),
        ("exp(1e-40) - 1", lambda: ball(Fraction(1, 10**40)).exp() - 1),
        ("log(1 + 1e-90)", lambda: (1 + ball(Fraction(1, 10**90))).log()),
    ],
)
def test_constants_against_arb(text, truth):
    lo, hi = enclose(written(text))
    value = truth()
    assert not (value < flint.arb(lo))
    assert not (value > flint.arb(hi))
    assert hi <= math.nextafter(math.nextafter(lo, math.inf), math.inf)


@pytest.mark.parametrize("value", [0, 1, -3, Fraction(1, 2), Fraction(0.1), 2**80, Fraction(5, 2**1000)])
def test_doubles_are_exact(value):
    lo, hi = enclose(constant(value))
    assert lo == hi == value


@pytest.mark.parametrize("value", [Fraction(1, 3), Fraction(-1, 10), 2**80 + 1, Fraction(1, 3**800)])
def test_other_rationals_lie_between_neighbours(value):
    lo, hi = enclose(constant(value))
    assert Fraction(lo) < value < Fraction(hi)
    assert math.nextafter(lo, math.inf) == hi


@pytest.mark.parametrize(
    "text",
    [
        "sqrt(-pi)",
        "log(3 - pi)",
        "log(sqrt(2)-sqrt(2))",
        "asin(pi)",
        "acos(-pi)",
        "(1-pi)^0.5",
        "1/(sqrt(2)*sqrt(3)-sqrt(6))",
        "atan2(pi - pi, sqrt(2) - sqrt(2))",
        "tan(pi/2)",
        "(1-pi)^pi",
        "mod(1, pi-pi)",
    ],
)
def test_undefined_constants_are_errors(text):
    with pytest.raises(FormulaError):
        enclose(written(text))


@pytest.mark.parametrize(
    "text", ["exp(1000)", "10^400", "-(10^309)", "pi^4000", "exp(exp(20))", "cosh(800)", "exp(exp(exp(10)))"]
)
def test_constants_beyond_doubles_are_errors(text):
    with pytest.raises(FormulaLimitError):
        parse(f"x + {text}")


def test_every_constant_of_a_formula_is_checked():
    f = node("add", (node("variable", (), ("x",)), node("log", (node("neg", (PI,)),))))
    with pytest.raises(FormulaError):
        check_constants([f])


@pytest.mark.parametrize("digits", [20, 50, 131, 400])
def test_series_stay_within_their_slack(digits):
    def near(fixed, truth):
        error = abs(flint.arb(fixed) / flint.arb(10) ** digits - truth) * flint.arb(10) ** digits
        return error < SLACK / 50

    assert near(pi(digits), flint.arb.pi())
    for value in (
        Fraction(0),
        Fraction(1, 7),
        Fraction(-3, 2),
        Fraction(157, 100),
        Fraction(10**9 + 7, 3),
        Fraction(10**25),
        Fraction(1, 10**15),
    ):
        fixed = value.numerator * 10**digits // value.denominator
        exact = flint.arb(fixed) / flint.arb(10) ** digits
        sine, cosine = sine_cosine(fixed, digits)
        assert near(sine, exact.sin())
        assert near(cosine, exact.cos())
        assert near(arctangent(fixed, digits), exact.atan())


@settings(max_examples=200, deadline=None, derandomize=True)
@given(a=st.fractions(-9, 9), b=st.fractions(-9, 9), n=st.integers(2, 9))
def test_ball_arithmetic_holds_the_rationals(a, b, n):
    balls = Balls(6)
    x, y = balls.const(a), balls.const(b)

    def inside(ball_, value):
        return Fraction(ball_.lo) <= value <= Fraction(ball_.hi)

    assert inside(balls.add(x, y), a + b)
    assert inside(balls.sub(x, y), a - b)
    assert inside(balls.mul(x, y), a * b)
    assert inside(balls.powi(x, n), a**n)
    assert inside(balls.sqr(x), a * a)
    assert inside(balls.abs(x), abs(a))
    if b:
        assert inside(balls.div(x, y), a / b)
    wide = balls.add(x, balls.const(0))._replace(hi=x.hi + 2)
    assert inside(balls.powi(wide, n), (a + 1) ** n)


def test_wide_balls_give_the_range():
    balls = Decimals(10)
    one = balls.const(Fraction(1))
    wide = one._replace(lo=-one.hi * 5)
    assert balls.sin(wide) == (-1, 1)
    assert balls.select(None, one, wide) == wide
    assert balls.lt(wide, one) is None
    assert balls.le(one, wide) is None
    assert balls.and_(None, True) is None
    assert balls.and_(None, False) is False
    assert balls.or_(None, True) is True
    assert balls.or_(None, False) is None
    assert balls.not_(None) is None
