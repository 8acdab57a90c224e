"""What is shown over the picture, or in its place."""

from __future__ import annotations

from dataclasses import replace

from zeroset.view.panels.context import Context
from zeroset.view.state import OVERLAYS, State
from zeroset.view.widgets import checkbox, choice

MEANINGS = {
    "none": "the picture as it is lit",
    "steps": "how often f was evaluated for each ray",
    "unresolved": "pixels that could be neither proven nor excluded",
    "normals": "the direction of the gradient",
    "depth": "bright is near",
}


def draw(state: State, context: Context) -> State:
    """The colours, and three kinds of lines."""
    imgui = context.imgui
    overlay = choice(imgui, "colours", state.overlay, OVERLAYS)
    imgui.text_disabled(MEANINGS[overlay])
    axes = checkbox(imgui, "axes", state.axes)
    imgui.same_line()
    grid = checkbox(imgui, "grid", state.grid)
    imgui.same_line()
    outline = checkbox(imgui, "bounds", state.outline)
    if (overlay, axes, grid, outline) == (state.overlay, state.axes, state.grid, state.outline):
        return state
    return replace(state, overlay=overlay, axes=axes, grid=grid, outline=outline)
