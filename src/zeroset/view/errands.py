"""What the window does when it is asked: save, copy, show a gallery surface, fit the bounds, declare a parameter."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np

from zeroset.atomic import check_writable, replacing
from zeroset.errors import ZerosetError
from zeroset.view import snippet
from zeroset.view.item import Item
from zeroset.view.worker import told

if TYPE_CHECKING:
    from zeroset.view.log import Log
    from zeroset.view.notes import Notes
    from zeroset.view.state import State


class Desk(Protocol):
    """What errands ask of what runs behind the window, which is the session.

    Attributes:
        state: what the user has chosen; an errand may replace it.
        size: of the picture, in pixels.
        snippet: the text that was copied last.
        clipboard: puts text on the clipboard, and gives whether there is one.
        log: is told what has been done.
        notes: messages to the user.
    """

    state: State
    size: tuple[int, int]
    snippet: str
    clipboard: Callable[[str], bool]
    log: Log
    notes: Notes

    def read(self, refit: bool = False) -> None:
        """Read the chosen formula again."""

    def show(self, item: Item) -> None:
        """Compile and show another version of a surface."""


def outcome(work: Callable[[], str], log: Log) -> str:
    """What came of a piece of work, in words for the user."""
    try:
        return work()
    except Exception as error:
        log.say("error", text=told(error))
        return told(error)


def read_size(text: str, usual: tuple[int, int]) -> tuple[int, int]:
    """The size that a text such as ``1920x1080`` or ``800`` asks for; the usual one where it says nothing.

    Example:
        >>> read_size("1920 x 1080", (1, 1)), read_size("800", (1, 1)), read_size("", (4, 3))
        ((1920, 1080), (800, 800), (4, 3))
    """
    parts = text.lower().replace(",", "x").replace("×", "x").split("x") if text.strip() else []
    if not parts:
        return usual
    try:
        width, height = map(int, parts * 2 if len(parts) == 1 else parts)
    except ValueError:
        raise ZerosetError(f"cannot read the size {text!r}", hint="write 800 or 1280x720") from None
    return width, height


def save_picture(desk: Desk, value: str) -> None:
    """Draw the picture anew, with its overlay, and save it; the value is path, line break, size."""
    path, _, asked = value.partition("\n")

    def work() -> str:
        from zeroset.rendering.image import encode, picture_format
        from zeroset.view.painting import Shot, paint

        place = Path(path).expanduser()
        kind = picture_format(check_writable(place))
        size = read_size(asked, usual)
        scene, method = state.scene, state.method
        shot = Shot(scene, size, method, state.device, state.tolerance, state.overlay, False, state.antialias)
        data = encode(np.ascontiguousarray(paint(shot, lambda: False).pixels[..., :3]), kind)
        with replacing(place) as file:
            file.write(data)
        desk.log.say("saved", path=str(place))
        return f"saved {place}, {size[0]} x {size[1]}"

    state, usual = desk.state, desk.size
    desk.notes.say("drawing the picture ...")
    desk.notes.apart(lambda: outcome(work, desk.log))


def save_scene(desk: Desk, value: str) -> None:
    """Write the scene file."""
    scene = desk.state.scene

    def work() -> str:
        from zeroset.scene.file import save

        place = save(scene, Path(value).expanduser())
        desk.log.say("saved", path=str(place))
        return f"saved {place}"

    desk.notes.apart(lambda: outcome(work, desk.log))


def copy_python(desk: Desk, value: str) -> None:
    """Put the picture as a Python program on the clipboard."""
    _copy(desk, snippet.python(desk.state, desk.size), "the Python program")


def copy_command(desk: Desk, value: str) -> None:
    """Put the picture as a command line on the clipboard."""
    _copy(desk, snippet.command(desk.state, desk.size), "the command line")


def _copy(desk: Desk, text: str, what: str) -> None:
    desk.snippet = text
    where = "is on the clipboard" if desk.clipboard(text) else "stands under the buttons"
    desk.notes.say(f"{what} {where}")
    desk.log.say("copied", text=text)


def gallery(desk: Desk, value: str) -> None:
    """Show a surface of the gallery in place of the chosen one, in its colours."""
    from zeroset.shelf import gallery as shelf
    from zeroset.surfaces import entry

    state = replace(desk.state.edited(text=entry(value).formula), flying=False)
    desk.state = state
    before = state.item
    desk.show(Item(before.key, before.text, shelf[value].with_material(None), before.material, values=before.known))


def fit_bounds(desk: Desk, value: str) -> None:
    """Fit the bounds to the formula again."""
    desk.read(refit=True)


def declare(desk: Desk, value: str) -> None:
    """Take a longer name for a parameter."""
    desk.state = desk.state.edited(named=desk.state.item.named | {value})
    desk.read()


TABLE: dict[str, Callable[[Desk, str], None]] = {
    "save-picture": save_picture,
    "save-scene": save_scene,
    "copy-python": copy_python,
    "copy-command": copy_command,
    "gallery": gallery,
    "fit-bounds": fit_bounds,
    "declare": declare,
}
