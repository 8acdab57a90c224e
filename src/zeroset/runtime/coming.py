"""Things that threads make while others are being used.

As the standard library's executors do it, which load its logging along: more than a warm start has time for.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Mapping
from typing import Generic, TypeVar

K = TypeVar("K")
T = TypeVar("T")


class Coming(Generic[T]):
    """Something that is being made.

    Args:
        make: makes it.
    """

    def __init__(self, make: Callable[[], T]) -> None:
        self._make = make
        self._made: T
        self._error: BaseException | None = None
        self._done = threading.Event()

    def done(self) -> bool:
        """Whether it is there, or never will be."""
        return self._done.is_set()

    def wait(self) -> None:
        """Return when it is there, or never will be."""
        self._done.wait()

    def result(self) -> T:
        """The thing, when it is there; raises what making it has raised."""
        self.wait()
        if self._error is not None:
            raise self._error
        return self._made

    def make(self) -> None:
        """Make it, here and now."""
        try:
            self._made = self._make()
        except BaseException as error:  # raised where it is asked for
            self._error = error
        self._done.set()


def side_by_side(work: Mapping[K, Callable[[], T]], at_once: int) -> dict[K, Coming[T]]:
    """Begin several things, in their order, no more than so many at once."""
    coming = {name: Coming(make) for name, make in work.items()}
    waiting = deque(coming.values())

    def live() -> None:
        while True:
            try:
                one = waiting.popleft()
            except IndexError:
                return
            one.make()

    for _ in range(min(at_once, len(work))):
        threading.Thread(target=live, name="zeroset-making").start()
    return coming
