"""A surface: f with values for its parameters, where it is drawn and how it is seen.

``surface`` makes one from anything that is a formula. A Surface is immutable; ``with_params`` and friends give changed
copies, and a copy that differs only in numbers runs on the same compiled kernels.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from zeroset.errors import FormulaError, ParameterError, did_you_mean
from zeroset.expr import Expr, from_sympy, is_sympy, parse, text
from zeroset.expr.text import brief
from zeroset.scene.bounds import Bounds, parse_bounds
from zeroset.scene.camera import Camera
from zeroset.scene.exprfield import ExprField, check_work
from zeroset.scene.isovalues import colors_of, isovalues_of
from zeroset.scene.light import Color, Material
from zeroset.scene.parameters import LARGEST, TIME, array, check_names, scalar

if TYPE_CHECKING:
    import sympy

    from zeroset.scene.solid import Solid

PLENTY = 2.0**90
"""Largest number on the way to f up to which nobody has to look: kernels in f32 know numbers up to 2^112, and what they
calculate beside f, its derivatives, may be larger than f: by its degree, or by the 8,192 up to which they tell angles
from each other, over the size of the bounds. Quotients, exponentials and poles watch over themselves."""
Enclosure = tuple[float, float]
"""Two doubles with a number between them."""


class Calculated(NamedTuple):
    """A surface as kernels calculate it.

    Attributes:
        field: f, of which parts that parameters alone decide are parameters themselves.
        numbers: between which doubles each of its parameters lies.
    """

    field: ExprField
    numbers: Mapping[str, Enclosure]


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
        material: its own; None takes the scene's.
        isovalues: where f is met, rising; empty for f = 0 alone.
        colors: of the isovalues, linear RGB.

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
    material: Material | None = None
    isovalues: tuple[float, ...] = ()
    colors: tuple[Color, ...] = ()

    def __post_init__(self) -> None:
        params = {TIME: 0.0} if TIME in self.field.parameters else {}
        params |= {k: scalar(k, v) for k, v in self.params.items()}
        arrays = {k: array(k, v) for k, v in self.arrays.items()}
        check_names(self.field, params, arrays)
        object.__setattr__(self, "params", MappingProxyType(params))
        object.__setattr__(self, "arrays", MappingProxyType(arrays))
        if self.material is not None and not isinstance(self.material, Material):
            raise ParameterError(f"a surface's material must be a Material, not {self.material!r}")

    def __reduce__(self) -> tuple[Any, ...]:
        # Mappings that nobody can write to cannot be pickled.
        values = {item.name: getattr(self, item.name) for item in dataclasses.fields(self)}
        return _made_of, ({**values, "params": dict(self.params), "arrays": dict(self.arrays)},)

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """Itself: what solids and scenes of several surfaces have many of."""
        return (self,)

    @property
    def formula(self) -> str:
        """The formula as text."""
        return text(self.field.expr)

    @property
    def expr(self) -> Expr:
        """f as an expression: operators and NumPy's functions make further ones of it, which ``zs.surface`` takes.

        Example:
            >>> import zeroset as zs
            >>> ball, plane = zs.surface("x^2 + y^2 + z^2 = 1"), zs.surface("z")
            >>> zs.surface(ball.expr * plane.expr - 2).formula
            '(x^2 + y^2 + z^2 - 1)*z - 2'
        """
        return self.field.expr

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

    def with_material(self, material: Material | None) -> Surface:
        """The same surface with a material of its own; None takes the scene's."""
        return dataclasses.replace(self, material=material)

    def with_isovalues(
        self, values: float | Sequence[float] | None, colors: Sequence[Iterable[float]] | None = None
    ) -> Surface:
        """The surfaces f = v for several values v, found in one traversal, instead of f = 0 (K09 6.2).

        The values are numbers of the kernels: other ones compile nothing anew, as long as they are as many.

        Args:
            values: one number or several, up to 16; None goes back to f = 0.
            colors: linear RGB of each value, in the same order; None takes colours that are easily told apart.

        Returns:
            The surface; its ``isovalues`` are in rising order, and its ``colors`` along with them.

        Raises:
            ParameterError: a value that is no finite number, two equal ones, too many, or not as many colours.

        Example:
            >>> import zeroset as zs
            >>> shells = zs.surface("x^2 + y^2 + z^2", bounds=2.0).with_isovalues((1.0, 0.25))
            >>> zs.cast(shells, [0, -5, 0], [[0, 1, 0]], max_hits=4).part.tolist()
            [[1, 0, 0, 1]]
        """
        chosen, order = isovalues_of(values)
        return dataclasses.replace(self, isovalues=chosen, colors=colors_of(colors, order))

    def mapped(self, change: Callable[[Surface], Surface]) -> Surface:
        """Itself, changed: what solids and scenes do to each of their surfaces."""
        return change(self)

    def materials(self, usual: Material) -> tuple[Material, ...]:
        """The material of each part: of the surface, or of each isovalue; ``usual`` where it has none of its own."""
        own = self.material or usual
        if not self.isovalues:
            return (own,)
        return tuple(dataclasses.replace(own, front=color, back=color) for color in self.colors)

    def __and__(self, other: object) -> Solid:
        from zeroset.scene.solid import join

        return join("and", self, other)

    def __or__(self, other: object) -> Solid:
        from zeroset.scene.solid import join

        return join("or", self, other)

    def __sub__(self, other: object) -> Solid:
        from zeroset.scene.solid import subtract

        return subtract(self, other)

    def __invert__(self) -> Solid:
        from zeroset.scene.solid import Solid

        return Solid("not", (self,))

    @cached_property
    def fitted(self) -> Bounds:
        """The bounds, fitted by interval subdivision where none were given."""
        if self.bounds is not None:
            return self.bounds
        from zeroset.scene.fit import fit_bounds

        self.check_work()
        return fit_bounds(self)

    @cached_property
    def settled(self) -> Calculated:
        """f and the numbers in it as kernels are given them."""
        given = {name: (value, value) for name, value in self.params.items()}
        try:
            found = self.field.settled.values(self.params)
        except FormulaError:
            return Calculated(self.field, given)
        if any(max(-low, high) > LARGEST for low, high in found.values()):
            # Kernels know what to make of numbers that pass the largest one if they come to them by themselves.
            return Calculated(self.field, given)
        return Calculated(self.field.remaining, given | found)

    def drawn_in(self, bounds: Bounds) -> ExprField:
        """f as kernels calculate it inside bounds: with an eye on large numbers where there may be any."""
        field, numbers = self.settled
        known = self._watched.get(bounds)
        if known is None:
            sizes = {name: max(-low, high) for name, (low, high) in numbers.items()}
            reaches = zip("xyz", bounds.farthest, strict=True)
            arrays = {name: (float(np.abs(v).max(initial=0.0)), v.size) for name, v in self.arrays.items()}
            largest = field.magnitude.largest({**sizes, **dict(reaches)}, arrays)
            # A derivative may be larger by as much as the bounds are small.
            known = self._watched[bounds] = largest > PLENTY * min(bounds.extent, 1.0)
        return field.watched if known else field

    @cached_property
    def _watched(self) -> dict[Bounds, bool]:
        return {}

    def check_work(self) -> None:
        """Raise ``FormulaLimitError`` for a formula that no compiler digests while somebody waits."""
        check_work(self.field.work)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Surface) and self._identity() == other._identity()

    def __hash__(self) -> int:
        return hash(self._identity())

    def _identity(self) -> tuple[object, ...]:
        """All that a surface is, as something to compare and to hash."""
        params = tuple(sorted(self.params.items()))
        arrays = tuple((name, values.tobytes()) for name, values in sorted(self.arrays.items()))
        looks = self.material, self.isovalues, self.colors
        return self.field.digest, params, arrays, self.bounds, self.camera, self.name, *looks

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
    if isinstance(source, str):
        scalars, arrays = (_still_there(given, expr, source) for given in (scalars, arrays))
    return Surface(ExprField(expr), {**defaults, **scalars}, arrays, limits, camera, name)


def _still_there(given: dict[str, Any], expr: Expr, text: str) -> dict[str, Any]:
    """Values without those of names that stand in the text and have gone as it was simplified: ``0*r + x``."""
    kept = expr.parameters | expr.arrays | {TIME}
    gone = [name for name in given if name not in kept and re.search(rf"(?<![A-Za-z_]){re.escape(name)}(?!\w)", text)]
    return {name: value for name, value in given.items() if name not in gone}


def _made_of(values: Mapping[str, Any]) -> Surface:
    return Surface(**values)


def _expression(source: Any, scalars: Mapping[str, Any], arrays: Mapping[str, Any]) -> tuple[Expr, dict[str, Any]]:
    if isinstance(source, str):
        return parse(source, params=set(scalars) - {TIME}, arrays=set(arrays)), {}
    if isinstance(source, Expr):
        return source, {}
    if is_sympy(source):
        return from_sympy(source), {}
    if callable(source):
        from zeroset.expr import trace

        traced = trace(source)
        # An argument that the function makes no use of is no parameter; who gives it a value is told so.
        return traced.expr, {name: value for name, value in traced.params.items() if name in traced.expr.parameters}
    raise FormulaError(
        f"cannot make a surface of {type(source).__name__}",
        hints=("give a formula as text, a SymPy expression, or a function of x, y, z",),
    )
