"""A surface: f with values for its parameters, where it is drawn and how it is seen.

``surface`` makes one from anything that is a formula. A Surface is immutable; ``with_params`` and friends give changed
copies, and a copy that differs only in numbers runs on the same compiled kernels.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from zeroset.errors import FormulaError, FormulaLimitError, ParameterError, did_you_mean
from zeroset.expr import OPS, Expr, degree, evaluate, parse, postorder, text
from zeroset.expr.text import brief
from zeroset.scene.bounds import Bounds, parse_bounds
from zeroset.scene.camera import Camera
from zeroset.scene.parameters import TIME, array, check_names, scalar

if TYPE_CHECKING:
    import sympy

MOST_WORK = 4000
"""Operations up to which a formula is compiled, functions counted several times: about half a minute."""
_FUNCTION_WORK = 8


@dataclass(frozen=True)
class ExprField:
    """An expression as something to evaluate on any number system."""

    expr: Expr

    @property
    def digest(self) -> str:
        """Hash of the expression's structure."""
        return self.expr.digest

    @property
    def parameters(self) -> frozenset[str]:
        """Scalar parameters, with ``w`` where it is used."""
        return self.expr.parameters | (self.expr.variables & {TIME})

    @property
    def arrays(self) -> frozenset[str]:
        """Array parameters."""
        return self.expr.arrays

    @cached_property
    def degree(self) -> int | None:
        """An upper bound of the degree in x, y, z; None for what is no polynomial."""
        return degree(self.expr)

    @cached_property
    def highest_power(self) -> int:
        """The largest whole exponent in f as it is written."""
        return max((abs(int(part.data[0])) for part in postorder(self.expr) if part.op == "powi"), default=1)

    @cached_property
    def work(self) -> int:
        """What compiling f costs, in arithmetic operations; functions and powers count for several."""
        return sum(_FUNCTION_WORK if OPS[part.op].kind == "function" else 1 for part in postorder(self.expr))

    def evaluate(self, system: Any, env: Any) -> Any:
        """f on numbers of ``system``."""
        return evaluate(self.expr, system, env)


@dataclass(frozen=True, eq=False)
class Surface:
    """The set f = 0 inside bounds.

    Attributes:
        field: f.
        params: value of each scalar parameter.
        arrays: value of each array parameter, 1-D.
        bounds: where it is drawn; None is fitted on first use.
        camera: how it is seen by default; None fits the bounds.
        name: what it is called, or "".

    Example:
        >>> import zeroset as zs
        >>> s = zs.surface("x^2 + y^2 + z^2 = r^2", params={"r": 1.5})
        >>> s.with_params(r=2.0).params["r"]
        2.0
    """

    field: ExprField
    params: Mapping[str, float] = dataclasses.field(default_factory=dict)
    arrays: Mapping[str, npt.NDArray[np.float64]] = dataclasses.field(default_factory=dict)
    bounds: Bounds | None = None
    camera: Camera | None = None
    name: str = ""

    def __post_init__(self) -> None:
        params = {TIME: 0.0} if TIME in self.field.parameters else {}
        params |= {k: scalar(k, v) for k, v in self.params.items()}
        arrays = {k: array(k, v) for k, v in self.arrays.items()}
        check_names(self.field, params, arrays)
        object.__setattr__(self, "params", MappingProxyType(params))
        object.__setattr__(self, "arrays", MappingProxyType(arrays))

    @property
    def formula(self) -> str:
        """The formula as text."""
        return text(self.field.expr)

    def with_params(self, **values: Any) -> Surface:
        """The same surface with other parameter values; nothing is compiled anew."""
        params, arrays = dict(self.params), dict(self.arrays)
        for name, value in values.items():
            if name not in params and name not in arrays:
                known = (*params, *arrays)
                raise ParameterError(
                    f"the surface has no parameter {name!r}",
                    hints=(*did_you_mean(name, known), f"it has {', '.join(known) or 'none'}"),
                )
            (arrays if name in arrays else params)[name] = value
        return dataclasses.replace(self, params=params, arrays=arrays)

    def with_bounds(self, bounds: Any) -> Surface:
        """The same surface inside other bounds."""
        return dataclasses.replace(self, bounds=parse_bounds(bounds))

    @cached_property
    def fitted(self) -> Bounds:
        """The bounds, fitted by interval subdivision where none were given."""
        if self.bounds is not None:
            return self.bounds
        from zeroset.scene.fit import fit_bounds

        self.check_work()
        return fit_bounds(self)

    def check_work(self) -> None:
        """Raise ``FormulaLimitError`` for a formula that no compiler digests while somebody waits."""
        if self.field.work > MOST_WORK:
            raise FormulaLimitError(
                f"the formula has too many operations to be drawn: {self.field.work:,} of at most {MOST_WORK:,}",
                hints=(
                    "put repeated data (such as sphere centres) into an array parameter: sum(i, ... c[i] ...)",
                    "draw parts of it as surfaces of their own",
                ),
            )

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Surface) and self._identity() == other._identity()

    def __hash__(self) -> int:
        return hash(self._identity())

    def _identity(self) -> tuple[object, ...]:
        """All that a surface is, as something to compare and to hash."""
        params = tuple(sorted(self.params.items()))
        arrays = tuple((name, values.tobytes()) for name, values in sorted(self.arrays.items()))
        return self.field.digest, params, arrays, self.bounds, self.camera, self.name

    def __repr__(self) -> str:
        return f"<zeroset.Surface {self.name or brief(self.field.expr, 60)!r}>"


def _is_array(value: Any) -> bool:
    return isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim > 0)


def surface(
    source: str | Expr | Surface | Callable[..., Any] | sympy.Basic,
    params: Mapping[str, Any] | None = None,
    bounds: Any = None,
    camera: Camera | None = None,
    name: str = "",
) -> Surface:
    """A surface from anything that is a formula.

    Args:
        source: text (``"x^2 + y^2 = 1"``; ``"f"`` alone means f = 0), a SymPy expression or equation, a NumPy-style
            function of x, y, z (and w), an expression, or a Surface to change.
        params: values of parameters: numbers, or 1-D arrays for names that the formula indexes, as ``r[i]``.
        bounds: a number (ball of that radius at the origin), a ``Ball``, a ``Box``, or None to fit the surface.
        camera: how to see it by default.
        name: what to call it.

    Raises:
        FormulaError: the text is no formula; the message shows where.
        ParameterError: a parameter lacks a value, or a value lacks a parameter.
        BoundsError: the bounds are empty or no bounds.

    Example:
        >>> import zeroset as zs
        >>> zs.surface("x^4 - a*x^2 + y^4 + z^4", params={"a": 5.0}, bounds=3.0).params["a"]
        5.0
    """
    if params is not None and not isinstance(params, Mapping):
        raise ParameterError(
            f"params must be a mapping of names to values, not {params!r}", hint="try params={'a': 1.0}"
        )
    values = dict(params or {})
    limits = parse_bounds(bounds)
    if isinstance(source, Surface):
        changed = source.with_params(**values) if values else source
        changed = changed if limits is None else dataclasses.replace(changed, bounds=limits)
        return changed if camera is None else dataclasses.replace(changed, camera=camera)
    scalars = {k: v for k, v in values.items() if not _is_array(v)}
    arrays = {k: v for k, v in values.items() if _is_array(v)}
    expr, defaults = _expression(source, scalars, arrays)
    return Surface(ExprField(expr), {**defaults, **scalars}, arrays, limits, camera, name)


def _expression(source: Any, scalars: Mapping[str, Any], arrays: Mapping[str, Any]) -> tuple[Expr, dict[str, Any]]:
    if isinstance(source, str):
        return parse(source, params=set(scalars) - {TIME}, arrays=set(arrays)), {}
    if isinstance(source, Expr):
        return source, {}
    if type(source).__module__.partition(".")[0] == "sympy":
        from zeroset.expr import from_sympy

        return from_sympy(source), {}
    if callable(source):
        from zeroset.expr import trace

        traced = trace(source)
        return traced.expr, traced.params
    raise FormulaError(
        f"cannot make a surface of {type(source).__name__}",
        hints=("give a formula as text, a SymPy expression, or a function of x, y, z",),
    )
