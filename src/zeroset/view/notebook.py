"""The window as a widget of a notebook."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from zeroset.view.canvas import NOTEBOOK, check_packages, find_adapter, notebook_canvas
from zeroset.view.log import Log
from zeroset.view.session import Session
from zeroset.view.state import State

if TYPE_CHECKING:
    from zeroset.view.plain import PlainWindow
    from zeroset.view.window import Window


def running() -> bool:
    """Whether this program is a notebook's kernel, so that widgets can be shown.

    Example:
        >>> running()
        False
    """
    marimo: Any = sys.modules.get("marimo")
    if marimo is not None and marimo.running_in_notebook():
        return True
    ipython: Any = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and shell.has_trait("kernel")


def widget(state: State, size: tuple[int, int], log: Log) -> Any:
    """A widget that shows a session; it goes on for as long as the notebook keeps it.

    Raises:
        ViewError: a package that it needs is not installed.
    """
    check_packages(NOTEBOOK, "notebook")
    adapter = find_adapter()
    canvas = notebook_canvas(size)
    session = Session(state, log, canvas.request_draw)
    window: PlainWindow | Window
    if adapter is None:
        from zeroset.view import plain

        window = plain.PlainWindow(canvas, session)
    else:
        from zeroset.view import window as panels

        window = panels.Window(canvas, adapter, session)

    def closed(event: dict[str, Any]) -> None:
        window.close()
        session.close()

    canvas.add_event_handler(closed, "close")
    return canvas
