"""THE operator table: one row an operator, and everything else reads it.

The grammar takes its function names from here, tracing its NumPy functions, the SymPy reader its class
names, the printer its symbols, the rewriter its algebraic facts. A number system (`zeroset.arith`) has one
method for each row, named `Operator.method`, called as `args[0].method(*args[1:], *data)`.

A new operator needs: a row here; a method on every number system; an enclosure in `constants.py` (for
constants such as `sin(1)`). A function that is a combination of these rows belongs in `derived.py`.
"""

from __future__ import annotations

import math
import operator
from fractions import Fraction
from types import MappingProxyType
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

__all__ = ["FUNCTIONS", "OPS", "Data", "Kind", "Operator", "rational_root"]

Data = tuple[Fraction | int | str, ...]
"""What else an operator needs besides its arguments: a constant's value, a name, an exponent."""

Kind = Literal["leaf", "arithmetic", "function", "condition", "sum"]


class Operator(NamedTuple):
    """What is known about one operator.

    Attributes:
        name: Name of the operator in the DAG.
        arity: Number of argument nodes.
        kind: `leaf`; `arithmetic` (printed with a symbol of its own), `function` (printed as a call),
            `condition` (its value is a truth, not a number), `sum`.
        spellings: Names under which a formula may call it, the printed one first.
        ufuncs: Names of the NumPy ufuncs that mean it.
        sympy: Names of the SymPy classes that mean it.
        commutative: Whether its two arguments may be swapped.
        idempotent: Whether applying it twice is applying it once.
        parity: `odd` if f(-x) = -f(x), `even` if f(-x) = f(x).
        defined: Whether it is defined at given rational arguments; None for defined everywhere.
        sign: What is known of its value: `positive`, `nonnegative`, `magnitude` (not negative, and positive
            where its first argument is), or `kept` (that of its argument).
        exact: Folds rational arguments, or gives None where the value is irrational.
        values: Exact values at single rational points.
        jumps: Whether it is not continuous everywhere where it is defined.
    """

    name: str
    arity: int
    kind: Kind
    spellings: tuple[str, ...] = ()
    ufuncs: tuple[str, ...] = ()
    sympy: tuple[str, ...] = ()
    commutative: bool = False
    idempotent: bool = False
    parity: Literal["", "odd", "even"] = ""
    defined: Callable[..., bool] | None = None
    sign: Literal["", "positive", "nonnegative", "magnitude", "kept"] = ""
    exact: Callable[..., Fraction | None] | None = None
    values: Mapping[Fraction | int, int] = MappingProxyType({})
    jumps: bool = False

    @property
    def total(self) -> bool:
        """Whether it is defined for all real arguments."""
        return self.defined is None

    @property
    def method(self) -> str:
        """Name of the method of a number (or condition) that computes it."""
        return f"{self.name}_" if self.name in _KEYWORDS else self.name


_KEYWORDS = frozenset({"and", "or", "not"})


def rational_root(value: Fraction, degree: int) -> Fraction | None:
    """The rational x >= 0 with x**degree == value >= 0, or None where there is none."""
    above = _integer_root(value.numerator, degree)
    below = _integer_root(value.denominator, degree)
    return None if above is None or below is None else Fraction(above, below)


def _integer_root(value: int, degree: int) -> int | None:
    """The exact whole root of a non-negative integer, by Newton's iteration, or None."""
    if value < 2:
        return value
    if degree > value.bit_length():
        return None
    guess = 1 << -(-value.bit_length() // degree)
    while True:
        better = ((degree - 1) * guess + value // guess ** (degree - 1)) // degree
        if better >= guess:
            return guess if guess**degree == value else None
        guess = better


def _sqrt(value: Fraction) -> Fraction | None:
    return rational_root(value, 2)


def _cbrt(value: Fraction) -> Fraction | None:
    root = rational_root(abs(value), 3)
    return -root if root is not None and value < 0 else root


def _sign(value: Fraction) -> Fraction:
    return Fraction((value > 0) - (value < 0))


def _mod(value: Fraction, modulus: Fraction) -> Fraction:
    return value % modulus


def _floor(value: Fraction) -> Fraction:
    return Fraction(math.floor(value))


def _ceil(value: Fraction) -> Fraction:
    return Fraction(math.ceil(value))


def _not_negative(value: Fraction) -> bool:
    return value >= 0


def _within_one(value: Fraction) -> bool:
    return -1 <= value <= 1


def _almost_everywhere(value: Fraction) -> bool:
    """Defined at every rational, though not at every real: the poles of the tangent."""
    return True


def _rows() -> Iterator[Operator]:
    row = Operator
    # leaves; data: value (a Fraction, or "pi") / name / name / (array, index)
    yield row("const", 0, "leaf")
    yield row("variable", 0, "leaf")
    yield row("parameter", 0, "leaf")
    yield row("element", 0, "leaf")
    # arithmetic; data of powi: the exponent n >= 3; of powr: (p, q), the exponent p/q > 0 in lowest terms
    arithmetic: Kind = "arithmetic"
    yield row("add", 2, arithmetic, ufuncs=("add",), sympy=("Add",), commutative=True, exact=operator.add)
    yield row("sub", 2, arithmetic, ufuncs=("subtract",), exact=operator.sub)
    yield row("mul", 2, arithmetic, ufuncs=("multiply",), sympy=("Mul",), commutative=True, exact=operator.mul)
    yield row("div", 2, arithmetic, ufuncs=("divide", "true_divide"), defined=lambda x, y: y != 0)
    yield row("neg", 1, arithmetic, ufuncs=("negative",), parity="odd", exact=operator.neg)
    yield row("sqr", 1, arithmetic, ("sqr",), ("square",), parity="even", sign="magnitude")
    yield row("powi", 1, arithmetic)
    yield row(
        "pow",
        2,
        arithmetic,
        ("pow",),
        ("power", "float_power"),
        ("Pow",),
        defined=lambda x, y: x > 0 or (x == 0 and y > 0),
        sign="magnitude",
    )
    yield row("powr", 1, arithmetic, defined=_not_negative, sign="magnitude")
    # functions of one argument
    call: Kind = "function"
    yield row("cbrt", 1, call, ("cbrt",), ("cbrt",), parity="odd", sign="kept", exact=_cbrt)
    yield row("sqrt", 1, call, ("sqrt",), ("sqrt",), defined=_not_negative, sign="magnitude", exact=_sqrt)
    yield row("exp", 1, call, ("exp",), ("exp",), ("exp",), sign="positive", values={0: 1})
    yield row("log", 1, call, ("log", "ln"), ("log",), ("log",), defined=lambda x: x > 0, values={1: 0})
    yield row("sin", 1, call, ("sin",), ("sin",), ("sin",), parity="odd", values={0: 0})
    yield row("cos", 1, call, ("cos",), ("cos",), ("cos",), parity="even", values={0: 1})
    yield row("tan", 1, call, ("tan",), ("tan",), ("tan",), parity="odd", defined=_almost_everywhere, values={0: 0})
    yield row(
        "asin",
        1,
        call,
        ("asin", "arcsin"),
        ("arcsin", "asin"),
        ("asin",),
        parity="odd",
        defined=_within_one,
        sign="kept",
        values={0: 0},
    )
    yield row(
        "acos",
        1,
        call,
        ("acos", "arccos"),
        ("arccos", "acos"),
        ("acos",),
        defined=_within_one,
        sign="nonnegative",
        values={1: 0},
    )
    yield row(
        "atan", 1, call, ("atan", "arctan"), ("arctan", "atan"), ("atan",), parity="odd", sign="kept", values={0: 0}
    )
    yield row("sinh", 1, call, ("sinh",), ("sinh",), ("sinh",), parity="odd", sign="kept", values={0: 0})
    yield row("cosh", 1, call, ("cosh",), ("cosh",), ("cosh",), parity="even", sign="positive", values={0: 1})
    yield row("tanh", 1, call, ("tanh",), ("tanh",), ("tanh",), parity="odd", sign="kept", values={0: 0})
    yield row(
        "abs",
        1,
        call,
        ("abs",),
        ("absolute", "fabs"),
        ("Abs",),
        idempotent=True,
        parity="even",
        sign="magnitude",
        exact=abs,
    )
    yield row(
        "sign",
        1,
        call,
        ("sign", "sgn"),
        ("sign",),
        ("sign",),
        idempotent=True,
        parity="odd",
        sign="kept",
        exact=_sign,
        jumps=True,
    )
    yield row("floor", 1, call, ("floor",), ("floor",), ("floor",), idempotent=True, exact=_floor, jumps=True)
    yield row("ceil", 1, call, ("ceil", "ceiling"), ("ceil",), ("ceiling",), idempotent=True, exact=_ceil, jumps=True)
    # functions of two arguments; mod(x, y) = x - y*floor(x/y)
    yield row(
        "atan2",
        2,
        call,
        ("atan2", "arctan2"),
        ("arctan2", "atan2"),
        ("atan2",),
        defined=lambda y, x: x != 0 or y != 0,
        jumps=True,
    )
    yield row(
        "mod", 2, call, ("mod",), ("remainder", "mod"), ("Mod",), defined=lambda x, y: y != 0, exact=_mod, jumps=True
    )
    yield row("min", 2, call, ("min",), ("minimum", "fmin"), ("Min",), commutative=True, exact=min)
    yield row("max", 2, call, ("max",), ("maximum", "fmax"), ("Max",), commutative=True, exact=max)
    # conditions, and the choice between two numbers by one
    truth: Kind = "condition"
    yield row("lt", 2, truth, ufuncs=("less",), sympy=("StrictLessThan",))
    yield row("le", 2, truth, ufuncs=("less_equal",), sympy=("LessThan",))
    yield row("and", 2, truth, ufuncs=("logical_and", "bitwise_and"), sympy=("And",), commutative=True, idempotent=True)
    yield row("or", 2, truth, ufuncs=("logical_or", "bitwise_or"), sympy=("Or",), commutative=True, idempotent=True)
    yield row("not", 1, truth, ufuncs=("logical_not", "invert"), sympy=("Not",))
    yield row("select", 3, call, ("if",), jumps=True)
    # data: (index, *arrays)
    yield row("sum", 1, "sum", ("sum",))


OPS: dict[str, Operator] = {row.name: row for row in _rows()}
"""All operators by name."""

FUNCTIONS: dict[str, Operator] = {
    spelling: row for row in OPS.values() if row.kind != "sum" for spelling in row.spellings
}
"""The operators that a formula can call, by each of their spellings (`sum` has a syntax of its own)."""
