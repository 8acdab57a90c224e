"""Colour maps: from a share between 0 and 1 to a colour, made in Oklab so that equal steps look equally large.

One table holds the control points of all maps, as lightness, chroma and hue. A smooth curve goes through them; colours
that no screen shows lose chroma until it does; and the curve is cut into steps of equal length (for diverging maps on
each side of the middle). Oklab: B. Ottosson, A perceptual color space for image processing (2020).
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from zeroset.errors import ParameterError, did_you_mean

STEPS = 256
"""Colours of a map's table."""
NEUTRAL = 0.23
"""Linear grey of points without a value."""
_FINE = 2048
"""Places at which a curve is measured."""

Floats = npt.NDArray[np.float64]


class ColorMap(NamedTuple):
    """A colour map.

    Attributes:
        kind: ``sequential``, ``diverging`` (two hues from a light middle) or ``cyclic`` (ends where it begins).
        points: its control points, evenly spaced: lightness 0 to 1, chroma, hue in degrees.
    """

    kind: str
    points: tuple[tuple[float, float, float], ...]


MAPS = {
    "lagoon": ColorMap(
        "sequential",
        ((0.25, 0.11, 300), (0.39, 0.12, 278), (0.53, 0.10, 235), (0.67, 0.11, 185), (0.81, 0.16, 145),
         (0.94, 0.17, 108)),
    ),
    "ember": ColorMap(
        "sequential",
        ((0.17, 0.05, 300), (0.33, 0.14, 315), (0.49, 0.18, 355), (0.64, 0.19, 30), (0.80, 0.15, 68),
         (0.96, 0.07, 103)),
    ),
    "gray": ColorMap("sequential", ((0.22, 0, 0), (0.97, 0, 0))),
    "coolwarm": ColorMap(
        "diverging",
        ((0.42, 0.17, 264), (0.60, 0.14, 258), (0.79, 0.075, 250), (0.95, 0, 0),
         (0.79, 0.09, 48), (0.61, 0.17, 33), (0.44, 0.17, 26)),
    ),
    "earth": ColorMap(
        "diverging",
        ((0.38, 0.08, 55), (0.58, 0.10, 68), (0.79, 0.07, 82), (0.95, 0, 0),
         (0.78, 0.07, 185), (0.57, 0.09, 190), (0.37, 0.065, 195)),
    ),
    "wheel": ColorMap("cyclic", tuple((0.72, 0.122, 45.0 * i + 20.0) for i in range(8))),
}  # fmt: skip
SIMILAR = {
    "viridis": "lagoon", "cividis": "lagoon", "parula": "lagoon", "turbo": "lagoon", "jet": "lagoon", "magma": "ember",
    "inferno": "ember", "plasma": "ember", "hot": "ember", "grey": "gray", "rdbu": "coolwarm", "bwr": "coolwarm",
    "seismic": "coolwarm", "brbg": "earth", "hsv": "wheel", "twilight": "wheel", "phase": "wheel",
}  # fmt: skip
"""Other programs' maps, and which of these does most nearly the same."""


def find_map(name: str) -> ColorMap:
    """A map by its name.

    Raises:
        ParameterError: there is none; the message says which there are.

    Example:
        >>> find_map("coolwarm").kind
        'diverging'
    """
    known = MAPS.get(name) if isinstance(name, str) else None
    if known is None:
        near = SIMILAR.get(str(name).lower())
        hints = (f"{near} is much like it",) if near else did_you_mean(str(name), MAPS)
        raise ParameterError(f"there is no colour map {name!r}", hints=(*hints, f"there are {', '.join(MAPS)}"))
    return known


@lru_cache(maxsize=8)
def table(name: str) -> Floats:
    """The colours of a map, (256, 3), linear RGB, read only; the last one of a cyclic map is its first.

    Example:
        >>> table("gray").shape, bool(table("gray")[0, 0] < table("gray")[-1, 0])
        ((256, 3), True)
    """
    found = find_map(name)
    curve = _in_gamut(_curve(found))
    halves = np.array_split(np.arange(len(curve)), 2) if found.kind == "diverging" else [np.arange(len(curve))]
    if len(halves) == 2:
        # Both halves have the middle.
        halves = [np.append(halves[0], halves[1][0]), halves[1]]
    share = np.linspace(0.0, 1.0, STEPS) * len(halves)
    colors = np.empty((STEPS, 3))
    for i, half in enumerate(halves):
        mine = (share >= i) & (share <= i + 1)
        colors[mine] = _even(curve[half], share[mine] - i)
    made = np.clip(to_linear(colors), 0.0, 1.0)
    made.flags.writeable = False
    return made


def _curve(made: ColorMap) -> Floats:
    """A smooth curve through the control points (Catmull and Rom's), in Oklab."""
    light, chroma, hue = np.array(made.points, np.float64).T
    points = np.stack([light, chroma * np.cos(np.radians(hue)), chroma * np.sin(np.radians(hue))], axis=-1)
    if made.kind == "cyclic":
        points = np.concatenate([points[-1:], points, points[:2]])
    else:
        points = np.concatenate([2 * points[:1] - points[1:2], points, 2 * points[-1:] - points[-2:-1]])
    place = np.linspace(0.0, len(points) - 3.0, _FINE + 1)
    piece = np.minimum(place.astype(int), len(points) - 4)
    t = (place - piece)[:, None]
    a, b, c, d = (points[piece + i] for i in range(4))
    curve: Floats = 0.5 * (2 * b + t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a))))
    return curve


def _in_gamut(lab: Floats) -> Floats:
    """The colours with as much of their chroma as sRGB holds, found by bisection."""
    low, high = np.zeros(len(lab)), np.ones(len(lab))
    for _ in range(30):
        middle = 0.5 * (low + high)
        rgb = to_linear(lab * np.stack([np.ones_like(middle), middle, middle], axis=-1))
        fits = np.all((rgb >= -1e-6) & (rgb <= 1 + 1e-6), axis=-1)
        low, high = np.where(fits, middle, low), np.where(fits, high, middle)
    whole = np.all((to_linear(lab) >= -1e-6) & (to_linear(lab) <= 1 + 1e-6), axis=-1)
    scale = np.where(whole, 1.0, low)
    fitting: Floats = lab * np.stack([np.ones_like(scale), scale, scale], axis=-1)
    return fitting


def _even(curve: Floats, share: Floats) -> Floats:
    """Places on a curve by their share of its length."""
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=-1))])
    return np.stack([np.interp(share * length[-1], length, axis) for axis in curve.T], axis=-1)


_TO_CONES = np.array(
    [[1, 0.3963377774, 0.2158037573], [1, -0.1055613458, -0.0638541728], [1, -0.0894841775, -1.2914855480]]
)
_TO_RGB = np.array(
    [[4.0767416621, -3.3077115913, 0.2309699292], [-1.2684380046, 2.6097574011, -0.3413193965],
     [-0.0041960863, -0.7034186147, 1.7076147010]]
)  # fmt: skip


def to_linear(lab: Floats) -> Floats:
    """Linear sRGB of colours in Oklab, (..., 3); outside [0, 1] where no screen shows them."""
    linear: Floats = ((lab @ _TO_CONES.T) ** 3) @ _TO_RGB.T
    return linear
