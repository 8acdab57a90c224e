"""Files that appear whole or not at all: written beside, then renamed.

An interruption, a full disk or a killed process leaves the old file, or none, and never half of one.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from zeroset.errors import OutputError


@contextlib.contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[IO[bytes]]:
    """Open a file for writing that takes the place of ``path`` only if the block ends well.

    Raises:
        OutputError: the folder is missing or cannot be written, the disk is full, or ``path`` is a folder.
    """
    target = Path(path)
    temporary: str | None = None
    try:
        if target.is_dir():
            raise OutputError(f"cannot write {str(target)!r}: it is a folder", hint="give a file name inside it")
        handle, temporary = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent or Path())
        with os.fdopen(handle, "wb") as file:
            yield file
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, target)
        temporary = None
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        hint = "the folder does not exist" if not target.parent.exists() else "choose another place with -o"
        raise OutputError(f"cannot write {str(target)!r}: {error.strerror or error}", hint=hint) from None
    finally:
        if temporary is not None:
            with contextlib.suppress(OSError):
                os.unlink(temporary)


def _umask() -> int:
    # The only portable way to read the umask is to set it.
    mask = os.umask(0)
    os.umask(mask)
    return mask
