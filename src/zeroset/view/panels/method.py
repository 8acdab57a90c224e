"""The ray method with its options, made from the fields of its class, and the tolerance."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import replace
from typing import Any

from zeroset.errors import MethodError, ZerosetError
from zeroset.rendering.drawn import as_drawn
from zeroset.rendering.render import default_tolerance
from zeroset.scene.several import Drawable
from zeroset.solve.method import METHODS, Method
from zeroset.view import theme
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import checkbox, choice, label, said, slider

CHOICES: dict[str, tuple[str, ...]] = {"test": ("sign", "taylor"), "axis": ("t", "k")}
"""Options that are words, and the words that they take."""


def draw(state: State, context: Context) -> State:
    """The list, its options, the tolerance."""
    imgui, method = context.imgui, state.method
    name = choice(imgui, "method", method.name, tuple(METHODS))
    if name != method.name:
        method = METHODS[name]()
    said(imgui, method.summary, theme.FAINT)
    said(imgui, "certified" if method.certified else "not certified", theme.GOOD if method.certified else theme.ERROR)
    refused = refusal(state.drawn, method)
    if refused:
        said(imgui, refused, theme.ERROR)
    for field in dataclasses.fields(method):
        method = _option(method, field.name, context)
    if method != state.method:
        state = replace(state, method=method)
    return _tolerance(state, context)


def refusal(shown: Drawable, method: Method) -> str:
    """Why a method cannot draw what is shown; empty where it can. The picture is the last one then, for as long."""
    try:
        as_drawn(shown).check(method)
    except ZerosetError as error:
        return error.message
    return ""


def _option(method: Method, name: str, context: Context) -> Method:
    """One option's field, by the type of its value."""
    imgui, value = context.imgui, getattr(method, name)
    wanted: Any = value
    if isinstance(value, bool):
        wanted = checkbox(imgui, name, value)
    elif isinstance(value, str):
        wanted = choice(imgui, name, value, CHOICES.get(name, (value,)))
    else:
        label(imgui, name)
        changed, number = imgui.input_float(f"##{name}", float(value), 0.0, 0.0, "%.6g")
        wanted = float(number) if changed else value
    return method if wanted == value else changed_method(method, name, wanted, context.fields)


def changed_method(method: Method, name: str, value: Any, fields: dict[str, str]) -> Method:
    """The method with another value of an option; as it was, with a word on why, where it takes no such value."""
    try:
        changed = replace(method, **{name: value})
    except MethodError as error:
        fields["method"] = str(error)
        return method
    fields.pop("method", None)
    return changed


def _tolerance(state: State, context: Context) -> State:
    imgui = context.imgui
    usual = default_tolerance(as_drawn(state.drawn).smallest)
    value = state.tolerance or usual
    span, hint = (-6.0, 8.0), "world length of a root's interval"
    changed, power = slider(imgui, "tolerance", math.log2(value / usual), span, f"{value:.2e}", hint=hint)
    if changed:
        state = replace(state, tolerance=usual * 2.0 ** min(max(power, -10.0), 12.0))
    if state.tolerance is not None and imgui.button("usual tolerance"):
        state = replace(state, tolerance=None)
    if context.fields.get("method"):
        said(imgui, context.fields["method"], theme.ERROR)
    return state
