"""What happens in a window, one JSON object a line: for those who automate it, test it, or want to know.

Every line has ``event`` and ``seconds`` since the window was opened; times are in milliseconds.

    opened    size, panels: whether there are any
    formula   a surface is shown: formula, params, bounds, milliseconds from the text to the picture
    error     text
    camera    it has come to rest: eye, target, fov, height
    picture   a full picture: size, milliseconds, waited (from asking to showing, drawing aside), params, hits,
              unresolved, certified, overlay, method, device; params of several surfaces are called 1.a, 2.a
    copied    text
    saved     path
    closed
"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import IO, Any

from zeroset.atomic import check_writable
from zeroset.errors import OutputError


class Log:
    """Lines in a file, or nowhere.

    Example:
        >>> Log(None).say("formula", formula="x^2 = y")
    """

    def __init__(self, path: str | Path | None) -> None:
        self._begin = time.monotonic()
        self._file: IO[str] | None = None
        if path is not None:
            try:
                self._file = open(check_writable(path), "w", encoding="utf-8", buffering=1)  # noqa: SIM115
            except OSError as error:
                raise OutputError(f"cannot write {str(path)!r}: {error.strerror or error}") from None

    def say(self, event: str, **facts: Any) -> None:
        """Write one line."""
        if self._file is not None:
            seconds = round(time.monotonic() - self._begin, 3)
            self._file.write(json.dumps({"event": event, "seconds": seconds, **facts}) + "\n")

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()
            self._file = None
