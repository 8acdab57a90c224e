"""Where the surface is drawn: a ball or a box, by sliders, or fitted to the formula."""

from __future__ import annotations

import math

from zeroset.scene.bounds import Ball, Bounds, Box
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import choice, label, slider


def draw(state: State, context: Context) -> State:
    """Kind, size, centre."""
    imgui, bounds = context.imgui, state.item.surface.fitted
    kind = "ball" if isinstance(bounds, Ball) else "box"
    wanted = choice(imgui, "shape", kind, ("ball", "box"))
    changed: Bounds = bounds if wanted == kind else other(bounds)
    changed = _ball(changed, context) if isinstance(changed, Ball) else _box(changed, context)
    if changed != bounds:
        state = state.edited(surface=state.item.surface.with_bounds(changed), refit=False)
    if imgui.button("fit to the formula", (-1.0, 0.0)):
        state = state.ask("fit-bounds")
    imgui.set_item_tooltip("finds where f can be zero, by interval arithmetic")
    return state


def other(bounds: Bounds) -> Bounds:
    """The box around a ball, the ball around a box.

    Example:
        >>> other(Ball(2.0)).max
        (2.0, 2.0, 2.0)
    """
    if isinstance(bounds, Ball):
        x, y, z = bounds.center
        r = bounds.radius
        return Box((x - r, y - r, z - r), (x + r, y + r, z + r))
    return Ball(bounds.reach, bounds.center)


def range_of(size: float) -> tuple[float, float]:
    """The range of a slider for a size: round numbers, a tenth to some ten times of it; the same for sizes near by.

    Example:
        >>> range_of(3.0), range_of(12.0)
        ((0.1, 10.0), (1.0, 100.0))
    """
    top = 10.0 ** (math.floor(math.log10(size) + 1e-9) + 1)
    return 0.01 * top, top


def _size(context: Context, text: str, size: float) -> float:
    # While a slider is held its range must not change under the pointer.
    key = f"range {text}"
    imgui = context.imgui
    low, high = map(float, context.fields.get(key, "0 0").split())
    if not low <= size <= high or not imgui.is_mouse_down(0):
        low, high = range_of(size) if not low < size < 0.999 * high else (low, high)
        context.fields[key] = f"{low!r} {high!r}"
    changed, value = slider(imgui, text, size, (low, high), "%.4g", True)
    return min(max(value, 1e-6), 1e6) if changed else size


def _ball(ball: Ball, context: Context) -> Bounds:
    return Ball(_size(context, "radius", ball.radius), _center(context, ball.center, ball.radius))


def _box(box: Box, context: Context) -> Bounds:
    """Half sizes along the axes, and the centre."""
    halves = [0.5 * (b - a) for a, b in zip(box.min, box.max, strict=True)]
    wanted = [_size(context, f"half {axis}", half) for axis, half in zip("xyz", halves, strict=True)]
    center = _center(context, box.center, box.reach)
    if wanted == halves and center == box.center:
        return box
    corners = [(c - h, c + h) for c, h in zip(center, wanted, strict=True)]
    return Box((corners[0][0], corners[1][0], corners[2][0]), (corners[0][1], corners[1][1], corners[2][1]))


def _center(context: Context, center: tuple[float, float, float], reach: float) -> tuple[float, float, float]:
    imgui = context.imgui
    label(imgui, "centre")
    changed, values = imgui.drag_float3("##centre", list(center), 0.01 * reach, 0.0, 0.0, "%.4g")
    x, y, z = (min(max(float(v), -1e6), 1e6) for v in values)
    return (x, y, z) if changed else center
