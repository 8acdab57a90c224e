"""The camera: where it looks from, its lens, and flight."""

from __future__ import annotations

from dataclasses import replace

from zeroset.view import orbit
from zeroset.view.controls import flight, with_projection
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.theme import FAINT
from zeroset.view.widgets import checkbox, said, slider

SIDES = {"front": "1", "back": "2", "right": "3", "left": "4", "top": "5", "bottom": "6", "3/4": "7"}
"""Buttons, and the keys that do the same."""


def draw(state: State, context: Context) -> State:
    """Buttons, lens, flight."""
    imgui = context.imgui
    for i, (name, key) in enumerate(SIDES.items()):
        if i % 4:
            imgui.same_line()
        if imgui.button(name, (74.0, 0.0)):
            state = replace(state, camera=orbit.along(state.camera, orbit.AXES[key]))
        imgui.set_item_tooltip(f"key {key}")
    imgui.same_line()
    if imgui.button("fit", (74.0, 0.0)):
        state = replace(state, camera=orbit.fit(state.camera, state.bounds))
    imgui.set_item_tooltip("the whole of the bounds; key F. R goes back to the first view")
    state = _lens(state, context)
    return _flight(state, context)


def _lens(state: State, context: Context) -> State:
    imgui, camera = context.imgui, state.camera
    flat = checkbox(imgui, "orthographic", camera.height is not None, "no perspective; key O")
    if flat != (camera.height is not None):
        return with_projection(state, flat)
    if camera.height is not None:
        reach = state.bounds.reach
        changed, height = slider(imgui, "height", camera.height, (0.02 * reach, 10 * reach), "%.4g", True)
        return replace(state, camera=replace(camera, height=max(height, 1e-6 * reach))) if changed else state
    changed, fov = slider(imgui, "opening", camera.fov or 35.0, (5.0, 120.0), "%.0f degrees")
    if not changed:
        return state
    fov = min(max(fov, 1.0), 170.0)
    if state.flying:
        return replace(state, camera=replace(camera, fov=fov))
    # The target stays as large as it is: the eye comes nearer as the opening widens.
    return replace(state, camera=orbit.perspective(camera, fov))


def _flight(state: State, context: Context) -> State:
    imgui = context.imgui
    flying = checkbox(imgui, "fly", state.flying, "key G; Esc ends it")
    if flying != state.flying:
        state = flight(state, flying)
    if state.flying:
        changed, speed = slider(imgui, "speed", state.fly_speed, (0.02, 50.0), "%.2f", True, "the wheel does the same")
        state = replace(state, fly_speed=min(max(speed, 0.02), 50.0)) if changed else state
        said(imgui, "W A S D and Q E move, Shift is faster, dragging looks around", FAINT)
    x, y, z = state.camera.eye
    imgui.text_disabled(f"eye  {x:.4g}, {y:.4g}, {z:.4g}")
    return state
