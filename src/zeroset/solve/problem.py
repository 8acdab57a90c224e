"""What every ray method is given and what it gives back, as Values of the kernel being traced.

A ``Problem`` is one lane's ray with the stretch of t to search; an ``Answer`` is what the lane found. Statuses are the
public ones: MISS (proven, for a certified method), HIT (a sign change is proven in an interval no wider than the
tolerance, nothing before it) and UNRESOLVED (an interval no wider than the tolerance that can be neither excluded nor
shown to hold a sign change).
"""

from __future__ import annotations

from typing import NamedTuple

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.arith import Format
from zeroset.kernel import F32, F64, Scalar, Type, Value, constant, lift
from zeroset.solve.body import LoweredBody
from zeroset.solve.field import Field, Lowered, Ray
from zeroset.solve.shape import Body, has_unions, leaves_of


class Problem(NamedTuple):
    """One lane's search for the first root of f along its ray.

    Attributes:
        lowered: f, ready to be evaluated on any number system.
        ray: origin and direction.
        t0: start of the stretch inside the bounds.
        t1: its end; the ray misses the bounds where ``t1 <= t0``.
        tolerance: in units of t, at least a few units in the last place of t.
        step: a first guess of a step that might be free of roots.
        body: what is searched where that is more than one f = 0: isovalues, a solid; ``lowered`` is then its first f.
        strict: whether what f does next to a place where it jumps or has no value must be known, too. Who draws takes
            it for nothing if f has the same sign on either side.
        asked: the tolerance that was asked for, in units of t; None where it is the one above.
    """

    lowered: Lowered
    ray: Ray
    t0: Value
    t1: Value
    tolerance: Value
    step: Value
    body: LoweredBody | None = None
    strict: bool = False
    asked: Value | None = None

    @property
    def hazy(self) -> bool:
        """Whether there may be places that are passed over because f jumps or has no value there."""
        return not (self.strict or self.field.continuous)

    @property
    def field(self) -> Field | Body:
        """What is searched, for those who choose a number system for it."""
        return self.lowered.field if self.body is None else self.body.body

    @property
    def levels(self) -> int:
        """How many isovalues there are; 0 where there are none."""
        return 0 if self.body is None else self.body.body.levels

    @property
    def first_part_bit(self) -> int:
        """The bit of the body's first part."""
        return 1 if self.body is None else 1 << self.body.body.leaves[0][0].part

    @property
    def orientations(self) -> tuple[int, int]:
        """The bits of a solid's parts that are in it as they are, and of those that are taken off; one may be both."""
        leaves = () if self.body is None or self.levels else leaves_of(self.body.body.tree)
        direct = taken = 0
        for leaf, sign in leaves:
            direct, taken = (direct | leaf.bits, taken) if sign > 0 else (direct, taken | leaf.bits)
        return direct, taken

    @property
    def shares_faces(self) -> bool:
        """Whether faces that two parts of a solid share are passed over: in pictures, where f64 has looked closely."""
        if self.type != F64 or self.strict or self.body is None or self.levels:
            return False
        return self.orientations[1] != 0 or has_unions(self.body.body.tree)

    @property
    def type(self) -> Type:
        """The scalar type that the search runs in."""
        return self.t0.type

    @property
    def fmt(self) -> Format:
        """Its format, for number systems."""
        return FORMAT32 if self.type == F32 else FORMAT64

    def number(self, value: float) -> Value:
        """A constant of the search's type."""
        return constant(value, self.type)

    def lift(self, value: Scalar) -> Value:
        """A Value as it is, a Python number as a constant: numbers of a system may hold either."""
        return lift(value, self.type)


class Answer(NamedTuple):
    """What a lane found.

    Attributes:
        t: where; meaningless on a miss.
        status: MISS, HIT or UNRESOLVED, u32.
        steps: evaluations spent, u32.
        clear: of a certified method that found something: there is certainly no root between the start and here.
        side: the certain sign of f where the ray comes from, just before t; 0 where it is not known.
        end: what was found is behind the ray here, and the search for what comes next may go on.
        mark: the parts that it can be of, as bits; None where there is but one.
        blunt: whether f was too flat there for its slope to prove the root: its sign around a whole tolerance did; None
            where the method does not tell.
    """

    t: Value
    status: Value
    steps: Value
    clear: Value
    side: Value
    end: Value
    mark: Value | None = None
    blunt: Value | None = None
