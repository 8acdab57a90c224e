"""The frames of an animation on their way: whole PNG files in a folder beside the movie, until the movie is whole.

A small ``manifest.json`` says what was asked for. If the work is interrupted and asked for again, frames that are there
are not drawn again; frames of another animation are never mixed in, and not thrown away without being told to.
"""

from __future__ import annotations

import contextlib
import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from zeroset.atomic import replacing
from zeroset.errors import OutputError
from zeroset.export.film.claim import make_folder

Pixels = npt.NDArray[np.uint8]
MANIFEST = "manifest.json"
_OURS = re.compile(r"\d{6}\.png|manifest\.json|movie(-\d+)?\.(mp4|gif)|\.zeroset-[0-9a-f]+\.part")


class Pictures(Protocol):
    """Pictures of one size in a row."""

    def __len__(self) -> int: ...

    def __getitem__(self, index: int) -> Pixels: ...

    def __iter__(self) -> Iterator[Pixels]: ...


class Frames:
    """A folder of frames.

    Args:
        folder: where; its parent must be there.
        asked: what is drawn, as plain values; frames are used again only where all of them are the same.
        count: how many frames there are in all.
    """

    def __init__(self, folder: Path, asked: Mapping[str, Any], count: int) -> None:
        self.folder = folder
        self._asked = dict(asked)
        self._count = count

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[Pixels]:
        return (self[i] for i in range(self._count))

    def open(self, restart: bool = False) -> None:
        """Make the folder, or go on with it.

        Raises:
            OutputError: it holds frames of another animation, or is somebody else's.
        """
        make_folder(self.folder)
        held = self._read()
        if held is None and (strange := _foreign(self.folder)):
            raise OutputError(
                f"the folder {str(self.folder)!r} is there already and is no animation's: it holds {strange!r}",
                hint="move it away, or give the movie another name",
            )
        if held is not None and restart:
            self._clear()
            held = None
        if held is not None and held != self._asked:
            raise self._other(held)
        if held is None:
            with replacing(self.folder / MANIFEST) as file:
                file.write(json.dumps(self._asked, indent=1).encode())

    def _read(self) -> dict[str, Any] | None:
        """The manifest that is there; None without one, and an empty one where it cannot be read."""
        path = self.folder / MANIFEST
        if not path.exists():
            return None
        try:
            held = json.loads(path.read_bytes())
        except (OSError, ValueError):
            return {}
        return held if isinstance(held, dict) else {}

    def _other(self, held: Mapping[str, Any]) -> OutputError:
        differs = [name for name in self._asked if held.get(name) != self._asked[name]]
        changed = next((f"{n} {held[n]}, now {self._asked[n]}" for n in differs if n in held), "it cannot be read")
        if differs == ["values"]:
            changed = "other values, cameras or lights"
        return OutputError(
            f"{str(self.folder)!r} holds {self.kept()} frames of another animation: {changed}",
            hints=("restart=True throws them away and begins anew", "or give the movie another name"),
        )

    def path(self, index: int) -> Path:
        """Where a frame is kept."""
        return self.folder / f"{index:06d}.png"

    def kept(self) -> int:
        """How many frames are there."""
        return sum(1 for _ in self.folder.glob("[0-9]*.png"))

    def has(self, index: int) -> bool:
        """Whether a frame is there and can be read."""
        try:
            return self.path(index).exists() and bool(self[index].size)
        except OSError:
            # What a power failure left is drawn again.
            return False

    def put(self, index: int, png: bytes) -> None:
        """Keep a frame, whole or not at all."""
        with replacing(self.path(index)) as file:
            file.write(png)

    def __getitem__(self, index: int) -> Pixels:
        """A frame's pixels, (height, width, 3).

        Raises:
            OutputError: it is gone, or is damaged.
        """
        if not 0 <= index < self._count:
            raise IndexError(index)
        from PIL import Image as Pillow

        with self._told_of(index), Pillow.open(self.path(index)) as image:
            return np.asarray(image.convert("RGB"))

    def png(self, index: int) -> bytes:
        """A frame's file; raises ``OutputError`` where it is gone."""
        with self._told_of(index):
            return self.path(index).read_bytes()

    @contextlib.contextmanager
    def _told_of(self, index: int) -> Iterator[None]:
        try:
            yield
        except (OSError, SyntaxError, ValueError) as error:
            # Somebody has removed the folder, or another process has finished with it.
            reason = (error.strerror if isinstance(error, OSError) else None) or "it is damaged"
            raise OutputError(
                f"cannot read the frame {str(self.path(index))!r}: {reason}", hint="the same once more draws it again"
            ) from None

    def close(self) -> None:
        """Remove what is ours of the folder, and the folder if nothing else is in it."""
        self._clear()
        with contextlib.suppress(OSError):
            self.folder.rmdir()

    def _clear(self) -> None:
        # The manifest at last: without it the rest would be nobody's.
        for path in sorted(_entries(self.folder), key=lambda path: path.name == MANIFEST):
            if _OURS.fullmatch(path.name):
                with contextlib.suppress(OSError):
                    path.unlink()


def _foreign(folder: Path) -> str:
    """The name of something in a folder, or nothing."""
    return min((path.name for path in _entries(folder) if not path.name.startswith(".zeroset-")), default="")


def _entries(folder: Path) -> list[Path]:
    """What is in a folder; nothing where it is gone."""
    try:
        return list(folder.iterdir())
    except OSError:
        return []
