"""What light costs on top of a plain frame: shadows, layers, mirrors, glass, edges, beside the papers' own ratios."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from zeroset.bench.timing import Times, take_turns
from zeroset.errors import ZerosetError
from zeroset.rendering.frame import settle
from zeroset.rendering.render import render
from zeroset.runtime import Device
from zeroset.scene.light import Light, Material
from zeroset.scene.surface import Surface

SUN = (Light(direction=(0.55, -0.35, 0.9), headlight=False),)


@dataclass(frozen=True, slots=True)
class Feature:
    """One thing that light does.

    Attributes:
        name: for people.
        goal: times a plain frame that it may take: what K09 or SN10 measured for theirs; None where they say nothing.
        options: of ``render``, beside those of the plain frame.
        isovalues: whether f is met at two values instead of at one of them.
    """

    name: str
    goal: float | None
    options: dict[str, Any] = field(default_factory=dict)
    isovalues: bool = False


FEATURES = (
    Feature("one shadow light", 1.5, {"shadows": True}),
    Feature("four layers", 3.0, {"material": Material(opacity=0.5), "depth": 3}),
    Feature("six reflections", 1.3, {"material": Material(reflectance=0.4), "depth": 6}),
    Feature("glass", None, {"material": Material(opacity=0.1, reflectance=0.1, ior=1.4), "environment": "sky"}),
    Feature("smooth edges, 16", 1.6, {"antialias": 16}),
    Feature("two isovalues", 1.4, isovalues=True),
)


@dataclass(frozen=True, slots=True)
class LightCost:
    """One feature on one surface at one size.

    Attributes:
        name: of the surface.
        feature: what was on.
        size: pixels along a side.
        plain: milliseconds of a frame with one light and nothing more.
        frame: milliseconds of a frame with the feature.
        goal: times a plain frame that it may take; None where there is no such goal.
        error: why it could not be drawn, or an empty string.
    """

    name: str
    feature: str
    size: int
    plain: Times | None = None
    frame: Times | None = None
    goal: float | None = None
    error: str = ""

    @property
    def ratio(self) -> float | None:
        """How many plain frames it takes, best by best."""
        return None if self.plain is None or self.frame is None else self.frame.best / self.plain.best


def measure_light(surface: Surface, size: int, method: str, device: Device, seconds: float) -> Iterator[LightCost]:
    """Measure every feature on one surface; each takes turns with a plain frame."""

    def draw(shown: Surface = surface, **options: Any) -> None:
        # The pixels are fetched, so that a GPU has drawn them.
        render(shown, size, method=method, device=device, lights=SUN, **options).pixels  # noqa: B018

    twice = surface.with_isovalues((0.0, surface.fitted.reach))
    for feature in FEATURES:
        both = draw, partial(draw, twice if feature.isovalues else surface, **feature.options)
        try:
            for one in both:
                one()
            # Nothing shall be compiled on the cores that are timed.
            settle()
            plain, frame = take_turns(both, seconds)
        except ZerosetError as error:
            yield LightCost(surface.name, feature.name, size, error=str(error).splitlines()[0])
        else:
            yield LightCost(surface.name, feature.name, size, plain, frame, feature.goal)
