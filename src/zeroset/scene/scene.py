"""A scene: what is drawn with its camera, material, lights and background; what a ``.toml`` file holds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from zeroset.errors import ParameterError, ZerosetError
from zeroset.scene.camera import Camera
from zeroset.scene.light import DEFAULT_BACKGROUND, DEFAULT_LIGHTS, Color, Light, Material, color
from zeroset.scene.several import Drawable, Several, as_drawable, plain_surface
from zeroset.scene.solid import Solid
from zeroset.scene.surface import Surface, surface

if TYPE_CHECKING:
    from zeroset.scene.colored import Colored
    from zeroset.scene.coloring import Coloring
    from zeroset.scene.environment import Environment

MOST_LIGHTS = 32
"""Lights of a scene: each is code in the shading kernel."""

MOST_PARTS = 32
"""Surfaces and isovalues of a scene, all together."""


@dataclass(frozen=True)
class Scene:
    """Everything that a picture needs.

    Attributes:
        surface: what is drawn: a Surface, a Solid, or a sequence of both.
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

    surface: Drawable
    camera: Camera | None = None
    material: Material = field(default_factory=Material)
    lights: tuple[Light, ...] = DEFAULT_LIGHTS
    background: Color = DEFAULT_BACKGROUND
    shadows: bool = False
    environment: Environment | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "surface", as_drawable(self.surface))
        if not isinstance(self.material, Material):
            raise ParameterError(f"a scene's material must be a Material, not {self.material!r}")
        check_parts(self.surface)
        if not isinstance(self.shadows, bool):
            raise ParameterError(f"a scene's shadows must be True or False, not {self.shadows!r}")
        if self.coloring is not None:
            # Whoever is coloured finds out here whether that can be.
            _ = self.colored
        if self.environment is not None:
            # Imported where there is one, as colourings are: most pictures have neither.
            from zeroset.scene.environment import as_environment

            object.__setattr__(self, "environment", as_environment(self.environment))
        lights = self.lights if isinstance(self.lights, (tuple, list)) else (self.lights,)
        for light in lights:
            if not isinstance(light, Light):
                raise ParameterError(f"a scene's lights must be Lights, not {light!r}")
        if len(lights) > MOST_LIGHTS:
            raise ParameterError(f"a scene has at most {MOST_LIGHTS} lights, not {len(lights)}")
        object.__setattr__(self, "lights", tuple(lights))
        object.__setattr__(self, "background", color(self.background, "the background"))

    @property
    def materials(self) -> tuple[Material, ...]:
        """The material of each part of what is drawn."""
        return self.surface.materials(self.material)

    @property
    def coloring(self) -> Coloring | None:
        """What the picture is coloured by; None for nothing."""
        return next((material.coloring for material in self.materials if material.coloring is not None), None)

    @property
    def colored(self) -> Colored | None:
        """What the picture is coloured by, and which surfaces; None for nothing. Raises for what cannot be."""
        if self.coloring is None:
            return None
        # Imported where there is one: most pictures are coloured by nothing.
        from zeroset.scene.colored import colored

        return colored(self.surface, self.material)

    def plain(self, what: str) -> Surface:
        """The surface f = 0, where that is all that is drawn; raises ``ParameterError`` where it is not.

        Args:
            what: what takes only such a surface, for the error: ``"the window"``.
        """
        return plain_surface(self.surface, what)


def check_parts(thing: Drawable) -> None:
    """Raise ``ParameterError`` for more surfaces and isovalues than a scene can have."""
    count = len(thing.materials(Material()))
    if count > MOST_PARTS:
        raise ParameterError(f"a scene has at most {MOST_PARTS} surfaces and isovalues, not {count}")


Shown = Surface | Solid | Several | Scene | str | Sequence[Surface | Solid]
"""What users give to be drawn."""


def as_scene(value: Shown) -> Scene:
    """A Scene as it is; a surface, a solid, several of them or a formula with everything else by default."""
    if isinstance(value, Scene):
        return value
    if isinstance(value, (Surface, Solid, Several, list, tuple)):
        return Scene(as_drawable(value))
    if isinstance(value, str):
        return Scene(surface(value))
    raise ZerosetError(
        f"cannot draw something of type {type(value).__name__}",
        hint="give a Surface, a Solid, a Scene or a formula as text",
    )
