from __future__ import annotations

import functools
import math

import numpy as np
import pytest

from zeroset.errors import FormulaError, ParameterError
from zeroset.expr import OPS, parse, trace

POINT = {"x": 0.4, "y": 0.7, "z": 0.3, "w": 0.9}

FUNCTIONS = [
    lambda x, y, z: np.sin(x) * y + z**2 - 1,
    lambda x, y, z: np.where(x > y, x, np.where(y <= z, y, z - 1)),
    lambda x, y, z: np.maximum(np.minimum(x, y), np.clip(z, 0.35, 0.6)),
    lambda x, y, z: np.hypot(x, y) - np.square(z) + np.reciprocal(x) + np.cbrt(y),
    lambda x, y, z: np.power(x, y) + np.power(z, 3) + np.float_power(2, x),
    lambda x, y, z: np.exp(x) + np.log(y) + np.tan(z) + np.arctan2(y, x) + np.arcsin(z) + np.arccos(z) + np.arctan(x),
    lambda x, y, z: np.sinh(x) + np.cosh(y) - np.tanh(z) + np.abs(x - y) + np.fabs(x) + np.sign(x - y),
    lambda x, y, z: np.floor(9 * x) + np.ceil(9 * y) + np.mod(x, z) + np.remainder(x, y) + (x % z) + x // z + abs(-y),
    lambda x, y, z: np.log2(x) + np.log10(y) + np.exp2(z) + np.expm1(x) + np.log1p(y) + np.arcsinh(x) + np.arctanh(z),
    lambda x, y, z: np.arccosh(x + 2) + np.deg2rad(y) + np.positive(z) + np.negative(x) + np.floor_divide(y, z),
    lambda x, y, z: np.where((x > 0.1) & ~(y < z) | np.logical_and(x < y, z > 1), x, y),
    lambda x, y, z: np.where(np.logical_or(x > 1, np.less(y, z)), x, np.where(np.logical_not(x > 1), 5.0, z)),
    lambda x, y, z: (x < y) * 2.0 + np.greater(x, y) * z + np.where(np.greater_equal(z, 0.3), 1, 0) * y,
    lambda x, y, z: np.linalg.norm([x, y, z]) - 1,
    lambda x, y, z: np.dot([x, y, z], [z, 2 * x, 1]) + np.sum([x, y]) + sum((x - c) ** 2 for c in (0.5, 1.5)),
    lambda x, y, z: np.pi * x + np.float32(0.5) * y + np.int64(3) * z,
    lambda x, y, z, w: x * w + y - z,
    lambda a, b, c: a - b * c,
    lambda x, y, z: math.floor(9 * x) + math.ceil(9 * y) + z,
]


@pytest.mark.parametrize("function", FUNCTIONS)
def test_tracing_computes_what_the_function_does(function, at):
    count = function.__code__.co_argcount
    arguments = list(POINT.values())[:count]
    assert at(trace(function).expr, **POINT) == pytest.approx(float(function(*map(np.float64, arguments))), rel=1e-14)


def test_arguments_with_defaults_become_parameters(at):
    def f(x, y, z, a=2, *, b=0.5):
        return a * x + b * y + z

    traced = trace(f)
    assert traced.params == {"a": 2, "b": 0.5}
    assert traced.expr.parameters == {"a", "b"}
    assert at(traced.expr, x=1.0, y=2.0, z=3.0, a=10.0, b=100.0) == 213.0


def test_callables_of_all_kinds():
    class Sphere:
        def __call__(self, x, y, z, r=1.5):
            return x**2 + y**2 + z**2 - r**2

        def method(self, x, y, z):
            return self(x, y, z)

    assert trace(Sphere()).params == {"r": 1.5}
    assert trace(Sphere().method).expr is parse("x^2 + y^2 + z^2 - 2.25")
    assert trace(functools.partial(Sphere(), r=2.0)).params == {"r": 2.0}
    assert trace(lambda *v: v[0] + v[2]).expr is parse("x + z")


def test_the_trace_is_the_parsed_formula():
    assert trace(lambda x, y, z: (x + y) ** 2 * (y + x)).expr is parse("(x+y)^2 (y+x)")


def test_every_ufunc_of_the_table_is_a_numpy_ufunc():
    for row in OPS.values():
        for name in row.ufuncs:
            if name not in {"acos", "asin", "atan", "atan2"} or hasattr(np, name):
                assert isinstance(getattr(np, name), np.ufunc), name


@pytest.mark.parametrize(
    ("function", "message", "hint"),
    [
        (lambda x, y, z: x if x > 0 else y, "cannot decide", "np.where"),
        (lambda x, y, z: min(x, y), "cannot decide", "np.minimum"),
        (lambda x, y, z: x if 0 < x < 1 else y, "cannot decide", "&"),
        (lambda x, y, z: math.sin(x), "module `math`", "np.sin"),
        (lambda x, y: x, "2 arguments", "lambda x, y, z"),
        (lambda x, y, z, w, v: x, "5 arguments", "default"),
        (lambda x, y, z: x == 1, "returned bool", "l - r"),
        (lambda x, y, z: None, "returned NoneType", "return"),
        (lambda x, y, z: np.array([x, y]), "returned ndarray", "return"),
        (lambda x, y, z: x < 1, "inequality", "difference"),
        (lambda x, y, z: 3.0, "none of the variables", "x^2"),
        (lambda x, y, z: np.i0(x), "NumPy's i0", "elementary"),
        (lambda x, y, z: np.fmod(x, y), "NumPy's fmod", "mod"),
        (lambda x, y, z: np.piecewise(x, [x < 0], [1, 2]), "NumPy's piecewise", "where"),
        (lambda x, y, z: np.arange(3) * x, "array stands beside", "one by one"),
        (lambda x, y, z: np.sin(x, where=True), "called in a way", "np.sin(x)"),
        (lambda x, y, z: np.add.outer(x, y), "called in a way", "np.add(x)"),
        (lambda x, y, z: x * float("nan"), "not finite", ""),
        (lambda x, y, z: np.sqrt(-1.0 + 0 * x), "sqrt is undefined", "x >= 0"),
        (lambda x, y, z: x @ y, "TypeError", "operators"),
        (lambda x, y, z: x.real_part, "AttributeError", "operators"),
        (lambda x, y, z: 1 / 0, "ZeroDivisionError", "operators"),
        (lambda x, y, z: np.clip(x, "a", 2), "bounds", ""),
        (lambda x, y, z: x**5000, "too large", "exp"),
    ],
)
def test_what_cannot_be_traced_says_what_to_write(function, message, hint):
    with pytest.raises(FormulaError) as caught:
        trace(function)
    assert message in caught.value.message
    assert not hint or any(hint in line for line in caught.value.hints)


@pytest.mark.parametrize(
    "function",
    [lambda x, y, z, a="s": x, lambda x, y, z, a=True: x, lambda x, y=1, z=2: x, lambda x, y, z, *, a: x],
)
def test_parameters_need_numbers(function):
    with pytest.raises((ParameterError, FormulaError)):
        trace(function)
