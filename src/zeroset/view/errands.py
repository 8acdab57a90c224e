"""What the window does when it is asked: save, copy, show a gallery surface, fit the bounds, declare a parameter."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from zeroset.atomic import check_writable, replacing
from zeroset.errors import ZerosetError
from zeroset.view import snippet
from zeroset.view.item import Item
from zeroset.view.worker import told

if TYPE_CHECKING:
    from zeroset.view.log import Log
    from zeroset.view.session import Session


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


def save_picture(session: Session, value: str) -> None:
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
        session.log.say("saved", path=str(place))
        return f"saved {place}, {size[0]} x {size[1]}"

    state, usual = session.state, session.size
    session.notes.say("drawing the picture ...")
    session.notes.apart(lambda: outcome(work, session.log))


def save_scene(session: Session, value: str) -> None:
    """Write the scene file."""
    scene = session.state.scene

    def work() -> str:
        from zeroset.scene.file import save

        place = save(scene, Path(value).expanduser())
        session.log.say("saved", path=str(place))
        return f"saved {place}"

    session.notes.apart(lambda: outcome(work, session.log))


def copy_python(session: Session, value: str) -> None:
    """Put the picture as a Python program on the clipboard."""
    _copy(session, snippet.python(session.state, session.size), "the Python program")


def copy_command(session: Session, value: str) -> None:
    """Put the picture as a command line on the clipboard."""
    _copy(session, snippet.command(session.state, session.size), "the command line")


def _copy(session: Session, text: str, what: str) -> None:
    session.snippet = text
    where = "is on the clipboard" if session.clipboard(text) else "stands under the buttons"
    session.notes.say(f"{what} {where}")
    session.log.say("copied", text=text)


def gallery(session: Session, value: str) -> None:
    """Show a surface of the gallery in place of the chosen one, in its colours."""
    from zeroset.shelf import gallery as shelf
    from zeroset.surfaces import entry

    state = replace(session.state.edited(text=entry(value).formula), flying=False)
    session.state = state
    before = state.item
    session.show(Item(before.key, before.text, shelf[value].with_material(None), before.material, values=before.known))


def fit_bounds(session: Session, value: str) -> None:
    """Fit the bounds to the formula again."""
    session.read(refit=True)


def declare(session: Session, value: str) -> None:
    """Take a longer name for a parameter."""
    session.state = session.state.edited(named=session.state.item.named | {value})
    session.read()


TABLE: dict[str, Callable[[Session, str], None]] = {
    "save-picture": save_picture,
    "save-scene": save_scene,
    "copy-python": copy_python,
    "copy-command": copy_command,
    "gallery": gallery,
    "fit-bounds": fit_bounds,
    "declare": declare,
}
