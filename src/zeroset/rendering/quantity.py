"""A quantity of one surface, computed in kernels at the point that a ray has met.

Derivatives are exact: dual numbers over plain ones for gradients, dual numbers over those for second derivatives. They
are taken in f64 where the device has it. ``measure`` asks for the quantity of the part that was met.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property, partial
from typing import NamedTuple

from zeroset.arith import F32 as FORMAT32
from zeroset.arith import F64 as FORMAT64
from zeroset.arith import Real, RealSystem
from zeroset.arith.derivatives import PAIRS, first_derivatives, second_derivatives
from zeroset.kernel import BOOL, F32, KernelBuilder, Value, constant, lift
from zeroset.rendering.tint import Source, Tint
from zeroset.shade.colormap import LARGEST, UNDEFINED
from zeroset.shade.curvature import gaussian, mean
from zeroset.shade.reflectance import dot
from zeroset.solve.field import Lowered, Ray

NEAR = 4.0
"""Tolerances by which a point may be moved to lie on the surface more closely."""
Vector = Sequence[Value]


class Met(NamedTuple):
    """What a ray has met.

    Attributes:
        ray: f32.
        t: where, f32.
        steps: evaluations that it took, u32.
        part: which part it is, u32, where there is more than one.
    """

    ray: Ray
    t: Value
    steps: Value
    part: Value | None = None

    def point(self) -> list[Value]:
        """The place, f32."""
        return [self.t.fma(d, o) for o, d in zip(self.ray.origin, self.ray.direction, strict=True)]


class Gauge:
    """One quantity of one surface inside one kernel.

    Args:
        builder: the kernel being traced; all values are made where the gauge is.
        offset: whether the method has one.
        tint: which quantity.
        source: of what.
    """

    def __init__(self, builder: KernelBuilder, offset: bool, tint: Tint, source: Source) -> None:
        self._builder = builder
        self._kind = tint.kind
        self._type = tint.type
        self._real = RealSystem(FORMAT32 if tint.type == F32 else FORMAT64)
        self._source = source
        self._offset = offset and tint.kind != "formula"

    @cached_property
    def _lowered(self) -> Lowered:
        """The formula where it is one, else f."""
        assert self._source.field is not None
        return Lowered(self._source.field, self._builder, self._type, self._offset, self._source.prefix)

    def at(self, met: Met) -> Value:
        """The value at what a ray has met, f32; ``UNDEFINED`` where it has none."""
        kinds: dict[str, Callable[[Met], tuple[Value, Value]]] = {
            "steps": lambda met: (met.steps.convert(F32), constant(True, BOOL)),
            "depth": self._depth,
            "gradient": self._gradient,
            "gaussian-curvature": partial(self._curvature, gaussian),
            "mean-curvature": partial(self._curvature, mean if self._source.sign > 0 else _turned_mean),
        }
        value, defined = kinds.get(self._kind, self._by_formula)(met)
        # A comparison that no NaN passes.
        usable = defined & (abs(value) <= LARGEST)
        return usable.select(value.convert(F32), UNDEFINED)

    def _depth(self, met: Met) -> tuple[Value, Value]:
        view = [self._builder.uniform(f"view_{axis}", F32) for axis in "xyz"]
        return dot(view, met.point()) - self._builder.uniform("view_start", F32), constant(True, BOOL)

    def _by_formula(self, met: Met) -> tuple[Value, Value]:
        found = self._lowered.evaluate(self._real, *map(self._real.exact, self._on_ray(met)))
        return lift(found.value, self._type), _all(found)

    def _gradient(self, met: Met) -> tuple[Value, Value]:
        _, g, defined = self._first(self._on_surface(met))
        scale = _scale(g)
        a = [x / scale for x in g]
        return dot(a, a).sqrt() * scale, defined

    def _curvature(self, formula: Callable[[Vector, Vector], Value], met: Met) -> tuple[Value, Value]:
        f, g, h = second_derivatives(self._real, self._lowered.evaluate, self._exact(self._on_surface(met)))
        first, second = self._values(g), self._values(h)
        # Curvatures are the same for any multiple of f; this one neither overflows nor vanishes.
        scale = _scale(first)
        first, second = [x / scale for x in first], [x / scale for x in second]
        slope = dot(first, first)
        bend = constant(0.0, self._type)
        for x, (i, j) in zip(second, PAIRS, strict=True):
            bend = bend + x * x * (1.0 if i == j else 2.0)
        # Where a step of the tolerance may turn the gradient about, the surface has no normal that could bend.
        length = self._builder.uniform("tolerance", F32).convert(self._type)
        steady = slope > bend * (length * length)
        safe = [steady.select(x, 1.0) for x in first]
        return formula(safe, second), steady & _all(f, *g, *h)

    # ------------------------------------------------- points and derivatives

    def _on_ray(self, met: Met) -> list[Value]:
        """Where the ray has met something, in the scalar type of the derivatives."""
        t, origin, direction = met.t, met.ray.origin, met.ray.direction
        type_ = self._type
        return [
            t.convert(type_).fma(d.convert(type_), o.convert(type_)) for o, d in zip(origin, direction, strict=True)
        ]

    def _on_surface(self, met: Met) -> list[Value]:
        """The same after one step of Newton's, along the gradient, where that is a short one."""
        point = self._on_ray(met)
        f, g, defined = self._first(point)
        scale = _scale(g)
        a = [x / scale for x in g]
        step = f / (scale * dot(a, a).maximum(1e-30))
        near = NEAR * self._builder.uniform("tolerance", F32).convert(self._type)
        short = defined & (abs(step) <= near)
        return [p - short.select(step * x, 0.0) for p, x in zip(point, a, strict=True)]

    def _first(self, point: Vector) -> tuple[Value, list[Value], Value]:
        """f, its gradient, and whether both exist."""
        f, g = first_derivatives(self._real, self._lowered.evaluate, self._exact(point))
        return lift(f.value, self._type), self._values(g), _all(f, *g)

    def _exact(self, point: Vector) -> list[Real]:
        return [self._real.exact(p) for p in point]

    def _values(self, numbers: Sequence[Real]) -> list[Value]:
        return [lift(n.value, self._type) for n in numbers]


def _turned_mean(g: Vector, h: Vector) -> Value:
    """The mean curvature of -f: of what is taken off a solid."""
    return lift(-mean(g, h), g[0].type)


def _scale(vector: Vector) -> Value:
    """The largest component's size; 1 for a vector that is zero, or nearly as small as numbers get."""
    largest = abs(vector[0]).maximum(abs(vector[1])).maximum(abs(vector[2]))
    return (largest > 1e-30).select(largest, 1.0)


def _all(*numbers: Real) -> Value:
    """Whether all of them are defined."""
    made = constant(True, BOOL)
    for n in numbers:
        if n.defined is not True:
            made = made & lift(n.defined, BOOL)
    return made
