"""A twin of this process: while Python traces one kernel here, another is traced there.

Python does one thing at a time in a process, and a first picture's kernels are traced in Python. A twin is a fork: it
has loaded what this process has loaded and knows what it knows, so nothing needs to be explained to it. It keeps what
it makes where both look for it, on disk, and says so when it is done. It is never relied on: what a twin that failed,
was killed or made nonsense has left out, is made here.

Only a process with a single thread can be doubled safely, and only who owns the process may decide that it is: the
command line calls ``allow``; a library in somebody's program does not.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NoReturn

from zeroset.runtime.coming import side_by_side

Work = Callable[[], object]
_allowed = False


def allow() -> None:
    """Say that this process may double itself."""
    global _allowed
    _allowed = True


def possible() -> bool:
    """Whether a twin can be made here and now."""
    return _allowed and sys.platform == "linux" and threading.active_count() == 1


class Twin:
    """A process at work beside this one.

    Args:
        work: what it does, by name, all of it side by side; 255 pieces at most.
        later: what it does then, one after the other, until it is ended.
    """

    def __init__(self, work: Mapping[str, Work], later: Mapping[str, Work] | None = None) -> None:
        later = later or {}
        self._left = dict(enumerate((*work, *later)))
        self._reading = threading.Lock()
        self._pipe, said = os.pipe()
        self._process = os.fork()
        if not self._process:
            _live(tuple(work.values()), tuple(later.values()), said)
        os.close(said)
        atexit.register(self.end)

    def wait(self, name: str) -> None:
        """Return when a piece of work is done, will never be, or was not the twin's."""
        while name in self._left.values():
            with self._reading:
                if name in self._left.values():
                    self._listen()

    def end(self) -> None:
        """Stop the twin if it is still at work; nobody waits for it any more."""
        process = self._process
        if process:
            # First of all: a thread that waits for the twin keeps the lock until it hears of its end.
            with contextlib.suppress(OSError):
                os.kill(process, signal.SIGKILL)
        with self._reading:
            if self._process:
                self._bury()

    def _listen(self) -> None:
        """Hear of one piece that is done; of the twin's end, after which nothing more is to be expected."""
        said = os.read(self._pipe, 1) if self._process else b""
        if said:
            self._left.pop(said[0], None)
        if self._process and (not said or not self._left):
            self._bury()

    def _bury(self) -> None:
        os.close(self._pipe)
        with contextlib.suppress(OSError):
            os.waitpid(self._process, 0)
        self._process = 0
        self._left.clear()
        atexit.unregister(self.end)


def _live(work: Sequence[Work], later: Sequence[Work], said: int) -> NoReturn:
    """The twin's life: the work, a byte for each piece that is done, and no word to anybody else."""
    try:
        # Ctrl-C reaches both processes, and only one of them has to explain it.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(nowhere, stream)

        def one(number: int) -> None:
            (*work, *later)[number]()
            os.write(said, bytes([number]))

        coming = side_by_side({number: partial(one, number) for number in range(len(work))}, len(work))
        for piece in coming.values():
            piece.wait()
        for number in range(len(work), len(work) + len(later)):
            one(number)
    finally:
        # No handler of the other process's, and none of its open files, must be run or written twice.
        os._exit(0)
