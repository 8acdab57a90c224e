"""The gallery: small pictures to choose from, and a box that filters them."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from zeroset.surfaces import entry, names
from zeroset.view import theme
from zeroset.view.panels.context import Context
from zeroset.view.state import State

COLUMNS = 3
HEIGHT = 330.0
CAPTION = 20.0
SMALL = 12.0
"""Size of the captions."""


def draw(state: State, context: Context) -> State:
    """The filter and the pictures."""
    imgui = context.imgui
    imgui.set_next_item_width(-1.0)
    _, wanted = imgui.input_text_with_hint("##filter", "filter by name", context.fields.get("filter", ""))
    context.fields["filter"] = wanted
    found = matching(wanted)
    if not found:
        imgui.text_disabled("no surface of that name")
        return state
    gap = 6.0
    side = (imgui.get_content_region_avail().x - 2 * gap - imgui.get_style().scrollbar_size - 2.0) / COLUMNS
    rows = -(-len(found) // COLUMNS)
    height = min(HEIGHT, rows * (side + CAPTION + gap) + gap)
    imgui.push_style_var(imgui.StyleVar_.item_spacing, (gap, gap))
    imgui.begin_child("##surfaces", (0.0, height))
    for i, name in enumerate(found):
        if i % COLUMNS:
            imgui.same_line()
        if _cell(imgui, context, name, side, name == state.item.surface.name):
            state = state.ask("gallery", name)
    imgui.end_child()
    imgui.pop_style_var()
    return state


def _cell(imgui: Any, context: Context, name: str, side: float, chosen: bool) -> bool:
    """One surface; gives whether it was clicked."""
    corner = imgui.get_cursor_screen_pos()
    clicked = imgui.invisible_button(name, (side, side + CAPTION))
    if not imgui.is_item_visible():
        return bool(clicked)
    hot = imgui.is_item_hovered()
    end = (corner.x + side, corner.y + side + CAPTION)
    pen = imgui.get_window_draw_list()
    fill = (0.24, 0.20, 0.16) if chosen else theme.FIELD_HOT if hot else theme.PANEL
    pen.add_rect_filled((corner.x, corner.y), end, _u32(imgui, fill), 5.0)
    if chosen:
        pen.add_rect((corner.x, corner.y), end, _u32(imgui, theme.ACCENT), 5.0, 1.5)
    context.thumbnails.draw(pen, name, (corner.x + 4, corner.y + 3), side - 8)
    pen.push_clip_rect((corner.x + 4, corner.y), (end[0] - 3, end[1]), True)
    width = imgui.calc_text_size(name).x * SMALL / theme.SIZE
    left = corner.x + max(4.0, 0.5 * (side - width))
    tint = theme.TEXT if hot or chosen else theme.FAINT
    pen.add_text(context.fonts.words, SMALL, (left, corner.y + side), _u32(imgui, tint), name)
    pen.pop_clip_rect()
    if hot:
        imgui.set_tooltip(_told(name))
    return bool(clicked)


def _u32(imgui: Any, tint: theme.Color) -> int:
    return int(imgui.color_convert_float4_to_u32((*tint, 1.0)))


@lru_cache(maxsize=64)
def matching(wanted: str) -> tuple[str, ...]:
    """Names of the surfaces whose name or title holds every word.

    Example:
        >>> matching("barth")
        ('barth-sextic', 'barth-decic')
    """
    words = wanted.lower().split()
    return tuple(name for name in names() if all(w in name or w in entry(name).title.lower() for w in words))


def _told(name: str) -> str:
    item = entry(name)
    formula = item.formula if len(item.formula) <= 160 else item.formula[:160] + " ..."
    lines = [formula[i : i + 70] for i in range(0, len(formula), 70)]
    return "\n".join([item.title, *lines])
