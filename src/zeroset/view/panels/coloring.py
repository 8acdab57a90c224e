"""What the surface is coloured by, and with it all that are: a quantity or a formula, the colour map, and the range."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from zeroset.errors import ZerosetError
from zeroset.scene.colored import formula_of
from zeroset.scene.coloring import QUANTITIES, Coloring
from zeroset.scene.colormap import MAPS
from zeroset.view import theme
from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import checkbox, choice, label, said

OWN, FORMULA, USUAL = "front and back", "a formula", "the usual"


def draw(state: State, context: Context) -> State:
    """A list to choose from, and what goes with the choice."""
    imgui, before = context.imgui, state.item.material.coloring
    shown = OWN if before is None else before.by if before.by in QUANTITIES else FORMULA
    offered = [name for name in QUANTITIES if name != "isovalue" or state.item.levels]
    wanted = choice(imgui, "colour by", shown, (OWN, *offered, FORMULA))
    after = before
    if wanted != shown:
        after = None if wanted == OWN else Coloring("z" if wanted == FORMULA else wanted)
    if after is not None:
        if wanted == FORMULA:
            after = _formula(state, context, after)
        name = choice(imgui, "map", after.map or USUAL, (USUAL, *MAPS))
        after = replace(after, map=None if name == USUAL else name)
        after = _range(imgui, context, after)
    return state if after == before else state.colored_by(after)


def _formula(state: State, context: Context, coloring: Coloring) -> Coloring:
    """A field for the formula; what cannot be read is said, and the last one that could stays."""
    imgui, fields = context.imgui, context.fields
    label(imgui, "formula", "in x, y, z, w and the surface's parameters")
    changed, text = imgui.input_text("##coloring", fields.get("coloring", coloring.by))
    try:
        made = replace(coloring, by=text)
        formula_of(made, state.item.drawn)
    except ZerosetError as error:
        said(imgui, error.message, theme.ERROR)
        if changed:
            fields["coloring"] = text
        return coloring
    # The field keeps a text of its own for as long only as it cannot be read.
    fields.pop("coloring", None)
    return made if changed else coloring


def _range(imgui: Any, context: Context, coloring: Coloring) -> Coloring:
    """Whether the range is found, and its ends where it is not."""
    fitted = checkbox(imgui, "find the range", coloring.range is None, "from what is seen, in every picture anew")
    if fitted:
        return replace(coloring, range=None)
    ends = coloring.range or _seen(context)
    label(imgui, "range")
    step = max((ends[1] - ends[0]) * 0.005, 1e-6)
    _, (low, high) = imgui.drag_float2("##range", list(ends), step)
    # Ends in the wrong order, on the way to others, change nothing.
    return replace(coloring, range=(float(low), float(high)) if low < high else ends)


def _seen(context: Context) -> tuple[float, float]:
    """The range of the picture that is shown."""
    picture = context.session.picture
    legend = None if picture is None else picture.legend
    return (-1.0, 1.0) if legend is None or not legend.map else (legend.low, legend.high)
