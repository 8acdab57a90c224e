"""A Python function of x, y, z becomes a DAG by being called once with symbols in place of numbers.

Python's operators and NumPy's functions on an `Expr` build nodes (`__array_ufunc__`, `__array_function__`), so a
function written for arrays is traced as it stands. What asks for a number (`if x > 0`, `math.sin(x)`) cannot be
traced, and the error says what to write instead.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from zeroset.errors import FormulaError, ParameterError, ZerosetError, did_you_mean
from zeroset.expr.build import build
from zeroset.expr.convert import as_expr, as_numbers
from zeroset.expr.dag import Expr, constant, node
from zeroset.expr.derived import DERIVED
from zeroset.expr.names import VARIABLES, variable
from zeroset.expr.ops import OPS
from zeroset.expr.whole import whole

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Traced", "apply_function", "apply_ufunc", "trace"]


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


def apply_ufunc(ufunc: Any, method: str, inputs: tuple[Any, ...], options: dict[str, Any]) -> Any:
    """What a NumPy ufunc makes of formulas (the hook behind `Expr.__array_ufunc__`)."""
    name = ufunc.__name__
    if method != "__call__" or options:
        raise FormulaError(
            f"np.{name} was called in a way that formulas do not support ({method} {', '.join(options)})".rstrip(" ()"),
            hints=(f"call it plainly: np.{name}(x)",),
        )
    arrays = [value for value in inputs if getattr(value, "shape", ()) != ()]
    if arrays:
        raise FormulaError(
            "an array stands beside a formula, but a formula is one number at each point",
            hints=("add up the parts one by one: sum((x - a)**2 for a in centres)",),
        )
    op = _ufuncs().get(name)
    if op is not None:
        nodes = as_numbers(op, inputs)
        return NotImplemented if nodes is None else build(op, nodes)
    function = _UFUNCS.get(name)
    nodes = as_numbers("add", inputs)
    if function is None or nodes is None:
        raise _unknown(name)
    return function(*nodes)


def apply_function(function: Any, args: tuple[Any, ...], options: dict[str, Any]) -> Any:
    """What a NumPy function makes of formulas (the hook behind `Expr.__array_function__`)."""
    name = function.__name__
    if name == "where" and len(args) == 3 and not options:
        nodes = as_numbers("select", args)
        if nodes is not None:
            return build("select", nodes)
    if name == "clip":
        low, high = [*args[1:], options.get("a_min", options.get("min")), options.get("a_max", options.get("max"))][:2]
        return _clip(args[0], low, high)
    raise _unknown(name)


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


def _clip(value: Any, low: Any, high: Any) -> Expr:
    """np.clip; either bound may be None."""
    for op, bound in (("max", low), ("min", high)):
        if bound is not None:
            nodes = as_numbers(op, (value, bound))
            if nodes is None:
                raise FormulaError("np.clip takes numbers or formulas as its bounds")
            value = build(op, nodes)
    return value  # type: ignore[no-any-return]


def _ufuncs() -> dict[str, str]:
    """The operator of each ufunc that the table names."""
    return {name: row.name for row in OPS.values() for name in row.ufuncs}


def _unknown(name: str) -> FormulaError:
    """The error for a NumPy function that no operator stands for."""
    return FormulaError(
        f"NumPy's {name} has no meaning in a formula",
        hints=(
            *did_you_mean(name, {*_ufuncs(), *_UFUNCS, "where", "clip"}),
            "NumPy's elementary functions, minimum, maximum, floor, ceil, mod, clip and where can be used",
        ),
    )


_UFUNCS: dict[str, Callable[..., Expr]] = {
    "positive": lambda x: x,
    "greater": lambda x, y: x > y,
    "greater_equal": lambda x, y: x >= y,
    "hypot": DERIVED["hypot"].make,
    "reciprocal": lambda x: 1 / x,
    "floor_divide": lambda x, y: x // y,
    "log2": DERIVED["log2"].make,
    "log10": DERIVED["log10"].make,
    "exp2": DERIVED["exp2"].make,
    "expm1": lambda x: build("exp", (x,)) - 1,
    "log1p": lambda x: build("log", (1 + x,)),
    "arcsinh": DERIVED["asinh"].make,
    "arccosh": DERIVED["acosh"].make,
    "arctanh": DERIVED["atanh"].make,
    "deg2rad": lambda x: x * (build("acos", (constant(-1),)) / 180),
    "clip": lambda x, low, high: _clip(x, low, high),
}
"""The ufuncs that are combinations of operators."""
