"""One process at a time draws into a folder of frames: two would take each other's frames away as they finish.

The folder itself is locked, so that there is no file that a killed process could leave behind. Where a folder cannot be
locked (Windows, some disks on a network) the second process finds frames missing and says so.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator
from pathlib import Path

from zeroset.errors import OutputError

TRIES = 5
"""How often a folder is made again that another process removes meanwhile."""


@contextlib.contextmanager
def claimed(folder: Path) -> Iterator[None]:
    """Make a folder, and keep other processes that ask from using it.

    Raises:
        OutputError: it cannot be made, or is in use.
    """
    held = _claim(folder)
    try:
        yield
    finally:
        if held is not None:
            os.close(held)


def make_folder(folder: Path) -> None:
    """Make a folder if it is not there; raises ``OutputError`` where it cannot be made."""
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot make the folder {str(folder)!r}: {error.strerror or error}") from None


def _claim(folder: Path) -> int | None:
    """A descriptor that holds the folder until it is closed; None where folders cannot be held."""
    for _ in range(TRIES):
        make_folder(folder)
        if sys.platform == "win32":
            return None
        try:
            held = os.open(folder, os.O_RDONLY)
        except OSError:
            continue
        if not _locked(folder, held):
            os.close(held)
            return None
        if _is_at(folder, held):
            return held
        os.close(held)
    raise OutputError(f"the folder {str(folder)!r} is removed again and again", hint="give the movie another name")


def _locked(folder: Path, held: int) -> bool:
    """Whether the folder is ours now; False where it is of a kind that cannot be locked."""
    if sys.platform != "win32":
        import fcntl

        try:
            fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(held)
            raise OutputError(
                f"an animation is being drawn into {str(folder)!r} already",
                hint="wait until it is done, or give the movie another name",
            ) from None
        except OSError:
            return False
    return True


def _is_at(folder: Path, held: int) -> bool:
    """Whether a folder is still where it was when it was opened."""
    try:
        there = os.stat(folder)
    except OSError:
        return False
    return os.path.samestat(there, os.fstat(held))
