"""Colours of the surface and behind it, and how it reflects."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from zeroset.view.panels import coloring
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import color, slider

SHARES = (("ambient", 1.0), ("diffuse", 1.5), ("specular", 1.5))


def draw(state: State, context: Context) -> State:
    """What the surface is coloured by, three colours and four numbers."""
    state = coloring.draw(state, context)
    imgui, material = context.imgui, state.material
    changes: dict[str, Any] = {}
    for side in ("front", "back"):
        changed, tint = color(imgui, side, getattr(material, side))
        if changed:
            changes[side] = tint
    changed, background = color(imgui, "behind", state.background)
    if changed:
        state = replace(state, background=background)
    for name, most in SHARES:
        changed, value = slider(imgui, name, getattr(material, name), (0.0, most), "%.2f")
        if changed:
            changes[name] = min(max(value, 0.0), 1e6)
    changed, value = slider(imgui, "shininess", material.shininess, (1.0, 500.0), "%.0f", True)
    if changed:
        changes["shininess"] = min(max(value, 1e-3), 10000.0)
    return replace(state, material=replace(material, **changes)) if changes else state
