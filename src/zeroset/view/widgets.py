"""Small pieces that panels are made of: rows with a label, faint text, colours in linear light."""

from __future__ import annotations

from typing import Any

from zeroset.scene.encoding import linear, srgb
from zeroset.scene.light import Color
from zeroset.view import theme

REMOVE = "\uf00d"
"""Icon of Font Awesome: a cross."""
LARGEST = 1e30
"""Size of a number that can be typed into a slider."""
SMALL = 28.0
"""Width of a button with an icon."""
ROOM = SMALL + 8.0
"""What such a button at the end of a row takes of it."""


def label(imgui: Any, text: str, hint: str = "") -> None:
    """Begin a row: its name on the left, and room for a field to the right edge."""
    imgui.align_text_to_frame_padding()
    imgui.text_disabled(text)
    if hint:
        imgui.set_item_tooltip(hint)
    imgui.same_line(theme.LABEL + imgui.get_style().window_padding.x)
    imgui.set_next_item_width(-1.0)


def slider(
    imgui: Any,
    text: str,
    value: float,
    span: tuple[float, float],
    form: str = "%.3g",
    logarithmic: bool = False,
    hint: str = "",
) -> tuple[bool, float]:
    """A row with a slider; Ctrl and a click let a number be typed."""
    label(imgui, text, hint)
    flags = imgui.SliderFlags_.no_round_to_format | (imgui.SliderFlags_.logarithmic if logarithmic else 0)
    changed, value = imgui.slider_float(f"##{text}", value, span[0], span[1], form, flags)
    # What is typed may be more than a float32 holds.
    return changed, min(max(float(value), -LARGEST), LARGEST)


def checkbox(imgui: Any, text: str, value: bool, hint: str = "") -> bool:
    """A box to tick."""
    _, value = imgui.checkbox(text, value)
    if hint:
        imgui.set_item_tooltip(hint)
    return bool(value)


def choice(imgui: Any, text: str, value: str, values: tuple[str, ...], hint: str = "") -> str:
    """A row with a list to choose from."""
    label(imgui, text, hint)
    index = values.index(value) if value in values else 0
    _, index = imgui.combo(f"##{text}", index, list(values))
    return values[int(index)]


def color(imgui: Any, text: str, value: Color) -> tuple[bool, Color]:
    """A row with a colour: shown as the eye sees it, kept in linear light."""
    label(imgui, text)
    flags = imgui.ColorEditFlags_.no_inputs | imgui.ColorEditFlags_.no_label
    changed, shown = imgui.color_edit3(f"##{text}", [srgb(v) for v in value], flags)
    red, green, blue = (linear(float(v)) for v in shown[:3])
    return changed, (red, green, blue)


def remover(imgui: Any, hint: str) -> bool:
    """A button at the end of a row that takes away what the row is about; gives whether it was clicked."""
    imgui.same_line()
    clicked = imgui.button(REMOVE, (SMALL, 0.0))
    imgui.set_item_tooltip(hint)
    return bool(clicked)


def said(imgui: Any, text: str, tint: theme.Color) -> None:
    """Text in a colour, broken at the right edge."""
    imgui.push_style_color(imgui.Col_.text, (*tint, 1.0))
    imgui.push_text_wrap_pos(0.0)
    imgui.text_unformatted(text)
    imgui.pop_text_wrap_pos()
    imgui.pop_style_color()


def packed(imgui: Any, tint: tuple[float, ...], alpha: float = 1.0) -> int:
    """A colour as draw lists take it."""
    return int(imgui.color_convert_float4_to_u32((*tint[:3], alpha)))
