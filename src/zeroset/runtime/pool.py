"""All cores on one job: threads that live as long as the process and cost nothing while they wait.

A job is a function that does a few milliseconds of work and says whether there may be more; every thread calls it
until it says no. The calling thread takes part, so one thread means no thread at all, and it looks up between calls:
Ctrl-C ends a long job within one call. ``ZEROSET_THREADS`` sets how many threads there are; the default is the number
of cores that this process may use.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable

from zeroset.errors import DeviceError

Job = Callable[[], bool]
_LOOK_UP = 0.1


def thread_count() -> int:
    """How many threads a job gets: ``ZEROSET_THREADS``, or one for each core that this process may use.

    Raises:
        DeviceError: the variable is set to something that is no positive number.
    """
    asked = os.environ.get("ZEROSET_THREADS", "").strip()
    if not asked:
        affinity = getattr(os, "sched_getaffinity", None)
        return len(affinity(0)) if affinity is not None else os.cpu_count() or 1
    if not asked.isdecimal() or not 1 <= int(asked) <= 1024:
        raise DeviceError(f"ZEROSET_THREADS is {asked!r}", hint="set it to a number of threads, 1 to 1024, or unset it")
    return int(asked)


class _Worker:
    """One waiting thread.

    What it was asked for and what it has done are counted, and only the counts tell whether it is done: an interrupt
    may come between any two steps of who asks. The locks are there to sleep on.
    """

    def __init__(self, number: int) -> None:
        self.wake = threading.Lock()
        self.done = threading.Lock()
        self.wake.acquire()
        self.done.acquire()
        self.job: Job | None = None
        self.error: BaseException | None = None
        self.stopped = False
        self.closed = False
        self.asked = self.taken = self.finished = 0
        threading.Thread(target=self._live, name=f"zeroset-{number}", daemon=True).start()

    def _live(self) -> None:
        while True:
            self.wake.acquire()
            if self.closed:
                return
            if self.taken != self.asked:
                self.taken = self.asked
                self._work()
                self.finished = self.taken
                _release(self.done)

    def _work(self) -> None:
        try:
            while not self.stopped and self.job is not None and self.job():
                pass
        except BaseException as error:  # handed to the thread that waits for the job
            self.error = error
        self.job = None

    def begin(self, job: Job) -> None:
        self.job, self.error, self.stopped = job, None, False
        self.asked += 1
        _release(self.wake)

    def wait(self) -> BaseException | None:
        """Its error, once it has done all that it was asked for; may be called again after an interrupt."""
        while self.finished != self.asked:
            # A wait without limit cannot be interrupted on every system.
            if not self.done.acquire(timeout=_LOOK_UP) and self.taken != self.asked:
                _release(self.wake)
        error, self.error = self.error, None
        return error

    def close(self) -> None:
        self.closed = True
        _release(self.wake)


def _release(lock: threading.Lock) -> None:
    """Release a lock that only this side releases."""
    if lock.locked():
        lock.release()


class Pool:
    """Threads for jobs, one job at a time.

    Example:
        >>> from itertools import count
        >>> numbers, seen = count(), []
        >>> Pool(2).run(lambda: (seen.append(n := next(numbers)) or n < 9))
        >>> sorted(seen)[:3]
        [0, 1, 2]
    """

    def __init__(self, threads: int) -> None:
        self.threads = threads
        self._workers: list[_Worker] = []
        self._busy = threading.Lock()
        self._owner = os.getpid()

    def run(self, job: Job, threads: int | None = None) -> None:
        """Call ``job`` on up to ``threads`` threads until it says that nothing is left.

        An error, or an interrupt, in any thread ends the job on all of them and is raised here.
        """
        helpers = min(threads or self.threads, self.threads) - 1
        if helpers < 1:
            while job():
                pass
            return
        with self._busy:
            self._spread(job, self._hire(helpers))

    def _hire(self, helpers: int) -> list[_Worker]:
        if self._owner != os.getpid():
            # A fork leaves the threads behind.
            self._workers, self._owner = [], os.getpid()
        while len(self._workers) < helpers:
            self._workers.append(_Worker(len(self._workers) + 1))
        return self._workers[:helpers]

    def _spread(self, job: Job, workers: list[_Worker]) -> None:
        begun = []
        errors: list[BaseException] = []
        try:
            for worker in workers:
                begun.append(worker)
                worker.begin(job)
            while job():
                pass
        except BaseException as error:
            errors.append(error)
            for worker in begun:
                worker.stopped = True
        for worker in begun:
            self._join(worker, begun, errors)
        if errors:
            raise errors[0]

    def _join(self, worker: _Worker, workers: list[_Worker], errors: list[BaseException]) -> None:
        """Wait for a worker; an interrupt, or its error, ends the others' work too."""
        while True:
            try:
                error = worker.wait()
                break
            except BaseException as interrupt:
                errors.append(interrupt)
                for other in workers:
                    other.stopped = True
        if error is not None:
            errors.append(error)
            for other in workers:
                other.stopped = True

    def close(self) -> None:
        """End the threads."""
        with self._busy:
            for worker in self._workers:
                worker.close()
            self._workers = []
