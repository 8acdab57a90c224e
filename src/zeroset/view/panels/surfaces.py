"""The surfaces of the scene, above the formula box: which one the panels act on, one more, one less."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from zeroset.scene.encoding import srgb
from zeroset.scene.light import Color
from zeroset.view import theme
from zeroset.view.item import Item
from zeroset.view.panels.context import Context
from zeroset.view.state import State, with_another_item, without_item
from zeroset.view.widgets import ROOM, packed, remover

ADD = "add a surface"
"""What the button says that adds one."""
ROWS = 6
"""Surfaces that are listed at once."""
SWATCH = 14.0
"""Side of the square that shows a surface's colours."""
LONGEST = 200
"""Characters of a formula in the list; far fewer can be seen."""


def draw(state: State, context: Context) -> State:
    """A row for each; nothing where there is one alone."""
    if not state.several:
        return state
    imgui, removed = context.imgui, None
    # The formula box stays in sight under however many there are.
    rows, gap = min(len(state.items), ROWS), imgui.get_style().item_spacing.y
    imgui.push_style_color(imgui.Col_.child_bg, (*theme.PANEL, 1.0))
    imgui.begin_child("##surfaces", (0.0, rows * (imgui.get_frame_height() + gap) - gap))
    for place, item in enumerate(state.items):
        imgui.push_id(item.key)
        if _row(context, item, place == state.chosen):
            state = replace(state, chosen=place)
        _follow(context, item, place == state.chosen)
        if remover(imgui, "remove this surface"):
            removed = place
        imgui.pop_id()
    imgui.end_child()
    imgui.pop_style_color()
    return state if removed is None else without_item(state, removed)


def add(state: State, imgui: Any) -> State:
    """A small button at the right edge of the row that was begun, for one more surface."""
    if state.full:
        return state
    width = imgui.calc_text_size(ADD).x + 2 * imgui.get_style().frame_padding.x
    imgui.same_line(imgui.get_content_region_avail().x + imgui.get_style().window_padding.x - width)
    return with_another_item(state) if imgui.small_button(ADD) else state


def _row(context: Context, item: Item, chosen: bool) -> bool:
    """A surface's colours and its formula; gives whether it was clicked."""
    imgui = context.imgui
    corner, height = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
    width = imgui.get_content_region_avail().x - ROOM
    clicked, hovered = imgui.invisible_button("##surface", (width, height)), imgui.is_item_hovered()
    if item.surface.name:
        imgui.set_item_tooltip(item.text[:LONGEST])
    pen, end = imgui.get_window_draw_list(), (corner.x + width, corner.y + height)
    if chosen or hovered:
        fill = (0.24, 0.20, 0.16) if chosen else theme.FIELD_HOT
        pen.add_rect_filled((corner.x, corner.y), end, packed(imgui, fill), 5.0)
    _swatch(imgui, pen, corner.x + 8.0, corner.y + 0.5 * (height - SWATCH), colors(item))
    wrong = context.session.complaint(item) is not None
    tint = theme.ERROR if wrong else theme.TEXT if chosen else theme.FAINT
    pen.push_clip_rect((corner.x, corner.y), (end[0] - 6.0, end[1]), True)
    place = (corner.x + SWATCH + 18.0, corner.y + 0.5 * (height - theme.SIZE))
    pen.add_text(context.fonts.code, theme.SIZE, place, packed(imgui, tint), title(item))
    pen.pop_clip_rect()
    return bool(clicked)


def _follow(context: Context, item: Item, chosen: bool) -> None:
    """Bring the row that was drawn last into view, if its surface has just been chosen; one that was added is."""
    fields, key = context.fields, str(item.key)
    if chosen and fields.get("chosen surface") != key:
        fields["chosen surface"] = key
        if not context.imgui.is_item_visible():
            context.imgui.set_scroll_here_y(1.0)


def _swatch(imgui: Any, pen: Any, x: float, y: float, shown: tuple[Color, ...]) -> None:
    """A square in equal stripes."""
    width = SWATCH / len(shown)
    for i, color in enumerate(shown):
        tint = packed(imgui, tuple(srgb(v) for v in color))
        pen.add_rect_filled((x + i * width, y), (x + (i + 1) * width, y + SWATCH), tint)


def colors(item: Item) -> tuple[Color, ...]:
    """The colours in which a surface is seen."""
    if item.levels:
        return tuple(level.color for level in item.levels)
    sides = (item.material.front, item.material.back)
    return sides[:1] if sides[0] == sides[1] else sides


def title(item: Item) -> str:
    """What a surface is called in the list: by its name, or its formula in one line."""
    return item.surface.name or " ".join(item.text[:LONGEST].split()) or "no formula"
