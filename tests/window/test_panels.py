"""Every panel drawn off the screen, in many states: none may fail, whatever the state is."""

from __future__ import annotations

import logging
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

PROGRAM = """
import logging, sys, time
from dataclasses import replace
logging.basicConfig(level=logging.ERROR)
import numpy as np
from rendercanvas.offscreen import RenderCanvas
import zeroset as zs
from zeroset.view import canvas as canvases, panels, window
from zeroset.view.log import Log
from zeroset.view.session import Session
from zeroset.view.show import scene_of, start
from zeroset.view.levels import Level
from zeroset.view.motion import Motion
from zeroset.view.state import OVERLAYS, with_another_item

window.PANELS = tuple((title, draw, lambda state: True) for title, draw, _ in panels.PANELS)
canvas = RenderCanvas(size=(600, 700), pixel_ratio=float(sys.argv[1]))
session = Session(start(*scene_of("x^2 + y^2 + a*z^2 = 1"), zs.methods.Auto(), "cpu", None), Log(None))
shown = window.Window(canvas, canvases.find_adapter(), session)

def draw(until=lambda: session.resting):
    end = time.monotonic() + 60
    for i in range(100_000):
        image = canvas.draw()
        if i > 2 and until():
            return np.asarray(image)
        assert time.monotonic() < end, session.trouble
        time.sleep(0.002)

plain = draw()
assert plain.shape[:2] == (700 * float(sys.argv[1]), 600 * float(sys.argv[1])), plain.shape
state = session.state
for method in zs.methods.METHODS.values():
    session.state = replace(state, method=method())
    draw()
for overlay in OVERLAYS:
    session.state = replace(state, overlay=overlay, axes=True, grid=True, outline=True, help=True)
    draw()
for changes in (
    {"surface": state.item.surface.with_bounds(zs.Box((-1, -1, -1), (1, 2, 1)))},
    {"levels": (Level(0.5, (1, 0, 0)), Level(-0.5, (0, 1, 0)))},
    {"levels": tuple(Level(0.1 * i, (1, 0, 0)) for i in range(16))},
    {"camera": zs.Camera(eye=(0.0, 0.0, 5.0), height=3.0)},
    {"flying": True},
    {"lights": ()},
    {"lights": (), "shadows": True, "antialias": 5},
    {"lights": (zs.Light(position=(1.0, 2.0, 3.0), headlight=False),)},
    {"lights": (zs.Light(position=(1.0, 2.0, 3.0)),)},
    {"material": zs.Material(opacity=0.5, ior=1.5, reflectance=0.5), "environment": zs.Environment("room")},
    {"picture": zs.Environment(sys.argv[2])},
    {"environment": zs.Environment(sys.argv[2]), "picture": zs.Environment(sys.argv[2])},
    {"lights": (zs.Light(headlight=False, color=(0.0, 0.0, 0.0)),)},
    {"tolerance": 1e-3},
    {"material": zs.Material(coloring="gaussian-curvature")},
    {"material": zs.Material(coloring=zs.Coloring("a*x + z", "wheel", (0, 1)))},
    {"material": zs.Material(coloring=zs.Coloring("nobody*x", "ember"))},
    {"motions": {"a": Motion(playing=True)}, "budget": 5.0},
    {"text": "x + % {"},
    {"text": "x + foo"},
    {"surface": zs.gallery["blinn-blobby"]},
):
    for several in (False, True):
        own = {name: value for name, value in changes.items() if hasattr(state.item, name)}
        session.state = state.edited(**own)
        session.state = replace(session.state, **{k: v for k, v in changes.items() if k not in own})
        if several:
            session.state = with_another_item(session.state)
            session.state = replace(session.state, chosen=0)
        draw(lambda: session.state.playing or session.resting)
session.state = state.ask("copy-python").ask("save-picture", "no/such/place.png\\n")
draw(lambda: "cannot" in session.notes.latest)
assert not shown._guard.failures

def failing(state, context):
    imgui = context.imgui
    imgui.push_id("open"), imgui.begin_group(), imgui.begin_disabled()
    imgui.push_style_color(imgui.Col_.text, (1, 0, 0, 1))
    raise zs.ZerosetError("a panel has failed")

session.state, before = state, shown._guard.failures
window.PANELS = (("failing", failing, lambda state: True), *window.PANELS)
draw(lambda: "a panel has failed" in session.notes.latest)
window.PANELS = window.PANELS[1:]
session.state = state.edited(surface=zs.gallery["tangle"])
draw(lambda: session.picture.shot.formulas == (zs.gallery["tangle"].field.digest,))
assert shown._guard.failures > before
print("panels drawn")
shown.close(), session.close()
"""


@pytest.mark.parametrize("ratio", ["1", "2"])
@pytest.mark.usefixtures("adapter")
def test_every_panel_draws_itself_in_every_state(ratio: str, tmp_path: Path) -> None:
    Image.new("RGB", (8, 4), (255, 0, 0)).save(tmp_path / "around.png")
    command = [sys.executable, "-c", PROGRAM, ratio, str(tmp_path / "around.png")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    # Dear ImGui says what it has closed of the panel that was made to fail.
    own = [line for line in done.stdout.splitlines() if "[imgui-error]" not in line]
    assert own == ["panels drawn"]
    # Errors while drawing are logged and not raised: nothing of the kind may be there.
    assert "Traceback" not in done.stderr
    assert logging.getLevelName(logging.ERROR) not in done.stderr.replace("error: XDG_RUNTIME_DIR", "")
