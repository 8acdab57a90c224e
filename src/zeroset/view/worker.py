"""A thread that does the newest thing asked of it: what was asked before about the same and not yet begun is forgotten.

The window must never wait for a compiler or a picture, so both happen on such threads. A job learns whether a newer one
is waiting and may give up; an error of any kind becomes an answer. The threads are daemons: no job keeps the process
alive after the window is gone.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from typing import Generic, TypeVar

from zeroset.errors import ZerosetError

Job = TypeVar("Job")
Answer = TypeVar("Answer")

Superseded = Callable[[], bool]
"""Tells a job whether a newer one is waiting."""


class GivenUp(Exception):  # noqa: N818 - no error: a newer job is waiting
    """Raised by a job that has seen that it is no longer wanted."""


@dataclass(frozen=True)
class Failed(Generic[Job]):
    """A job that ended in an error.

    Attributes:
        job: what was asked.
        text: what went wrong, as the user is told.
        error: the error itself.
    """

    job: Job
    text: str
    error: Exception


class Newest(Generic[Job, Answer]):
    """One thread for one kind of job.

    Args:
        name: of the thread.
        work: does a job; is given the job and whether it is superseded.
        wake: called, on the thread, when there is an answer.
        about: what a job is about; jobs about different things do not take each other's place.

    Example:
        >>> double = Newest("double", lambda number, superseded: 2 * number)
        >>> double.ask(21)
        >>> double.wait()
        True
        >>> double.answers()
        [42]
        >>> double.close()
        True
    """

    def __init__(
        self,
        name: str,
        work: Callable[[Job, Superseded], Answer],
        wake: Callable[[], object] = lambda: None,
        about: Callable[[Job], Hashable] = lambda job: None,
    ) -> None:
        self._work = work
        self._wake = wake
        self._about = about
        self._changed = threading.Condition()
        self._next: list[Job] = []
        self._answers: list[Answer | Failed[Job]] = []
        self._busy = False
        self._closed = False
        self._thread = threading.Thread(target=self._live, name=f"zeroset-{name}", daemon=True)
        self._thread.start()

    def ask(self, job: Job) -> None:
        """Do this, in place of what is waiting about the same."""
        with self._changed:
            self._next = [waiting for waiting in self._next if self._about(waiting) != self._about(job)]
            self._next.append(job)
            self._changed.notify_all()

    def answers(self) -> list[Answer | Failed[Job]]:
        """What has been answered since the last call, oldest first."""
        with self._changed:
            found, self._answers = self._answers, []
            return found

    @property
    def busy(self) -> bool:
        """Whether a job is under way or waiting, or an answer has not been taken."""
        with self._changed:
            return self._busy or bool(self._next) or bool(self._answers)

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until nothing is under way; gives whether that is so."""
        with self._changed:
            return self._changed.wait_for(lambda: not self._busy and not self._next, timeout)

    def close(self, timeout: float = 1.0) -> bool:
        """End the thread after the job that it is at; gives whether it has ended within the time."""
        with self._changed:
            self._closed = True
            self._next = []
            self._changed.notify_all()
        self._thread.join(timeout)
        return not self._thread.is_alive()

    def _superseded(self, job: Job) -> bool:
        return self._closed or any(self._about(waiting) == self._about(job) for waiting in tuple(self._next))

    def _live(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._next or self._closed)
                if self._closed:
                    return
                job = self._next.pop(0)
                self._busy = True
            answer = self._answered(job)
            with self._changed:
                self._busy = False
                if answer:
                    self._answers += answer
                self._changed.notify_all()
            if answer and not self._closed:
                self._wake()

    def _answered(self, job: Job) -> list[Answer | Failed[Job]]:
        """The answer to a job; none where it gave up."""
        try:
            return [self._work(job, lambda: self._superseded(job))]
        except GivenUp:
            return []
        except Exception as error:
            return [Failed(job, told(error), error)]


def told(error: Exception) -> str:
    """What the user is told of an error: its own text, or what kind it is where it was none of ours."""
    if isinstance(error, ZerosetError):
        return str(error)
    if isinstance(error, MemoryError):
        return "there is not enough memory for this"
    return f"this should not have happened: {type(error).__name__}: {error}"
