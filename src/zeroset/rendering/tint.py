"""What of a colouring shapes kernels, and the numbers that go into them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from zeroset.kernel.types import F32, F64, Type
from zeroset.rendering.drawn import Drawn
from zeroset.rendering.values import scalar_uniforms
from zeroset.runtime import Device
from zeroset.scene.camera import Rays
from zeroset.scene.colored import Colored, formula_of, has_numbers
from zeroset.scene.coloring import QUANTITIES, Coloring
from zeroset.scene.colormap import NEUTRAL, table
from zeroset.scene.parameters import TIME
from zeroset.scene.surface import Surface
from zeroset.solve.field import Field
from zeroset.solve.method import Method
from zeroset.solve.names import OFFSET
from zeroset.solve.shape import Leaf

FEW, MANY = 2.0, 98.0
"""Percentiles of the values seen that a range goes between where none was given."""
NOTHING = 1e-9
"""Sizes below this are rounding: of the mean curvature of a minimal surface nothing else is left."""
MOST = 95.0
"""Percentile of their sizes that one around 0 reaches: curvatures grow without bound towards singular points."""
MOST_SAMPLES = 1 << 16
"""Values that they are taken of, evenly spread over the picture."""


class Source(NamedTuple):
    """What a value is computed from.

    Attributes:
        field: f, or the formula; None where it takes neither.
        prefix: before the names of its numbers.
        sign: turns its gradient out of a solid, where that matters.
    """

    field: Field | None
    prefix: str = ""
    sign: int = 1

    @property
    def digest(self) -> str:
        """Equal for equal computations."""
        return f"{self.prefix}{self.sign:+}{'' if self.field is None else self.field.digest}"


class Tint(NamedTuple):
    """What of a colouring shapes kernels.

    Attributes:
        kind: the name of a quantity, or ``formula``.
        type: scalar type in which it is computed.
        parts: how many parts there are.
        sources: from what it is computed, for sets of parts, as bits; the parts of none keep their own colours.
    """

    kind: str
    type: Type
    parts: int
    sources: tuple[tuple[int, Source], ...]

    @property
    def digest(self) -> str:
        """Equal for equal kernels of one shape."""
        return f"{self.kind} {self.type} {self.parts} " + " ".join(f"{bits:x}:{of.digest}" for bits, of in self.sources)

    @classmethod
    def of(cls, found: Colored, drawn: Drawn, device: Device) -> Tint:
        """The tint of something that is coloured by a quantity."""
        by = found.coloring.by
        formula = by not in QUANTITIES or by == "isovalue"
        exact = formula or QUANTITIES[by].order > 0
        type_ = F64 if exact and device.supports(F64) else F32
        return cls("formula" if formula else by, type_, drawn.parts, _sources(found, drawn))

    def uniforms(self, drawn: Drawn, method: Method) -> dict[str, float]:
        """The parameters that the quantity takes, in its scalar type."""
        named: dict[str, float] = {}
        for prefix, surface in drawn.surfaces:
            # A formula may have w where f has none.
            numbers = {TIME: (0.0, 0.0), **surface.settled.numbers, OFFSET: (method.offset, method.offset)}
            named |= scalar_uniforms(numbers, self.type, prefix)
        return named


def _sources(found: Colored, drawn: Drawn) -> tuple[tuple[int, Source], ...]:
    """From what each part's value is computed; parts that have the same source have it together."""
    leaves = sorted((pair for body in drawn.shape.bodies for pair in body.leaves), key=lambda pair: pair[0].part)
    bits: dict[Source, int] = {}
    for (leaf, sign), surface, shown in zip(leaves, found.surfaces, found.shown, strict=True):
        if shown:
            source = _source(found.coloring, surface, leaf, sign)
            bits[source] = bits.get(source, 0) | leaf.bits
    return tuple((parts, source) for source, parts in bits.items())


def _source(coloring: Coloring, surface: Surface, leaf: Leaf, sign: int) -> Source:
    formula = formula_of(coloring, surface)
    if formula is not None:
        return Source(formula, leaf.prefix if has_numbers(formula) else "")
    if QUANTITIES[coloring.by].order == 0:
        return Source(None)
    # Of all quantities the mean curvature alone has a sign that turns with the gradient.
    return Source(leaf.field, leaf.prefix, sign if coloring.by == "mean-curvature" else 1)


class Palette(NamedTuple):
    """The numbers of a colouring.

    Attributes:
        coloring: as it was asked for.
        table: linear RGB of the map's colours, and of points without a value.
        view: uniforms for depth.
        range: values of the first and the last colour; None to find them.
    """

    coloring: Coloring
    table: npt.NDArray[np.float32]
    view: Mapping[str, float] = MappingProxyType({})
    range: tuple[float, float] | None = None

    @classmethod
    def of(cls, found: Colored, rays: Rays) -> Palette:
        """The palette of what is coloured as it is seen along a camera's rays."""
        coloring = found.coloring
        colors = np.concatenate([table(coloring.chosen_map), np.full((1, 3), NEUTRAL)])
        forward = np.asarray(rays.forward)
        view = {f"view_{axis}": float(v) for axis, v in zip("xyz", forward, strict=True)}
        view["view_start"] = float(forward @ np.asarray(rays.eye))
        return cls(coloring, colors.astype(np.float32).reshape(-1), view, coloring.range or found.range)

    def uniforms(self, low: float, high: float) -> dict[str, float]:
        """What the look-up of colours needs to know."""
        return {"color_low": low, "color_scale": 1.0 / (high - low), "color_wraps": float(self.coloring.cyclic)}


def found_range(values: npt.NDArray[np.float32], centred: bool) -> tuple[float, float]:
    """A range for values that are seen: from the 2nd to the 98th percentile, or as far as the 95th of the sizes.

    Args:
        values: finite ones, in any order.
        centred: whether 0 is to be in the middle.

    Example:
        >>> found_range(np.linspace(0, 100, 101, dtype=np.float32), False)
        (2.0, 98.0)
        >>> found_range(np.array([-1, 3], np.float32), True)
        (-2.9, 2.9)
    """
    if not len(values):
        return (-1.0, 1.0) if centred else (0.0, 1.0)
    some = values[:: -(-len(values) // MOST_SAMPLES)].astype(np.float64)
    if centred:
        most = float(np.percentile(np.abs(some), MOST))
        return (-most, most) if most > NOTHING else (-1.0, 1.0)
    low, high = (float(v) for v in np.percentile(some, (FEW, MANY)))
    # Values that are all alike get the middle colour.
    room = max(1e-6 * max(abs(low), abs(high)), 1e-12)
    return (low, high) if high - low > room else (low - max(abs(low), 1.0) / 2, high + max(abs(high), 1.0) / 2)
