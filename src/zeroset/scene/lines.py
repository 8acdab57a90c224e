"""On which line each value of a TOML text stands, which TOML's own reader does not tell.

A path is what leads to a value: ``("lights", 1, "color")`` is the colour of the second of the lights, whether these are
``[[lights]]`` or a list of inline tables. The text is one that the reader has taken, so nothing is checked here.
"""

from __future__ import annotations

import contextlib
import re
import tomllib
from bisect import bisect_left
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from zeroset.errors import SceneFileError

if TYPE_CHECKING:
    import os

Path = tuple[str | int, ...]
"""What leads to a value: names of keys, and numbers of elements."""

_BLANK = re.compile(r"(?:[\s,]|#[^\n]*)*")
_KEY = re.compile(r"""[A-Za-z0-9_-]+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*'""")
_DOT = re.compile(r"[ \t]*\.[ \t]*")
_STRING = re.compile(r'"""(?:[^\\]|\\.)*?"{3,5}|\'\'\'.*?\'{3,5}|"(?:[^"\\\n]|\\.)*"|\'[^\'\n]*\'', re.DOTALL)
_PLAIN = re.compile(r"[^,\]}\n#]+")


def read_toml(text: str, path: str | os.PathLike[str]) -> dict[str, Any]:
    """What a TOML text says; raises ``SceneFileError`` with the line where it is none."""
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise SceneFileError("this is no TOML that can be read: it is nested too deeply", path=path) from None
    except ValueError as error:
        # Among these are whole numbers with more digits than Python reads.
        found = re.search(r"line (\d+)", str(error))
        line = int(found[1]) if found else None
        if "end of document" in str(error):
            line = text.rstrip("\n").count("\n") + 1
        twice = re.search("overwrite|declare", str(error))
        hint = "each key and each table may stand once" if twice else "text stands in quotes, and tables in brackets"
        raise SceneFileError(f"this is no TOML: {error}", path=path, line=line, hint=hint) from None


class Lines:
    """The lines of all values of a TOML text.

    Example:
        >>> lines = Lines("a = 1\\n[[b]]\\nc = 2\\n[[b]]\\nc = 3")
        >>> lines.of(("b", 1, "c")), lines.of(("b", 1, "d")), lines.of(("e",))
        (5, 4, None)
    """

    def __init__(self, text: str) -> None:
        self._text = text
        self._ends = [found.start() for found in re.finditer("\n", text)]
        self._found: dict[Path, int] = {}
        self._elements: dict[Path, int] = {}
        self._at = 0
        # What is nested more deeply than can be followed stands inside of something whose line is known.
        with contextlib.suppress(RecursionError):
            self._read()

    def of(self, path: Path) -> int | None:
        """The line of a value, from 1; of what it stands in where there is none; None where that is the whole text."""
        for length in range(len(path), 0, -1):
            if path[:length] in self._found:
                return self._found[path[:length]]
        return None

    def _note(self, path: Path) -> None:
        self._found.setdefault(path, bisect_left(self._ends, self._at) + 1)

    def _take(self, pattern: re.Pattern[str]) -> str:
        found = pattern.match(self._text, self._at)
        self._at = found.end() if found else self._at
        return found[0] if found else ""

    def _read(self) -> None:
        """Tables' heads and pairs, one after another."""
        table: Path = ()
        self._take(_BLANK)
        while self._at < len(self._text):
            before = self._at
            if self._text[self._at] == "[":
                table = self._head()
            else:
                self._pair(table)
            self._take(_BLANK)
            if self._at == before:
                return

    def _head(self) -> Path:
        """``[a.b]``, or ``[[a.b]]`` for another element of a list."""
        listed = self._text.startswith("[[", self._at)
        self._at += 2 if listed else 1
        self._take(_BLANK)
        path: Path = ()
        *above, last = self._dotted()
        for name in above:
            path = self._latest((*path, name))
            self._note(path)
        path = (*path, last)
        if listed:
            self._note(path)
            self._elements[path] = self._elements.get(path, -1) + 1
        path = self._latest(path)
        self._note(path)
        self._at = self._text.index("]", self._at) + (2 if listed else 1)
        return path

    def _latest(self, path: Path) -> Path:
        """The latest element where a path leads to a list of tables."""
        return (*path, self._elements[path]) if path in self._elements else path

    def _dotted(self) -> list[str]:
        """The names of a key such as ``a."b c".d``."""
        names = []
        while True:
            raw = self._take(_KEY)
            names.append(next(iter(tomllib.loads(f"{raw} = 0"))) if raw[:1] in ('"', "'") else raw)
            if not self._take(_DOT):
                return names

    def _pair(self, table: Path) -> None:
        begin = self._at
        names = self._dotted()
        end, self._at = self._at, begin
        for length in range(1, len(names) + 1):
            self._note((*table, *names[:length]))
        self._at = self._text.index("=", end) + 1
        self._take(_BLANK)
        self._value((*table, *names))

    def _value(self, path: Path) -> None:
        opening = self._text[self._at : self._at + 1]
        if opening == "[":
            count = iter(range(len(self._text)))
            self._inside("]", lambda: self._element((*path, next(count))))
        elif opening == "{":
            self._inside("}", lambda: self._pair(path))
        elif not self._take(_STRING):
            self._take(_PLAIN)

    def _inside(self, closing: str, item: Callable[[], None]) -> None:
        """Items up to a closing bracket; commas count as blank."""
        self._at += 1
        self._take(_BLANK)
        while not self._text.startswith(closing, self._at):
            item()
            self._take(_BLANK)
        self._at += 1

    def _element(self, path: Path) -> None:
        self._note(path)
        self._value(path)
