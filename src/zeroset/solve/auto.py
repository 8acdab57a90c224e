"""The method that is used where none is asked for: an enclosure of f, and strides along the ray.

Each interval is cut to what the affine form leaves of it, which near a simple root squares the width each time. It
shares ``search.py`` with the methods of ``bisection.py`` and proves what it answers.

What tracing needs is imported where it is traced: a picture whose kernels come from the cache never loads it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from zeroset.solve.method import Method, register

if TYPE_CHECKING:
    from zeroset.solve.problem import Answer, Problem


@register
@dataclass(frozen=True)
class Auto(Method):
    """The default: strides with affine cuts; the interval is kept beside the form where that pays."""

    name: ClassVar[str] = "auto"
    certified: ClassVar[bool] = True
    enclosing: ClassVar[bool] = True
    summary: ClassVar[str] = "picks by degree and operators; always certified"

    def trace(self, problem: Problem) -> Answer:
        """Emit the search for the first root."""
        from zeroset.solve.search import search
        from zeroset.solve.systems import automatic_system
        from zeroset.solve.walk import Striding

        return search(problem, automatic_system(problem.field, problem.fmt), Striding())
