"""From a DAG back to formula text that parses to the identical DAG.

Shared parts are written out each time they occur, so the length is bounded before anything is written. A constant whose
name a parameter has taken is written so that it still means the constant: pi as acos(-1).
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from zeroset.errors import FormulaLimitError
from zeroset.expr import limits
from zeroset.expr.build import ZERO
from zeroset.expr.dag import PI, Expr, postorder
from zeroset.expr.derived import PHI, E
from zeroset.expr.ops import OPS

if TYPE_CHECKING:
    from collections.abc import Collection

__all__ = ["brief", "text"]

# How tightly the printed form of a node binds, loosest first.
_OR, _AND, _NOT, _COMPARE, _SUM, _PRODUCT, _SIGN, _POWER, _ATOM = range(9)

_INFIX = {
    "or": (" or ", _OR, _OR, _AND),
    "and": (" and ", _AND, _AND, _NOT),
    "lt": (" < ", _COMPARE, _SUM, _SUM),
    "le": (" <= ", _COMPARE, _SUM, _SUM),
    "add": (" + ", _SUM, _SUM, _PRODUCT),
    "sub": (" - ", _SUM, _SUM, _PRODUCT),
    "mul": ("*", _PRODUCT, _PRODUCT, _SIGN),
    "div": ("/", _PRODUCT, _PRODUCT, _SIGN),
    "pow": ("^", _POWER, _ATOM, _SIGN),
}
"""Operator, its binding, and the bindings that its two arguments need."""

_PLACES = 60
"""Decimal places up to which a number is written as a decimal: enough for most doubles near one."""

_Rope = str | tuple["_Rope", ...]
"""Text in nested parts: joining strings node by node would copy a long sum once for each of its terms."""

_Piece = tuple[_Rope, int]


def text(expr: Expr, limit: int = limits.TEXT) -> str:
    """The formula as text.

    Args:
        expr: The formula or any part of one.
        limit: Longest text to write, in characters.

    Raises:
        FormulaLimitError: The text would be longer: the DAG shares what a text must repeat.
    """
    _check_length(expr, limit)
    taken = expr.parameters
    pieces: dict[Expr, _Piece] = {}
    for part in postorder(expr):
        pieces[part] = _named(part, taken) or _piece(part, [pieces[arg] for arg in part.args])
    return _joined(pieces[expr][0])


def brief(expr: Expr, limit: int = 200) -> str:
    """The formula as text, or a description where that would be long."""
    try:
        return text(expr, limit)
    except FormulaLimitError:
        return f"{expr.op} of {expr.size} distinct operations"


def _check_length(expr: Expr, limit: int) -> None:
    """Bound the length from below, with repetitions: parentheses and some signs are not counted."""
    lengths: dict[Expr, int] = {}
    for part in postorder(expr):
        below = sum(lengths[arg] for arg in part.args) + _length(part)
        lengths[part] = min(limit + 1, below)
    if lengths[expr] > limit:
        raise FormulaLimitError(f"the formula written out has more than {limit:,} characters")


def _length(part: Expr) -> int:
    """A lower bound on the characters that a node adds to its arguments."""
    if part.args:
        return len(OPS[part.op].spellings[0]) + 2 if OPS[part.op].kind == "function" else 1
    value = part.data[0]
    if isinstance(value, Fraction):
        return 1 + (value.numerator.bit_length() - 1) * 3 // 10
    return len(str(value))


def _joined(rope: _Rope) -> str:
    """The characters of a rope, without recursion."""
    strings = []
    stack = [rope]
    while stack:
        top = stack.pop()
        if isinstance(top, str):
            strings.append(top)
        else:
            stack.extend(reversed(top))
    return "".join(strings)


def _named(part: Expr, taken: Collection[str]) -> _Piece | None:
    """A constant that has a name, unless a parameter has taken it."""
    if part is PI:
        return ("acos(-1)" if "pi" in taken else "pi"), _ATOM
    for constant, name in ((E, "e"), (PHI, "phi")):
        if part is constant and name not in taken:
            return name, _ATOM
    return None


def _piece(part: Expr, args: list[_Piece]) -> _Piece:
    """The text of a node from those of its arguments, and how tightly it binds."""
    if part.op in _INFIX:
        sign, binding, left, right = _INFIX[part.op]
        factor = part.args[0]
        if part.op == "mul" and factor.is_constant and factor is not ZERO and part.args[1].op in {"mul", "div"}:
            # The rewriter takes constant factors out of a product read from the left; zero would swallow one by one.
            right = _PRODUCT
        return (_within(args[0], left), sign, _within(args[1], right)), binding
    match part.op:
        case "const":
            return _rational(part.data[0])
        case "variable" | "parameter":
            return str(part.data[0]), _ATOM
        case "element":
            return f"{part.data[0]}[{part.data[1]}]", _ATOM
        case "neg":
            return ("-", _within(args[0], _SIGN)), _SIGN
        case "not":
            return ("not ", _within(args[0], _NOT)), _NOT
        case "sqr":
            return (_within(args[0], _ATOM), "^2"), _POWER
        case "powi":
            return (_within(args[0], _ATOM), f"^{part.data[0]}"), _POWER
        case "powr":
            return (_within(args[0], _ATOM), f"^({part.data[0]}/{part.data[1]})"), _POWER
        case "sum":
            return _sum(part, args[0][0]), _ATOM
    rest = tuple((", ", rope) for rope, _ in args[1:])
    return (OPS[part.op].spellings[0], "(", args[0][0], *rest, ")"), _ATOM


def _within(piece: _Piece, binding: int) -> _Rope:
    """The text of an argument, in parentheses where it binds too loosely."""
    return piece[0] if piece[1] >= binding else ("(", piece[0], ")")


def _rational(value: object) -> _Piece:
    """An exact number: whole, decimal where that is exact and short, else a quotient."""
    if not isinstance(value, Fraction):
        raise TypeError("pi has a name")
    if value < 0:
        digits, binding = _rational(-value)
        return ("-", digits), _SIGN if binding > _SIGN else binding
    if value.denominator == 1:
        return str(value.numerator), _ATOM
    return _decimal(value) or f"{value.numerator}/{value.denominator}", _PRODUCT


def _decimal(value: Fraction) -> str:
    """The decimal expansion of a positive rational if it ends within `_PLACES` places."""
    scaled = value * 10**_PLACES
    if scaled.denominator != 1:
        return ""
    digits = str(scaled.numerator).rjust(_PLACES + 1, "0")
    return f"{digits[:-_PLACES]}.{digits[-_PLACES:]}".rstrip("0")


def _sum(part: Expr, body: _Rope) -> _Rope:
    """A sum; an array that only says how many terms there are is kept in sight."""
    index, *arrays = map(str, part.data)
    used = {str(leaf.data[0]) for leaf in postorder(part.args[0]) if leaf.op == "element" and leaf.data[1] == index}
    kept = "".join(f" + 0*{array}[{index}]" for array in arrays if array not in used)
    return (f"sum({index}, ", body, kept, ")")
