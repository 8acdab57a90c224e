"""What runs behind a window, whatever draws it: the state, the threads that compile and draw, and what they answer.

``tick`` is called for every frame of the window. It moves what plays, takes pictures that have come, and asks for those
that are wanted: small ones while something changes, a full one at rest. The last good picture stays until a better one
is there.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from zeroset.view import errands, formula
from zeroset.view.boxes import Boxes
from zeroset.view.compiling import Shown, Wish, compile_and_show
from zeroset.view.controls import Controls, Pane
from zeroset.view.item import Item
from zeroset.view.log import Log
from zeroset.view.notes import Notes
from zeroset.view.pace import Pace
from zeroset.view.painting import Picture, Shot, paint
from zeroset.view.standin import StandIn, slow_to_compile, structure
from zeroset.view.state import State, advanced
from zeroset.view.worker import Failed, Newest

REST = 0.15
"""Seconds without a change before the full picture is drawn."""
LATE = 1.0
"""Seconds after which it is said that a picture is on its way."""
COLUMNS = 42
"""Characters of a formula that the sidebar shows beside each other."""


class Session:
    """A window's inside.

    Args:
        state: what to begin with.
        log: where to write what happens.
        wake: called, on any thread, when the window should be drawn again.

    Attributes:
        state: what the user has chosen; the window replaces it.
        picture: the last good picture.
        trouble: why the picture could not be drawn, or "".
        times: milliseconds of the latest pictures.
        notes: messages to the user.
        clipboard: puts text on the clipboard, and gives whether there is one.
    """

    def __init__(self, state: State, log: Log, wake: Callable[[], object] = lambda: None) -> None:
        self.state = state
        self.log = log
        self.controls = Controls()
        self.picture: Picture | None = None
        self.trouble = ""
        self.times: deque[float] = deque([0.0] * 120, maxlen=120)
        self.snippet = ""
        self.clipboard: Callable[[str], bool] = lambda text: False
        self.size = (1, 1)
        self.notes = Notes(wake)
        self._painter: Newest[Shot, Picture] = Newest("painter", paint, wake)
        self._reader: Newest[formula.Text, formula.Read] = Newest(
            "reader", formula.read_typed, wake, lambda asked: asked.key
        )
        self._compiler: Newest[Wish, Shown] = Newest("compiler", compile_and_show, wake, lambda wish: wish.item.key)
        self._stand_in = StandIn(wake)
        self._pace = Pace()
        self._boxes = Boxes(state.items)
        self._wanted: Shot | None = None
        self._changed, self._refined, self._moving = 0.0, False, False
        self._ticked = time.perf_counter()
        self._told_camera = state.camera

    # ---------------------------------------------------------------- for the window

    @property
    def compiling(self) -> bool:
        """Whether a formula is being compiled."""
        return self._compiler.busy or self._reader.busy

    @property
    def drawing(self) -> bool:
        """Whether a picture is being drawn."""
        return self._painter.busy

    @property
    def late(self) -> bool:
        """Whether a better picture has been on its way for a while."""
        return self.drawing and time.perf_counter() - self._changed > LATE

    @property
    def resting(self) -> bool:
        """Whether nothing is to be done: background work may begin."""
        return self._refined and not self.drawing and not self.compiling and not self._boxes.waiting(self.state.items)

    def complaint(self, item: Item) -> formula.Complaint | None:
        """What is wrong with the formula of a surface."""
        return self._boxes.complaint(item)

    @property
    def stand_in(self) -> str:
        """Why the CPU draws though the GPU was asked for and is not just being made ready, or ""."""
        return self._stand_in.trouble

    def handle(self, event: dict[str, Any], pane: Pane) -> None:
        """Take an event of mouse or keyboard."""
        self.state = self.controls.handle(event, self.state, pane, self.picture)

    def tick(self, size: tuple[int, int]) -> bool:
        """Go on by a frame of the window whose picture has so many pixels; gives whether there is more to come soon."""
        now = time.perf_counter()
        elapsed, self._ticked = min(now - self._ticked, 0.25), now
        self.size = size
        for reading in self._reader.answers():
            self._take_reading(reading)
        for shown in self._compiler.answers():
            self._take_formula(shown)
        for picture in self._painter.answers():
            self._take_picture(picture)
        if not self.state.flying:
            self.controls.keys.clear()
        self.state = self.controls.flown(advanced(self.state, elapsed), elapsed)
        return self.follow()

    def follow(self) -> bool:
        """Act on the present state; gives whether there is more to come soon.

        ``tick`` does it at the beginning of a frame. Once more after the panels, what they have changed is being drawn
        while their frame is still on its way to the screen.
        """
        now = time.perf_counter()
        self._do()
        self._compile(now)
        self._draw(now)
        flying = self.state.flying and bool(self.controls.keys)
        waiting = self._boxes.waiting(self.state.items) or not self._refined
        return self.state.playing or flying or waiting or bool(self.notes.latest)

    def catch_up(self) -> None:
        """Wait for a picture that moves, if it may be expected within its budget: so it is seen at once."""
        if self._moving and self._painter.busy and self.times[-1] < self.state.budget:
            self._painter.wait(self.state.budget * 1e-3)
            for picture in self._painter.answers():
                self._take_picture(picture)

    def close(self, timeout: float = 1.0) -> bool:
        """End the threads, after what was to be saved; gives whether each has ended within the time."""
        self.notes.finish()
        closed = [self._stand_in.close(timeout)]
        closed += [worker.close(timeout) for worker in (self._reader, self._compiler, self._painter)]
        self.log.say("closed")
        self.log.close()
        return all(closed)

    # ---------------------------------------------------------------- formulas

    def _compile(self, now: float) -> None:
        """Read the texts that have been left alone for a moment; what is a formula will be compiled and shown."""
        for item in self._boxes.due(self.state.items, now):
            refit = self._boxes.ask(item) or item.refit
            self._reader.ask(formula.Text(item.key, item.text, item.known, item.named, refit))

    def read(self, refit: bool = False) -> None:
        """Read the chosen formula again; ``refit`` looks anew for where it is."""
        self._boxes.again(self.state.item, refit)

    def show(self, item: Item, typed: bool = False) -> None:
        """Compile and show another version of a surface: a typed one, or one whose formula is in the box already."""
        if not typed:
            self._boxes.take(item)
        # The first picture of a formula is the CPU's where the GPU would be long in coming.
        shot = self._shot(True)
        shot = replace(shot, device="cpu") if slow_to_compile(shot.device) else shot
        self._compiler.ask(Wish(self.state, item, typed, shot))

    def _take_reading(self, answer: formula.Read | Failed[formula.Text]) -> None:
        """What has become of a text: on to the compiler, or a complaint."""
        asked = answer.job if isinstance(answer, Failed) else answer.asked
        item = self.state.find(asked.key)
        if item is None:
            return
        if isinstance(answer, Failed):
            self._complain(item, answer.error, answer.text)
            return
        self._boxes.complain(item, None)
        surface = answer.reading.surface
        if not asked.refit:
            surface = surface.with_bounds(item.surface.fitted)
        self.show(replace(item, surface=surface), typed=True)

    def _take_formula(self, shown: Shown | Failed[Wish]) -> None:
        wish = shown.job if isinstance(shown, Failed) else shown.wish
        item = self.state.find(wish.item.key)
        if item is None:
            return
        if isinstance(shown, Failed):
            self._complain(item, shown.error, shown.text)
            return
        state, before = self.state.with_item(shown.merged(item)), wish.state.camera
        # Whoever has turned the surface meanwhile keeps the view.
        camera = shown.camera if self.state.camera == before or not wish.typed else self.state.camera
        home = shown.camera if shown.camera != before or not wish.typed else self.state.home
        self.state = replace(state, camera=camera, home=home)
        self.picture, self.trouble = shown.picture, ""
        self._boxes.show(item)
        surface = shown.item.surface
        self.log.say(
            "formula",
            formula=surface.formula,
            params=dict(surface.params),
            bounds=repr(surface.fitted),
            milliseconds=round((time.perf_counter() - wish.shot.asked) * 1e3, 1),
        )

    def _complain(self, item: Item, error: Exception, text: str) -> None:
        self._boxes.complain(item, formula.complaint(error, text, COLUMNS))
        self.log.say("error", text=text)

    # ---------------------------------------------------------------- pictures

    def _shot(self, moving: bool) -> Shot:
        state = self.state
        size = self._pace.size(*self.size) if moving else self.size
        shot = Shot(
            state.scene, size, state.method, state.device, state.tolerance, state.overlay, moving, state.antialias
        )
        # The GPU's compiler would slow down what the CPU is about to draw: it waits until that is there.
        return self._stand_in.placed(shot, compile=self.resting)

    def _draw(self, now: float) -> None:
        """Ask for the picture of the present state, if it is another one than was asked for last."""
        full = self._shot(False)
        if full != self._wanted:
            self._wanted, self._changed, self._refined = full, now, False
            self._moving = True
            self._painter.ask(self._shot(True))
        elif not self._refined and now - self._changed >= REST and not self.controls.dragging:
            self._refined = True
            self._moving = False
            self._painter.ask(full)
            self._tell_camera()

    def _take_picture(self, picture: Picture | Failed[Shot]) -> None:
        if isinstance(picture, Failed):
            if picture.text != self.trouble:
                self.log.say("error", text=picture.text)
            self.trouble = picture.text
            return
        shot, before = picture.shot, self.picture
        if shot.formulas != tuple(item.surface.field.digest for item in self.state.items):
            return
        self.picture, self.trouble = picture, ""
        self.times.append(picture.milliseconds)
        # The first picture of another structure has waited for the compiler: that is no measure of its pace.
        if shot.moving and before is not None and structure(before.shot) == structure(shot):
            full, pixels = self.size[0] * self.size[1], shot.size[0] * shot.size[1]
            self._pace = self._pace.after(picture.milliseconds, pixels, full, self.state.budget)
        if not shot.moving:
            self.log.say("picture", **picture.facts)

    def _tell_camera(self) -> None:
        camera = self.state.camera
        if camera != self._told_camera:
            self._told_camera = camera
            self.log.say("camera", eye=camera.eye, target=camera.target, fov=camera.fov, height=camera.height)

    # ---------------------------------------------------------------- what panels ask for

    def _do(self) -> None:
        """Do what the panels have asked for."""
        todo = self.state.todo
        if todo:
            self.state = replace(self.state, todo=())
        for what, value in todo:
            errands.TABLE[what](self, value)
