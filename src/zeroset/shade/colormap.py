"""The colour of a value: looked up in a buffer, so that another map or range is no other kernel."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from zeroset.kernel import U32, Buffer, Value, load
from zeroset.shade.albedo import Albedo

LARGEST = 1e36
"""Values stay within this, so that no kernel meets an infinity."""
UNDEFINED = 3e38
"""Stands for a value that does not exist."""
OWN = -3e38
"""Stands for the value of a point that nothing colours: it keeps its material's colours."""
STEPS = 256
"""Colours of a table; after the last one comes the colour of points without a value."""


def mapped(table: Buffer, uniform: Callable[[str], Value], value: Value, own: Albedo | None = None) -> Albedo:
    """Both sides in the colour of a value.

    Args:
        table: linear RGB of 256 colours and one more, f32.
        uniform: gives f32 numbers by name: ``color_low``, the value of the first colour; ``color_scale``, one over
            the range; ``color_wraps``, 1 where values beyond it begin again.
        value: f32; ``UNDEFINED`` for none.
        own: the colours where it is ``OWN``; None where it never is.
    """
    known = abs(value) <= LARGEST
    share = (known.select(value, 0.0) - uniform("color_low")) * uniform("color_scale")
    share = share.maximum(-LARGEST).minimum(LARGEST)
    share = (uniform("color_wraps") > 0.0).select(share - share.floor(), share).maximum(0.0).minimum(1.0)
    place = share * (STEPS - 1.0)
    first = place.floor().minimum(STEPS - 2.0)
    rest = known.select(place - first, 0.0)
    at = known.select(first, float(STEPS)).convert(U32) * 3
    # The colour after the last one is asked for, and not used, where there is no value.
    step = known.select(3.0, 0.0).convert(U32)

    def color(back: Value) -> Sequence[Value]:
        ends = [(load(table, at + i), load(table, at + step + i)) for i in range(3)]
        return [rest.fma(high - low, low) for low, high in ends]

    if own is None:
        return color
    keeps = value < -LARGEST
    return lambda back: [keeps.select(a, b) for a, b in zip(own(back), color(back), strict=True)]
