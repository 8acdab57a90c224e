"""Every error that zeroset raises for a mistake of its user, as one tree.

    ZerosetError
    ├── FormulaError (ValueError)          a formula cannot be read; shows the text with a caret
    │   ├── UnknownNameError               a name that means nothing here; shows the nearest ones
    │   └── FormulaLimitError              a formula past a stated limit (nodes, nesting, powers)
    ├── ParameterError (ValueError)        a parameter is missing, unknown, or has a bad value
    ├── ArrayShapeError (ValueError)       an array has the wrong shape, type, or non-finite entries
    ├── BoundsError (ValueError)           bounds that are empty, infinite, or cannot be fitted
    ├── CameraError (ValueError)           a camera that sees nothing
    ├── UnknownSurfaceError (KeyError)     no gallery entry of that name
    ├── UnknownFigureError (KeyError)      no figure of that name
    ├── MethodError (ValueError)           a method that is unknown or cannot treat this surface
    ├── DeviceError (RuntimeError)         a device that is absent or failed
    │   └── DeviceLostError                a GPU that was reset, switched off or taken away
    ├── ViewError (RuntimeError)           a window that cannot be opened: no display, something not installed
    ├── KernelError (RuntimeError)         a kernel that breaks a rule of the kernel language
    ├── SceneFileError (ValueError)        a scene file that cannot be read (path and line)
    └── OutputError (OSError)              a file that cannot be written

The first line of an error says what is wrong and where; each hint is a likely cure. The module
imports nothing slow and nothing of zeroset, so every part may use it.
"""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Sequence

__all__ = [
    "ArrayShapeError",
    "BoundsError",
    "CameraError",
    "DeviceError",
    "DeviceLostError",
    "FormulaError",
    "FormulaLimitError",
    "KernelError",
    "MethodError",
    "OutputError",
    "ParameterError",
    "SceneFileError",
    "UnknownFigureError",
    "UnknownNameError",
    "UnknownSurfaceError",
    "ViewError",
    "ZerosetError",
    "did_you_mean",
    "nearest_names",
]

WINDOW = 72
"""Widest excerpt of a formula, in characters, that an error shows."""


class ZerosetError(Exception):
    """Root of all errors that zeroset raises for a mistake of its user.

    Attributes:
        message: One line: what is wrong, and where.
        hints: Likely cures, best first; may be empty.
    """

    message: str
    hints: tuple[str, ...]

    def __init__(self, message: str = "", *, hint: str = "", hints: Iterable[str] = ()) -> None:
        super().__init__(message)
        self.message = message
        self.hints = ((hint,) if hint else ()) + tuple(hints)

    @property
    def hint(self) -> str:
        """The best hint, or an empty string."""
        return self.hints[0] if self.hints else ""

    def place(self) -> str:
        """What is shown between the message and the hints (an excerpt, say); may be empty."""
        return ""

    def __str__(self) -> str:
        lines = [self.message]
        place = self.place()
        if place:
            lines.append(place)
        lines.extend(f"  hint: {hint}" for hint in self.hints)
        return "\n".join(lines)


class FormulaError(ZerosetError, ValueError):
    """A formula cannot be read.

    Attributes:
        text: The whole formula as given; None when the formula did not come as text.
        position: Index into `text` of the first wrong character (`len(text)` for the end).
        length: How many characters the caret underlines.

    Example:
        >>> print(FormulaError("a factor is missing", text="x + * y", position=4))
        a factor is missing
          x + * y
              ^
    """

    def __init__(
        self,
        message: str = "",
        *,
        text: str | None = None,
        position: int | None = None,
        length: int = 1,
        hint: str = "",
        hints: Iterable[str] = (),
    ) -> None:
        super().__init__(message, hint=hint, hints=hints)
        self.text = text
        self.position = position
        self.length = length

    def place(self) -> str:
        """The formula, windowed around the spot, with a caret under it."""
        if self.text is None or self.position is None or not self.text.strip():
            return ""
        return excerpt(self.text, self.position, self.length)


class UnknownNameError(FormulaError):
    """A name in a formula that is no variable, constant, function or parameter.

    Attributes:
        name: The name as written.
    """

    def __init__(
        self,
        message: str = "",
        *,
        name: str = "",
        text: str | None = None,
        position: int | None = None,
        hint: str = "",
        hints: Iterable[str] = (),
    ) -> None:
        super().__init__(message, text=text, position=position, length=max(1, len(name)), hint=hint, hints=hints)
        self.name = name


class FormulaLimitError(FormulaError):
    """A formula past one of the limits stated in `zeroset.expr.limits`."""


class ParameterError(ZerosetError, ValueError):
    """A parameter is missing, unknown, or has a value that cannot be used."""


class ArrayShapeError(ZerosetError, ValueError):
    """An array has the wrong shape or type, or entries that cannot be used."""


class BoundsError(ZerosetError, ValueError):
    """Bounds that are empty or infinite, or that cannot be fitted to a surface."""


class CameraError(ZerosetError, ValueError):
    """A camera that sees nothing: eye at its target, no width, up along the view."""


class UnknownSurfaceError(ZerosetError, KeyError):
    """The gallery has no surface of that name."""

    # KeyError prints the repr of its argument; the text is wanted here.
    __str__ = ZerosetError.__str__


class UnknownFigureError(ZerosetError, KeyError):
    """No figure of that name is among those of the papers."""

    # KeyError prints the repr of its argument; the text is wanted here.
    __str__ = ZerosetError.__str__


class MethodError(ZerosetError, ValueError):
    """A root-finding method that is unknown, or that cannot treat this surface."""


class DeviceError(ZerosetError, RuntimeError):
    """A device that is absent, or that failed at run time."""


class DeviceLostError(DeviceError):
    """A GPU was reset, switched off or taken away; asking for the device again opens it anew."""


class ViewError(ZerosetError, RuntimeError):
    """A window that cannot be opened: there is no display, or something that windows need is not installed."""


class KernelError(ZerosetError, RuntimeError):
    """A kernel that breaks a rule of the kernel language."""


class SceneFileError(ZerosetError, ValueError):
    """A scene file that cannot be read.

    Attributes:
        path: The file.
        line: Line number from 1, or None where no line can be named.
    """

    def __init__(
        self,
        message: str = "",
        *,
        path: str | os.PathLike[str] | None = None,
        line: int | None = None,
        hint: str = "",
        hints: Iterable[str] = (),
    ) -> None:
        super().__init__(message, hint=hint, hints=hints)
        self.path = path
        self.line = line

    def place(self) -> str:
        """`file:line`, as editors and terminals understand it."""
        if self.path is None:
            return ""
        return f"  in {self.path}" + (f":{self.line}" if self.line is not None else "")


class OutputError(ZerosetError, OSError):
    """A file that cannot be written; nothing half written is left behind."""

    # OSError prints errno and file name when it has them; the text is wanted here.
    __str__ = ZerosetError.__str__


def nearest_names(name: str, known: Iterable[str], count: int = 3) -> tuple[str, ...]:
    """The known names that look most like `name`, best first, at most `count`.

    Upper and lower case count as nearly equal, so `Sin` finds `sin`.
    """
    import difflib

    by_folded: dict[str, str] = {}
    for candidate in known:
        by_folded.setdefault(candidate.casefold(), candidate)
    folded = name.casefold()[:100]
    return tuple(by_folded[match] for match in difflib.get_close_matches(folded, by_folded, count, 0.6))


def did_you_mean(name: str, known: Iterable[str]) -> tuple[str, ...]:
    """A hint naming the known names nearest to `name`, or no hint when none is near.

    Example:
        >>> did_you_mean("barth-sextik", ["barth-sextic", "cayley"])
        ('did you mean barth-sextic?',)
    """
    matches = nearest_names(name, known)
    return (f"did you mean {_either(matches)}?",) if matches else ()


def excerpt(text: str, position: int, length: int = 1) -> str:
    """Two lines: `text` windowed around `position`, and carets under `length` characters."""
    position = min(max(position, 0), len(text))
    start, stop = 0, len(text)
    if len(text) > WINDOW:
        start = min(max(0, position - WINDOW // 2), len(text) - WINDOW)
        stop = start + WINDOW
    before = "… " if start > 0 else ""
    after = " …" if stop < len(text) else ""
    carets = "^" * max(1, min(length, stop - position))
    indent = " " * (len(before) + sum(map(_columns, text[start:position])))
    return f"  {before}{_printable(text[start:stop])}{after}\n  {indent}{carets}"


def _either(names: Sequence[str]) -> str:
    """`a`, `a or b`, `a, b or c`."""
    *rest, last = names
    return f"{', '.join(rest)} or {last}" if rest else last


def _printable(text: str) -> str:
    """`text` with each character that would move the cursor shown as a space."""
    return "".join(character if character.isprintable() else " " for character in text)


def _columns(character: str) -> int:
    """How many terminal columns a character takes."""
    if unicodedata.combining(character):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1
