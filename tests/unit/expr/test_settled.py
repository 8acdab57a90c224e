"""What parameters alone decide is taken out of formulas, and means the same."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from zeroset.errors import FormulaError
from zeroset.expr import Expr, build, constant, degree, enclose, parse, postorder, settled, text

NAMES = ["a", "b"]


def settled_text(formula: str) -> tuple[str, list[str]]:
    found = settled(parse(formula, NAMES, ["c"]))
    return text(found.expr), [text(part) for part in found.parts.values()]


@pytest.mark.parametrize(
    ("formula", "left", "parts"),
    [
        ("x^2 + y^2 = 1", "x^2 + y^2 - 1", []),
        ("a x + b y", "a*x + b*y", []),
        ("2 a x", "part 0*x", ["2*a"]),
        ("a (b x)", "part 0*x", ["a*b"]),
        ("(a x) (b y)", "part 0*(x*y)", ["a*b"]),
        ("x + a + y + b", "x + y + part 0", ["a + b"]),
        ("a - x - (b - y)", "y - x + part 0", ["a - b"]),
        ("3 - x - a", "part 0 - x", ["3 - a"]),
        ("sin(a) x + cos(w)", "part 0*x + part 1", ["sin(a)", "cos(w)"]),
        ("if(a < 2, x, y)", "if(a < 2, x, y)", []),
        ("if(a < 2, 1, 3) x", "part 0*x", ["if(a < 2, 1, 3)"]),
        ("sum(i, 2 a c[i] x)", "sum(i, part 0*(c[i]*x))", ["2*a"]),
    ],
)
def test_what_is_taken_out(formula: str, left: str, parts: list[str]) -> None:
    assert settled_text(formula) == (left, parts)


@pytest.mark.parametrize("formula", ["x/a", "sqrt(a) x", "log(a) + x", "x + tan(a)", "x mod(2, a)"])
def test_what_may_be_undefined_stays(formula: str) -> None:
    """Whether it has a value is the business of kernels, which then know what to make of it."""
    assert settled_text(formula)[1] == []


def test_a_part_keeps_its_sign() -> None:
    """A denominator that is known to be above 0 is no pole, whoever calculates it."""
    (part,) = [p for p in postorder(settled(parse("x/(a^2 + 1)", NAMES)).expr) if p.op == "parameter"]
    assert part.is_positive
    assert not settled(parse("x/(y^2 + (a - 1) + b)", NAMES)).expr.args[1].is_positive


def test_polynomials_stay_polynomials() -> None:
    assert degree(settled(parse("floor(2a) x^3 + sin(b) y", NAMES)).expr) == 3


def test_values_are_exact_or_between_neighbours() -> None:
    found = settled(parse("floor(2a) x + (a - b)^2 y + sin(a) z", NAMES))
    whole, square, sine = found.values({"a": 0.5, "b": 0.1}).values()
    assert whole == (1.0, 1.0)
    assert Fraction(square[0]) <= (Fraction(0.5) - Fraction(0.1)) ** 2 <= Fraction(square[1])
    assert pytest.approx(sine[0], abs=1e-15) == 0.479425538604203
    assert 0 < sine[1] - sine[0] <= 2**-53


def test_what_passes_the_largest_double_is_an_error() -> None:
    found = settled(parse("x - exp(exp(a))", NAMES))
    with pytest.raises(FormulaError):
        found.values({"a": 10.0})


def test_a_sum_of_very_many_terms_is_gathered_at_once() -> None:
    terms = " + ".join(f"{i} a x^{i}" for i in range(2, 1500))
    found = settled(parse(terms, NAMES))
    assert len(found.parts) == 1498


LEAVES = st.sampled_from(["x", "y", "a", "b", "w", "2", "3", "1/2"])
FORMULAS = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from([" + ", " - ", " * "]), inner).map(lambda t: f"({t[0]}{t[1]}{t[2]})"),
        inner.map(lambda f: f"(-{f})"),
        inner.map(lambda f: f"({f})^2"),
        inner.map(lambda f: f"floor({f})"),
        st.tuples(inner, inner).map(lambda t: f"max({t[0]}, {t[1]})"),
        inner.map(lambda f: f"({f})/(1 + ({f})^2)"),
    ),
    max_leaves=12,
)
NUMBERS = st.fractions(-4, 4, max_denominator=16)


def at(expr: Expr, values: dict[str, Fraction]) -> Expr:
    """A formula with numbers for its names."""
    known: dict[Expr, Expr] = {}
    for part in postorder(expr):
        if part.op in ("variable", "parameter"):
            known[part] = constant(values[str(part.data[0])])
        else:
            known[part] = build(part.op, tuple(known[arg] for arg in part.args), part.data)
    return known[expr]


@given(FORMULAS, st.tuples(*[NUMBERS] * 5))
def test_it_means_the_same(formula: str, numbers: tuple[Fraction, ...]) -> None:
    expr = parse(f"z + {formula}", NAMES)
    found = settled(expr)
    values = dict(zip(["x", "y", "a", "b", "w"], numbers, strict=True)) | {"z": Fraction(1, 3)}
    decided = {name: at(part, values) for name, part in found.parts.items()}
    exact = {name: part.data[0] for name, part in decided.items() if part.op == "const"}
    assert len(exact) == len(decided)
    assert at(found.expr, values | exact) is at(expr, values)
    floats = {name: float(value) for name, value in values.items()}
    if all(Fraction(floats[name]) == values[name] for name in ("a", "b", "w")):
        for name, (low, high) in found.values(floats).items():
            assert Fraction(low) <= exact[name] <= Fraction(high)
            assert (low, high) == enclose(decided[name])
