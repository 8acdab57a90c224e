"""The isovalues of the chosen surface: the values and colours of those that there are, one more, one less."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from zeroset.scene.encoding import linear, srgb
from zeroset.scene.isovalues import MOST_ISOVALUES
from zeroset.view.item import with_levels
from zeroset.view.levels import Level
from zeroset.view.panels.context import Context
from zeroset.view.spans import Span
from zeroset.view.state import State, with_another_level
from zeroset.view.widgets import ROOM, remover


def draw(state: State, context: Context) -> State:
    """A row for each, and a button for one more."""
    imgui, item = context.imgui, state.item
    if not item.levels:
        imgui.text_disabled("none: f = 0 is drawn")
    rows = []
    for i, level in enumerate(item.levels):
        imgui.push_id(f"{item.key} {i}")
        row = _row(imgui, level, item.level_span)
        rows += [] if row is None else [row]
        imgui.pop_id()
    if tuple(rows) != item.levels:
        state = state.with_item(with_levels(item, rows))
    imgui.begin_disabled(state.full or len(item.levels) >= MOST_ISOVALUES)
    if imgui.button("add an isovalue", (-1.0, 0.0)):
        state = with_another_level(state)
    imgui.end_disabled()
    return state


def _row(imgui: Any, level: Level, span: Span) -> Level | None:
    """Colour, value, and a button that removes it; None where that was clicked."""
    flags = imgui.ColorEditFlags_.no_inputs | imgui.ColorEditFlags_.no_label
    tinted, shown = imgui.color_edit3("##color", [srgb(v) for v in level.color], flags)
    imgui.same_line()
    imgui.set_next_item_width(-ROOM)
    flags = imgui.SliderFlags_.no_round_to_format
    moved, value = imgui.slider_float("##value", level.value, span.low, span.high, "f = %.4g", flags)
    if remover(imgui, "remove this isovalue"):
        return None
    if tinted:
        red, green, blue = (linear(float(v)) for v in shown[:3])
        level = replace(level, color=(red, green, blue))
    return replace(level, value=float(value)) if moved else level
