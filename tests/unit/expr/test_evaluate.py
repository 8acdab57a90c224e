from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from zeroset.errors import FormulaError
from zeroset.expr import OPS, build, evaluate, node, parse, rewrite, sum_over, variable


class Tracer:
    """A number that only writes down what is done with it."""

    def __init__(self, log, name):
        self.log = log
        self.name = name

    def __getattr__(self, method):
        if method not in {row.method for row in OPS.values()}:
            raise AttributeError(method)

        def call(*others):
            names = ", ".join(getattr(other, "name", str(other)) for other in others)
            self.log.append(f"{self.name}.{method}({names})")
            return Tracer(self.log, f"t{len(self.log)}")

        return call


class Recorder:
    """System and environment of tracers."""

    def __init__(self):
        self.log = []

    def constant(self, lo, hi):
        self.log.append(f"constant({lo!r}, {hi!r})")
        return Tracer(self.log, f"c{len(self.log)}")

    def variable(self, name):
        self.log.append(f"variable {name}")
        return Tracer(self.log, name)

    def parameter(self, name):
        self.log.append(f"parameter {name}")
        return Tracer(self.log, name)

    def sum(self, system, arrays, body):
        assert system is self
        self.log.append(f"sum over {', '.join(arrays)} {{")
        total = body({name: Tracer(self.log, f"{name}_i") for name in arrays})
        self.log.append(f"}} {total.name}")
        return Tracer(self.log, f"sum{len(self.log)}")


def trace(text, **options):
    recorder = Recorder()
    f = parse(text, **options) if isinstance(text, str) else text
    evaluate(f, recorder, recorder)
    return recorder.log


def test_each_node_is_evaluated_once_arguments_first():
    assert trace("sin(x*y) + cos(x*y)") == [
        "variable x",
        "variable y",
        "x.mul(y)",
        "t3.sin()",
        "t3.cos()",
        "t4.add(t5)",
    ]


def test_constants_are_enclosed_as_whole_subtrees():
    assert trace("(1 + sqrt(5))/2 * x") == trace("phi*x")
    assert trace("phi*x") == ["constant(1.6180339887498947, 1.618033988749895)", "variable x", "c1.mul(x)"]
    log = trace("2 pi sqrt(7) x + 0.5")
    assert [line for line in log if line.startswith("constant")][1:] == ["constant(0.5, 0.5)"]
    assert sum(line.startswith("constant") for line in log) == 2


def test_methods_get_what_they_need_besides_numbers():
    assert "x.powi(5)" in trace("x^5")
    assert "x.powr((5, 2))" in trace("x^2.5")
    assert any(line.startswith("x.pow(y") for line in trace("x^y"))
    assert "x.atan2(y)" in trace("atan2(x, y)")


def test_conditions():
    log = trace("if(x < 1 and not (y <= 2 or z < 3), x, y)")
    assert any(".and_(" in line for line in log)
    assert any(".or_(" in line for line in log) or any(".not_(" in line for line in log)
    assert any(".select(x, y)" in line for line in log)


def test_a_condition_between_constants_is_compared_by_the_system():
    log = trace("if(pi < e, x, y)")
    assert any(".lt(" in line for line in log)


def test_what_needs_no_index_is_evaluated_once_before_the_sum():
    log = trace("sum(i, sin(x)*r[i] + a)", params=["a"], arrays=["r"])
    start = log.index("sum over r {")
    assert log[:start] == ["variable x", "x.sin()", "parameter a"]
    assert log[start + 1 :] == ["t2.mul(r_i)", "t5.add(a)", "} t6"]


def test_parts_shared_between_a_sum_and_its_outside_are_evaluated_once():
    log = trace("sin(x) + sum(i, sin(x)*r[i])", arrays=["r"])
    assert log.count("x.sin()") == 1


def test_parts_of_a_sum_do_not_leak_out():
    # The same element of the same array under two sums is two numbers.
    log = trace("sum(i, sin(r[i])*x) + sum(i, sin(r[i])*y)", arrays=["r"])
    assert log.count("r_i.sin()") == 2


def test_nested_sums_hoist_to_the_right_depth():
    f = parse("sum(i, sum(j, sin(r[i])*cos(s[j])*exp(x)))", arrays=["r", "s"])
    log = trace(f)
    outer, inner = log.index("sum over r {"), log.index("sum over s {")
    assert log.index("x.exp()") < outer
    assert outer < log.index("r_i.sin()") < inner
    assert inner < log.index("s_i.cos()")


def test_a_sum_that_needs_no_outer_index_moves_out_of_the_outer_sum():
    log = trace("sum(i, r[i]*x*sum(j, s[j]*y))", arrays=["r", "s"])
    assert log.index("sum over s {") < log.index("sum over r {")


def test_sums_over_several_arrays_and_without_elements(at):
    f = parse("sum(i, r[i]*s[i]) + x", arrays=["r", "s"])
    assert at(f, x=0.0, r=[1.0, 2.0], s=[3.0, 4.0]) == 11.0
    count = node("add", (node("sum", (node("const", (), (Fraction(1),)),), ("i", "r")), variable("x")))
    assert at(count, x=0.0, r=[5.0, 5.0, 5.0]) == 3.0


def test_the_index_of_an_inner_sum_hides_that_of_an_outer_one(at):
    # The innermost sum runs over r again, though r[i] of the outermost is known where it stands.
    element = node("element", (), ("r", "i"))
    other = node("element", (), ("s", "j"))
    part = build("sin", (element,))
    inner = sum_over("i", part * other)
    f = sum_over("i", sum_over("j", part * other * inner)) + variable("x")
    sines = math.fsum(math.sin(value) for value in (0.5, 1.5))
    expected = math.fsum(sines * s * sines * s for s in (2.0, 3.0))
    assert at(f, x=0.0, r=[0.5, 1.5], s=[2.0, 3.0]) == pytest.approx(expected, rel=1e-14)


def test_deep_formulas(at):
    f = variable("x")
    for _ in range(30_000):
        f = node("sin", (f,))
    assert 0 < at(f, x=1.0) < 0.02


@settings(max_examples=100, deadline=None, derandomize=True)
@given(data=st.data())
def test_rewritten_and_unrewritten_agree_on_floats(data, raw_formulas, points, at):
    raw = data.draw(raw_formulas)
    try:
        rewritten = rewrite(raw)
        point = {name: float(value) for name, value in data.draw(points).items()}
        before, after = at(raw, **point), at(rewritten, **point)
    except (FormulaError, OverflowError, TypeError):
        assume(False)
    steps = {"floor", "ceil", "mod", "sign", "select", "lt", "le", "tan"}
    assume(math.isfinite(before) and math.isfinite(after) and abs(before) < 1e6)
    assume(not any(part.op in steps for part in _parts(raw)))
    # Cancellation and square roots near zero magnify rounding, so agreement is loose: a wrong rule is far off.
    assert after == pytest.approx(before, rel=1e-4, abs=1e-4)


def _parts(expr):
    from zeroset.expr import postorder

    return postorder(expr)
