"""The job of the compiling thread: a new formula, or a surface of the gallery, with its first picture."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from zeroset.scene.bounds import Ball, Bounds
from zeroset.scene.camera import Camera, fit_camera
from zeroset.scene.fit import UNBOUNDED
from zeroset.scene.scene import Scene
from zeroset.view.item import Item
from zeroset.view.levels import value_span
from zeroset.view.orbit import refitted
from zeroset.view.painting import Picture, Shot, paint
from zeroset.view.state import State
from zeroset.view.worker import Superseded

FIRST = 320
"""Longer side of the first picture of a formula: it is there as soon as the formula is compiled."""


@dataclass(frozen=True)
class Wish:
    """A surface that is to be shown in place of one that is there.

    Attributes:
        state: as it was when this was wished.
        item: with the surface that is wanted, inside the bounds to keep if it is seen in them; None fits it.
        typed: whether its formula was typed, so that the view stays where it can; or it brings along what it has.
        shot: how the picture is drawn.
    """

    state: State
    item: Item
    typed: bool
    shot: Shot


@dataclass(frozen=True, eq=False)
class Shown:
    """A surface that has been compiled, with the first picture of the scene that it is in.

    Attributes:
        item: with the surface in its bounds.
    """

    wish: Wish
    item: Item
    camera: Camera
    picture: Picture

    def merged(self, now: Item) -> Item:
        """The surface with what has been changed of it while it was compiled.

        Args:
            now: what stands in its place by now.
        """
        if not self.wish.typed:
            return replace(self.item, text=now.text)
        new, values = self.item, now.surface.params
        kept = {name: values[name] for name in new.surface.params if name in values}
        surface = new.surface.with_params(**kept) if kept else new.surface
        return replace(now, surface=surface, level_span=new.level_span, refit=new.refit, values=now.known)


def compile_and_show(wish: Wish, superseded: Superseded) -> Shown:
    """Make the surface, compile the scene with it, and draw it small."""
    shown = _show(wish, wish.item)
    kept = wish.item.surface.bounds is not None
    if wish.typed and kept and not _seen(shown) and not superseded():
        # Nothing of it lies in the old bounds: look where it is.
        shown = _show(wish, replace(wish.item, surface=replace(wish.item.surface, bounds=None)))
    return shown


def _show(wish: Wish, wanted: Item) -> Shown:
    item = replace(
        wanted, surface=wanted.surface.with_bounds(_bounds(wish, wanted)), refit=wanted.surface.bounds is None
    )
    if item.levels:
        item = replace(item, level_span=value_span(item.surface, item.levels))
    state = wish.state.with_item(item)
    camera = _camera(wish, state)
    scene = replace(state, camera=camera).scene
    return Shown(wish, item, camera, paint(_first(wish.shot, scene), lambda: False))


def _bounds(wish: Wish, wanted: Item) -> Bounds:
    """Its bounds, fitted where it has none; what goes on for ever beside others stays where it was."""
    bounds, before = wanted.drawn.fitted, wish.state.find(wanted.key)
    endless = bounds == Ball(UNBOUNDED) and wish.state.several
    return before.surface.fitted if endless and before is not None else bounds


def _camera(wish: Wish, state: State) -> Camera:
    """A lone gallery surface's own camera, or the one that sees a lone surface as it saw the one before.

    Others beside it stay where they are in the picture, as long as all of it is among them.
    """
    if not (wish.typed or state.several):
        return state.item.surface.camera or fit_camera(state.bounds)
    before, camera = wish.state, wish.state.camera
    if state.several and _within(state.bounds, before.bounds):
        return camera
    return camera if _alike(before.bounds, state.bounds) else refitted(camera, before.bounds, state.bounds)


def _first(shot: Shot, scene: Scene) -> Shot:
    """The small picture of a scene."""
    width, height = shot.size
    scale = min(1.0, FIRST / max(width, height))
    size = max(1, round(width * scale)), max(1, round(height * scale))
    return replace(shot, scene=scene, size=size, moving=True)


def _seen(shown: Shown) -> bool:
    """Whether anything of the new surface is in its picture; of one among several, in a picture of it alone."""
    if not shown.wish.state.several:
        return shown.picture.hits > 0
    alone = replace(shown.picture.shot.scene, surface=shown.item.drawn)
    return paint(replace(shown.picture.shot, scene=alone), lambda: False).hits > 0


def _within(inner: Bounds, outer: Bounds) -> bool:
    """Whether bounds reach hardly beyond others."""
    return math.dist(inner.center, outer.center) + inner.reach < 1.25 * outer.reach


def _alike(before: Bounds, after: Bounds) -> bool:
    """Whether bounds are so alike that the camera may stay where it is."""
    apart = math.dist(before.center, after.center)
    return apart < 0.15 * before.reach and 0.8 < after.reach / before.reach < 1.25
