"""K09's two certified methods: an enclosure of f, and a bisection of the ray.

``interval`` and ``affine`` bisect t without a stack (K09 section 5.5) or the dominant axis (section 4.2), as the paper
does. Like ``auto`` they share ``search.py`` and prove what they answer.

What tracing needs is imported where it is traced: a picture whose kernels come from the cache never loads it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from zeroset.errors import MethodError
from zeroset.solve.method import Method, register, uniform

if TYPE_CHECKING:
    from zeroset.arith import Format
    from zeroset.solve.problem import Answer, Problem
    from zeroset.solve.walk import Walk


@dataclass(frozen=True)
class _Bisection(Method):
    """Options shared by K09's two methods.

    Attributes:
        axis: ``"t"`` bisects the ray parameter, ``"k"`` the dominant axis.
        delta: where above 0, bisection goes on until f itself is enclosed to this width (K09 section 6.1.2).
    """

    certified: ClassVar[bool] = True
    enclosing: ClassVar[bool] = True

    axis: str = "t"
    delta: float = uniform(0.0)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.axis not in ("t", "k"):
            raise MethodError(f"{self.name}: axis must be 't' or 'k', not {self.axis!r}")
        if self.delta < 0:
            raise MethodError(f"{self.name}: delta must be 0 or more, not {self.delta!r}")

    def system(self, fmt: Format) -> Any:
        """The number system that encloses f."""
        raise NotImplementedError

    def trace(self, problem: Problem) -> Answer:
        """Emit the search for the first root."""
        from zeroset.solve.search import search
        from zeroset.solve.walk import AxisBisecting, Bisecting

        walk: Walk = AxisBisecting() if self.axis == "k" else Bisecting()
        return search(problem, self.system(problem.fmt), walk, delta=self.option(problem, "delta"))


@register
@dataclass(frozen=True)
class Interval(_Bisection):
    """K09's interval bisection: the plain interval extension of f."""

    name: ClassVar[str] = "interval"
    summary: ClassVar[str] = "interval arithmetic, bisecting t or the dominant axis (K09 4.2, 5.5)"

    def system(self, fmt: Format) -> Any:
        """The number system that encloses f."""
        from zeroset.arith import IntervalSystem

        return IntervalSystem(fmt)


@register
@dataclass(frozen=True)
class Affine(_Bisection):
    """K09's reduced affine bisection, with affine extensions of every operation."""

    name: ClassVar[str] = "affine"
    summary: ClassVar[str] = "reduced affine arithmetic, bisecting t or the dominant axis (K09 3.3, 5.3, 5.5)"

    def system(self, fmt: Format) -> Any:
        """The number system that encloses f."""
        from zeroset.arith import AffineSystem

        return AffineSystem(fmt, symbols=1)
