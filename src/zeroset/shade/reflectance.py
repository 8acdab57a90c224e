"""Blinn-Phong reflectance with two-sided colours, in linear light.

``normal`` is the unit gradient; where it points away from the viewer the back of the surface is seen, with its own
colour and the normal turned. A surface point without a usable gradient (a singular point) is lit as if it faced the
viewer, so that isolated nodes and thin axes stay visible.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from zeroset.kernel import Value
from zeroset.shade.power import shine

Color = tuple[Value, Value, Value]


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
) -> Color:
    """Colour of a point.

    Args:
        uniform: gives the material's numbers by name: ``front_r``, ..., ``ambient``, ``shininess``.
        normal: unit gradient, or zero.
        toward_eye: unit vector to the viewer.
        lights: for each light its unit direction (3) and colour (3).
    """
    facing = dot(normal, toward_eye)
    singular = dot(normal, normal) < 0.25
    back = facing < 0.0
    n = [singular.select(v, back.select(-x, x)) for x, v in zip(normal, toward_eye, strict=True)]
    base = [back.select(uniform(f"back_{c}"), uniform(f"front_{c}")) for c in "rgb"]
    ambient, diffuse = uniform("ambient"), uniform("diffuse")
    specular, shininess = uniform("specular"), uniform("shininess")
    color = [b * ambient for b in base]
    for lx, ly, lz, *tint in lights:
        light = (lx, ly, lz)
        lambert = dot(n, light).maximum(0.0)
        half = normalised([a + b for a, b in zip(light, toward_eye, strict=True)])
        highlight = (lambert > 0.0).select(shine(dot(n, half), shininess) * specular, 0.0)
        color = [c + t * (b * diffuse * lambert + highlight) for c, b, t in zip(color, base, tint, strict=True)]
    return color[0], color[1], color[2]
