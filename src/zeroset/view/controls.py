"""Mouse and keys: from events, as rendercanvas and web browsers write them, to changed states.

Left turns, right or middle pans, the wheel zooms to the surface point under the pointer, a double click makes that
point the target. In flight, dragging looks around, W A S D and Q E move, and the wheel changes the speed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from zeroset.scene.bounds import Vector
from zeroset.view import orbit
from zeroset.view.painting import Picture
from zeroset.view.state import State, play_or_pause

TURN = 180.0
"""Degrees that dragging across the shorter side of the picture turns."""
LOOK = 90.0
"""Degrees that the same drag turns the head in flight."""
WHEEL = 0.0015
"""Share of a zoom for a unit of the wheel; a notch is 100."""
SPEED = 0.4
"""Reaches of the bounds that a second of flight covers."""
MOVES: dict[str, Vector] = {
    "w": (1, 0, 0),
    "s": (-1, 0, 0),
    "d": (0, 1, 0),
    "a": (0, -1, 0),
    "e": (0, 0, 1),
    "q": (0, 0, -1),
}
"""Keys of flight: forward, right, up."""

Event = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Pane:
    """Where the picture is in the window, in logical pixels."""

    x: float
    y: float
    width: float
    height: float

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        return self.width, self.height

    def holds(self, x: float, y: float) -> bool:
        """Whether a place is on the picture."""
        return self.x <= x < self.x + self.width and self.y <= y < self.y + self.height


def pick(picture: Picture | None, pane: Pane, x: float, y: float) -> Vector | None:
    """The point of the surface under the pointer, or None."""
    if picture is None or not pane.holds(x, y):
        return None
    rows, columns = picture.depth.shape
    column = min(columns - 1, int((x - pane.x) / pane.width * columns))
    row = min(rows - 1, int((y - pane.y) / pane.height * rows))
    depth = float(picture.depth[row, column])
    if not math.isfinite(depth):
        return None
    return orbit.unproject(picture.camera, pane.size, x - pane.x, y - pane.y, depth)


class Controls:
    """What is pressed at the moment, and what events make of it.

    Attributes:
        keys: keys of flight that are down.
    """

    def __init__(self) -> None:
        self.keys: set[str] = set()
        self._fast = False
        self._button = 0
        self._last = (0.0, 0.0)
        self._depth = 1.0

    @property
    def dragging(self) -> bool:
        """Whether a button is held on the picture."""
        return self._button != 0

    def handle(self, event: Event, state: State, pane: Pane, picture: Picture | None) -> State:
        """The state after an event."""
        handler = getattr(self, f"_{event['event_type']}", None)
        changed: State = state if handler is None else handler(event, state, pane, picture)
        return changed

    def _pointer_down(self, event: Event, state: State, pane: Pane, picture: Picture | None) -> State:
        if pane.holds(event["x"], event["y"]) and not self._button:
            self._button = 2 if event["button"] == 1 and "Shift" in event["modifiers"] else event["button"]
            self._last = event["x"], event["y"]
            self._depth = _depth_of(state, pick(picture, pane, *self._last))
        return state

    def _pointer_up(self, event: Event, state: State, pane: Pane, picture: Picture | None) -> State:
        self._button = 0
        return state

    def _pointer_move(self, event: Event, state: State, pane: Pane, picture: Picture | None) -> State:
        if not self._button:
            return state
        dx, dy = event["x"] - self._last[0], event["y"] - self._last[1]
        self._last = event["x"], event["y"]
        share = min(pane.size)
        if self._button != 1:
            return replace(state, camera=orbit.pan(state.camera, pane.size, dx, dy, self._depth))
        if state.flying:
            return replace(state, camera=orbit.look(state.camera, -dx / share * LOOK, -dy / share * LOOK))
        return replace(state, camera=orbit.turn(state.camera, -dx / share * TURN, dy / share * TURN))

    def _wheel(self, event: Event, state: State, pane: Pane, picture: Picture | None) -> State:
        x, y = event["x"], event["y"]
        if not pane.holds(x, y):
            return state
        factor = math.exp(max(-3.0, min(3.0, event["dy"] * WHEEL)))
        if state.flying:
            return replace(state, fly_speed=max(0.02, min(50.0, state.fly_speed / factor)))
        point = pick(picture, pane, x, y)
        if point is None:
            depth = _depth_of(state, None)
            point = orbit.unproject(state.camera, pane.size, x - pane.x, y - pane.y, depth)
        camera = orbit.zoom(state.camera, factor, point)
        return replace(state, camera=camera) if _in_reach(state, camera) else state

    def _double_click(self, event: Event, state: State, pane: Pane, picture: Picture | None) -> State:
        point = pick(picture, pane, event["x"], event["y"])
        if point is None or event["button"] != 1:
            return state
        return replace(state, camera=orbit.aim(state.camera, point))

    def _key_down(self, event: Event, state: State, pane: Pane, picture: Picture | None) -> State:
        key = str(event["key"])
        self._fast = "Shift" in event["modifiers"]
        if "Control" in event["modifiers"] or "Meta" in event["modifiers"]:
            return state
        if key.lower() in MOVES and state.flying:
            self.keys.add(key.lower())
            return state
        return _pressed(key if key in orbit.AXES else key.lower(), state)

    def _key_up(self, event: Event, state: State, pane: Pane, picture: Picture | None) -> State:
        self._fast = "Shift" in event["modifiers"]
        self.keys.discard(str(event["key"]).lower())
        return state

    def flown(self, state: State, seconds: float) -> State:
        """The state after so much time in flight."""
        if not (state.flying and self.keys):
            return state
        length = SPEED * state.bounds.reach * state.fly_speed * seconds * (4.0 if self._fast else 1.0)
        forward, right, up = (float(v) * length for v in np.sum([MOVES[key] for key in self.keys], axis=0))
        camera = orbit.walk(state.camera, forward, right, up)
        return replace(state, camera=camera) if _in_reach(state, camera) else state

    def release(self) -> None:
        """Forget what is pressed: the window has lost the keyboard, or flight has ended."""
        self.keys.clear()
        self._button = 0


def _depth_of(state: State, point: Vector | None) -> float:
    """Depth of a point along the viewing direction; of the target where there is none."""
    if point is None:
        return orbit.distance(state.camera)
    *_, forward = orbit.frame(state.camera)
    return float(np.dot(np.subtract(point, state.camera.eye), forward))


def _in_reach(state: State, camera: Any) -> bool:
    """Whether a camera is neither so far nor so near that nothing can be made out."""
    reach = state.bounds.reach
    away = math.dist(camera.eye, state.bounds.center)
    near = camera.height if camera.height is not None else orbit.distance(camera)
    return bool(away < 1e4 * reach and 1e-6 * reach < near < 1e4 * reach)


def _pressed(key: str, state: State) -> State:
    """What single keys do."""
    if key == "r":
        return replace(state, camera=state.home, flying=False)
    if key == "f":
        return replace(state, camera=orbit.fit(state.camera, state.bounds), flying=False)
    if key in orbit.AXES:
        return replace(state, camera=orbit.along(state.camera, orbit.AXES[key]), flying=False)
    if key == "o":
        return with_projection(state, state.camera.height is None)
    if key == "g":
        return flight(state, not state.flying)
    if key == " ":
        return play_or_pause(state)
    if key == "h":
        return replace(state, help=not state.help)
    if key == "escape":
        return replace(state, flying=False, help=False)
    return state


def with_projection(state: State, orthographic: bool) -> State:
    """The state with an orthographic or a perspective camera."""
    camera = orbit.orthographic(state.camera) if orthographic else orbit.perspective(state.camera, 35.0)
    return replace(state, camera=camera, flying=state.flying and not orthographic)


def flight(state: State, flying: bool) -> State:
    """The state in flight or out of it; whoever flies sees in perspective."""
    if flying and state.camera.height is not None:
        state = with_projection(state, False)
    return replace(state, flying=flying)
