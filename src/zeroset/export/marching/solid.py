"""What is meshed, inside kernels: f, and the bounds with it where the mesh is to be closed at them.

A ball is a function of its own, g <= 0 inside. A capped mesh is the skin of the solid max(f, g) <= 0. An open mesh is
that of f alone, cut at the ball afterwards: a gap between the surface and the ball that is thinner than a cell must not
take the surface with it. A box needs no function, for the lattice ends at its faces.
"""

from __future__ import annotations

from collections.abc import Sequence

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.arith import DualSystem, RealSystem
from zeroset.kernel import BOOL, F32, KernelBuilder, Type, Value, constant, lift
from zeroset.scene.bounds import NAMES
from zeroset.solve.field import Field, Lowered

Point = Sequence[Value]
LARGE = 1e30
"""Values of f are cut off here: larger ones are no nearer to a zero."""


class Solid:
    """f and the bounds in one kernel.

    Args:
        field: f.
        builder: the kernel being traced.
        kind: of the bounds, ``ball`` or ``box``.
        capped: whether the mesh is to be closed at them.
        type_: scalar type of the evaluation.
    """

    def __init__(self, field: Field, builder: KernelBuilder, kind: str, capped: bool, type_: Type) -> None:
        self.capped = capped
        self.type = type_
        self.lowered = Lowered(field, builder, type_)
        self.real = RealSystem(FORMAT32 if type_ == F32 else FORMAT64)
        self._ball = [builder.uniform(name, F32).convert(type_) for name in NAMES[:4]] if kind == "ball" else None

    def surface(self, point: Point) -> tuple[Value, Value]:
        """f at a point, and whether it is defined there."""
        f = self.lowered.evaluate(self.real, *map(self.real.exact, point))
        value, defined = lift(f.value, self.type), f.defined
        defined = defined if isinstance(defined, Value) else constant(defined, BOOL)
        return value.minimum(LARGE).maximum(-LARGE), defined & value.eq(value)

    def bounds(self, point: Point) -> Value | None:
        """g at a point: nearly the distance from the ball; None for a box."""
        if self._ball is None:
            return None
        *center, radius = self._ball
        square = sum(((p - c) * (p - c) for p, c in zip(point, center, strict=True)), start=-(radius * radius))
        return square * (0.5 / radius)

    @property
    def radius(self) -> Value:
        """The ball's."""
        assert self._ball is not None
        return self._ball[3]

    def value(self, point: Point) -> tuple[Value, Value]:
        """The function that is meshed at a point, and whether it is defined there."""
        f, defined = self.surface(point)
        g = self.bounds(point) if self.capped else None
        return (f if g is None else f.maximum(g)), defined

    def outward(self, point: Point) -> tuple[Value, ...]:
        """The direction away from the ball's centre, not normalised."""
        assert self._ball is not None
        return tuple(p - c for p, c in zip(point, self._ball[:3], strict=True))

    def slope(self, point: Point) -> tuple[Value, tuple[Value, ...]]:
        """f and its gradient at a point."""
        dual = DualSystem(self.real, 3)
        f = self.lowered.evaluate(dual, *(dual.variable(self.real.exact(p), i) for i, p in enumerate(point)))
        return lift(f.value.value, self.type), tuple(lift(f.derivative(i).value, self.type) for i in range(3))


def dot(a: Point, b: Point) -> Value:
    """The scalar product."""
    return a[0].fma(b[0], a[1].fma(b[1], a[2] * b[2]))


def unit(vector: Point) -> tuple[Value, Value, Value]:
    """A vector of length 1; zero for one that is too short or too long to have a direction."""
    # By the largest component first: squares of large or small ones would overflow or vanish.
    largest = abs(vector[0]).maximum(abs(vector[1])).maximum(abs(vector[2]))
    usable = (largest > 1e-30) & (largest < LARGE)
    scale = 1.0 / usable.select(largest, 1.0)
    x, y, z = (usable.select(v * scale, 0.0) for v in vector)
    inverse = 1.0 / dot((x, y, z), (x, y, z)).maximum(1e-10).sqrt()
    return x * inverse, y * inverse, z * inverse
