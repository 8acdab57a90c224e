"""Colours of the surface, what is behind it, and how it reflects, mirrors and lets light through."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from zeroset.scene.environment import BUILT_IN, Environment
from zeroset.scene.light import Material
from zeroset.view.panels import coloring
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import checkbox, choice, color, slider

SHARES = (("ambient", 1.0), ("diffuse", 1.5), ("specular", 1.5))
NOTHING = "none"


def draw(state: State, context: Context) -> State:
    """What the surface is coloured by, three colours, the surroundings, and seven numbers."""
    state = coloring.draw(state, context)
    imgui, material = context.imgui, state.item.material
    changes: dict[str, Any] = {}
    if state.item.levels:
        imgui.text_disabled("front and back: those of the isovalues")
    for side in ("front", "back") if not state.item.levels else ():
        changed, tint = color(imgui, side, getattr(material, side))
        if changed:
            changes[side] = tint
    changed, background = color(imgui, "behind", state.background)
    if changed:
        state = replace(state, background=background)
    state = _surroundings(imgui, state)
    for name, most in SHARES:
        changed, value = slider(imgui, name, getattr(material, name), (0.0, most), "%.2f")
        if changed:
            changes[name] = min(max(value, 0.0), 1e6)
    changed, value = slider(imgui, "shininess", material.shininess, (1.0, 500.0), "%.0f", True)
    if changed:
        changes["shininess"] = min(max(value, 1e-3), 10000.0)
    changes |= _optics(imgui, material)
    return state.edited(material=replace(material, **changes)) if changes else state


def _optics(imgui: Any, material: Material) -> dict[str, Any]:
    """What has changed of a mirror and of glass; the index of refraction is there where light goes in."""
    changes: dict[str, Any] = {}
    for name, text, hint in (
        ("reflectance", "mirror", "share of the light that is mirrored"),
        ("opacity", "opacity", "1 is solid; below, what lies behind is seen through it"),
    ):
        changed, value = slider(imgui, text, getattr(material, name), (0.0, 1.0), "%.2f", hint=hint)
        if changed:
            changes[name] = min(max(value, 0.0), 1.0)
    if material.opacity < 1.0:
        hint = "index of refraction of the inside, where f < 0; 1 bends nothing, glass is 1.5"
        changed, value = slider(imgui, "refraction", material.ior, (0.5, 2.5), "%.2f", hint=hint)
        if changed:
            changes["ior"] = min(max(value, 0.1), 10.0)
        hint = "seen through only where another surface lies behind"
        last = checkbox(imgui, "last one solid", material.last_solid, hint)
        if last != material.last_solid:
            changes["last_solid"] = last
    return changes


def _surroundings(imgui: Any, state: State) -> State:
    """What is seen all around: nothing, what needs no file, and the picture that the scene came with."""
    own = state.picture
    around: dict[str, Environment | None] = {NOTHING: None, **{name: Environment(name) for name in BUILT_IN}}
    if own is not None:
        around["picture"] = own
    now = state.environment
    name = NOTHING if now is None else now.source if now.source in BUILT_IN else "picture"
    wanted = choice(imgui, "all around", str(name), tuple(around), "seen behind, in mirrors and through glass")
    return state if wanted == name else replace(state, environment=around[wanted])
