"""How long pictures take, and the budget that they keep to while something moves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from zeroset.view.panels.context import Context
from zeroset.view.state import State
from zeroset.view.widgets import slider


def draw(state: State, context: Context) -> State:
    """A graph of the latest pictures, and the budget."""
    imgui, times = context.imgui, np.asarray(context.session.times, np.float32)
    most = max(float(times.max()), 1.0)
    imgui.plot_lines("##times", times, 0, f"at most {most:.0f} ms", 0.0, 1.1 * most, (-1.0, 64.0))
    changed, budget = slider(
        imgui, "budget", state.budget, (5.0, 200.0), "%.0f ms", True, "while moving, pictures get smaller to keep to it"
    )
    return replace(state, budget=min(max(budget, 1.0), 10_000.0)) if changed else state
