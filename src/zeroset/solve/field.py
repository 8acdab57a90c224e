"""What a ray method sees of a surface: f, evaluated on any number system inside the kernel being traced.

``Field`` is all that the methods ask of a surface: something that can be evaluated on numbers. The expression DAG is
the first such thing; procedures and spline patches are later ones. ``Lowered`` binds a field to one kernel: its
parameters are uniforms (value and storage error), its array parameters buffers, its sums loops.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol

from zeroset.kernel import BOOL, F32, U32, Buffer, KernelBuilder, Type, Value, constant, for_, if_, lift, load
from zeroset.solve.names import OFFSET, array_names, length_name, parameter_names

Number = Any
"""A number of whichever system is being evaluated."""


class Field(Protocol):
    """A real function of x, y, z (and w) that can be evaluated on any number system."""

    @property
    def digest(self) -> str:
        """A hash of what is computed; equal fields have equal digests in every process."""

    @property
    def parameters(self) -> frozenset[str]:
        """Names of scalar parameters, ``w`` among them where it is used."""

    @property
    def arrays(self) -> frozenset[str]:
        """Names of array parameters."""

    @property
    def degree(self) -> int | None:
        """An upper bound of the polynomial degree in x, y, z; None where f is no polynomial."""

    @property
    def highest_power(self) -> int:
        """The largest whole exponent in f as it is written; 1 where there is none."""

    @property
    def continuous(self) -> bool:
        """Whether f is likely to be defined and continuous everywhere; nothing that is proven rests on it."""

    @property
    def total(self) -> bool:
        """Whether f certainly has a value everywhere, though it may jump."""

    @property
    def jumps(self) -> bool:
        """Whether f may jump for another reason than that it is divided by 0."""

    @property
    def large(self) -> bool:
        """Whether what f is made of may pass the largest number of f32's or f64's enclosures."""

    @property
    def fraction(self) -> tuple[Field, Field] | None:
        """N and D of f = N/D, both defined where f has a pole; None where f has none."""

    def evaluate(self, system: Any, env: Any) -> Number:
        """f on numbers of ``system`` with leaves from ``env``."""


class Lowered:
    """One field inside one kernel.

    Attributes:
        field: what is evaluated.
        builder: the kernel being traced.
        type: scalar type of the evaluation, f32 or f64.
        prefix: before the names of its numbers, where a kernel holds several fields.
    """

    def __init__(
        self, field: Field, builder: KernelBuilder, type_: Type = F32, offset: bool = False, prefix: str = ""
    ) -> None:
        self.field = field
        self.builder = builder
        self.type = type_
        self.prefix = prefix
        self._parameters = {name: self._uniform_pair(name) for name in sorted(field.parameters)}
        self._offset = self._uniform_pair(OFFSET) if offset else None
        self._arrays = {name: self._array(name) for name in sorted(field.arrays)}
        parts = field.fraction
        self._fraction = None if parts is None else [Lowered(part, builder, type_, prefix=prefix) for part in parts]

    @property
    def has_poles(self) -> bool:
        """Whether f is divided by something that may be 0."""
        return self._fraction is not None

    def beside_poles(
        self, f: Number, excluded: Value, at: Callable[[Lowered], Number], value: Number | None = None
    ) -> Value:
        """Whether f is nowhere 0, or ``value``, where its enclosure does not say so as f is not defined everywhere.

        A denominator that jumps over 0 makes f jump from one sign to the other at no pole: there it is not said.

        Args:
            f: an enclosure, less ``value``.
            excluded: whether it excludes 0.
            at: gives the enclosure of another function over the same points.
            value: the isovalue.
        """
        if self._fraction is None:
            return constant(False, BOOL)
        bottom = self._fraction[1]

        def free() -> tuple[Value]:
            under = at(bottom) if bottom.field.jumps else None
            excludes = ~lift(self.numerator(f.system, at, value).contains_zero(), BOOL)
            return (excludes if under is None else excludes & lift(under.defined, BOOL),)

        (found,) = if_(~excluded & ~lift(f.defined, BOOL), free, lambda: (False,))
        return found

    def numerator(self, system: Any, at: Callable[[Lowered], Number], value: Number | None = None) -> Number:
        """What is 0 where f is 0, or ``value``, and defined at f's poles: N - v D."""
        assert self._fraction is not None
        top, bottom = self._fraction
        levels = [] if self._offset is None else [system.enclose(*self._offset)]
        levels += [] if value is None else [value]
        over = at(top)
        return over - sum(levels[1:], start=levels[0]) * at(bottom) if levels else over

    def _uniform_pair(self, name: str) -> tuple[Value, Value]:
        value, error = parameter_names(self.prefix + name, self.type)
        return self.builder.uniform(value, self.type), self.builder.uniform(error, self.type)

    def _array(self, name: str) -> tuple[Buffer, Buffer, Value]:
        data, error = (
            self.builder.buffer(key, self.type, constant=True) for key in array_names(self.prefix + name, self.type)
        )
        return data, error, self.builder.uniform(length_name(self.prefix + name), U32)

    def evaluate(self, system: Any, x: Number, y: Number, z: Number) -> Number:
        """f at numbers of ``system``; the offset, where there is one, is taken off."""
        value = self.field.evaluate(system, _Env(self, system, {"x": x, "y": y, "z": z}))
        return value if self._offset is None else value - system.enclose(*self._offset)

    def along(self, system: Any, ray: Ray, t: Number) -> Number:
        """f at ``origin + t * direction``."""
        point = [system.exact(o) + system.exact(d) * t for o, d in zip(ray.origin, ray.direction, strict=True)]
        return self.evaluate(system, *point)


class Ray:
    """Origin and direction of the lane's ray, three Values each, taken as exact."""

    __slots__ = ("direction", "origin")

    def __init__(self, origin: tuple[Value, ...], direction: tuple[Value, ...]) -> None:
        self.origin = origin
        self.direction = direction


class _Env:
    def __init__(self, lowered: Lowered, system: Any, variables: Mapping[str, Number]) -> None:
        self._lowered = lowered
        self._system = system
        self._variables = variables

    def variable(self, name: str) -> Number:
        known = self._variables.get(name)
        return self.parameter(name) if known is None else self._seen(known)

    def parameter(self, name: str) -> Number:
        return self._seen(self._system.enclose(*self._lowered._parameters[name]))

    def _seen(self, number: Number) -> Number:
        return number.watched() if self._lowered.field.large else number

    def sum(self, system: Any, arrays: tuple[str, ...], body: Callable[[Mapping[str, Number]], Number]) -> Number:
        """A kernel loop over the elements; the sum so far is the loop's state, flattened to its scalars."""
        lowered = self._lowered
        count = lowered._arrays[arrays[0]][2]

        def step(i: Value, *state: Value) -> tuple[Value, ...]:
            elements = {}
            for name in arrays:
                data, error, _ = lowered._arrays[name]
                elements[name] = self._seen(system.enclose(load(data, i), load(error, i)))
            total = system.rebuild(list(state)) + body(elements)
            return tuple(system.components(system.general(total)))

        start = system.components(system.general(system.constant(0.0, 0.0)))
        lifted = [v if isinstance(v, Value) else _constant(v, lowered.type) for v in start]
        return system.rebuild(list(for_(count, step, *lifted)))


def _constant(value: float | bool, type_: Type) -> Value:
    from zeroset.kernel import BOOL, constant

    return constant(value, BOOL if isinstance(value, bool) else type_)
