"""NumPy's functions on formulas: what `np.sin(f)`, `np.where(c, f, g)` and their like make of nodes.

NumPy asks an `Expr` itself (`__array_ufunc__`, `__array_function__`). Most functions are one operator, which the
operator table names; the rest are combinations.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from zeroset.errors import FormulaError, did_you_mean
from zeroset.expr.build import build
from zeroset.expr.convert import as_numbers
from zeroset.expr.dag import Expr, constant
from zeroset.expr.derived import DERIVED
from zeroset.expr.ops import OPS

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["apply_function", "apply_ufunc"]


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
