"""Messages to the user that go away by themselves, and work apart whose outcome becomes one."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

SECONDS = 6.0
"""How long a message stays."""


class Notes:
    """The latest message, and the threads that will write others.

    Args:
        wake: called, on any thread, when there is a new one.

    Example:
        >>> notes = Notes(lambda: None)
        >>> notes.apart(lambda: "saved")
        >>> notes.finish()
        >>> notes.latest
        'saved'
    """

    def __init__(self, wake: Callable[[], object]) -> None:
        self._wake = wake
        self._text, self._until = "", 0.0
        self._threads: list[threading.Thread] = []

    @property
    def latest(self) -> str:
        """The latest message, for a while; then an empty string."""
        return self._text if time.perf_counter() < self._until else ""

    def say(self, text: str) -> None:
        """Show a message for a while."""
        self._text, self._until = text, time.perf_counter() + SECONDS

    def apart(self, work: Callable[[], str]) -> None:
        """Do something on a thread of its own, and say what it gives; the process waits for it."""

        def run() -> None:
            self.say(work())
            self._wake()

        thread = threading.Thread(target=run, name="zeroset-errand")
        self._threads = [*(known for known in self._threads if known.is_alive()), thread]
        thread.start()

    def finish(self) -> None:
        """Wait for all that is under way."""
        for thread in self._threads:
            thread.join()
