"""Reduced affine arithmetic: a real as centre + terms times shared symbols in [-1, 1] + one error.

AF1 of Messine as Knoll et al. 2009 use it (section 3.3.2 and eq. 15; doi:10.1111/j.1467-8659.2008.01189.x), with one
symbol for a ray or three for a beam; squares are tight, division and the elementary functions are affine too
(``linearise``), and rounding is carried in the error through the account of ``budget``. With ``intersect`` an
interval goes along, and the range is the meet of both (Gamito & Maddock 2007).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.arith import affine_arithmetic as arithmetic
from zeroset.arith import affine_choice as choice
from zeroset.arith import affine_functions as functions
from zeroset.arith import contraction
from zeroset.arith.affine_curved import bend_reach
from zeroset.arith.budget import MARGIN, Budget, repaid
from zeroset.arith.contraction import Contraction
from zeroset.arith.flags import TOTAL, Flags
from zeroset.arith.format import Format
from zeroset.arith.interval import Interval
from zeroset.arith.number import Number
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
    lt,
    maximum,
    minimum,
    not_,
    or_,
    select,
    sub,
)  # fmt: skip

if TYPE_CHECKING:
    from zeroset.arith.affine_system import AffineSystem

__all__ = ["Affine", "Contraction"]


class Affine(Number):
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

    Example:
        >>> from zeroset.arith import F64, AffineSystem
        >>> system = AffineSystem(F64)
        >>> t = system.symbol(0, 0.5, 0.25)  # 0.5 + 0.25 e
        >>> bool((t.sqr() - t + 1.0).contains_zero()), bool((t.sqr() - 0.25).contains_zero())
        (False, True)
    """

    __slots__ = ("_system", "bounds", "budget", "centre", "error", "flags", "nonnegative", "terms")

    def __init__(
        self,
        system: AffineSystem,
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

    def __repr__(self) -> str:
        return f"Affine({self.centre!r}, {self.terms!r}, {self.error!r})"

    @property
    def system(self) -> AffineSystem:
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

    def knowing(self, nonnegative: bool) -> Affine:
        """This form, perhaps with the knowledge that what it stands for is not negative."""
        if not nonnegative or self.nonnegative:
            return self
        return Affine(
            self._system, self.centre, self.terms, self.error, self.budget, self.flags, self.bounds, nonnegative=True
        )

    def radius(self) -> Scalar:
        """sum |u_i| + error, before repayment."""
        total = self.error
        for term in self.terms:
            total = add(absolute(term), total)
        return total

    def reach(self) -> Scalar:
        """How far the number may be from its centre: the radius with the roundings of its arithmetic repaid."""
        return repaid(self.fmt, self.radius(), self.budget.depth + len(self.terms))

    def _reaches(self) -> tuple[Scalar, Scalar]:
        """How far the number may be below and above its centre, before repayment: a bend lifts one of the two."""
        plain = self.radius()
        if not self._system.curved or is_zero(self.terms[-1]):
            return plain, plain
        *others, line, bend = self.terms
        lifted = bend_reach(line, bend)
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

    def contract(self, symbol: int = 0) -> Contraction:
        """Where along one symbol f can be 0, and whether it certainly changes sign; see ``Contraction``."""
        return contraction.contract(self, symbol)

    def make(
        self,
        centre: Scalar,
        terms: tuple[Scalar, ...],
        error: Scalar,
        budget: Budget,
        flags: Flags | None = None,
        bounds: Interval | None = None,
    ) -> Affine:
        """A number of the same system, by default with the same flags."""
        return Affine(self._system, centre, terms, error, budget, self.flags if flags is None else flags, bounds)

    def within(self, bounds: Interval | None) -> Affine:
        """This form with another interval that holds the same function, where the system keeps intervals."""
        if bounds is None or not self._system.intersect:
            return self
        return self.make(self.centre, self.terms, self.error, self.budget, bounds=bounds)

    def add(self, other: Affine, /) -> Affine:
        """The sum."""
        return arithmetic.add(self, other).knowing(self.is_nonnegative and other.is_nonnegative)

    def mul(self, other: Affine, /) -> Affine:
        """The product."""
        return arithmetic.mul(self, other).knowing(self.is_nonnegative and other.is_nonnegative)

    def sqr(self) -> Affine:
        """The square."""
        return arithmetic.sqr(self).knowing(True)

    def powi(self, n: int, /) -> Affine:
        """A whole power."""
        return arithmetic.powi(self, n).knowing(n % 2 == 0 or self.is_nonnegative)

    def abs(self) -> Affine:
        """The absolute value."""
        return choice.absolute(self).knowing(True)

    def max(self, other: Affine, /) -> Affine:
        """The larger of two."""
        return choice.larger(self, other).knowing(self.is_nonnegative or other.is_nonnegative)

    def min(self, other: Affine, /) -> Affine:
        """The smaller of two."""
        return choice.smaller(self, other).knowing(self.is_nonnegative and other.is_nonnegative)

    def powr(self, exponent: tuple[int, int], /) -> Affine:
        """A rational power."""
        return functions.rational_power(self, exponent).knowing(True)

    def sqrt(self) -> Affine:
        """The square root."""
        return functions.sqrt(self).knowing(True)

    def exp(self) -> Affine:
        """The exponential function."""
        return functions.exp(self).knowing(True)

    sub = arithmetic.sub
    neg = arithmetic.neg
    div = functions.divide
    sign = choice.sign
    floor = choice.floor
    mod = choice.mod
    pow = functions.power
    cbrt = functions.cbrt
    log = functions.log
    sin = functions.sin
    cos = functions.cos
    tan = functions.tan
    asin = functions.asin
    acos = functions.acos
    atan = functions.atan
    atan2 = functions.atan2
    sinh = functions.sinh
    cosh = functions.cosh
    tanh = functions.tanh
    lt = choice.less
    le = choice.less_equal
