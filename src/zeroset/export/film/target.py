"""Where an animation goes, told by its name: a movie, or its frames one by one."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path

from zeroset.atomic import check_writable
from zeroset.errors import OutputError, did_you_mean
from zeroset.export.film.movie import check_encoder
from zeroset.rendering.image import FORMATS, picture_format

MOVIES = (".mp4", ".gif")


@dataclass(frozen=True)
class Target:
    """Where an animation goes.

    Attributes:
        path: as the user wrote it.
        kind: ``mp4``, ``gif``, or a picture format as Pillow calls it for single frames.
    """

    path: Path
    kind: str

    @property
    def movie(self) -> bool:
        """Whether it is one file."""
        return self.kind in ("mp4", "gif")

    @property
    def folder(self) -> Path:
        """Where frames are kept until all are there: beside the output, on the same disk."""
        plain = re.sub(r"[-_. ]*#+", "", self.path.stem) or "out"
        return self.path.parent / f"{plain}{'' if self.path.is_dir() else self.path.suffix}.frames"

    def check_room(self, count: int) -> None:
        """Raise ``OutputError`` where pictures of a longer animation would follow on those of this one."""
        if not self.movie and self.still(count, count).exists():
            raise OutputError(
                f"{os.fspath(self.still(count, count))!r} is there: the pictures of a longer animation would be left "
                f"behind the {count} of this one",
                hint="remove them, or give the pictures another name",
            )

    def still(self, index: int, count: int) -> Path:
        """The file of a single frame, counted from 1.

        Example:
            >>> Target(Path("out-###.png"), "PNG").still(0, 20).name
            'out-001.png'
        """
        name = self.path.name if "#" in self.path.name else "####.png"
        folder = self.path.parent if "#" in self.path.name else self.path

        def digits(found: re.Match[str]) -> str:
            return str(index + 1).zfill(max(len(found[0]), len(str(count))))

        return folder / re.sub("#+", digits, name, count=1)


def read_target(output: str | os.PathLike[str]) -> Target:
    """The target of a name: ``.mp4``, ``.gif``, a picture's name with ``#`` for the frame's number, or a folder.

    Raises:
        OutputError: the name asks for nothing that can be written, or its place cannot be written.

    Example:
        >>> read_target("out.gif").kind
        'gif'
    """
    shown = os.fspath(output)
    path = Path(shown)
    suffix = path.suffix.lower()
    if path.is_dir() or shown.endswith(("/", os.sep)):
        if path.exists() and not path.is_dir():
            raise OutputError(f"cannot write {shown!r}: it is a file, and not a folder")
        check_writable((path if path.is_dir() else path.parent) / "0001.png")
        return Target(path, "PNG")
    if "#" in path.name and suffix not in MOVIES:
        check_writable(path)
        return Target(path, picture_format(path))
    if suffix in FORMATS:
        numbered = path.with_name(f"{path.stem}-####{path.suffix}")
        raise OutputError(
            f"{shown!r} is one picture, and an animation is many", hint=f"{str(numbered)!r} gives each its number"
        )
    if suffix not in MOVIES:
        what = f"the suffix {path.suffix!r}" if suffix else "a name without a suffix"
        raise OutputError(
            f"cannot tell what to write from {what} in {shown!r}",
            hints=(*did_you_mean(suffix, MOVIES), "use .mp4 or .gif, out-####.png for single frames, or folder/"),
        )
    if suffix == ".mp4":
        check_encoder(shown)
    check_writable(path)
    return Target(path, suffix[1:])
