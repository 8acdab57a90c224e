"""The formula box, and under it what is wrong with it."""

from __future__ import annotations

from zeroset.view import theme
from zeroset.view.formula import Complaint
from zeroset.view.panels import surfaces
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import said

LINES = 4
"""Height of the box."""
LONGEST = 20_000
"""Characters of a formula that the box takes."""


def draw(state: State, context: Context) -> State:
    """The box and the error."""
    imgui, session = context.imgui, context.session
    imgui.push_font(context.fonts.code, theme.SIZE + 1)
    height = LINES * imgui.get_text_line_height() + 2 * imgui.get_style().frame_padding.y
    flags = imgui.InputTextFlags_.word_wrap
    # A box of its own for every surface: what is being typed stays where it was begun.
    changed, text = imgui.input_text_multiline(f"##formula{state.item.key}", state.item.text, (-1.0, height), flags)
    imgui.pop_font()
    if changed:
        state = state.edited(text=text[:LONGEST])
    wrong = session.complaint(state.item)
    if wrong is not None:
        return _complain(state, context, wrong)
    imgui.text_disabled("compiling ..." if session.compiling else _what(state))
    return surfaces.add(state, imgui)


def _complain(state: State, context: Context, complaint: Complaint) -> State:
    """The error with its caret, in a font of equal widths so that the caret stands where it should."""
    imgui = context.imgui
    said(imgui, complaint.message, theme.ERROR)
    imgui.push_font(context.fonts.code, theme.SIZE)
    imgui.push_style_var(imgui.StyleVar_.item_spacing, (0.0, 0.0))
    for line, tint in zip(complaint.place, (theme.TEXT, theme.ACCENT), strict=False):
        imgui.push_style_color(imgui.Col_.text, (*tint, 1.0))
        imgui.text_unformatted(line)
        imgui.pop_style_color()
    imgui.pop_style_var()
    imgui.pop_font()
    for hint in complaint.hints:
        said(imgui, hint, theme.FAINT)
    if complaint.offer and imgui.button(f"make {complaint.offer} a parameter"):
        state = state.ask("declare", complaint.offer)
    return state


def _what(state: State) -> str:
    """The surface in a few words."""
    surface = state.item.surface
    degree = surface.field.degree
    kind = f"algebraic, degree {degree}" if degree is not None else "not algebraic"
    return f"{surface.name}: {kind}" if surface.name else kind
