"""The window as a widget of a notebook.

A notebook keeps every widget in its kernel for good, also those that no cell shows any longer. So what a cell has shown
is closed, with its threads, when that cell runs again, and when the next one runs after it has been deleted.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from zeroset.view.canvas import NOTEBOOK, check_packages, find_adapter, notebook_canvas
from zeroset.view.log import Log
from zeroset.view.session import Session
from zeroset.view.state import State

if TYPE_CHECKING:
    from zeroset.view.plain import PlainWindow
    from zeroset.view.window import Window

_shown: defaultdict[str, list[Any]] = defaultdict(list)
"""Canvases that are open, by the id of the cell that shows them."""


def running() -> bool:
    """Whether this program is a notebook's kernel, so that widgets can be shown.

    Example:
        >>> running()
        False
    """
    marimo: Any = sys.modules.get("marimo")
    if marimo is not None and marimo.running_in_notebook():
        return True
    shell = _shell()
    return shell is not None and shell.has_trait("kernel")


def _shell() -> Any:
    ipython: Any = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython is not None else None


def widget(state: State, size: tuple[int, int], log: Log) -> Any:
    """A widget that shows a session; it goes on until its cell runs again or is deleted.

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
    _remember(canvas, _shell())
    return canvas


def _remember(canvas: Any, shell: Any) -> None:
    """Have a canvas closed with its cell; one of which the notebook does not tell the cell stays open."""
    facts = _facts(shell)
    if not facts.get("cellId"):
        return
    if _before_cell not in shell.events.callbacks["pre_run_cell"]:
        shell.events.register("pre_run_cell", _before_cell)
    _shown[facts["cellId"]].append(canvas)


def _facts(shell: Any) -> dict[str, Any]:
    """What the notebook has said about the cell that runs: its ``cellId``, and the ``deletedCells`` before it."""
    parent = shell.get_parent() if hasattr(shell, "get_parent") else {}
    facts: dict[str, Any] = parent.get("metadata", {})
    return facts


def _before_cell(info: Any) -> None:
    """Close what nobody can see any longer, as a cell is about to run."""
    facts = _facts(_shell())
    _close_cells([facts.get("cellId", ""), *facts.get("deletedCells", ())])


def _close_cells(ids: Iterable[str]) -> None:
    for name in ids:
        for canvas in _shown.pop(name, ()):
            canvas.close()
