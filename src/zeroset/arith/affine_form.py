"""What an affine form is: centre, terms, error and account, its range and its sign, without the operators.

Those are functions (``affine_arithmetic``, ``affine_choice``, ``affine_functions``) that take such numbers and give one
of the same kind, ``F``; ``affine`` makes them its methods.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, Self, TypeVar

from zeroset.arith.budget import MARGIN, Budget, repaid
from zeroset.arith.flags import TOTAL, Flags
from zeroset.arith.format import Format
from zeroset.arith.interval import Interval, IntervalSystem
from zeroset.arith.number import Number, System
from zeroset.arith.rounding import clamp
from zeroset.arith.scalar import (
    Mask,
    Scalar,
    absolute,
    add,
    fma,
    gt,
    is_literal,
    is_zero,
    le,
    lt,
    maximum,
    minimum,
    mul,
    not_,
    or_,
    select,
    sub,
)  # fmt: skip

__all__ = ["F", "Form", "FormSystem"]


class Form(Number):
    """c + u_1 e_1 + ... + u_n e_n, within ``error``.

    Attributes:
        centre: c, a scalar.
        terms: u_1 ... u_n, scalars; a literal 0 where a symbol does not occur.
        error: bound of everything else, before the repayment that ``budget`` asks for; literal 0 when exact.
        budget: the rounding account.
        flags: where f is defined on the box.
        bounds: an interval that holds f too, or None.
        nonnegative: whether f >= 0 is known while tracing. The form itself may reach below 0, by its error; the range
            does not, so that a root of a sum of squares is defined everywhere.
    """

    __slots__ = ("_system", "bounds", "budget", "centre", "error", "flags", "nonnegative", "terms")

    def __init__(
        self,
        system: FormSystem[Any],
        centre: Scalar,
        terms: tuple[Scalar, ...],
        error: Scalar,
        budget: Budget | None = None,
        flags: Flags = TOTAL,
        bounds: Interval | None = None,
        nonnegative: bool = False,
    ) -> None:
        self._system = system
        self.centre = centre
        self.terms = terms
        self.error = error
        self.budget = Budget() if budget is None else budget
        self.flags = flags
        self.bounds = bounds
        self.nonnegative = nonnegative

    @property
    def system(self) -> FormSystem[Self]:
        """The system that made this number."""
        return self._system

    @property
    def fmt(self) -> Format:
        """The floating-point format of the scalars."""
        return self._system.fmt

    @property
    def defined(self) -> Mask:
        """Whether f is certainly defined and continuous on the whole box."""
        return self.flags.defined

    @property
    def empty(self) -> Mask:
        """Whether f is certainly defined nowhere on the box."""
        return self.flags.empty

    @property
    def is_scalar(self) -> bool:
        """Whether this is exactly its centre, as known while tracing."""
        return is_zero(self.error) and all(is_zero(u) for u in self.terms)

    @property
    def is_constant(self) -> bool:
        """Whether this is known while tracing altogether."""
        return is_literal(self.centre, self.error) and all(is_zero(u) for u in self.terms)

    @property
    def is_nonnegative(self) -> bool:
        """Whether f >= 0 is known while tracing, for constants by their value."""
        return self.nonnegative or (self.is_constant and bool(self.centre >= 2 * self.error))

    def knowing(self, nonnegative: bool) -> Self:
        """This form, perhaps with the knowledge that what it stands for is not negative."""
        if not nonnegative or self.nonnegative:
            return self
        return type(self)(
            self._system, self.centre, self.terms, self.error, self.budget, self.flags, self.bounds, nonnegative=True
        )

    def radius(self) -> Scalar:
        """sum |u_i| + error, before repayment."""
        total = self.error
        for term in self.terms:
            total = add(absolute(term), total)
        return total

    def endless(self) -> Mask:
        """Whether values may pass ``big``, or come so near that rounding may tell."""
        return not_(lt(add(absolute(self.centre), self.radius()), 0.5 * self.fmt.big))

    def endless_where(self, mask: Mask) -> Self:
        """This form, which claims nothing where the mask says so."""
        error = select(mask, add(absolute(self.centre), self.fmt.big), self.error, like=self.centre)
        return self.make(self.centre, self.terms, error, self.budget, bounds=self.bounds)

    def watched(self) -> Self:
        """This form, of which sums and products see to it that none claims more than it may."""
        bounds = None if self.bounds is None else self.bounds.watched()
        form = self.make(self.centre, self.terms, self.error, self.budget, self.flags.growing(), bounds)
        return form.knowing(self.nonnegative)

    def reach(self) -> Scalar:
        """How far the number may be from its centre: the radius with the roundings of its arithmetic repaid."""
        return repaid(self.fmt, self.radius(), self.budget.depth + len(self.terms))

    def _reaches(self) -> tuple[Scalar, Scalar]:
        """How far the number may be below and above its centre, before repayment: a bend lifts one of the two."""
        plain = self.radius()
        if not self._system.curved or is_zero(self.terms[-1]):
            return plain, plain
        *others, line, bend = self.terms
        lifted = _bend_reach(line, bend)
        for rest in (*others, self.error):
            lifted = add(absolute(rest), lifted)
        up = gt(bend, 0.0)
        return select(up, lifted, plain), select(up, plain, lifted)

    def form_range(self) -> tuple[Scalar, Scalar]:
        """Bounds from the form alone, ``interval`` without the interval that goes along."""
        if self.is_scalar:
            return self.centre, self.centre
        below, above = self._reaches()
        depth = self.budget.depth + len(self.terms) + (2 if self._system.curved else 0)
        if self.budget.credit < MARGIN or self.budget.slack < 4:
            # Pays for the two roundings below: a share of |c|, and one of the radius by way of its depth.
            below, above = (
                fma(absolute(self.centre), 2 * self.fmt.eps, repaid(self.fmt, reach, depth + 3) + self.fmt.tiny)
                for reach in (below, above)
            )
        else:
            below, above = (repaid(self.fmt, reach, depth) for reach in (below, above))
        # clamp keeps its second operand for a NaN, which makes a form that overflowed the whole line.
        low, high = sub(self.centre, below), add(self.centre, above)
        if all(is_zero(u) for u in self.terms) and not is_literal(self.error):
            # A parameter that is stored exactly may be the end of a domain, or where something jumps.
            inexact = not_(le(self.error, 0.0))
            low, high = select(inexact, low, self.centre), select(inexact, high, self.centre)
        big = self.fmt.big
        return clamp(self.fmt, low), maximum(minimum(high, big), -big)

    def interval(self) -> Interval:
        """The range, as an interval."""
        low, high = self.form_range()
        if self.is_nonnegative:
            low, high = maximum(low, 0.0), maximum(high, 0.0)
        form = Interval(self._system.intervals, low, high, self.flags, self.is_nonnegative)
        return form if self.bounds is None else self.bounds.meet(form)

    def contains_zero(self) -> Mask:
        """False only where f certainly has no zero; true for a form that overflowed."""
        if self._system.curved or self.bounds is not None:
            excluded = or_(*self.signs(), self.empty)
            return not_(excluded if self.bounds is None else or_(excluded, self.bounds.empty))
        # The same in fewer operations.
        return not_(or_(gt(absolute(self.centre), self.reach()), self.empty))

    def signs(self) -> tuple[Mask, Mask]:
        """Whether f is certainly above 0, and whether it is certainly below.

        The ends of ``interval`` are rounded once more, and may not tell where these do.
        """
        if self._system.curved:
            low, high = self.form_range()
            above, below = gt(low, 0.0), lt(high, 0.0)
        else:
            reach = self.reach()
            above, below = gt(self.centre, reach), lt(self.centre, -reach)
        if self.bounds is None:
            return above, below
        more, less = self.bounds.signs()
        return or_(above, more), or_(below, less)

    def make(
        self,
        centre: Scalar,
        terms: tuple[Scalar, ...],
        error: Scalar,
        budget: Budget,
        flags: Flags | None = None,
        bounds: Interval | None = None,
    ) -> Self:
        """A number of the same system, by default with the same flags."""
        return type(self)(self._system, centre, terms, error, budget, self.flags if flags is None else flags, bounds)

    def within(self, bounds: Interval | None) -> Self:
        """This form with another interval that holds the same function, where the system keeps intervals."""
        if bounds is None or not self._system.intersect:
            return self
        return self.make(self.centre, self.terms, self.error, self.budget, bounds=bounds)


def _bend_reach(line: Scalar, bend: Scalar) -> Scalar:
    """How far line * e + |bend| T2(e) may be below 0 for e in [-1, 1].

    T2 is convex: it lies above its tangents at 0, at 1/2 and at 1, the first of which is the plain sum.
    """
    steep, size = (term if is_zero(term) else absolute(term) for term in (line, bend))
    at_half = sub(maximum(steep, mul(size, 2.0)), mul(size, 0.5))
    at_one = sub(maximum(steep, mul(size, 4.0)), size)
    return minimum(add(steep, size), minimum(at_half, at_one))


F = TypeVar("F", bound=Form)
"""The kind of form that an operator is given, and gives."""


class FormSystem(System[F]):
    """What a form asks of the system that made it.

    Attributes:
        intersect: whether an interval goes along with each form.
        curved: whether a form keeps T2 of its last symbol too, as one more term; see ``affine_curved``.
        intervals: the system of the ranges.
    """

    intersect: bool
    curved: bool
    intervals: IntervalSystem

    @abstractmethod
    def from_interval(self, interval: Interval) -> F:
        """The form without terms that holds an interval."""
