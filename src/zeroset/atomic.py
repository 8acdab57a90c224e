"""Files that appear whole or not at all: written beside, then renamed.

An interruption, a full disk or a killed process leaves the old file, or none, and never half of one. What is no file
(a pipe, ``/dev/null``) cannot be replaced and is written to directly.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from zeroset.errors import OutputError


@contextlib.contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[IO[bytes]]:
    """Open a file for writing that takes the place of ``path`` only if the block ends well.

    A link is followed, so that the file it points to is replaced and the link stays.

    Raises:
        OutputError: the folder is missing or cannot be written, the disk is full, or ``path`` is a folder.
    """
    check_writable(path)
    with _told_of(path):
        target = Path(os.path.realpath(path))
        beside = target.parent / f".zeroset-{os.urandom(6).hex()}.part"
        place = beside if target.is_file() or not target.exists() else target
        with _removed_on_error(place, beside):
            with open(place, "xb" if place is beside else "wb") as file:
                yield file
            if place is beside:
                if target.exists():
                    os.chmod(beside, target.stat().st_mode & 0o7777)
                os.replace(beside, target)


@contextlib.contextmanager
def _told_of(path: str | os.PathLike[str]) -> Iterator[None]:
    """What the system refuses becomes an ``OutputError`` that names the path as the user wrote it."""
    try:
        yield
    except OutputError:
        raise
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise OutputError(f"cannot write {os.fspath(path)!r}: {reason}", hint="choose another place") from None


@contextlib.contextmanager
def _removed_on_error(place: Path, beside: Path) -> Iterator[None]:
    try:
        yield
    except BaseException:
        if place is beside:
            with contextlib.suppress(OSError):
                os.unlink(beside)
        raise


def check_writable(path: str | os.PathLike[str]) -> Path:
    """The path, if a file can be written there as far as can be told beforehand: before long work rather than after.

    Raises:
        OutputError: it is a folder, or its folder is missing or closed to writing.
    """
    shown = os.fspath(path)
    with _told_of(path):
        target = Path(os.path.realpath(path))
        if target.is_dir():
            raise OutputError(f"cannot write {shown!r}: it is a folder", hint="give a file name inside it")
        if not target.parent.is_dir():
            raise OutputError(f"cannot write {shown!r}: there is no folder {str(target.parent)!r}")
        if not os.access(target if target.exists() else target.parent, os.W_OK):
            raise OutputError(f"cannot write {shown!r}: permission denied", hint="choose another place")
    return Path(path)
