"""The key light: a small ball to drag it on, how strong it is, and shadows; and how smooth edges are at rest."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from zeroset.scene.bounds import Vector
from zeroset.scene.camera import Camera
from zeroset.scene.light import Light
from zeroset.view import orbit
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import checkbox, choice, color, packed, slider

RADIUS = 46.0
STRONGEST = 1000.0
"""Strength that can be typed."""
EDGES = {1: "one ray", 4: "4 rays", 16: "16 rays", 64: "64 rays"}
"""Rays of each pixel at an edge, and what they are called."""


def draw(state: State, context: Context) -> State:
    """The ball and the light's properties, shadows and edges."""
    imgui = context.imgui
    if state.lights:
        state = _key(imgui, state)
    elif imgui.button("add a light"):
        state = replace(state, lights=(Light(),))
    shadows = checkbox(imgui, "shadows", state.shadows, "what is between a point and a light takes it away")
    if shadows != state.shadows:
        state = replace(state, shadows=shadows)
    return _edges(imgui, state)


def _edges(imgui: Any, state: State) -> State:
    known = EDGES if state.antialias in EDGES else {**EDGES, state.antialias: f"{state.antialias} rays"}
    names = tuple(known.values())
    hint = "rays of a pixel at a silhouette or a crease, once nothing moves"
    rays = tuple(known)[names.index(choice(imgui, "edges", known[state.antialias], names, hint))]
    return state if rays == state.antialias else replace(state, antialias=rays)


def _key(imgui: Any, state: State) -> State:
    key, *others = state.lights
    key = _ball(imgui, key, state.camera)
    imgui.same_line()
    imgui.begin_group()
    key = _fixed(imgui, key, state.camera)
    strength = max(key.color)
    imgui.set_next_item_width(-1.0)
    changed, wanted = imgui.slider_float("##strength", strength, 0.0, 3.0, "strength %.2f")
    if changed and strength > 0:
        red, green, blue = (v * min(max(float(wanted), 1e-3), STRONGEST) / strength for v in key.color)
        key = replace(key, color=(red, green, blue))
    imgui.end_group()
    changed, tint = color(imgui, "tint", _normal(key.color))
    if changed and max(tint) > 0:
        red, green, blue = (v / max(tint) * strength for v in tint)
        key = replace(key, color=(red, green, blue))
    azimuth, height = angles(_toward(key, state.camera))
    turned, azimuth = slider(imgui, "around", azimuth, (-180.0, 180.0), "%.0f degrees")
    lifted, height = slider(imgui, "height", height, (-90.0, 90.0), "%.0f degrees")
    if turned or lifted:
        # A light at a place becomes one far away.
        key = replace(key, direction=direction(azimuth, height), position=None)
    lights = (key, *others)
    return state if lights == state.lights else replace(state, lights=lights)


def _normal(tint: Vector) -> Vector:
    most = max(*tint, 1e-9)
    red, green, blue = (v / most for v in tint)
    return red, green, blue


def angles(toward: Vector) -> tuple[float, float]:
    """Degrees around and up, of a direction (right, up, back) or (x, y, z) alike: about its second axis.

    Example:
        >>> angles((0.0, 0.0, 1.0)), angles((1.0, 0.0, 0.0))
        ((0.0, 0.0), (90.0, 0.0))
    """
    x, y, z = toward
    return math.degrees(math.atan2(x, z)), math.degrees(math.atan2(y, math.hypot(x, z)))


def direction(azimuth: float, height: float) -> Vector:
    """What ``angles`` takes apart."""
    a, h = math.radians(azimuth), math.radians(height)
    return math.cos(h) * math.sin(a), math.sin(h), math.cos(h) * math.cos(a)


def seen(light: Light, camera: Camera) -> Vector:
    """The light's direction in the camera's coordinates: right, up, back."""
    toward = np.asarray(_toward(light, camera))
    if light.headlight:
        x, y, z = (float(v) for v in toward)
        return _unit((x, y, z))
    right, up, forward = orbit.frame(camera)
    return _unit((float(toward @ right), float(toward @ up), float(-(toward @ forward))))


def placed(light: Light, camera: Camera, toward: Vector) -> Light:
    """The light with a direction given in the camera's coordinates; one at a place becomes one far away."""
    if light.headlight:
        return replace(light, direction=toward, position=None)
    right, up, forward = orbit.frame(camera)
    x, y, z = (float(v) for v in toward[0] * right + toward[1] * up - toward[2] * forward)
    return replace(light, direction=(x, y, z), position=None)


def _toward(light: Light, camera: Camera) -> Vector:
    """The direction that a light comes from, at the camera's target; of a headlight, from the camera's axes."""
    if light.position is None:
        return light.direction
    target = (0.0, 0.0, -math.dist(camera.eye, camera.target)) if light.headlight else camera.target
    x, y, z = (p - t for p, t in zip(light.position, target, strict=True))
    return (x, y, z) if (x, y, z) != (0.0, 0.0, 0.0) else light.direction


def _unit(toward: Vector) -> Vector:
    length = math.hypot(*toward)
    x, y, z = (v / length for v in toward)
    return x, y, z


def _fixed(imgui: Any, light: Light, camera: Camera) -> Light:
    """Whether it moves with the camera; it stays where it is seen when that changes."""
    along = checkbox(imgui, "headlight", light.headlight, "moves with the camera; otherwise it stays in the scene")
    if along == light.headlight:
        return light
    return placed(replace(light, headlight=along, position=None), camera, seen(light, camera))


def _ball(imgui: Any, light: Light, camera: Camera) -> Light:
    """A ball lit by the light; dragging on it puts the light there."""
    corner = imgui.get_cursor_screen_pos()
    imgui.invisible_button("##ball", (2 * RADIUS + 8, 2 * RADIUS + 4))
    if imgui.is_item_active():
        pointer = imgui.get_mouse_pos()
        x = (pointer.x - corner.x - RADIUS - 2) / RADIUS
        y = (corner.y + RADIUS + 2 - pointer.y) / RADIUS
        light = placed(light, camera, _on_ball(x, y))
    x, y, z = seen(light, camera)
    pen, middle = imgui.get_window_draw_list(), (corner.x + RADIUS + 2, corner.y + RADIUS + 2)
    pen.add_circle_filled(middle, RADIUS, packed(imgui, (0.13, 0.14, 0.16)), 48)
    # Discs that shrink towards the lit side, each brighter: a ball with few strokes.
    for i in range(24):
        share = (i + 1) / 24
        place = (middle[0] + x * share * RADIUS * 0.62, middle[1] - y * share * RADIUS * 0.62)
        bright = max(0.0, 0.45 + 0.55 * z) * share
        tint = (0.13 + 0.82 * bright, 0.14 + 0.46 * bright, 0.16 + 0.06 * bright)
        pen.add_circle_filled(place, RADIUS * (1.0 - 0.92 * share), packed(imgui, tint), 32)
    spot = (middle[0] + x * RADIUS, middle[1] - y * RADIUS)
    pen.add_circle_filled(spot, 5.0, packed(imgui, (1.0, 0.95, 0.8), 1.0 if z >= 0 else 0.35))
    pen.add_circle(spot, 5.5, packed(imgui, (0.0, 0.0, 0.0), 0.7), 0, 1.5)
    return light


def _on_ball(x: float, y: float) -> Vector:
    """The point of the front half of the unit ball over a place; its rim for a place outside."""
    length = math.hypot(x, y)
    if length >= 0.999:
        return _unit((x, y, 0.04 * length))
    return x, y, math.sqrt(1.0 - length * length)
