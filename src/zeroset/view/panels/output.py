"""Saving the picture and the scene, and copying them as a program."""

from __future__ import annotations

from typing import Any

from zeroset.view import theme
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import label


def draw(state: State, context: Context) -> State:
    """Names of files, and buttons."""
    imgui, fields = context.imgui, context.fields
    _field(imgui, fields, "picture", "zeroset.png")
    label(imgui, "size", "width x height; empty: as in the window")
    width, height = context.session.size
    _, fields["size"] = imgui.input_text_with_hint("##size", f"{width} x {height}", fields.get("size", ""))
    if imgui.button("save picture", (-1.0, 0.0)):
        state = state.ask("save-picture", f"{fields['picture']}\n{fields['size']}")
    _field(imgui, fields, "scene", "scene.toml")
    if imgui.button("save scene", (-1.0, 0.0)):
        state = state.ask("save-scene", fields["scene"])
    half = 0.5 * (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x)
    if imgui.button("copy as Python", (half, 0.0)):
        state = state.ask("copy-python")
    imgui.same_line()
    if imgui.button("copy as command", (half, 0.0)):
        state = state.ask("copy-command")
    if context.session.snippet:
        imgui.push_font(context.fonts.code, theme.SIZE - 1)
        flags = imgui.InputTextFlags_.read_only | imgui.InputTextFlags_.word_wrap
        imgui.input_text_multiline("##snippet", context.session.snippet, (-1.0, 150.0), flags)
        imgui.pop_font()
    return state


def _field(imgui: Any, fields: dict[str, str], name: str, usual: str) -> None:
    """A row for a file's name."""
    label(imgui, name)
    _, fields[name] = imgui.input_text(f"##{name}", fields.get(name, usual))
