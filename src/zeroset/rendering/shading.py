"""The numbers of the shading and shadow passes: material, lights and background as uniforms."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from zeroset.errors import ParameterError
from zeroset.rendering.buffers import CLEAR, END, Ends
from zeroset.rendering.materials import material_numbers
from zeroset.scene.bounds import Bounds
from zeroset.scene.camera import Rays
from zeroset.scene.encoding import srgb
from zeroset.scene.light import Color, Light, Material
from zeroset.scene.scene import Scene

LIGHT = ("x", "y", "z", "r", "g", "b")
MOST_DEEP = 32
"""Surfaces that one ray may meet after the first."""
MOST_SAMPLES = 256
"""Rays of one pixel."""


class Smooth(NamedTuple):
    """Antialiasing.

    Attributes:
        samples: rays of a pixel that is antialiased; 1 for none.
        everywhere: whether every pixel is, or only those at edges.
    """

    samples: int = 1
    everywhere: bool = False

    @classmethod
    def of(cls, antialias: int, samples: int) -> Smooth:
        """The antialiasing that was asked for; raises ``ParameterError`` for what is no number of rays."""
        for name, value in (("antialias", antialias), ("samples", samples)):
            if not (isinstance(value, int) and 1 <= value <= MOST_SAMPLES):
                raise ParameterError(f"{name} must be a whole number from 1 to {MOST_SAMPLES}, not {value!r}")
        if samples > 1 and antialias > 1:
            raise ParameterError("antialias is for pixels at edges and samples for every pixel: give one of the two")
        return cls(samples, True) if samples > 1 else cls(antialias, False)


class Optics(NamedTuple):
    """What of materials and surroundings shapes the kernels of rays beyond the first hit.

    Attributes:
        through: whether light passes through surfaces.
        bends: whether it is bent there.
        backed: whether some surfaces are seen through only where another one lies behind.
        mirror: whether surfaces mirror.
        sky: whether the surroundings are a cube map.
        smooth: whether some pixels have many rays.
        shadows: whether lights throw shadows.
    """

    through: bool
    bends: bool
    backed: bool
    mirror: bool
    sky: bool
    shadows: bool
    smooth: bool

    @property
    def branches(self) -> bool:
        """Whether two rays may come of one."""
        return self.mirror and self.through

    @property
    def plain(self) -> bool:
        """Whether the first hit is all but at edges: then pixels are shaded as in any other frame."""
        return not (self.through or self.mirror or self.sky)

    @property
    def ends(self) -> Ends:
        """What rays that go on need to know: where one that turns back, and where one that goes through may start."""
        back = (CLEAR,) if self.mirror or self.bends else ()
        return (*back, END) if self.through else back

    @classmethod
    def of(cls, scene: Scene, smooth: Smooth) -> Optics | None:
        """What a scene asks for; None where the first hit is all."""
        materials = scene.materials
        through, mirror = any(m.opacity < 1 for m in materials), any(m.reflectance > 0 for m in materials)
        more = smooth.samples > 1
        if not (through or mirror or scene.environment or more):
            return None
        return cls(
            through,
            any(m.opacity < 1 and m.ior != 1 for m in materials),
            any(m.opacity < 1 and m.last_solid for m in materials),
            mirror,
            scene.environment is not None,
            scene.shadows,
            more,
        )


class Lighting(NamedTuple):
    """What of the lights shapes kernels.

    Attributes:
        kinds: a letter for each: ``d`` far away in a direction, ``p`` at a place.
        shadows: whether they throw shadows.
        optics: where rays go on beyond the first hit; None where they do not.
        colored: whether a pixel's value gives its colour.
    """

    kinds: str
    shadows: bool = False

    optics: Optics | None = None
    colored: bool = False

    @classmethod
    def of(cls, scene: Scene, smooth: Smooth) -> Lighting:
        """The lighting of a scene."""
        optics = Optics.of(scene, smooth)
        colored = any(material.coloring for material in scene.materials)
        if optics is not None and not optics.plain:
            # There the lights are data.
            return cls("", False, optics, colored)
        kinds = "".join("d" if light.position is None else "p" for light in scene.lights)
        return cls(kinds, scene.shadows, optics, colored)

    def depth(self, value: int | None) -> int:
        """How many surfaces a ray may meet after the first; raises ``ParameterError`` for what is no such number."""
        if value is None:
            return 6 if self.optics is not None and (self.optics.mirror or self.optics.bends) else 3
        if not (isinstance(value, int) and 0 <= value <= MOST_DEEP):
            raise ParameterError(f"the depth must be a whole number from 0 to {MOST_DEEP}, not {value!r}")
        return value


class Illumination(NamedTuple):
    """The numbers of a scene's light that are no plain uniforms.

    Attributes:
        shadows: the shadow pass's uniforms for each light; empty where there are no shadows.
        lights: eight numbers for each light, for rays beyond the first hit: its place, or a vector towards it; 1 or 0
            for which of the two; its colour; and what makes the vector one of length 1.
        texels: the cube map all around, or None.
        tolerance: world length to which shadows are found.
        depth: how many surfaces a ray may meet after the first.
        samples: rays of a pixel that is antialiased; 1 for none.
        everywhere: whether every pixel is.
    """

    shadows: tuple[dict[str, float], ...]
    lights: npt.NDArray[np.float32]
    texels: npt.NDArray[np.float32] | None
    tolerance: float
    depth: int
    samples: int = 1
    everywhere: bool = False

    @classmethod
    def of(cls, scene: Scene, rays: Rays, tolerance: float, depth: int, smooth: Smooth) -> Illumination:
        """The light of a scene that is seen along a camera's rays."""
        places = shadow_uniforms(scene.lights, rays, scene.surface.fitted, tolerance)
        rows = [
            [*(place[f"light_{axis}"] for axis in "xyzw"), *light.color, 1.0 / _length(place)]
            for place, light in zip(places, scene.lights, strict=True)
        ]
        lights = np.asarray(rows, np.float32).reshape(-1)
        texels = None if scene.environment is None else scene.environment.texels()
        shadows = tuple(places) if scene.shadows else ()
        return cls(shadows, lights, texels, tolerance, depth, smooth.samples, smooth.everywhere)


def shading_uniforms(material: Material, lights: Sequence[Light], background: Color, rays: Rays) -> dict[str, float]:
    """Numbers of the shading pass by uniform name; headlights are turned into world directions here."""
    named = material_numbers(material)
    named |= {f"background_{c}": srgb(v) for c, v in zip("rgb", background, strict=True)}
    named |= {f"sky_{c}": v for c, v in zip("rgb", background, strict=True)}
    for i, light in enumerate(lights):
        named |= {f"light{i}_{k}": v for k, v in zip(LIGHT, (*_world(light, rays), *light.color), strict=True)}
    return named


def shadow_uniforms(lights: Sequence[Light], rays: Rays, bounds: Bounds, tolerance: float) -> list[dict[str, float]]:
    """Numbers of the shadow pass by uniform name, for each light."""
    made = []
    for i, light in enumerate(lights):
        near = light.position is not None
        # From anywhere inside the bounds, twice their extent leads out.
        place = np.asarray(_world(light, rays)) * (1.0 if near else 2.0 * bounds.extent + 2.0 * bounds.reach)
        named = {f"light_{axis}": float(v) for axis, v in zip("xyz", place, strict=True)}
        made.append(named | {"light_w": float(near), "shadow_tolerance": tolerance, "bit": 1 << i})
    return made


def _length(place: Mapping[str, float]) -> float:
    """Length of the vector to a light; 1 for one that is where the axes meet."""
    return math.hypot(*(place[f"light_{axis}"] for axis in "xyz")) or 1.0


def _world(light: Light, rays: Rays) -> tuple[float, ...]:
    """The light's place, or the unit direction towards it, in the world."""
    given = light.direction if light.position is None else light.position
    vector: npt.NDArray[np.float64] = np.asarray(given, np.float64)
    if light.headlight:
        across = np.asarray(rays.right) + np.asarray(rays.right_origin)
        upwards = np.asarray(rays.up) + np.asarray(rays.up_origin)
        frame = [across / np.linalg.norm(across), upwards / np.linalg.norm(upwards), -np.asarray(rays.forward)]
        vector = vector @ np.stack(frame)
        if light.position is not None:
            vector = vector + np.asarray(rays.eye)
    if light.position is None:
        vector = vector / np.linalg.norm(vector)
    return tuple(float(v) for v in vector)
