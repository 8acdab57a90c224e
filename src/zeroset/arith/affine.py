"""Reduced affine arithmetic: a real as centre + terms times shared symbols in [-1, 1] + one error.

AF1 of Messine as Knoll et al. 2009 use it (section 3.3.2 and eq. 15; doi:10.1111/j.1467-8659.2008.01189.x), with one
symbol for a ray or three for a beam; squares are tight, division and the elementary functions are affine too
(``linearise``), and rounding is carried in the error through the account of ``budget``. With ``intersect`` an
interval goes along, and the range is the meet of both (Gamito & Maddock 2007).
"""

from __future__ import annotations

from zeroset.arith import affine_arithmetic as arithmetic
from zeroset.arith import affine_choice as choice
from zeroset.arith import affine_functions as functions
from zeroset.arith import contraction
from zeroset.arith.affine_form import Form, FormSystem
from zeroset.arith.budget import Budget, quanta, repaid
from zeroset.arith.contraction import Contraction
from zeroset.arith.flags import Flags
from zeroset.arith.format import Format
from zeroset.arith.interval import Interval, IntervalSystem
from zeroset.arith.scalar import Scalar, is_zero, maximum, sub

__all__ = ["Affine", "AffineSystem"]


class Affine(Form):
    """c + u_1 e_1 + ... + u_n e_n, within ``error``; ``Form`` tells of its attributes.

    Example:
        >>> from zeroset.arith import F64, AffineSystem
        >>> system = AffineSystem(F64)
        >>> t = system.symbol(0, 0.5, 0.25)  # 0.5 + 0.25 e
        >>> bool((t.sqr() - t + 1.0).contains_zero()), bool((t.sqr() - 0.25).contains_zero())
        (False, True)
    """

    __slots__ = ()

    _system: AffineSystem

    def __repr__(self) -> str:
        return f"Affine({self.centre!r}, {self.terms!r}, {self.error!r})"

    @property
    def system(self) -> AffineSystem:
        """The system that made this number."""
        return self._system

    def contract(self, symbol: int = 0) -> Contraction:
        """Where along one symbol f can be 0, and whether it certainly changes sign; see ``Contraction``."""
        return contraction.contract(self, symbol)

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


class AffineSystem(FormSystem[Affine]):
    """Makes affine forms.

    Args:
        fmt: format of the scalars.
        symbols: how many shared symbols a form has: 1 for a ray, 3 for a beam.
        intersect: whether an interval goes along with each form.
        curved: whether a form keeps T2 of its last symbol too, as one more term; see ``affine_curved``.

    Attributes:
        symbols: as given.
        intersect: as given.
        curved: as given.
        width: how many terms a form has.
        intervals: the system of the ranges.
    """

    def __init__(self, fmt: Format, symbols: int = 1, intersect: bool = False, curved: bool = False) -> None:
        self._fmt = fmt
        self.symbols = symbols
        self.intersect = intersect
        self.curved = curved
        self.width = symbols + curved
        self.intervals = IntervalSystem(fmt)

    @property
    def fmt(self) -> Format:
        """The floating-point format of the scalars."""
        return self._fmt

    def constant(self, lo: float, hi: float) -> Affine:
        """The middle of [lo, hi], rounded, with what that leaves as error."""
        middle = self._fmt.round(0.5 * lo + 0.5 * hi)
        if max(-lo, hi) > 0.5 * self._fmt.big:
            endless = self.form(middle, (0.0,) * self.width, 2.0 * self._fmt.big)
            return self._with_bounds(endless, self.intervals.constant(lo, hi)).watched()
        widest = max(sub(self._fmt.up(hi), middle), sub(middle, self._fmt.down(lo)))
        error = 0.0 if lo == hi == middle else self._fmt.up(widest)
        return self._with_bounds(self.form(middle, (0.0,) * self.width, error), self.intervals.constant(lo, hi))

    def exact(self, value: Scalar) -> Affine:
        """A run-time scalar without error."""
        return self.form(value, (0.0,) * self.width)

    def enclose(self, value: Scalar, error: Scalar) -> Affine:
        """A run-time scalar with its error."""
        if is_zero(error):
            return self.exact(value)
        form = self.form(value, (0.0,) * self.width, error)
        return self._with_bounds(form, self.intervals.enclose(value, error))

    def symbol(self, index: int, centre: Scalar, radius: Scalar) -> Affine:
        """centre + radius * e_index, exactly; index counts from 0."""
        return self.form(centre, tuple(radius if i == index else 0.0 for i in range(self.width)))

    def form(self, centre: Scalar, terms: tuple[Scalar, ...], error: Scalar = 0.0) -> Affine:
        """centre + sum terms_i e_i within ``error``, all taken as exact."""
        return Affine(self, centre, terms, error)

    def from_interval(self, interval: Interval) -> Affine:
        """The form without terms that holds an interval."""
        fmt, lo, hi = self._fmt, interval.lo, interval.hi
        if lo is hi:
            form = self.form(lo, (0.0,) * self.width)
        else:
            centre = 0.5 * lo + 0.5 * hi
            error = maximum(hi - centre, centre - lo) + fmt.tiny
            form = self.form(centre, (0.0,) * self.width, error)
            form.budget = Budget(slack=0.9 * quanta(fmt), depth=2)
        form.flags = interval.flags
        return self._with_bounds(form, interval)

    def _with_bounds(self, form: Affine, bounds: Interval) -> Affine:
        form.bounds = bounds if self.intersect else None
        return form

    def general(self, number: Affine) -> Affine:
        """The form with its error repaid and its account empty."""
        error = repaid(self._fmt, number.error, number.budget.depth)
        bounds = number.interval() if self.intersect else None
        return Affine(self, number.centre, number.terms, error, Budget(), number.flags, bounds)

    def components(self, number: Affine) -> list[Scalar]:
        """centre, terms, error, with an interval its bounds too, defined, empty."""
        bounds = [] if number.bounds is None else [number.bounds.lo, number.bounds.hi]
        return [number.centre, *number.terms, number.error, *bounds, number.defined, number.empty]

    def rebuild(self, components: list[Scalar]) -> Affine:
        """The form of these components."""
        n = self.width
        flags = Flags(components[-2], components[-1], large=True)
        bounds = Interval(self.intervals, components[n + 2], components[n + 3], flags) if self.intersect else None
        return Affine(self, components[0], tuple(components[1 : n + 1]), components[n + 1], Budget(), flags, bounds)
