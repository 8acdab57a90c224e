"""A scene: a surface with its camera, material, lights and background; what a ``.toml`` file holds."""

from __future__ import annotations

from dataclasses import dataclass, field

from zeroset.errors import ParameterError, ZerosetError
from zeroset.scene.camera import Camera
from zeroset.scene.coloring import formula_of
from zeroset.scene.environment import Environment, as_environment
from zeroset.scene.light import DEFAULT_BACKGROUND, DEFAULT_LIGHTS, Color, Light, Material, color
from zeroset.scene.surface import Surface, surface

MOST_LIGHTS = 32
"""Lights of a scene: each is code in the shading kernel."""


@dataclass(frozen=True)
class Scene:
    """Everything that a picture needs.

    Attributes:
        surface: what is drawn.
        camera: how it is seen; None takes the surface's own, or one that fits its bounds.
        material: its colours and reflectance.
        lights: where the light comes from.
        background: linear RGB behind everything.
        shadows: whether the lights throw shadows.
        environment: what is seen all around instead of the background: an Environment, ``"sky"``, ``"room"``, the
            file name of a picture, or those of a cube map.

    Example:
        >>> import zeroset as zs
        >>> scene = zs.Scene(zs.surface("x^2 + y^2 = z"), background=(0.0, 0.0, 0.0))
        >>> scene.background
        (0.0, 0.0, 0.0)
    """

    surface: Surface
    camera: Camera | None = None
    material: Material = field(default_factory=Material)
    lights: tuple[Light, ...] = DEFAULT_LIGHTS
    background: Color = DEFAULT_BACKGROUND
    shadows: bool = False
    environment: Environment | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.surface, Surface):
            raise ParameterError(f"a scene's surface must be a Surface, not a {type(self.surface).__name__}")
        if not isinstance(self.material, Material):
            raise ParameterError(f"a scene's material must be a Material, not {self.material!r}")
        if not isinstance(self.shadows, bool):
            raise ParameterError(f"a scene's shadows must be True or False, not {self.shadows!r}")
        if self.material.coloring is not None:
            formula_of(self.material.coloring, self.surface)
        object.__setattr__(self, "environment", as_environment(self.environment))
        lights = self.lights if isinstance(self.lights, (tuple, list)) else (self.lights,)
        for light in lights:
            if not isinstance(light, Light):
                raise ParameterError(f"a scene's lights must be Lights, not {light!r}")
        if len(lights) > MOST_LIGHTS:
            raise ParameterError(f"a scene has at most {MOST_LIGHTS} lights, not {len(lights)}")
        object.__setattr__(self, "lights", tuple(lights))
        object.__setattr__(self, "background", color(self.background, "the background"))


def as_scene(value: Surface | Scene | str) -> Scene:
    """A Scene as it is, a Surface or a formula with everything else by default."""
    if isinstance(value, Scene):
        return value
    if isinstance(value, Surface):
        return Scene(value)
    if isinstance(value, str):
        return Scene(surface(value))
    raise ZerosetError(
        f"cannot draw something of type {type(value).__name__}", hint="give a Surface, a Scene or a formula as text"
    )
