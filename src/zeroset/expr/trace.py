"""A Python function of x, y, z becomes a DAG by being called once with symbols in place of numbers.

Python's operators and NumPy's functions (`ufuncs`) on an `Expr` build nodes, so a function written for arrays is
traced as it stands. What asks for a number (`if x > 0`, `math.sin(x)`) cannot be traced, and the error says what to
write instead.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from zeroset.errors import FormulaError, ParameterError, ZerosetError
from zeroset.expr.convert import as_expr
from zeroset.expr.dag import Expr, node
from zeroset.expr.names import VARIABLES, variable
from zeroset.expr.whole import whole

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Traced", "trace"]


class Traced(NamedTuple):
    """What tracing a function finds.

    Attributes:
        expr: The formula.
        params: The function's further arguments and their default values.
    """

    expr: Expr
    params: dict[str, Any]


def trace(function: Callable[..., Any]) -> Traced:
    """The formula that a NumPy-style function computes.

    Args:
        function: Takes x, y, z, and w if it has a fourth argument without a default; any names will do. Further
            arguments with defaults become parameters with those values.

    Raises:
        FormulaError: The function does something that only numbers can do, or returns no number.
        ParameterError: A default is no number.

    Example:
        >>> traced = trace(lambda x, y, z, a=2.0: x**2 + y**2 - a * z)
        >>> str(traced.expr), traced.params
        ('x^2 + y^2 - a*z', {'a': 2.0})
    """
    count, params = _signature(function)
    symbols = [variable(name) for name in VARIABLES[:count]]
    try:
        result = function(*symbols, **{name: node("parameter", (), (name,)) for name in params})
    except ZerosetError:
        raise
    except Exception as error:
        raise FormulaError(
            f"the function failed when it was called with symbols: {type(error).__name__}: {error}",
            hints=("it must work on any number: Python's operators and NumPy's functions, one number at a time",),
        ) from error
    return Traced(_checked(result), params)


def _signature(function: Callable[..., Any]) -> tuple[int, dict[str, Any]]:
    """How many variables a function takes, and its parameters with their defaults."""
    import inspect

    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):
        return 3, {}
    count, params = 0, {}
    for argument in signature.parameters.values():
        optional = argument.kind is argument.KEYWORD_ONLY and not isinstance(argument.default, int | float | type)
        if optional or argument.kind in {argument.VAR_POSITIONAL, argument.VAR_KEYWORD}:
            continue
        if argument.default is not argument.empty:
            params[argument.name] = _default(argument.name, argument.default)
        elif argument.kind is argument.KEYWORD_ONLY:
            raise ParameterError(
                f"the parameter {argument.name} of the function has no value",
                hint=f"give it a default: {argument.name}=1.0",
            )
        else:
            count += 1
    starred = any(argument.kind is argument.VAR_POSITIONAL for argument in signature.parameters.values())
    if count == 0 and starred:
        count = 3
    if count not in {3, 4}:
        raise FormulaError(
            f"the function takes {count} arguments without defaults; it must take x, y, z, or x, y, z, w",
            hints=("write lambda x, y, z: ...", "give parameters a default: lambda x, y, z, a=1.0: ..."),
        )
    return count, params


def _default(name: str, value: Any) -> Any:
    """A parameter's default, if it is a number."""
    if name in VARIABLES:
        raise ParameterError(f"{name} is a variable and has no default", hint=f"write {name} without a default")
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ParameterError(f"the default of {name} is no number", hint=f"write {name}=1.0")
    return value


def _checked(result: Any) -> Expr:
    """The traced result, if it is a formula."""
    expr = as_expr(result)
    if expr is None:
        raise FormulaError(
            f"the function returned {type(result).__name__} where a number was expected",
            hints=("return f(x, y, z); the surface is where that is zero", "for l == r return l - r"),
        )
    return whole(expr)
