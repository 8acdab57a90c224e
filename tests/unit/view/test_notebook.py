"""Widgets and the cells that show them, without a notebook."""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from zeroset.view import canvas, notebook


class Shell:
    """What IPython's shell tells of the cell that runs, and whom it calls before one."""

    def __init__(self) -> None:
        self.metadata: dict[str, Any] = {}
        self.callbacks: defaultdict[str, list[Callable[[Any], None]]] = defaultdict(list)
        self.events = self

    def get_parent(self) -> dict[str, Any]:
        return {"metadata": self.metadata}

    def register(self, event: str, callback: Callable[[Any], None]) -> None:
        self.callbacks[event].append(callback)

    def run(self, cell: str, *canvases: Any, deleted: tuple[str, ...] = ()) -> None:
        """Run a cell that shows some canvases."""
        self.metadata = {"cellId": cell, "deletedCells": list(deleted)} if cell else {}
        for callback in self.callbacks["pre_run_cell"]:
            callback(None)
        for each in canvases:
            notebook._remember(each, self)


class Canvas:
    closed = False

    def close(self) -> None:
        assert not self.closed
        self.closed = True


@pytest.fixture
def shell(monkeypatch: pytest.MonkeyPatch) -> Shell:
    made = Shell()
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: made))
    monkeypatch.setattr(notebook, "_shown", defaultdict(list))
    return made


def test_a_cell_that_runs_again_closes_what_it_has_shown(shell: Shell) -> None:
    first, second, other, again = Canvas(), Canvas(), Canvas(), Canvas()
    shell.run("a", first, second)
    shell.run("b", other)
    shell.run("c")
    assert not any(each.closed for each in (first, second, other))
    shell.run("a", again)
    assert [each.closed for each in (first, second, other, again)] == [True, True, False, False]
    assert len(shell.callbacks["pre_run_cell"]) == 1


def test_the_widgets_of_a_deleted_cell_are_closed_with_the_next_run(shell: Shell) -> None:
    gone, kept = Canvas(), Canvas()
    shell.run("a", gone)
    shell.run("b", kept)
    shell.run("c", deleted=("a", "z"))
    assert gone.closed
    assert not kept.closed


def test_where_cells_have_no_names_widgets_stay(shell: Shell) -> None:
    shown = Canvas()
    shell.run("", shown)
    shell.run("")
    assert not shown.closed
    notebook._remember(shown, None)


def test_a_canvas_that_closes_itself_while_it_closes_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    class Widget:
        """Closes as the widget of rendercanvas 2.7 does."""

        closed = 0

        def __init__(self, **options: Any) -> None:
            self.options = options

        def set_css_width(self, width: str) -> None:
            self.width = width

        def close(self) -> None:
            self.closed += 1
            self.close()

    module = SimpleNamespace(RenderCanvas=Widget)
    monkeypatch.setattr(canvas.importlib, "import_module", lambda name: module)
    widget = canvas.notebook_canvas((960, 600))
    assert widget.options["size"] == (960, 600)
    assert widget.width == "min(960px, calc(100% - 8px))"
    widget.close()
    widget.close()
    assert widget.closed == 1
