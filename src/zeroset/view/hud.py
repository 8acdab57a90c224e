"""What stands on the picture: lines, the legend, numbers, notes, and the list of keys."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from zeroset.rendering.legend import bar_colors, map_colors
from zeroset.rendering.ticks import exact_labels
from zeroset.view import theme
from zeroset.view.controls import Pane
from zeroset.view.lines import strokes
from zeroset.view.overlay import HEAT, Legend
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import packed

KEYS = (
    ("left drag", "turn"),
    ("right or middle drag", "move sideways"),
    ("wheel", "zoom to the point under the pointer"),
    ("double click", "turn about that point"),
    ("R", "back to the first view"),
    ("F", "fit the bounds into the picture"),
    ("1 2 3 4 5 6 7", "front, back, right, left, top, bottom, three-quarter"),
    ("O", "orthographic or perspective"),
    ("G", "fly: W A S D, Q E, drag to look, Shift is faster; Esc ends it"),
    ("Space", "play or pause the parameters"),
    ("H", "this list"),
)
SHADE = (0.06, 0.065, 0.08)


def draw(state: State, context: Context, pane: Pane) -> None:
    """Draw all of it."""
    imgui, session = context.imgui, context.session
    pen = imgui.get_background_draw_list()
    pen.push_clip_rect((pane.x, pane.y), (pane.x + pane.width, pane.y + pane.height))
    if session.picture is not None:
        if state.axes or state.grid or state.outline:
            _lines(state, context, pane, pen)
        if session.picture.legend is not None:
            _legend(imgui, pen, session.picture.legend, pane)
        _numbers(state, context, pane, pen)
    else:
        _strip(context, pen, session.trouble or "compiling ...", pane.x + 0.5 * pane.width, pane.y + 0.5 * pane.height)
    _messages(state, context, pane, pen)
    pen.pop_clip_rect()
    if state.help:
        _help(context, pane)


def _lines(state: State, context: Context, pane: Pane, pen: Any) -> None:
    picture = context.session.picture
    assert picture is not None
    imgui = context.imgui
    made, labels = strokes(state, picture, pane.size)
    for stroke in made:
        tint = packed(imgui, stroke.color, 0.14 if stroke.hidden else 0.85)
        points = [(pane.x + float(x), pane.y + float(y)) for x, y in stroke.points]
        pen.add_polyline(points, tint, stroke.width, 0)
    for label in labels:
        pen.add_text((pane.x + label.x + 4, pane.y + label.y - 8), packed(imgui, label.color), label.text)


def _legend(imgui: Any, pen: Any, legend: Legend, pane: Pane) -> None:
    """A bar of the colours with its ends, or a block for each value where these are few."""
    width, height = 220.0, 12.0
    x, y = pane.x + pane.width - width - 24, pane.y + 44
    pen.add_rect_filled((x - 12, y - 30), (x + width + 12, y + height + 26), packed(imgui, SHADE, 0.82), 6.0)
    pen.add_text((x, y - 24), packed(imgui, theme.TEXT), legend.title)
    _bar(imgui, pen, legend, (x, y, width, height))
    faint, texts = packed(imgui, theme.FAINT), [f"{legend.low:.4g}", f"{legend.high:.4g}"]
    if legend.values:
        texts = exact_labels(legend.values)
        each = width / len(texts)
        if max(imgui.calc_text_size(text).x for text in texts) + 4 <= each:
            for i, text in enumerate(texts):
                place = x + each * (i + 0.5) - imgui.calc_text_size(text).x / 2
                pen.add_text((place, y + height + 4), faint, text)
            return
    pen.add_text((x, y + height + 4), faint, texts[0])
    pen.add_text((x + width - imgui.calc_text_size(texts[-1]).x, y + height + 4), faint, texts[-1])


def _bar(imgui: Any, pen: Any, legend: Legend, place: tuple[float, float, float, float]) -> None:
    x, y, width, height = place
    if legend.values:
        shares = (np.asarray(legend.values) - legend.low) / (legend.high - legend.low)
        pairs = [(color, color) for color in map_colors(legend.map, shares)]
    else:
        colors = bar_colors(legend.map, 33) if legend.map else HEAT
        pairs = list(pairwise(colors if legend.heat or legend.map else [(41,) * 3, (255,) * 3]))
    for i, pair in enumerate(pairs):
        a, b = (x + width * (i + k) / len(pairs) for k in (0, 1))
        left, right = (packed(imgui, tuple(float(c) / 255 for c in color)) for color in pair)
        pen.add_rect_filled_multi_color((a, y), (b, y + height), left, right, right, left)


def numbers(state: State, context: Context) -> list[tuple[str, theme.Color]]:
    """What is known of the picture, in words with their colours."""
    picture = context.session.picture
    assert picture is not None
    height, width = picture.depth.shape
    proof = ("certified", theme.GOOD) if picture.certified else ("not certified", theme.ERROR)
    # Where most is open nothing false is claimed, but little is known.
    open_ = theme.ERROR if 2 * picture.unresolved > picture.hits else theme.FAINT
    parts = [
        (f"{picture.milliseconds:.1f} ms", theme.TEXT),
        (f"{width} x {height}", theme.FAINT),
        (f"{picture.hits:,} hits", theme.FAINT),
        (f"{picture.unresolved:,} unresolved", open_),
        (picture.device, theme.FAINT),
        proof,
    ]
    more = [("a better one is on its way ...", theme.ACCENT)] if context.session.late else []
    return [*parts, *more, ("flying, Esc ends it", theme.ACCENT)] if state.flying else [*parts, *more]


SPARED = 1, 4, 2, 0, 3
"""Which of the numbers a narrow picture leaves out, the least needed first: what is proven is said to the last."""


def fitting(widths: Sequence[float], gap: float, room: float) -> list[int]:
    """Which of the numbers there is room for."""
    kept = list(range(len(widths)))
    for spared in SPARED:
        if sum(widths[i] for i in kept) + gap * (len(kept) - 1) <= room:
            break
        kept.remove(spared)
    return kept


def _numbers(state: State, context: Context, pane: Pane, pen: Any) -> None:
    """A strip along the lower edge."""
    imgui = context.imgui
    parts, gap = numbers(state, context), 18.0
    widths = [imgui.calc_text_size(text).x for text, _ in parts]
    kept = fitting(widths, gap, pane.width - 52)
    parts, widths = [parts[i] for i in kept], [widths[i] for i in kept]
    x, y = pane.x + 14, pane.y + pane.height - 38
    end = x + sum(widths) + gap * (len(parts) - 1) + 24
    pen.add_rect_filled((x, y), (end, y + 26), packed(imgui, SHADE, 0.82), 6.0)
    x += 12
    for (text, tint), width in zip(parts, widths, strict=True):
        pen.add_text((x, y + 5), packed(imgui, tint), text)
        x += width + gap


def _messages(state: State, context: Context, pane: Pane, pen: Any) -> None:
    """Trouble, notes, and a word on an empty picture, above the numbers."""
    session = context.session
    picture = session.picture
    y = pane.y + pane.height - 60
    if session.trouble and picture is not None:
        _strip(context, pen, session.trouble, pane.x + 0.5 * pane.width, y, theme.ERROR)
    elif session.stand_in:
        _strip(context, pen, session.stand_in, pane.x + 0.5 * pane.width, y, theme.FAINT)
    elif session.notes.latest:
        _strip(context, pen, session.notes.latest, pane.x + 0.5 * pane.width, y, theme.TEXT)
    elif picture is not None and not picture.hits and not session.compiling and not session.drawing:
        text = "no ray meets a zero of f inside the bounds: F fits the view, Bounds fits the formula"
        _strip(context, pen, text, pane.x + 0.5 * pane.width, pane.y + 0.5 * pane.height, theme.FAINT)


def _strip(context: Context, pen: Any, text: str, x: float, y: float, tint: theme.Color = theme.TEXT) -> None:
    """Text on a dark strip, its lower edge in the middle of which is at a place."""
    imgui = context.imgui
    size = imgui.calc_text_size(text)
    left, top = x - 0.5 * size.x, y - size.y - 8
    pen.add_rect_filled((left - 14, top - 8), (left + size.x + 14, top + size.y + 8), packed(imgui, SHADE, 0.9), 6.0)
    pen.add_text((left, top), packed(imgui, tint), text)


def _help(context: Context, pane: Pane) -> None:
    imgui = context.imgui
    middle = (pane.x + 0.5 * pane.width, pane.y + 0.5 * pane.height)
    imgui.set_next_window_pos(middle, imgui.Cond_.always, (0.5, 0.5))
    flags = imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.always_auto_resize | imgui.WindowFlags_.no_move
    imgui.push_style_var(imgui.StyleVar_.window_border_size, 1.0)
    imgui.push_style_var(imgui.StyleVar_.window_rounding, 8.0)
    imgui.push_style_var(imgui.StyleVar_.window_padding, (22.0, 18.0))
    imgui.begin("##help", None, flags | imgui.WindowFlags_.no_saved_settings)
    for keys, meaning in KEYS:
        imgui.text_colored((*theme.ACCENT, 1.0), keys)
        imgui.same_line(200.0)
        imgui.text(meaning)
    imgui.end()
    imgui.pop_style_var(3)
