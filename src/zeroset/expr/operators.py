"""Python's operators on formulas, and the honest refusals of what only numbers can do.

`Operators` is the base of `Expr` that holds them: each operator makes a rewritten node. What asks for a number
(`if`, `float`, `math.sin`) raises an error that says what to write instead.

Nodes lie at the ground, and what makes further ones of them above: the rewriter and NumPy's functions. A node that
answers to `+` has to know them all the same, so each is imported when it is first asked: here alone, and in `Expr` for
its text.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, Self, Union

from zeroset.errors import FormulaError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from zeroset.expr.dag import Expr

__all__ = ["Operand", "Operators"]

Operand = Union["Operators", int, float, Fraction]


class Operators:
    """What Python code may do with a formula."""

    __slots__ = ()

    # NumPy must not try to make an array of objects out of `array * expr`.
    __array_priority__ = 1000

    def __bool__(self) -> bool:
        raise FormulaError(
            "whether this holds depends on where x, y, z are, so Python cannot decide it here",
            hints=(
                "for `a if condition else b` write np.where(condition, a, b)",
                "for `min(a, b)` write np.minimum(a, b), for `max(a, b)` np.maximum(a, b)",
                "for `a < x < b`, `and`, `or`, `not` write (a < x) & (x < b), `&`, `|`, `~`",
            ),
        )

    def _no_number(self) -> Any:
        raise FormulaError(
            "a formula is no number, so functions of the module `math` cannot be applied to it",
            hints=("use NumPy's functions: np.sin(x), np.sqrt(x), np.floor(x)",),
        )

    __float__ = __int__ = __index__ = __complex__ = __round__ = __trunc__ = _no_number

    def __iter__(self) -> Iterator[Expr]:
        raise FormulaError(
            "a formula is one number at each point and cannot be iterated over or unpacked",
            hints=("take the variables one by one: lambda x, y, z: ...",),
        )

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        from zeroset.expr.ufuncs import apply_ufunc

        return apply_ufunc(ufunc, method, inputs, options)

    def __array_function__(self, function: Any, types: Any, args: Any, options: Any) -> Any:
        from zeroset.expr.ufuncs import apply_function

        return apply_function(function, args, options)

    def __neg__(self) -> Expr:
        return _apply("neg", self)

    def __pos__(self) -> Self:
        return self

    def __abs__(self) -> Expr:
        return _apply("abs", self)

    def __floor__(self) -> Expr:
        return _apply("floor", self)

    def __ceil__(self) -> Expr:
        return _apply("ceil", self)

    def __add__(self, other: Operand) -> Expr:
        return _apply("add", self, other)

    def __radd__(self, other: Operand) -> Expr:
        return _apply("add", other, self)

    def __sub__(self, other: Operand) -> Expr:
        return _apply("sub", self, other)

    def __rsub__(self, other: Operand) -> Expr:
        return _apply("sub", other, self)

    def __mul__(self, other: Operand) -> Expr:
        return _apply("mul", self, other)

    def __rmul__(self, other: Operand) -> Expr:
        return _apply("mul", other, self)

    def __truediv__(self, other: Operand) -> Expr:
        return _apply("div", self, other)

    def __rtruediv__(self, other: Operand) -> Expr:
        return _apply("div", other, self)

    def __mod__(self, other: Operand) -> Expr:
        return _apply("mod", self, other)

    def __rmod__(self, other: Operand) -> Expr:
        return _apply("mod", other, self)

    def __floordiv__(self, other: Operand) -> Expr:
        return _apply("floor", _apply("div", self, other))

    def __rfloordiv__(self, other: Operand) -> Expr:
        return _apply("floor", _apply("div", other, self))

    def __pow__(self, other: Operand) -> Expr:
        return _apply("pow", self, other)

    def __rpow__(self, other: Operand) -> Expr:
        return _apply("pow", other, self)

    def __lt__(self, other: Operand) -> Expr:
        return _apply("lt", self, other)

    def __le__(self, other: Operand) -> Expr:
        return _apply("le", self, other)

    def __gt__(self, other: Operand) -> Expr:
        return _apply("lt", other, self)

    def __ge__(self, other: Operand) -> Expr:
        return _apply("le", other, self)

    def __and__(self, other: Operand) -> Expr:
        return _apply("and", self, other)

    def __or__(self, other: Operand) -> Expr:
        return _apply("or", self, other)

    def __invert__(self) -> Expr:
        return _apply("not", self)


def _apply(op: str, *args: Operand) -> Expr:
    """The rewritten node of an operator; NotImplemented where an argument is of a foreign type."""
    from zeroset.expr.build import build
    from zeroset.expr.convert import as_numbers

    nodes = as_numbers(op, args)
    foreign: Expr = NotImplemented
    return foreign if nodes is None else build(op, nodes)
