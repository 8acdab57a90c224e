"""The bar that long work shows, and what is begun beside it."""

from __future__ import annotations

import threading

from zeroset.cli.progress import Progress


def test_what_can_be_done_meanwhile_is_begun_once() -> None:
    begun = threading.Semaphore(0)
    with Progress("work", meanwhile=begun.release) as progress:
        assert not begun.acquire(blocking=False)
        progress(0.0)
        progress(0.5)
    assert begun.acquire(timeout=10)
    assert not begun.acquire(timeout=0.05)
