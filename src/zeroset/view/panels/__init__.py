"""The sidebar's sections: each file has a ``draw`` from the state to a changed one, and draws itself on the way.

``PANELS`` lists them from top to bottom. ``imgui`` is handed in, since only a window loads it.
"""

from __future__ import annotations

from zeroset.view.panels import (
    bounds,
    camera,
    formula,
    gallery,
    light,
    material,
    method,
    output,
    overlays,
    parameters,
    timing,
)

PANELS = (
    ("Parameters", parameters.draw, True),
    ("Gallery", gallery.draw, True),
    ("Camera", camera.draw, False),
    ("Bounds", bounds.draw, False),
    ("Light", light.draw, False),
    ("Colours", material.draw, False),
    ("Method", method.draw, False),
    ("Overlays", overlays.draw, False),
    ("Timing", timing.draw, False),
    ("Save and copy", output.draw, False),
)
"""Title, function, and whether it is open at first; the formula stands above them all."""

__all__ = ["PANELS", "formula"]
