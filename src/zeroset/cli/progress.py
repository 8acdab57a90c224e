"""Progress of long work on the terminal: nothing at all for what is done in a moment."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any

PATIENCE = 0.7
"""Seconds before anything is shown."""


class Progress:
    """A bar on stderr that appears only when the work takes long and somebody is looking.

    Args:
        what: the work.
        meanwhile: what else may be done while the work is under way: begun once, when that is first heard.
    """

    def __init__(self, what: str, meanwhile: Callable[[], None] | None = None) -> None:
        self._what = what
        self._meanwhile = meanwhile
        self._begin = time.monotonic()
        self._bar: Any = None
        self._task: Any = None

    def __enter__(self) -> Progress:
        return self

    def __call__(self, share: float) -> None:
        """Tell how much is done, from 0 to 1."""
        if self._meanwhile is not None:
            threading.Thread(target=self._meanwhile, daemon=True).start()
            self._meanwhile = None
        if self._bar is None:
            if not sys.stderr.isatty() or time.monotonic() - self._begin < PATIENCE:
                return
            from rich.console import Console
            from rich.progress import Progress as Bar

            self._bar = Bar(console=Console(stderr=True), transient=True)
            self._bar.start()
            self._task = self._bar.add_task(self._what, total=1.0)
        self._bar.update(self._task, completed=share)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.stop()
