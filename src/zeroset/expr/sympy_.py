"""From SymPy expressions to the DAG; SymPy itself is never imported before there is one.

The classes are known by their names, which the operator table holds. SymPy's numbers are taken exactly; its roots
mean real roots, as everywhere in zeroset.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache, reduce
from typing import TYPE_CHECKING, Any

from zeroset.errors import FormulaError, UnknownNameError, did_you_mean
from zeroset.expr.build import ONE, ZERO, build
from zeroset.expr.dag import Expr, constant, node
from zeroset.expr.derived import CONSTANTS, DERIVED, chebyshev
from zeroset.expr.names import VARIABLES, check_name, variable
from zeroset.expr.ops import OPS, Operator
from zeroset.expr.whole import whole

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

__all__ = ["from_sympy", "is_sympy"]

_CONSTANTS = {"Pi": "pi", "Exp1": "e", "GoldenRatio": "phi"}
_NARY = frozenset({"add", "mul", "min", "max", "and", "or"})


def is_sympy(value: object) -> bool:
    """Whether a value is a SymPy object, told by the module of its type, without importing SymPy."""
    return any((base.__module__ or "").partition(".")[0] == "sympy" for base in type(value).__mro__)


def from_sympy(expression: Any, params: Collection[str] | None = None) -> Expr:
    """The formula f (meaning f = 0) of a SymPy expression, or l - r of an `Eq(l, r)`.

    Args:
        expression: The expression; its symbols x, y, z, w are the variables.
        params: Names of the symbols that are parameters; by default every other symbol is one.

    Raises:
        FormulaError: The expression holds something that has no meaning here; the error names it.
        UnknownNameError: A symbol is neither a variable nor a parameter.

    Example:
        >>> import sympy
        >>> x, y = sympy.symbols("x y")
        >>> print(from_sympy(sympy.Eq(x**2 + sympy.sin(y), 1)))
        x^2 + sin(y) - 1
    """
    return whole(_Reader(params).read(expression))


class _Reader:
    """One conversion: the parameters that may occur, and what has been converted."""

    def __init__(self, params: Collection[str] | None) -> None:
        self.params = params
        self.done: dict[Any, Expr] = {}

    def read(self, root: Any) -> Expr:
        """The node of an expression; arguments first, on a stack of its own."""
        if not is_sympy(root) or getattr(root, "is_Matrix", False):
            raise FormulaError(f"{_name(root)} is no SymPy expression for a number")
        if _name(root) == "Equality":
            return build("sub", (self.read(root.args[0]), self.read(root.args[1])))
        stack = [root]
        while stack:
            top = stack[-1]
            waiting = [] if top in self.done else [arg for arg in _arguments(top) if arg not in self.done]
            if waiting:
                stack.extend(waiting)
                continue
            stack.pop()
            if top not in self.done:
                self.done[top] = self._node(top, [self.done[arg] for arg in _arguments(top)])
        return self.done[root]

    def _node(self, item: Any, args: list[Expr]) -> Expr:
        """The node of one object whose arguments are done."""
        name = _name(item)
        if getattr(item, "is_Symbol", False):
            return self._symbol(item.name)
        if getattr(item, "is_Rational", False):
            return constant(Fraction(int(item.p), int(item.q)))
        if getattr(item, "is_Float", False) and item.is_finite:
            return constant(_float(item))
        if name in _CONSTANTS:
            return CONSTANTS[_CONSTANTS[name]]
        if name in _SPECIAL:
            return _SPECIAL[name](*args)
        row = _rows().get(name)
        if row is not None and row.name in _NARY and args:
            return reduce(lambda left, right: build(row.name, (left, right)), args)
        if row is not None and len(args) == row.arity:
            return build(row.name, tuple(args))
        if name in DERIVED:
            return DERIVED[name].make(*args)
        raise FormulaError(f"SymPy's {name} has no meaning in a formula: {_brief(item)}", hints=_HINTS.get(name, ()))

    def _symbol(self, name: str) -> Expr:
        if name in VARIABLES:
            return variable(name)
        if self.params is None or name in self.params:
            check_name(name)
            return node("parameter", (), (name,))
        raise UnknownNameError(
            f"unknown symbol {name}: it is no variable (x, y, z, w) or parameter",
            name=name,
            hints=(
                *did_you_mean(name, {*VARIABLES, *self.params}),
                f"give it a value: params={{'{name}': 1.0}}",
            ),
        )


@cache
def _rows() -> dict[str, Operator]:
    """The operator of each SymPy class that the table names."""
    return {name: row for row in OPS.values() for name in row.sympy}


def _float(item: Any) -> Fraction:
    """The binary number that a SymPy float is, exactly."""
    import sympy

    exact = sympy.Rational(item)
    return Fraction(int(exact.p), int(exact.q))


def _name(item: Any) -> str:
    """The class that says what an object means; a number's or function's own class is a detail."""
    return type(item).__name__


def _arguments(item: Any) -> tuple[Any, ...]:
    """The objects to convert before an object: for `Piecewise` its values and conditions in turn."""
    name = _name(item)
    if name == "Piecewise":
        return tuple(part for pair in item.args for part in pair.args)
    if name == "Add" and item.args[0].is_Number:
        # SymPy puts the number first; people read it last.
        return (*item.args[1:], item.args[0])
    return tuple(item.args) if name in _SPECIAL or name in DERIVED or name in _rows() else ()


def _piecewise(*parts: Expr) -> Expr:
    """Values and conditions in turn, the last condition true."""
    *rest, otherwise, last = parts
    if last is not _TRUE:
        raise FormulaError(
            "a Piecewise without a last case for everywhere else is undefined there",
            hints=("end it with (value, True)",),
        )
    for value, condition in zip(rest[-2::-2], rest[::-2], strict=True):
        otherwise = build("select", (condition, value, otherwise))
    return otherwise


def _equal(left: Expr, right: Expr) -> Expr:
    """The condition that two numbers are equal."""
    return build("and", (build("le", (left, right)), build("le", (right, left))))


def _brief(item: Any) -> str:
    """The object as SymPy prints it, cut to one line."""
    shown = str(item).replace("\n", " ")
    return shown if len(shown) <= 60 else f"{shown[:57]}..."


_TRUE = build("le", (ZERO, ONE))
_FALSE = build("lt", (ONE, ZERO))
_SPECIAL: dict[str, Callable[..., Expr]] = {
    "Piecewise": _piecewise,
    "BooleanTrue": lambda: _TRUE,
    "BooleanFalse": lambda: _FALSE,
    "StrictGreaterThan": lambda left, right: build("lt", (right, left)),
    "GreaterThan": lambda left, right: build("le", (right, left)),
    "Equality": lambda left, right: _equal(left, right),
    "Unequality": lambda left, right: build("not", (_equal(left, right),)),
    "chebyshevt": chebyshev,
    # Everything is real here, which SymPy's roots ask about.
    "re": lambda value: value,
    "im": lambda value: ZERO,
    "conjugate": lambda value: value,
}
_HINTS = {
    "ImaginaryUnit": ("formulas are real; take re(...) or Abs(...) by hand",),
    "Sum": ("write it out: .doit()",),
    "Integral": ("work it out: .doit()",),
    "Derivative": ("work it out: .doit()",),
    "Infinity": ("write a large number, such as 1e30",),
    "NaN": ("the expression is undefined",),
}
