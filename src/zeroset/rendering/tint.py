"""What of a colouring shapes kernels, and the numbers that go into them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from zeroset.kernel.types import F32, F64, Type
from zeroset.rendering.values import scalar_uniforms
from zeroset.runtime import Device
from zeroset.scene.camera import Rays
from zeroset.scene.colored import formula_of, value_range
from zeroset.scene.coloring import QUANTITIES, Coloring
from zeroset.scene.colormap import NEUTRAL, table
from zeroset.scene.exprfield import ExprField
from zeroset.scene.parameters import TIME
from zeroset.scene.scene import Scene
from zeroset.scene.several import Drawable, colored_surface
from zeroset.scene.surface import Surface
from zeroset.solve.method import Method
from zeroset.solve.names import OFFSET

FEW, MANY = 2.0, 98.0
"""Percentiles of the values seen that a range goes between where none was given."""
NOTHING = 1e-9
"""Sizes below this are rounding: of the mean curvature of a minimal surface nothing else is left."""
MOST = 95.0
"""Percentile of their sizes that one around 0 reaches: curvatures grow without bound towards singular points."""
MOST_SAMPLES = 1 << 16
"""Values that they are taken of, evenly spread over the picture."""


class Tint(NamedTuple):
    """What of a colouring shapes kernels.

    Attributes:
        kind: the name of a quantity, or ``formula``.
        formula: the formula, where it is one.
        type: scalar type in which it is computed.
    """

    kind: str
    formula: ExprField | None
    type: Type

    @property
    def digest(self) -> str:
        """Equal for equal kernels of one surface."""
        return f"{self.kind} {self.type} {'' if self.formula is None else self.formula.digest}"

    @classmethod
    def of(cls, scene: Scene, device: Device) -> Tint:
        """The tint of a scene that is coloured by a quantity."""
        surface, coloring = colored_surface(scene.surface), scene.materials[0].coloring
        assert coloring is not None
        formula = formula_of(coloring, surface)
        exact = formula is not None or QUANTITIES[coloring.by].order > 0
        return cls("formula" if formula else coloring.by, formula, F64 if exact and device.supports(F64) else F32)

    def uniforms(self, surface: Surface, method: Method) -> dict[str, float]:
        """The parameters that the quantity takes, in its scalar type."""
        # A formula may have w where f has none.
        numbers = {TIME: (0.0, 0.0), **surface.settled.numbers, OFFSET: (method.offset, method.offset)}
        return scalar_uniforms(numbers, self.type)


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
    def of(cls, coloring: Coloring, drawn: Drawable, rays: Rays) -> Palette:
        """The palette of what is coloured as it is seen along a camera's rays."""
        colors = np.concatenate([table(coloring.chosen_map), np.full((1, 3), NEUTRAL)])
        forward = np.asarray(rays.forward)
        view = {f"view_{axis}": float(v) for axis, v in zip("xyz", forward, strict=True)}
        view["view_start"] = float(forward @ np.asarray(rays.eye))
        range_ = coloring.range or value_range(coloring, colored_surface(drawn))
        return cls(coloring, colors.astype(np.float32).reshape(-1), view, range_)

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
