"""A slider for every parameter, with its range and how it plays."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from zeroset.view.item import Item, span_of, with_motion, with_param, with_span
from zeroset.view.motion import Motion
from zeroset.view.panels.context import Context
from zeroset.view.state import State

PLAY, PAUSE, MORE = "\uf04b", "\uf04c", "\uf1de"
"""Icons of Font Awesome: play, pause, sliders."""


def draw(state: State, context: Context) -> State:
    """One row a parameter."""
    imgui, item = context.imgui, state.item
    names = list(item.surface.params)
    if not names:
        imgui.text_disabled("none: write a letter such as a into the formula")
    for name in names:
        imgui.push_id(f"{item.key} {name}")
        item = _row(item, context, name)
        imgui.pop_id()
    arrays = ", ".join(f"{name} ({len(values)})" for name, values in item.surface.arrays.items())
    if arrays:
        imgui.text_disabled(f"arrays: {arrays}")
    return state if item is state.item else state.with_item(item)


def _row(item: Item, context: Context, name: str) -> Item:
    imgui: Any = context.imgui
    motion = item.motions.get(name, Motion())
    if imgui.button(PAUSE if motion.playing else PLAY, (28.0, 0.0)):
        item = with_motion(item, name, replace(motion, playing=not motion.playing))
    imgui.set_item_tooltip("pause" if motion.playing else "play")
    imgui.same_line()
    imgui.align_text_to_frame_padding()
    imgui.text(name)
    imgui.same_line(76.0)
    imgui.set_next_item_width(-36.0)
    span, value = span_of(item, name), item.surface.params[name]
    flags = imgui.SliderFlags_.no_round_to_format
    changed, value = imgui.slider_float("##value", value, span.low, span.high, "%.4g", flags)
    if changed:
        item = with_param(item, name, float(value))
    imgui.same_line()
    if imgui.button(MORE, (28.0, 0.0)):
        imgui.open_popup("range")
    imgui.set_item_tooltip("range and speed")
    if imgui.begin_popup("range"):
        item = _popup(item, context, name)
        imgui.end_popup()
    return item


def _popup(item: Item, context: Context, name: str) -> Item:
    """The range, and how it plays."""
    imgui: Any = context.imgui
    span, motion = span_of(item, name), item.motions.get(name, Motion())
    imgui.set_next_item_width(120.0)
    low_changed, low = imgui.input_float("lowest", span.low, 0.0, 0.0, "%.6g")
    imgui.set_next_item_width(120.0)
    high_changed, high = imgui.input_float("highest", span.high, 0.0, 0.0, "%.6g")
    if low_changed or high_changed:
        asked = with_span(item, name, float(low), float(high))
        if asked is item:
            context.session.notes.say(f"the range of {name} stays: its lowest must be below its highest")
        item = asked
    imgui.set_next_item_width(120.0)
    changed, seconds = imgui.slider_float(
        "seconds one way", motion.seconds, 0.5, 60.0, "%.1f", imgui.SliderFlags_.logarithmic
    )
    if changed:
        motion = replace(motion, seconds=max(0.05, float(seconds)))
        item = with_motion(item, name, motion)
    for text, loop in (("to and fro", False), ("from the start again", True)):
        if imgui.radio_button(text, motion.loop == loop):
            item = with_motion(item, name, replace(motion, loop=loop))
    return item
