"""What the user of the window has chosen: plain immutable values, and the changes that they go through.

The window holds one ``State`` and replaces it; panels and the mouse are functions from a state to a changed one.
Nothing here knows of a window, so all of it is tested without one.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from zeroset.scene.bounds import Bounds
from zeroset.scene.camera import Camera, fit_camera
from zeroset.scene.coloring import suited
from zeroset.scene.environment import BUILT_IN, Environment
from zeroset.scene.light import DEFAULT_LIGHTS, Color, Light, Material
from zeroset.scene.scene import Scene
from zeroset.scene.surface import Surface
from zeroset.solve.method import Method

BACKGROUND: Color = (0.0125, 0.0145, 0.019)
"""Behind a surface that came without a scene: dark, as the window is."""
OVERLAYS = ("none", "steps", "unresolved", "normals", "depth")


@dataclass(frozen=True, slots=True)
class Span:
    """The range of a slider."""

    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Motion:
    """How a parameter plays.

    Attributes:
        playing: whether it moves.
        seconds: time from one end of the range to the other.
        loop: start again at the low end; otherwise it goes to and fro.
        rising: the way it goes now.
    """

    playing: bool = False
    seconds: float = 4.0
    loop: bool = False
    rising: bool = True


@dataclass(frozen=True)
class State:
    """Everything that the window shows.

    Attributes:
        text: what stands in the formula box; may be ahead of the surface, or wrong.
        surface: what is drawn, inside bounds of its own.
        camera: how it is seen.
        home: the camera that "reset" goes back to.
        shadows: whether lights throw shadows.
        environment: what is seen all around instead of the background.
        picture: surroundings from a picture that the window was opened with, to come back to.
        antialias: rays of each pixel at an edge, in the picture at rest.
        tolerance: world length to which roots are found; None takes the default.
        device: the name of the device that draws.
        refit: whether bounds follow the formula, or are the user's own.
        spans: ranges of sliders that are not the usual one.
        motions: how parameters play.
        named: longer names in the formula that the user has declared parameters.
        budget: milliseconds that a picture may take while something moves.
        todo: what the panels ask the window to do, as pairs of what and with what.
    """

    text: str
    surface: Surface
    camera: Camera
    home: Camera
    method: Method
    material: Material = field(default_factory=Material)
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
    refit: bool = True
    flying: bool = False
    fly_speed: float = 1.0
    help: bool = False
    spans: Mapping[str, Span] = field(default_factory=dict)
    motions: Mapping[str, Motion] = field(default_factory=dict)
    named: frozenset[str] = frozenset()
    budget: float = 33.0
    todo: tuple[tuple[str, str], ...] = ()

    @property
    def scene(self) -> Scene:
        """What ``zs.render`` is given to make this picture."""
        return Scene(
            self.surface,
            self.camera,
            dressed(self.material, self.surface),
            self.lights,
            self.background,
            self.shadows,
            self.environment,
        )

    @property
    def bounds(self) -> Bounds:
        """Where the surface is drawn."""
        return self.surface.fitted

    @property
    def playing(self) -> bool:
        """Whether any parameter moves by itself."""
        return any(self.motions[name].playing for name in self.surface.params if name in self.motions)

    def ask(self, what: str, value: str = "") -> State:
        """The state with one more thing to do for the window."""
        return replace(self, todo=(*self.todo, (what, value)))


def dressed(material: Material, surface: Surface) -> Material:
    """The material as a surface can have it: without a formula to colour by that is not meant for it."""
    coloring = suited(material.coloring, surface)
    return material if coloring is material.coloring else replace(material, coloring=coloring)


def opened(scene: Scene, text: str, method: Method, device: str, tolerance: float | None) -> State:
    """The state that a window opens with."""
    surface = scene.plain("the window")
    refit = surface.bounds is None
    # The window has one material: the surface's own, where it has one.
    material = surface.material or scene.material
    surface = surface.with_bounds(surface.fitted).with_material(None)
    camera = scene.camera or surface.camera or fit_camera(surface.fitted)
    around = scene.environment
    return State(
        text,
        surface,
        camera,
        camera,
        method,
        material,
        scene.lights,
        scene.background,
        scene.shadows,
        around,
        None if around is None or around.source in BUILT_IN else around,
        tolerance=tolerance,
        device=device,
        refit=refit,
    )


def usual_span(value: float) -> Span:
    """A sensible range around a value: to twice its size on either side of zero, in round numbers.

    Example:
        >>> usual_span(5.0), usual_span(0.0)
        (Span(low=-10.0, high=10.0), Span(low=-1.0, high=1.0))
    """
    if value == 0.0:
        return Span(-1.0, 1.0)
    twice = 2.0 * abs(value)
    unit = 10.0 ** math.floor(math.log10(twice))
    reach = next(step * unit for step in (1.0, 2.0, 5.0, 10.0) if step * unit >= twice * (1 - 1e-12))
    return Span(-reach, reach)


def span_of(state: State, name: str) -> Span:
    """The range of a parameter's slider."""
    known = state.spans.get(name)
    return known if known is not None else usual_span(state.surface.params[name])


def with_param(state: State, name: str, value: float) -> State:
    """Another value of a parameter; its slider keeps its range."""
    spans = {**state.spans, name: span_of(state, name)}
    return replace(state, surface=state.surface.with_params(**{name: value}), spans=spans)


def with_span(state: State, name: str, low: float, high: float) -> State:
    """Another range of a parameter's slider; ends in the wrong order, or on one spot, change nothing."""
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        return state
    return replace(state, spans={**state.spans, name: Span(low, high)})


def with_motion(state: State, name: str, motion: Motion) -> State:
    """Another way for a parameter to play."""
    return replace(state, motions={**state.motions, name: motion})


def play_or_pause(state: State) -> State:
    """All parameters stop, if one plays; otherwise those that have played before go on, or else the first one."""
    names = [name for name in state.surface.params if name in state.motions]
    if state.playing:
        paused = {name: replace(motion, playing=False) for name, motion in state.motions.items()}
        return replace(state, motions=paused)
    for name in names or list(state.surface.params)[:1]:
        state = with_motion(state, name, replace(state.motions.get(name, Motion()), playing=True))
    return state


def advanced(state: State, seconds: float) -> State:
    """The state after so much time: every parameter that plays has moved."""
    for name, motion in state.motions.items():
        if motion.playing and name in state.surface.params:
            span = span_of(state, name)
            value, rising = moved(state.surface.params[name], span, motion, seconds)
            state = with_motion(with_param(state, name, value), name, replace(motion, rising=rising))
    return state


def moved(value: float, span: Span, motion: Motion, seconds: float) -> tuple[float, bool]:
    """Where a playing parameter has come to, and which way it goes then.

    Example:
        >>> moved(0.5, Span(0.0, 1.0), Motion(seconds=1.0), 0.75)
        (0.75, False)
        >>> moved(0.5, Span(0.0, 1.0), Motion(seconds=1.0, loop=True), 0.75)
        (0.25, True)
    """
    share = (min(max(value, span.low), span.high) - span.low) / (span.high - span.low)
    step = seconds / max(motion.seconds, 1e-3)
    if motion.loop:
        share = (share + step) % 1.0
        return span.low + share * (span.high - span.low), True
    # To and fro is a turn around a circle of two lengths: up in the first half, down in the second.
    phase = ((share if motion.rising else 2.0 - share) + step) % 2.0
    share = phase if phase <= 1.0 else 2.0 - phase
    return span.low + share * (span.high - span.low), phase < 1.0
