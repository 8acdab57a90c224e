"""Random formulas: rewriting keeps function and domain, text comes back as the same node."""

from __future__ import annotations

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from zeroset.errors import FormulaError
from zeroset.expr import enclose, parse, postorder, rewrite, text
from zeroset.expr.build import shared

MANY = settings(
    max_examples=150,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.too_slow],
)


def _rewritten(raw):
    try:
        return rewrite(raw)
    except FormulaError:
        assume(False)


@MANY
@given(data=st.data())
def test_rewriting_keeps_the_function_and_its_domain(data, raw_formulas, points, exactly_at, irrational):
    raw = data.draw(raw_formulas)
    rewritten = _rewritten(raw)
    for _ in range(5):
        point = data.draw(points)
        try:
            before, after = exactly_at(raw, point), exactly_at(rewritten, point)
        except irrational:
            continue
        assert before == after, (raw, rewritten, point)


@MANY
@given(data=st.data())
def test_rewriting_twice_is_rewriting_once(data, raw_formulas):
    once = _rewritten(data.draw(raw_formulas))
    assert rewrite(once) is once


@MANY
@given(data=st.data())
def test_text_parses_back_to_the_same_node(data, raw_formulas):
    expr = _rewritten(data.draw(raw_formulas))
    assume(expr.variables)
    try:
        expr = shared(expr)
        again = parse(text(expr), params=["a", "b"])
    except FormulaError:
        for part in postorder(expr):
            if part.is_constant and not part.is_condition:
                try:
                    enclose(part)
                except FormulaError:
                    assume(False)
        raise
    assert again is expr


_PIECES = st.sampled_from(
    [
        *"xyzwae0123().,+-*/^|=<>[]i² √π&%\n",
        "sin",
        "sin(",
        "if(",
        "sum(i,",
        "r[i]",
        "min(",
        "T(3,",
        " and ",
        "not ",
        "1e9",
        "<=",
    ]
)


@settings(max_examples=600, deadline=None, derandomize=True)
@given(pieces=st.lists(_PIECES, max_size=14))
def test_any_text_is_a_formula_or_an_error_with_a_place(pieces):
    written = "".join(pieces)
    expr, error = _read(written)
    if error is None:
        assert parse(text(expr), params=["a"], arrays=["r"]) is expr
    else:
        assert error.text == written
        assert error.position is not None
        assert 0 <= error.position <= len(written)
        assert error.hints


def _read(written):
    try:
        return parse(written, params=["a"], arrays=["r"]), None
    except FormulaError as error:
        return None, error
