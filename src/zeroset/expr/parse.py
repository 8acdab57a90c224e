"""The text of a formula becomes its DAG: one action for each named alternative of `grammar.lark`."""

from __future__ import annotations

import unicodedata
from fractions import Fraction
from typing import TYPE_CHECKING

from zeroset.errors import FormulaError, FormulaLimitError
from zeroset.expr import limits
from zeroset.expr.build import build, sum_over
from zeroset.expr.complaints import unexpected
from zeroset.expr.constants import enclose
from zeroset.expr.dag import Expr, constant, made_so_far, rational
from zeroset.expr.derived import DERIVED
from zeroset.expr.grammar import Token, run, tables
from zeroset.expr.names import VARIABLES, Names
from zeroset.expr.ops import FUNCTIONS
from zeroset.expr.tokens import tokens
from zeroset.expr.whole import whole

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

__all__ = ["parse"]

_BINARY = {"ADD": "add", "SUB": "sub", "MUL": "mul", "DIV": "div", "JUX": "mul", "POW": "pow"}
_COMPARE = {"<": "lt", "<=": "le", "≤": "le", ">": "lt", ">=": "le", "≥": "le"}
_DIGITS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
_NARY = frozenset({"min", "max"})


def parse(text: str, params: Collection[str] = (), arrays: Collection[str] = (), open: bool = False) -> Expr:
    """The DAG of a formula f (meaning f = 0) or an equation l = r (meaning l - r = 0).

    Args:
        text: The formula; the language is described in the user guide.
        params: Names of its scalar parameters.
        arrays: Names of its array parameters, used as `r[i]` inside `sum(i, ...)`.
        open: Whether unknown names become parameters instead of errors.

    Raises:
        FormulaError: The text is no formula; the error shows the place and the cure.
        UnknownNameError: A name means nothing.
        FormulaLimitError: A limit of `zeroset.expr.limits` is passed.
        ParameterError: A parameter has a name that no formula can use.

    Example:
        >>> print(parse("2x(x+y) = a", params=["a"]))
        2*x*(x + y) - a
    """
    names = Names(text, params, arrays, open)
    actions = _Actions(names)
    try:
        expr = run(tables(), tokens(text, names), actions.table(), lambda token: unexpected(text, token))
        return _finished(expr, actions)
    except FormulaError as error:
        if error.text is None:
            error.text = text
        raise


def _finished(expr: Expr, actions: _Actions) -> Expr:
    """The checks that need the whole formula."""
    loose = min(expr.indices, key=actions.indices.__getitem__, default=None)
    if loose is not None:
        raise FormulaError(
            f"the index {loose} belongs to no sum",
            position=actions.indices[loose],
            length=len(loose),
            hints=(f"sum over it: sum({loose}, ...)",),
        )
    try:
        return whole(expr)
    except FormulaError as error:
        if expr.is_condition and actions.truth is not None:
            error.position, error.length = actions.truth.position, len(actions.truth.text)
        elif not expr.variables:
            error.position = 0
        raise


class _Actions:
    """What each alternative of the grammar makes.

    `indices` says where each index was first used, `truth` where the first comparison is, and `elements` lists place,
    index and array of the elements that no sum has yet taken; `called` remembers what calls made.
    """

    def __init__(self, names: Names) -> None:
        self.names = names
        self.indices: dict[str, int] = {}
        self.elements: list[tuple[int, str, str]] = []
        self.truth: Token | None = None
        self.called: dict[tuple[str, tuple[Expr, ...]], Expr] = {}
        self.start = made_so_far()

    def table(self) -> dict[str, Callable[..., object]]:
        """The actions by name."""
        return {
            "alone": lambda value: value,
            "equation": lambda left, sign, right: build("sub", (left, right)),
            "either": self.logical,
            "both": self.logical,
            "negated": lambda word, value: build("not", (value,)),
            "compared": lambda chain: chain[0],
            "chain_start": lambda left, sign, right: (self.compared(left, sign, right), right),
            "chain_more": self.chain_more,
            "binary": self.binary,
            "minus": lambda sign, value: build("neg", (value,)),
            "plus": lambda sign, value: value,
            "superscript": self.superscript,
            "number": lambda token: constant(_number(token)),
            "name": lambda token: self.names.value(token.text, token.position),
            "root": lambda sign, value: build("sqrt", (value,)),
            "group": lambda left, value, right: value,
            "magnitude": lambda left, value, right: build("abs", (value,)),
            "call": self.call,
            "first_argument": lambda value: [value],
            "next_argument": _appended,
            "element": self.element,
            "summed": self.summed,
        }

    def chain_more(self, chain: tuple[Expr, Expr], sign: Token, right: Expr) -> tuple[Expr, Expr]:
        """`a < b < c` is `a < b and b < c`."""
        return build("and", (chain[0], self.compared(chain[1], sign, right))), right

    def logical(self, left: Expr, word: Token, right: Expr) -> Expr:
        """`and`, `or`."""
        return build(word.kind.lower(), (left, right))

    def compared(self, left: Expr, sign: Token, right: Expr) -> Expr:
        """A comparison; the greater-than signs are the less-than signs read backwards."""
        self.truth = self.truth or sign
        args = (right, left) if sign.text in {">", ">=", "≥"} else (left, right)
        return build(_COMPARE[sign.text], args)

    def binary(self, left: Expr, sign: Token, right: Expr) -> Expr:
        """An operator between two values."""
        limits.check_nodes(made_so_far() - self.start)
        result = build(_BINARY[sign.kind], (left, right))
        return result if result.is_total else _defined(result)

    def superscript(self, base: Expr, token: Token) -> Expr:
        """`x²`."""
        return build("pow", (base, constant(_whole(token.text.translate(_DIGITS)))))

    def call(self, function: Token, left: Token, values: list[Expr], right: Token) -> Expr:
        """A function and its arguments; the same call again is the same node again."""
        limits.check_nodes(made_so_far() - self.start)
        key = function.text, tuple(values)
        if key not in self.called:
            self.called[key] = self.applied(*key)
        return self.called[key]

    def applied(self, name: str, values: tuple[Expr, ...]) -> Expr:
        """A function on its arguments."""
        row = FUNCTIONS.get(name)
        op = row.name if row else ""
        arity = row.arity if row else DERIVED[name].arity
        if op in _NARY and len(values) >= 2:
            result = values[0]
            for value in values[1:]:
                result = build(op, (result, value))
            return result
        if len(values) != arity:
            raise _wrong_count(name, arity, len(values), op in _NARY)
        return _defined(build(op, values) if op else DERIVED[name].make(*values))

    def element(self, array: Token, left: Token, index: Token, right: Token) -> Expr:
        """`r[i]`."""
        self.indices.setdefault(index.text, index.position)
        self.elements.append((array.position, index.text, array.text))
        return self.names.element(array.text, index.text, array.position)

    def summed(self, word: Token, left: Token, index: Token, comma: Token, body: Expr, right: Token) -> Expr:
        """`sum(i, body)` over the arrays that the body indexes by i."""
        name = index.text
        if name in VARIABLES:
            raise FormulaError(
                f"{name} is a variable and cannot be the index of a sum",
                position=index.position,
                hints=("name the index i",),
            )
        arrays = set()
        waiting = []
        while self.elements and self.elements[-1][0] > word.position:
            element = self.elements.pop()
            if element[1] == name:
                arrays.add(element[2])
            else:
                waiting.append(element)
        self.elements.extend(reversed(waiting))
        return sum_over(name, body, arrays)


def _appended(values: list[Expr], comma: Token, value: Expr) -> list[Expr]:
    """One more argument."""
    values.append(value)
    return values


def _defined(expr: Expr) -> Expr:
    """The node itself; a constant such as sqrt(-pi) or exp(1000) is refused where it is written."""
    if expr.is_constant and not expr.is_condition and rational(expr) is None:
        enclose(expr)
    return expr


def _number(token: Token) -> Fraction:
    """The exact value of a number."""
    digits, _, exponent = token.text.lower().partition("e")
    if len(digits) > limits.LITERAL_DIGITS or len(exponent) > 6 or abs(int(exponent or 0)) > limits.LITERAL_DIGITS:
        raise FormulaLimitError(
            f"this number is too long: digits and power of ten go up to {limits.LITERAL_DIGITS}",
            position=token.position,
            length=len(token.text),
            hints=("double precision holds 16 digits, and powers of ten up to 308",),
        )
    # A half in one character decomposes to 1, a slash of fractions, and 2.
    return Fraction(unicodedata.normalize("NFKC", token.text).replace("\u2044", "/"))


def _whole(text: str) -> int:
    """A superscript's value; far past the limit of powers it need not be exact."""
    return int(text) if len(text) < 10 else 10**10


def _wrong_count(name: str, arity: int, count: int, many: bool) -> FormulaError:
    """A function with too many or too few arguments."""
    letters = ("c, a, b" if name == "if" else ", ".join("xyz"[:arity])) + (", ..." if many else "")
    wanted = "one argument" if arity == 1 else f"{arity} arguments"
    return FormulaError(
        f"{name} takes {wanted}{' or more' if many else ''}, not {count}",
        hints=(f"write {name}({letters})",),
    )
