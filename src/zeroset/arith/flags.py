"""Where a function is defined, and whether it may be large: what every enclosing number carries beside its bounds.

``defined`` promises that f is defined and continuous on the whole box, which is what a proof of a root by a change of
sign needs; ``empty`` promises that f is defined nowhere on it. Both are literals wherever that is known while
tracing, and then cost nothing. ``large`` is always known while tracing: only where it is set do sums and products have
to look whether a bound stands at ``big``, which claims nothing, so that they do not make a claim of it.
"""

from __future__ import annotations

from typing import NamedTuple

from zeroset.arith.scalar import Mask, and_, not_, or_

__all__ = ["TOTAL", "Flags"]


class Flags(NamedTuple):
    """Domain knowledge about a function on a box.

    Attributes:
        defined: certainly defined and continuous on all of the box; literally True when it always is.
        empty: certainly defined nowhere on the box; literally False when it never is.
        large: whether values may pass ``big``, as those of an exponential or near a pole do.
    """

    defined: Mask = True
    empty: Mask = False
    large: bool = False

    @property
    def is_total(self) -> bool:
        """Whether f is defined everywhere, as known while tracing."""
        return self.defined is True and self.empty is False

    def growing(self) -> Flags:
        """These flags of what may be large."""
        return self if self.large else self._replace(large=True)

    def meet(self, *others: Flags) -> Flags:
        """Flags of an expression that uses all the operands."""
        large = self.large or any(o.large for o in others)
        return Flags(
            and_(self.defined, *(o.defined for o in others)), or_(self.empty, *(o.empty for o in others)), large
        )

    def within(self, defined: Mask, empty: Mask = False) -> Flags:
        """These flags on a part of the domain: also defined only where the mask says, also empty where it says."""
        return Flags(and_(self.defined, defined), or_(self.empty, empty), self.large)

    def choose(self, other: Flags, first: Mask, second: Mask) -> Flags:
        """Flags of "self where ``first``, other where ``second``", a jump being possible where neither is certain."""
        large = self.large or other.large
        if first is True:
            return self._replace(large=large)
        if second is True:
            return other._replace(large=large)
        undecided = not_(or_(first, second))
        return Flags(
            or_(and_(first, self.defined), and_(second, other.defined)),
            or_(and_(first, self.empty), and_(second, other.empty), and_(undecided, self.empty, other.empty)),
            large,
        )


TOTAL = Flags()
