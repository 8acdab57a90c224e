"""The quantity that a picture is coloured by, of whichever part a ray has met.

The ``value`` pass finds it for the camera's rays, with one value a pixel in a buffer; rays beyond the first hit find it
where they are shaded. No kernel of a picture without colouring has any of it.
"""

from __future__ import annotations

from zeroset.kernel import F32, U32, Kernel, KernelBuilder, Value, constant, if_, load, store
from zeroset.rendering.buffers import PART, VALUE
from zeroset.rendering.layout import pixel_coordinates
from zeroset.rendering.quantity import Gauge, Met
from zeroset.rendering.tint import Source, Tint
from zeroset.rendering.view import pixel_ray
from zeroset.shade.colormap import OWN, UNDEFINED
from zeroset.solve.status import MISS


def value_kernel(offset: bool, tint: Tint) -> Kernel:
    """The value at what each camera's ray has met; ``UNDEFINED`` where there is none."""
    with KernelBuilder("value") as builder:
        lane = builder.index()
        measure = Measure(builder, offset, tint)
        hit = load(builder.buffer("status", U32), lane).ne(MISS)

        def there() -> tuple[Value, ...]:
            ray = pixel_ray(builder, *pixel_coordinates(builder, lane))
            t, steps = load(builder.buffer("t", F32), lane), load(builder.buffer("steps", U32), lane)
            part = load(builder.buffer(PART, U32), lane) if measure.tells_apart else None
            return (measure.at(Met(ray, t, steps, part)),)

        (value,) = if_(hit, there, lambda: (constant(UNDEFINED, F32),))
        store(builder.buffer(VALUE, F32, writable=True), lane, value)
    return builder.kernel


class Measure:
    """The quantity of every part inside one kernel.

    Attributes:
        tells_apart: whether it depends on the part.
    """

    def __init__(self, builder: KernelBuilder, offset: bool, tint: Tint) -> None:
        self._builder = builder
        self._offset = offset
        self._tint = tint
        # One formula for all, or a distance, is the same whatever was met.
        self.tells_apart = [bits for bits, _ in tint.sources] != [(1 << tint.parts) - 1]

    def at(self, met: Met) -> Value:
        """The value at what a ray has met, f32: ``UNDEFINED`` where it has none, ``OWN`` where nothing colours it."""
        if not self.tells_apart:
            return self._of(self._tint.sources[0][1], met)
        assert met.part is not None
        value = constant(OWN, F32)
        for bits, source in self._tint.sources:
            value = self._where(((constant(bits, U32) >> met.part) & 1).ne(0), source, met, value)
        return value

    def _where(self, mine: Value, source: Source, met: Met, other: Value) -> Value:
        (value,) = if_(mine, lambda: (self._of(source, met),), lambda: (other,))
        return value

    def _of(self, source: Source, met: Met) -> Value:
        return Gauge(self._builder, self._offset, self._tint, source).at(met)
