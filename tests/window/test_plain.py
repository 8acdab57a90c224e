"""The window without panels, on a canvas that takes bitmaps; no adapter is needed for it."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest

import zeroset as zs
from zeroset.view.log import Log
from zeroset.view.plain import PlainWindow
from zeroset.view.session import Session
from zeroset.view.show import scene_of, start


@pytest.fixture
def shown() -> Any:
    offscreen: Any = pytest.importorskip("rendercanvas.offscreen", reason="rendercanvas is not installed")
    canvas = offscreen.RenderCanvas(size=(120, 90))
    session = Session(start(*scene_of("x^2 + y^2 + z^2 = 1"), zs.methods.Auto(), "cpu", None), Log(None))
    window = PlainWindow(canvas, session)
    yield canvas, session
    assert window.close()
    assert session.close(30.0)
    canvas.close()


def drawn(canvas: Any, session: Session) -> Any:
    """What the canvas shows at rest."""
    end = time.monotonic() + 60
    while True:
        image = canvas.draw()
        if session.resting and image is not None:
            return np.asarray(image)
        assert time.monotonic() < end
        time.sleep(0.002)


def test_it_shows_the_picture_and_answers_to_mouse_and_keys(shown: Any) -> None:
    canvas, session = shown
    picture = drawn(canvas, session)
    assert np.array_equal(picture[..., :3], zs.render(session.state.scene, (120, 90)).pixels)
    before = session.state.camera
    for kind, x in (("pointer_down", 60), ("pointer_move", 90), ("pointer_up", 90)):
        canvas.submit_event({"event_type": kind, "x": x, "y": 45, "button": 1, "buttons": (1,), "modifiers": ()})
    canvas._process_events()
    assert session.state.camera != before
    canvas.submit_event({"event_type": "key_down", "key": "r", "modifiers": ()})
    canvas._process_events()
    assert session.state.camera == before
    assert np.array_equal(drawn(canvas, session), picture)
