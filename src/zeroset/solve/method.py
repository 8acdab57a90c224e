"""Ray methods by name: each is a dataclass of options that traces itself into a kernel.

A method's options split into *structure*, which shapes the kernel (and so its cache key), and *uniforms*, numbers that
change without recompiling. A new method is one new file with a ``@register``-ed class, and one row of ``HOMES``.
"""

from __future__ import annotations

import dataclasses
import importlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from zeroset.errors import MethodError, nearest_names
from zeroset.kernel.types import F32

if TYPE_CHECKING:
    from zeroset.kernel import Value
    from zeroset.solve.field import Field
    from zeroset.solve.problem import Answer, Problem
    from zeroset.solve.shape import Shape

HOMES = {
    "auto": "auto",
    "affine": "bisection",
    "interval": "bisection",
    "analytic": "analytic",
    "mitchell": "mitchell",
    "mitchell-exact": "exact",
    "marching-points": "sampling",
    "adaptive-marching-points": "sampling",
}
"""The file of each method, in the order in which they are listed; it is imported when the method is asked for."""


LARGEST = 1e30
"""Size of the numbers among a method's options: they are f32 in kernels."""


def uniform(default: float) -> Any:
    """A method option that is a uniform: changing it does not recompile."""
    return field(default=default, metadata={"uniform": True})


@dataclass(frozen=True)
class Method:
    """Base of every ray method.

    Attributes:
        offset: draw f = offset instead of f = 0 (SN10 figure 6); any method.
    """

    name: ClassVar[str] = ""
    certified: ClassVar[bool] = False
    enclosing: ClassVar[bool] = False
    """Whether it works by enclosures of f alone, and so on isovalues and solids as well."""
    summary: ClassVar[str] = ""

    offset: float = uniform(0.0)

    def __post_init__(self) -> None:
        for item in dataclasses.fields(self):
            value = getattr(self, item.name)
            if item.metadata.get("uniform") and not (isinstance(value, (int, float)) and abs(value) <= LARGEST):
                raise MethodError(f"{self.name}: {item.name} must be a finite number, up to {LARGEST:g}, not {value!r}")
            if isinstance(item.default, bool) and not isinstance(value, bool):
                raise MethodError(f"{self.name}: {item.name} must be True or False, not {value!r}")

    def structure(self) -> str:
        """What shapes the kernel: the name and the options that are no uniforms."""
        fixed = {f.name: getattr(self, f.name) for f in dataclasses.fields(self) if not f.metadata.get("uniform")}
        return f"{self.name} {fixed} offset={self.offset != 0.0}"

    def uniforms(self) -> dict[str, float]:
        """Values of the options that are uniforms, by the name that the kernel knows them by; the offset is no such."""
        named = {f.name: float(getattr(self, f.name)) for f in dataclasses.fields(self) if f.metadata.get("uniform")}
        return {f"m_{key}": value for key, value in named.items() if key != "offset"}

    def option(self, problem: Problem, name: str) -> Value:
        """The uniform of one option, while tracing."""
        return problem.lowered.builder.uniform(f"m_{name}", F32).convert(problem.type)

    def check(self, field: Field) -> None:
        """Raise ``MethodError`` where the method cannot treat this field."""

    def check_shape(self, shape: Shape) -> None:
        """Raise ``MethodError`` where the method cannot treat one of a shape's bodies."""
        for body in shape.bodies:
            if not body.plain and not self.enclosing:
                what = "several isovalues" if body.levels else "solids"
                raise MethodError(f"{self.name} cannot treat {what}", hint="'auto', 'affine' and 'interval' can")
            for leaf, _ in body.leaves:
                self.check(leaf.field)

    def trace(self, problem: Problem) -> Answer:
        """Emit the search for the first root into the kernel being traced."""
        raise NotImplementedError


M = TypeVar("M", bound=type[Method])

_known: dict[str, type[Method]] = {}


def register(cls: M) -> M:
    """Class decorator: make a method known by its name."""
    _known[cls.name] = cls
    return cls


class _Methods(Mapping[str, type[Method]]):
    """All methods by name, each imported when it is asked for."""

    def __getitem__(self, name: str) -> type[Method]:
        importlib.import_module(f"zeroset.solve.{HOMES[name]}")
        return _known[name]

    def __iter__(self) -> Iterator[str]:
        return iter(HOMES)

    def __len__(self) -> int:
        return len(HOMES)


METHODS: Mapping[str, type[Method]] = _Methods()


def resolve_method(method: str | Method) -> Method:
    """A method from its name or an instance with options; raises ``MethodError`` with the nearest names."""
    if isinstance(method, Method):
        return method
    if isinstance(method, type) and issubclass(method, Method):
        return method()
    known = METHODS.get(str(method))
    if known is None:
        near = nearest_names(str(method), METHODS)
        raise MethodError(
            f"there is no method {method!r}",
            hints=([f"did you mean {near[0]!r}?"] if near else []) + [f"the methods are {', '.join(METHODS)}"],
        )
    return known()
