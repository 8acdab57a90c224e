"""Colour by what the surface is: which quantity, through which colour map, over which range.

``QUANTITIES`` lists what can be named; anything else is a formula in x, y, z, w and the surface's parameters, which
``colored`` reads. How a quantity is computed is told in ``rendering.quantity``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from zeroset.errors import ParameterError
from zeroset.scene.bounds import number
from zeroset.scene.colormap import find_map

Range = tuple[float, float]


class Quantity(NamedTuple):
    """Something that a surface can be coloured by.

    Attributes:
        title: what a legend calls it.
        signed: whether 0 is in its middle: then so it is in a range that is found.
        order: of the derivatives of f that it takes.
    """

    title: str
    signed: bool = False
    order: int = 0


QUANTITIES = {
    "gaussian-curvature": Quantity("Gaussian curvature", True, 2),
    "mean-curvature": Quantity("mean curvature", True, 2),
    "gradient": Quantity("|grad f|", False, 1),
    "steps": Quantity("evaluations"),
    "depth": Quantity("depth"),
    "isovalue": Quantity("isovalue"),
}
"""What can be named."""


@dataclass(frozen=True, slots=True)
class Coloring:
    """Colours that show a quantity.

    Attributes:
        by: ``gaussian-curvature`` (the product of the principal curvatures), ``mean-curvature`` (half their sum;
            positive where the surface bends away from growing f, or from the outside of a solid, 1/r for a ball with
            f < 0 inside), ``gradient`` (the length of f's gradient), ``steps`` (evaluations of f for the ray),
            ``depth`` (distance along the viewing direction), ``isovalue`` (which one it is, of surfaces that have
            some), or a formula in x, y, z, w and the surface's parameters. In solids and of several surfaces it is
            that of the part that is seen; parts for which it means nothing keep their material's colours.
        map: a colour map: ``lagoon``, ``ember``, ``gray``, ``coolwarm``, ``earth`` or ``wheel``; None takes
            ``coolwarm`` for curvatures and ``lagoon`` for all else.
        range: values of the first and the last colour; None finds them from the picture: the 2nd and the 98th
            percentile of what is seen; for curvatures and diverging maps 0 is in the middle, and the 95th percentile
            of the sizes at the ends.

    Example:
        >>> import zeroset as zs
        >>> import numpy as np
        >>> by = zs.Coloring("gaussian-curvature", range=(-2, 2))
        >>> image = zs.render("x^2 + y^2 + z^2 = 1", size=32, color_by=by)
        >>> float(np.nanmax(abs(image.aov("value") - 1))) < 1e-4
        True
    """

    by: str = "gaussian-curvature"
    map: str | None = None
    range: Range | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.by, str) or not self.by.strip():
            raise ParameterError(f"what to colour by must be text, not {self.by!r}", hint=offered())
        if self.map is not None:
            find_map(self.map)
        if self.range is not None:
            object.__setattr__(self, "range", _range(self.range))

    @property
    def quantity(self) -> Quantity:
        """What is shown; a formula is called by its text."""
        return QUANTITIES.get(self.by) or Quantity(self.by.strip())

    @property
    def chosen_map(self) -> str:
        """The map that is used."""
        return self.map or ("coolwarm" if self.quantity.signed else "lagoon")

    @property
    def centred(self) -> bool:
        """Whether a range that is found has 0 in its middle."""
        return self.quantity.signed or find_map(self.chosen_map).kind == "diverging"

    @property
    def cyclic(self) -> bool:
        """Whether values beyond the range begin again at its other end."""
        return find_map(self.chosen_map).kind == "cyclic"


def as_coloring(value: Any) -> Coloring | None:
    """A Coloring, what to colour by as text, or None; anything else is a ``ParameterError``."""
    if value is None or isinstance(value, Coloring):
        return value
    if isinstance(value, str):
        return Coloring(value)
    raise ParameterError(f"a coloring must be a Coloring or text, not {value!r}", hint=offered())


def offered() -> str:
    """What there is to colour by, as a hint."""
    return f"there are {', '.join(QUANTITIES)}, and any formula in x, y, z"


def _range(values: Any) -> Range:
    try:
        low, high = (number(v, "an end of a colour range", ParameterError) for v in values)
    except (TypeError, ValueError) as error:
        if isinstance(error, ParameterError):
            raise
        raise ParameterError(f"a colour range must be two numbers, not {values!r}") from None
    if not low < high:
        raise ParameterError(f"a colour range must begin below its end, not {low!r} to {high!r}")
    return low, high
