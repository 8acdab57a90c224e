"""Compiled code kept on disk, so that a formula seen before starts at once.

One file is one program: a header with a checksum, what a caller binds to it, and its code. A second kind of file, a
link, leads from a key that the caller made to the kernel that was built under it, so that a warm start need not even
trace the kernel. Every name is a hash of what decides the content and of ``source_stamp``: the package's own files.

Nothing here is an error to the user. A file that is damaged is deleted and made anew; a folder that cannot be used
switches the cache off, and ``status`` says why. Files appear whole, by a rename, so processes may share the folder.
``ZEROSET_CACHE_DIR`` sets the folder, ``ZEROSET_CACHE=0`` does without.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
from pathlib import Path
from typing import NamedTuple

from zeroset.hashes import digest, hexdigest
from zeroset.runtime.compiled import Compiled

_MAGIC = b"zeroset program 2\n"
_LIMIT = 256 << 20
_STALE = 3600.0
_SWEEP = 3600.0
"""Seconds between two looks at all files."""


class CacheStatus(NamedTuple):
    """What ``zeroset doctor`` shows of the cache.

    Attributes:
        folder: where the files are, or None.
        enabled: whether files are read and, as far as the folder allows, written.
        reason: why not, or why the last write failed, or an empty string.
        files: how many there are.
        size: their bytes.
    """

    folder: Path | None
    enabled: bool
    reason: str
    files: int
    size: int


class Cache:
    """Programs and links in one folder.

    Args:
        folder: made if missing; None for a cache that keeps nothing.
        limit: bytes; beyond it the files unused for longest are deleted.
        reason: why there is no folder, for ``status``.
    """

    def __init__(self, folder: Path | None, limit: int = _LIMIT, reason: str = "") -> None:
        self._folder = folder
        self._limit = limit
        self._reason = reason
        self._write_error = ""
        self._ready = False
        self._written = 0

    # ------------------------------------------------------------- programs

    def get(self, key: str) -> Compiled | None:
        """The program under a key."""
        data = self._read(key, "program")
        if data is None:
            return None
        try:
            return Compiled.from_bytes(data)
        except (ValueError, KeyError, TypeError):
            self._delete(key, "program")
            return None

    def put(self, key: str, compiled: Compiled) -> None:
        """Keep a program under a key."""
        self._write(key, "program", compiled.to_bytes())

    def link(self, key: str, target: str) -> None:
        """Say that the key leads to the program under ``target``."""
        self._write(key, "link", target.encode())

    def follow(self, key: str) -> str | None:
        """Where a key leads."""
        data = self._read(key, "link")
        return None if data is None else data.decode("ascii", "replace")

    # --------------------------------------------------------------- folder

    def status(self) -> CacheStatus:
        """Whether the cache works, and what it holds."""
        enabled = self.usable
        files = self._files() if enabled else []
        size = sum(size for _, size, _ in files)
        return CacheStatus(self._folder, enabled, self._reason or self._write_error, len(files), size)

    def clear(self) -> None:
        """Delete every file."""
        if not self.usable:
            return
        for _, _, path in self._files():
            _unlink(path)

    @property
    def usable(self) -> bool:
        """Whether the folder is there and nobody else can put code into it; looks once."""
        if self._folder is not None and not self._ready and not self._reason:
            try:
                self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
                self._reason = _distrust(self._folder)
            except OSError as error:
                self._reason = f"{self._folder}: {error.strerror or error}"
            self._ready = True
        return self._folder is not None and not self._reason

    def _path(self, key: str, suffix: str) -> Path:
        assert self._folder is not None
        return self._folder / f"{hexdigest(key)[:40]}.{suffix}"

    def _read(self, key: str, suffix: str) -> bytes | None:
        if not self.usable:
            return None
        path = self._path(key, suffix)
        try:
            data = path.read_bytes()
        except OSError:
            return None
        body = data[len(_MAGIC) + 32 :]
        if data[: len(_MAGIC)] != _MAGIC or digest(body) != data[len(_MAGIC) : len(_MAGIC) + 32]:
            _unlink(path)
            return None
        with contextlib.suppress(OSError):
            os.utime(path)
        return body

    def _write(self, key: str, suffix: str, body: bytes) -> None:
        if not self.usable:
            return
        data = _MAGIC + digest(body) + body
        try:
            _write_whole(self._path(key, suffix), data)
            self._write_error = ""
        except OSError as error:
            # What is there can still be read, and a full disk may have room next time.
            self._write_error = f"{self._folder}: {error.strerror or error}"
            return
        self._written += len(data)
        if self._sweep_due():
            self._evict()

    def _delete(self, key: str, suffix: str) -> None:
        _unlink(self._path(key, suffix))

    def _files(self) -> list[tuple[float, int, Path]]:
        """Last use, size and path of every file, the least recently used first."""
        found = []
        assert self._folder is not None
        with contextlib.suppress(OSError):
            for entry in os.scandir(self._folder):
                with contextlib.suppress(OSError):
                    if entry.name.endswith((".program", ".link", ".part")):
                        stat = entry.stat()
                        found.append((stat.st_mtime, stat.st_size, Path(entry.path)))
        return sorted(found)

    def _sweep_due(self) -> bool:
        """Whether it is time to look at all files, which takes a tenth of a second where there are ten thousand.

        Once an hour, as a file's time tells all processes, and whenever this one alone has written a part of the limit.
        """
        assert self._folder is not None
        mark = self._folder / "swept"
        try:
            recent = time.time() - mark.stat().st_mtime < _SWEEP
        except OSError:
            recent = False
        if recent and self._written <= self._limit // 16:
            return False
        self._written = 0
        with contextlib.suppress(OSError):
            mark.touch()
        return True

    def _evict(self) -> None:
        files = self._files()
        total = sum(size for _, size, _ in files)
        for used, size, path in files:
            abandoned = path.suffix == ".part" and used < time.time() - _STALE
            if total > self._limit or abandoned:
                _unlink(path)
                total -= size


def _write_whole(path: Path, data: bytes) -> None:
    import tempfile

    handle, part = tempfile.mkstemp(suffix=".part", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.replace(part, path)
    except BaseException:
        _unlink(Path(part))
        raise


def _unlink(path: Path) -> None:
    with contextlib.suppress(OSError):
        path.unlink()


def _distrust(folder: Path) -> str:
    """Why code in a folder must not be run, or an empty string."""
    if sys.platform == "win32":
        return ""
    stat = folder.stat()
    if stat.st_uid != os.geteuid():
        return f"{folder} belongs to another user"
    return f"{folder} can be written by other users" if stat.st_mode & 0o022 else ""


def cache_folder() -> Path:
    """Where the platform keeps caches, or ``ZEROSET_CACHE_DIR``."""
    asked = os.environ.get("ZEROSET_CACHE_DIR")
    if asked:
        return Path(asked)
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local") / "zeroset" / "cache"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "zeroset"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "zeroset"


def default_cache() -> Cache:
    """The cache that the environment asks for."""
    if os.environ.get("ZEROSET_CACHE") == "0":
        return Cache(None, reason="switched off by ZEROSET_CACHE=0")
    try:
        return Cache(cache_folder())
    except (OSError, RuntimeError) as error:
        return Cache(None, reason=str(error))
