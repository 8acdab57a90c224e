"""The sidebar's sections: each file has a ``draw`` from the state to a changed one, and draws itself on the way.

``PANELS`` lists them from top to bottom. ``imgui`` is handed in, since only a window loads it.
"""

from __future__ import annotations

from collections.abc import Callable

from zeroset.view.panels import (
    bounds,
    camera,
    formula,
    gallery,
    isovalues,
    light,
    material,
    method,
    output,
    overlays,
    parameters,
    surfaces,
    timing,
)
from zeroset.view.panels.context import Context
from zeroset.view.state import State

Panel = tuple[str, Callable[[State, Context], State], Callable[[State], bool]]


def _always(state: State) -> bool:
    return True


def _never(state: State) -> bool:
    return False


PANELS: tuple[Panel, ...] = (
    ("Parameters", parameters.draw, _always),
    ("Isovalues", isovalues.draw, lambda state: any(item.levels for item in state.items)),
    ("Gallery", gallery.draw, lambda state: not state.several),
    ("Camera", camera.draw, _never),
    ("Bounds", bounds.draw, _never),
    ("Light", light.draw, _never),
    ("Colours", material.draw, _never),
    ("Method", method.draw, _never),
    ("Overlays", overlays.draw, _never),
    ("Timing", timing.draw, _never),
    ("Save and copy", output.draw, _never),
)
"""Title, function, and whether it is open at first; the surfaces and the chosen one's formula stand above them all."""

__all__ = ["PANELS", "formula", "surfaces"]
