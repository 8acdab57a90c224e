"""Blinn-Phong reflectance with two-sided colours, in linear light.

``normal`` is the unit gradient; where it points away from the viewer the back of the surface is seen, with its own
colour and the normal turned. A surface point without a usable gradient (a singular point) is lit as if it faced the
viewer, so that isolated nodes and thin axes stay visible.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from zeroset.kernel import Value, if_
from zeroset.shade.albedo import Albedo, two_sided
from zeroset.shade.power import shine

Color = tuple[Value, Value, Value]
_FAINT = 22.0
"""Of q <= 1 - 22/s, q**(s/2) is less than 2**-15: no highlight that anybody sees, and not worth a power."""


def dot(a: Sequence[Value], b: Sequence[Value]) -> Value:
    """Scalar product of two vectors of Values."""
    return a[0].fma(b[0], a[1].fma(b[1], a[2] * b[2]))


def normalised(a: Sequence[Value]) -> list[Value]:
    """A vector of length 1; the zero vector stays as it is."""
    inverse = 1.0 / dot(a, a).maximum(1e-30).sqrt()
    return [x * inverse for x in a]


def blinn_phong(
    uniform: Callable[[str], Value],
    normal: Sequence[Value],
    toward_eye: Sequence[Value],
    lights: Sequence[Sequence[Value]],
    albedo: Albedo | None = None,
) -> Color:
    """Colour of a point.

    Args:
        uniform: gives the material's numbers by name: ``front_r``, ..., ``ambient``, ``shininess``.
        normal: unit gradient, or zero.
        toward_eye: unit vector to the viewer.
        lights: for each light its unit direction (3) and colour (3).
        albedo: the colour that the point has without light; None for the material's two.
    """
    seen = face(uniform, normal, toward_eye, albedo)
    color = seen.ambient
    for x, y, z, r, g, b in lights:
        color = seen.lit(color, (x, y, z), (r, g, b))
    return color


class Face(NamedTuple):
    """The side of a point that is seen, ready to be lit.

    Attributes:
        normal: towards the viewer.
        toward_eye: unit vector to the viewer.
        base: its colour.
        ambient: what it shows without any light.
        uniform: gives the material's numbers by name.
    """

    normal: Sequence[Value]
    toward_eye: Sequence[Value]
    base: Sequence[Value]
    ambient: Color
    uniform: Callable[[str], Value]

    def lit(self, color: Sequence[Value], light: Sequence[Value], tint: Sequence[Value]) -> Color:
        """A colour with one more light, given by its unit direction and its colour."""
        cosine = dot(self.normal, light)
        lambert = cosine.maximum(0.0)
        # The vector halfway between light and viewer is never made: of unit vectors, its square is 2 + 2 light * eye.
        along = (cosine + dot(self.normal, self.toward_eye)).maximum(0.0)
        square = along * along / dot(light, self.toward_eye).fma(2.0, 2.0).maximum(1e-6)
        shininess, specular, diffuse = (self.uniform(name) for name in ("shininess", "specular", "diffuse"))
        seen = (lambert > 0.0) & (square > 1.0 - _FAINT / shininess)
        (highlight,) = if_(seen, lambda: (shine(square, shininess * 0.5) * specular,), lambda: (0.0,))
        r, g, b = (c + t * (k * diffuse * lambert + highlight) for c, k, t in zip(color, self.base, tint, strict=True))
        return r, g, b


def face(
    uniform: Callable[[str], Value],
    normal: Sequence[Value],
    toward_eye: Sequence[Value],
    albedo: Albedo | None = None,
) -> Face:
    """The side of a point that the viewer sees; arguments as of ``blinn_phong``."""
    facing = dot(normal, toward_eye)
    singular = dot(normal, normal) < 0.25
    back = facing < 0.0
    n = [singular.select(v, back.select(-x, x)) for x, v in zip(normal, toward_eye, strict=True)]
    base = (albedo or two_sided(uniform))(back)
    ambient = uniform("ambient")
    r, g, b = (k * ambient for k in base)
    return Face(n, toward_eye, base, (r, g, b), uniform)
