"""Number systems and random formulas for the tests of `zeroset.expr`."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import strategies as st

from zeroset.expr import Expr, constant, evaluate, node, variable
from zeroset.expr.ops import OPS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


class UndefinedError(Exception):
    """The formula is undefined at the point."""


class IrrationalError(Exception):
    """The value is defined, but is no rational."""


@dataclass(frozen=True)
class Exact:
    """A rational number with the table's operators, each checked against its domain."""

    value: Fraction

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name not in OPS:
            raise AttributeError(name)
        return lambda *others: self._apply(name, others)

    def _apply(self, op: str, others: tuple[Any, ...]) -> Any:
        values = (self.value, *(other.value for other in others if isinstance(other, Exact)))
        if op == "powi":
            return Exact(self.value ** others[0])
        if op == "powr":
            return self._real_power(Fraction(*others[0]))
        if op == "pow":
            return self._power(others[0].value)
        row = OPS[op]
        if row.defined is not None and not row.defined(*values):
            raise UndefinedError
        if op in {"sqr", "div", "lt", "le"}:
            return self._plain(op, values)
        if row.exact is not None:
            result = row.exact(*values)
        else:
            result = row.values.get(values[0]) if len(values) == 1 else None
        if result is None:
            raise IrrationalError
        return Exact(Fraction(result))

    def _plain(self, op: str, values: tuple[Fraction, ...]) -> Any:
        match op:
            case "sqr":
                return Exact(self.value**2)
            case "div":
                return Exact(values[0] / values[1])
            case "lt":
                return Truth(values[0] < values[1])
        return Truth(values[0] <= values[1])

    def _power(self, exponent: Fraction) -> Exact:
        if exponent.denominator == 1:
            if self.value == 0 and exponent < 0:
                raise UndefinedError
            return Exact(self.value**exponent.numerator)
        return self._real_power(exponent)

    def _real_power(self, exponent: Fraction) -> Exact:
        if self.value < 0 or (self.value == 0 and exponent < 0):
            raise UndefinedError
        if self.value in {0, 1}:
            return self
        raise IrrationalError


@dataclass(frozen=True)
class Truth:
    """A condition on rationals."""

    value: bool

    def and_(self, other: Truth) -> Truth:
        return Truth(self.value and other.value)

    def or_(self, other: Truth) -> Truth:
        return Truth(self.value or other.value)

    def not_(self) -> Truth:
        return Truth(not self.value)

    def select(self, then: Any, otherwise: Any) -> Any:
        return then if self.value else otherwise


class Real(float):
    """A float with the table's operators; NaN where undefined."""

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name not in OPS:
            raise AttributeError(name)
        return lambda *others: self._apply(name, others)

    def _apply(self, op: str, others: tuple[Any, ...]) -> Any:
        if op in {"lt", "le"}:
            return Truth(self < others[0] if op == "lt" else self <= others[0])
        try:
            return Real(_FLOATS[op](float(self), *others))
        except (ValueError, ZeroDivisionError, OverflowError):
            return Real(math.nan)


_FLOATS: dict[str, Callable[..., Any]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a: -a,
    "sqr": lambda a: a * a,
    "powi": lambda a, n: a**n,
    "pow": lambda a, b: math.pow(a, b) if a >= 0 else math.nan,
    "powr": lambda a, r: a ** (r[0] / r[1]) if a >= 0 else math.nan,
    "cbrt": math.cbrt,
    "abs": abs,
    "sign": lambda a: (a > 0) - (a < 0),
    "floor": math.floor,
    "ceil": math.ceil,
    "mod": lambda a, b: a - b * math.floor(a / b),
    "min": min,
    "max": max,
    **{
        name: getattr(math, name)
        for name in ["sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh"]
    },
}


class Reals:
    """The system and environment of floats."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self.values = values
        self.log: list[str] = []

    def constant(self, lo: float, hi: float) -> Real:
        return Real(lo if lo == hi else (lo + hi) / 2)

    def variable(self, name: str) -> Real:
        return Real(self.values[name])

    parameter = variable

    def sum(self, system: Any, arrays: tuple[str, ...], body: Callable[[Mapping[str, Real]], Real]) -> Real:
        self.log.append(f"sum over {', '.join(arrays)}")
        columns = [self.values[name] for name in arrays]
        terms = [body(dict(zip(arrays, map(Real, row), strict=True))) for row in zip(*columns, strict=True)]
        return Real(math.fsum(terms))


@pytest.fixture(scope="session")
def at() -> Callable[..., float]:
    """Evaluates a formula on floats: at(expr, x=1.0, r=[1.0, 2.0])."""
    return lambda expr, **values: float(evaluate(expr, *[Reals(values)] * 2))


@pytest.fixture(scope="session")
def exactly_at() -> Callable[[Expr, Mapping[str, Fraction]], Fraction | None]:
    """Evaluates a DAG in rationals, as it stands: None where undefined; IrrationalError where no rational."""

    def value(expr: Expr, point: Mapping[str, Fraction]) -> Fraction | None:
        try:
            return _exact_value(expr, point, {})
        except UndefinedError:
            return None

    return value


@pytest.fixture(scope="session")
def irrational() -> type[Exception]:
    return IrrationalError


def _exact_value(expr: Expr, point: Mapping[str, Fraction], done: dict[Expr, Any]) -> Any:
    """Recursive, node by node, choices lazily: written unlike `evaluate`, to check it and the rewriter."""

    def value(part: Expr) -> Any:
        if part not in done:
            done[part] = compute(part)
        return done[part]

    def compute(part: Expr) -> Any:
        if part.op == "const":
            if not isinstance(part.data[0], Fraction):
                raise IrrationalError
            return Exact(part.data[0])
        if part.op in {"variable", "parameter"}:
            return Exact(point[str(part.data[0])])
        if part.op == "select":
            return value(part.args[1] if value(part.args[0]).value else part.args[2])
        first, *rest = [value(arg) for arg in part.args]
        data = (part.data,) if part.op == "powr" else part.data
        return getattr(first, OPS[part.op].method)(*rest, *data)

    return value(expr).value


_NUMBERS = st.one_of(
    st.sampled_from([Fraction(0), Fraction(1), Fraction(-1), Fraction(2), Fraction(1, 2), Fraction(-2, 3)]),
    st.fractions(-9, 9, max_denominator=12),
)
_UNARY = [
    "neg",
    "sqr",
    "cbrt",
    "sqrt",
    "exp",
    "log",
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "sinh",
    "cosh",
    "tanh",
    "abs",
    "sign",
    "floor",
    "ceil",
]
_BINARY = ["add", "sub", "mul", "div", "min", "max", "mod", "atan2", "pow"]


def _leaves() -> st.SearchStrategy[Expr]:
    return st.one_of(
        st.sampled_from([variable(name) for name in "xyzw"]),
        st.sampled_from([node("parameter", (), ("a",)), node("parameter", (), ("b",))]),
        _NUMBERS.map(constant),
        st.just(node("const", (), ("pi",))),
    )


def _branches(parts: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
    comparisons = st.builds(lambda op, a, b: node(op, (a, b)), st.sampled_from(["lt", "le"]), parts, parts)
    conditions = st.one_of(
        comparisons,
        st.builds(lambda op, a, b: node(op, (a, b)), st.sampled_from(["and", "or"]), comparisons, comparisons),
        comparisons.map(lambda a: node("not", (a,))),
    )
    return st.one_of(
        st.builds(lambda op, a: node(op, (a,)), st.sampled_from(_UNARY), parts),
        st.builds(lambda op, a, b: node(op, (a, b)), st.sampled_from(_BINARY), parts, parts),
        st.builds(lambda op, a, b: node(op, (a, b)), st.sampled_from(["add", "sub", "mul", "div"]), parts, parts),
        st.builds(lambda a, n: node("powi", (a,), (n,)), parts, st.integers(2, 6)),
        st.builds(
            lambda a, r: node("powr", (a,), (r.numerator, r.denominator)),
            parts,
            st.sampled_from([Fraction(1, 3), Fraction(3, 2), Fraction(2, 3), Fraction(7, 4)]),
        ),
        st.builds(lambda c, a, b: node("select", (c, a, b)), conditions, parts, parts),
    )


RAW = st.recursive(_leaves(), _branches, max_leaves=12)


@pytest.fixture(scope="session")
def raw_formulas() -> st.SearchStrategy[Expr]:
    """DAGs as they come, without any rewriting."""
    return RAW


@pytest.fixture(scope="session")
def points() -> st.SearchStrategy[dict[str, Fraction]]:
    """Rational values for the variables and for the parameters a and b, often zero or equal."""
    return st.fixed_dictionaries(dict.fromkeys("xyzwab", _NUMBERS))
