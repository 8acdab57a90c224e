"""An expression as the field of a surface: what it asks for, what it costs, and its value on any number system."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from zeroset.errors import FormulaLimitError
from zeroset.expr import OPS, Expr, Magnitude, Settled, continuous, degree, evaluate, fraction, postorder, settled
from zeroset.scene.parameters import TIME

MOST_WORK = 4000
"""Operations up to which a formula is compiled, functions counted several times: about half a minute."""
_FUNCTION_WORK = 8


@dataclass(frozen=True)
class ExprField:
    """An expression as something to evaluate on any number system.

    Attributes:
        expr: the expression.
        large: whether its parts may pass the largest number that kernels know, so that every step has to look.
    """

    expr: Expr
    large: bool = False

    @property
    def digest(self) -> str:
        """Hash of the expression's structure."""
        return f"{self.expr.digest} large" if self.large else self.expr.digest

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
    def continuous(self) -> bool:
        """Whether f has no jumps, poles and ends of its domain where its parameters are positive."""
        return self.degree is not None or continuous(self.expr)

    @property
    def total(self) -> bool:
        """Whether f has a value everywhere, though it may jump."""
        return self.expr.is_total

    @cached_property
    def jumps(self) -> bool:
        """Whether f may jump for another reason than that it is divided by 0."""
        return any(OPS[part.op].jumps for part in postorder(self.expr))

    @cached_property
    def fraction(self) -> tuple[ExprField, ExprField] | None:
        """N and D of f = N/D; N vanishes where f does and is defined at poles. None where f divides by nothing."""
        parts = fraction(self.expr)
        return None if parts is None else (ExprField(parts[0], self.large), ExprField(parts[1], self.large))

    @cached_property
    def settled(self) -> Settled:
        """The expression without parts that parameters alone decide."""
        return settled(self.expr)

    @cached_property
    def remaining(self) -> ExprField:
        """What is left for kernels to calculate where those parts are calculated beforehand."""
        expr = self.settled.expr
        return self if expr is self.expr else ExprField(expr, self.large)

    @cached_property
    def watched(self) -> ExprField:
        """The same field, calculated with an eye on how large its parts get."""
        return ExprField(self.expr, large=True)

    @cached_property
    def magnitude(self) -> Magnitude:
        """Tells how large they may be."""
        return Magnitude(self.expr)

    @cached_property
    def work(self) -> int:
        """What compiling f costs, in arithmetic operations; functions and powers count for several."""
        return sum(_FUNCTION_WORK if OPS[part.op].kind == "function" else 1 for part in postorder(self.expr))

    def evaluate(self, system: Any, env: Any) -> Any:
        """f on numbers of ``system``."""
        return evaluate(self.expr, system, env)


def check_work(work: int) -> None:
    """Raise ``FormulaLimitError`` for so many operations that no compiler digests them while somebody waits."""
    if work > MOST_WORK:
        raise FormulaLimitError(
            f"the formula has too many operations to be drawn: {work:,} of at most {MOST_WORK:,}",
            hints=(
                "put repeated data (such as sphere centres) into an array parameter: sum(i, ... c[i] ...)",
                "draw parts of it as surfaces of their own",
            ),
        )
