"""What the user of the window has chosen: plain immutable values, and the changes that they go through.

The window holds one ``State`` and replaces it; panels and the mouse are functions from a state to a changed one.
Nothing here knows of a window, so all of it is tested without one.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from zeroset.scene.bounds import Bounds
from zeroset.scene.camera import Camera, fit_camera
from zeroset.scene.colored import suited
from zeroset.scene.coloring import Coloring
from zeroset.scene.environment import BUILT_IN, Environment
from zeroset.scene.isovalues import MOST_ISOVALUES
from zeroset.scene.light import DEFAULT_LIGHTS, Color, Light, Material
from zeroset.scene.scene import MOST_PARTS, Scene
from zeroset.scene.several import Drawable, Several
from zeroset.solve.method import Method
from zeroset.view import item as items
from zeroset.view.item import Item
from zeroset.view.motion import Motion

BACKGROUND: Color = (0.0125, 0.0145, 0.019)
"""Behind a surface that came without a scene: dark, as the window is."""
OVERLAYS = ("none", "steps", "unresolved", "normals", "depth")


@dataclass(frozen=True)
class State:
    """Everything that the window shows.

    Attributes:
        items: the surfaces of the scene; at least one.
        camera: how they are seen.
        home: the camera that "reset" goes back to.
        chosen: the place of the surface that panels act on.
        shadows: whether lights throw shadows.
        environment: what is seen all around instead of the background.
        picture: surroundings from a picture that the window was opened with, to come back to.
        antialias: rays of each pixel at an edge, in the picture at rest.
        tolerance: world length to which roots are found; None takes the default.
        device: the name of the device that draws.
        budget: milliseconds that a picture may take while something moves.
        todo: what the panels ask the window to do, as pairs of what and with what.
    """

    items: tuple[Item, ...]
    camera: Camera
    home: Camera
    method: Method
    chosen: int = 0
    lights: tuple[Light, ...] = DEFAULT_LIGHTS
    background: Color = BACKGROUND
    shadows: bool = False
    environment: Environment | None = None
    picture: Environment | None = None
    antialias: int = 1
    tolerance: float | None = None
    device: str = "auto"
    overlay: str = "none"
    axes: bool = False
    grid: bool = False
    outline: bool = False
    flying: bool = False
    fly_speed: float = 1.0
    help: bool = False
    budget: float = 33.0
    todo: tuple[tuple[str, str], ...] = ()

    @property
    def item(self) -> Item:
        """The surface that panels act on."""
        return self.items[self.chosen]

    @property
    def several(self) -> bool:
        """Whether there are several surfaces."""
        return len(self.items) > 1

    @cached_property
    def drawn(self) -> Drawable:
        """All surfaces; several have a material each, one has the scene's."""
        if not self.several:
            return self.item.drawn
        return Several(tuple(item.drawn.with_material(_own(self._dressed(item))) for item in self.items))

    @cached_property
    def coloring(self) -> Coloring | None:
        """What the picture is coloured by: the first coloring that means something for its surface."""
        suiting = (suited(item.material.coloring, item.drawn) for item in self.items)
        return next((coloring for coloring in suiting if coloring is not None), None)

    def _dressed(self, item: Item) -> Material:
        """A surface's material in this picture, which has one coloring for all that are coloured."""
        coloring = None if item.material.coloring is None else self.coloring
        return replace(item.material, coloring=coloring)

    @cached_property
    def scene(self) -> Scene:
        """What ``zs.render`` is given to make this picture."""
        material = Material() if self.several else self._dressed(self.item)
        return Scene(self.drawn, self.camera, material, self.lights, self.background, self.shadows, self.environment)

    @property
    def bounds(self) -> Bounds:
        """Around everything that is drawn."""
        return self.drawn.fitted

    @property
    def playing(self) -> bool:
        """Whether any parameter moves by itself."""
        return any(item.playing for item in self.items)

    @property
    def full(self) -> bool:
        """Whether a scene can hold no more surfaces or isovalues."""
        return sum(item.parts for item in self.items) >= MOST_PARTS

    def edited(self, **changes: Any) -> State:
        """The state with changes of the surface that panels act on."""
        return self.with_item(replace(self.item, **changes))

    def with_item(self, item: Item) -> State:
        """The state with another version of one of its surfaces."""
        return replace(self, items=tuple(item if item.key == known.key else known for known in self.items))

    def colored_by(self, coloring: Coloring | None) -> State:
        """The state with the chosen surface coloured by something, and with it all that are coloured already."""
        state = self.edited(material=replace(self.item.material, coloring=coloring))
        return state if coloring is None else _each(state, lambda item: items.recolored(item, coloring))

    def find(self, key: int) -> Item | None:
        """The surface with a key, if it is still there."""
        return next((item for item in self.items if item.key == key), None)

    def ask(self, what: str, value: str = "") -> State:
        """The state with one more thing to do for the window."""
        return replace(self, todo=(*self.todo, (what, value)))


def _own(material: Material) -> Material | None:
    """The material of one of several surfaces; None for the usual one."""
    return None if material == Material() else material


def opened(scene: Scene, texts: Sequence[str], method: Method, device: str, tolerance: float | None) -> State:
    """The state that a window opens with.

    Args:
        scene: surfaces, and what comes with them; no solids.
        texts: what stands in the formula box of each surface.
        method: how roots are found.
        device: the name of the device that draws.
        tolerance: world length to which roots are found.
    """
    given = zip(scene.surface.surfaces, texts, strict=True)
    shown = tuple(items.opened(key, surface, text, scene.material) for key, (surface, text) in enumerate(given))
    camera = scene.camera or scene.surface.camera or fit_camera(scene.surface.fitted)
    around = scene.environment
    return State(
        shown,
        camera,
        camera,
        method,
        0,
        scene.lights,
        scene.background,
        scene.shadows,
        around,
        None if around is None or around.source in BUILT_IN else around,
        tolerance=tolerance,
        device=device,
    )


def with_another_item(state: State) -> State:
    """One more surface, which is chosen; as it is where a scene can hold no more."""
    if state.full:
        return state
    key = 1 + max(item.key for item in state.items)
    # Planes that were added and not yet typed over are no measure of the scene.
    own = [item for item in state.items if not items.fresh(item)] or list(state.items)
    scene = replace(state, items=tuple(own), chosen=0)
    new = items.added(key, scene.bounds, len(state.items) - len(own))
    return replace(state, items=(*state.items, new), chosen=len(state.items))


def without_item(state: State, place: int) -> State:
    """One surface less; the last one stays."""
    if not state.several:
        return state
    left = (*state.items[:place], *state.items[place + 1 :])
    chosen = state.chosen - (state.chosen > place)
    return replace(state, items=left, chosen=min(chosen, len(left) - 1))


def with_another_level(state: State) -> State:
    """One more isovalue of the chosen surface; as it is where there can be no more."""
    # The first one brings f = 0 along, which counts already.
    if state.full or len(state.item.levels) >= MOST_ISOVALUES:
        return state
    return state.with_item(items.with_another_level(state.item))


def play_or_pause(state: State) -> State:
    """All parameters stop, if one plays; otherwise those that have played before go on, or else the first one."""
    if state.playing:
        return _each(state, items.paused)
    played = {(item.key, name) for item in state.items for name in item.surface.params if name in item.motions}
    first = [(state.item.key, name) for name in list(state.item.surface.params)[:1]]
    for key, name in played or first:
        item = state.find(key)
        assert item is not None
        motion = replace(item.motions.get(name, Motion()), playing=True)
        state = state.with_item(items.with_motion(item, name, motion))
    return state


def advanced(state: State, seconds: float) -> State:
    """The state after so much time: every parameter that plays has moved."""
    return _each(state, lambda item: items.advanced(item, seconds)) if state.playing else state


def _each(state: State, change: Callable[[Item], Item]) -> State:
    """The state with all of its surfaces changed."""
    return replace(state, items=tuple(map(change, state.items)))
