from __future__ import annotations

import errno
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from zeroset.kernel import F32, U32, Buffer, Uniform
from zeroset.runtime import cache as module
from zeroset.runtime.cache import Cache, cache_folder, default_cache
from zeroset.runtime.compiled import Compiled
from zeroset.runtime.device import Signature

SIGNATURE = Signature("k", (Uniform("a", F32), Uniform("n", U32)), (Buffer("x", F32, True), Buffer("y", U32, False)))


def compiled(code: bytes = b"\x90" * 100) -> Compiled:
    return Compiled(SIGNATURE, 8, "image", code)


def files(folder: Path, suffix: str) -> list[Path]:
    return sorted(folder.glob(f"*.{suffix}"))


def test_what_goes_in_comes_out(tmp_path: Path) -> None:
    Cache(tmp_path / "made" / "here").put("key", compiled())
    assert Cache(tmp_path / "made" / "here").get("key") == compiled()
    assert Cache(tmp_path / "made" / "here").get("other") is None


def test_links(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    cache.link("formula", "digest")
    assert cache.follow("formula") == "digest"
    assert cache.follow("digest") is None
    assert cache.get("formula") is None


@pytest.mark.parametrize("damage", ["empty", "short", "flipped", "header", "nonsense"])
def test_damaged_files_are_removed_and_made_anew(tmp_path: Path, damage: str) -> None:
    cache = Cache(tmp_path)
    cache.put("key", compiled())
    (path,) = files(tmp_path, "program")
    data = bytearray(path.read_bytes())
    data[-5] ^= damage == "flipped"
    data[0] ^= damage == "header"
    path.write_bytes({"empty": b"", "short": data[:-1]}.get(damage, bytes(data)))
    if damage == "nonsense":
        cache._write("key", "program", b"\x04\x00\x00\x00{}{}rest")
    assert cache.get("key") is None
    assert not path.exists()
    cache.put("key", compiled())
    assert cache.get("key") == compiled()


def test_a_folder_that_cannot_be(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    cache = Cache(tmp_path / "file" / "cache")
    cache.put("key", compiled())
    assert cache.get("key") is None
    status = cache.status()
    assert not status.enabled
    assert str(tmp_path / "file") in status.reason


def test_a_full_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*arguments: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    cache = Cache(tmp_path)
    cache.put("before", compiled())
    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", full)
        cache.put("key", compiled())
    assert cache.get("key") is None
    assert cache.get("before") == compiled()
    assert cache.status().enabled
    assert "No space left" in cache.status().reason
    assert not files(tmp_path, "part")
    cache.put("key", compiled())
    assert cache.status().reason == ""


@pytest.mark.skipif(sys.platform == "win32", reason="permissions are POSIX's")
def test_code_that_others_could_have_put_there_is_not_run(tmp_path: Path) -> None:
    Cache(tmp_path).put("key", compiled())
    tmp_path.chmod(0o777)
    assert Cache(tmp_path).get("key") is None
    assert "written by other users" in Cache(tmp_path).status().reason
    tmp_path.chmod(0o700)
    assert Cache(tmp_path).get("key") == compiled()


def test_the_least_recently_used_are_evicted(tmp_path: Path) -> None:
    cache = Cache(tmp_path, limit=3500)
    for age, key in enumerate("abc"):
        cache.put(key, compiled(bytes(900)))
        os.utime(cache._path(key, "program"), (1000 + age, 1000 + age))
    assert cache.get("a") is not None
    cache.put("d", compiled(bytes(900)))
    assert [key for key in "abcd" if cache.get(key) is not None] == ["a", "c", "d"]
    assert cache.status().size <= 3500


def test_files_that_a_killed_process_left(tmp_path: Path) -> None:
    old, new = tmp_path / "old.part", tmp_path / "new.part"
    old.write_bytes(b"half")
    new.write_bytes(b"half")
    os.utime(old, (time.time() - 7200,) * 2)
    Cache(tmp_path).put("key", compiled())
    assert not old.exists()
    assert new.exists()


def test_two_processes_write_at_once(tmp_path: Path) -> None:
    program = f"""
from pathlib import Path
from zeroset.runtime.cache import Cache
from zeroset.runtime.compiled import Compiled
from zeroset.runtime.device import Signature
cache = Cache(Path({str(tmp_path)!r}), limit=60_000)
for n in range(150):
    mine = Compiled(Signature("k", (), ()), 4, "image", bytes([n]) * 3000)
    cache.put(f"key {{n % 7}}", mine)
    for key in range(7):
        found = cache.get(f"key {{key}}")
        assert found is None or len(set(found.code)) == 1 and len(found.code) == 3000
"""
    both = [subprocess.Popen([sys.executable, "-c", program]) for _ in range(2)]
    assert [process.wait(60) for process in both] == [0, 0]
    assert not files(tmp_path, "part")
    assert all(Cache(tmp_path).get(f"key {n}") is not None for n in range(7))


def test_status_and_clear(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    assert cache.status() == module.CacheStatus(tmp_path, True, "", 0, 0)
    cache.put("key", compiled())
    cache.link("a", "b")
    assert cache.status().files == 2
    cache.clear()
    assert cache.status().size == 0


def test_where_it_is(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("ZEROSET_CACHE_DIR", str(tmp_path))
    monkeypatch.delenv("ZEROSET_CACHE", raising=False)
    assert default_cache().status().folder == tmp_path
    monkeypatch.setenv("ZEROSET_CACHE", "0")
    assert default_cache().status().reason == "switched off by ZEROSET_CACHE=0"
    default_cache().put("key", compiled())
    assert default_cache().get("key") is None
    monkeypatch.delenv("ZEROSET_CACHE_DIR")
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setenv("XDG_CACHE_HOME", "/x")
    assert cache_folder() == Path("/x/zeroset")
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", "/home/u")
    assert cache_folder() == Path("/home/u/.cache/zeroset")
    monkeypatch.setattr(sys, "platform", "darwin")
    assert cache_folder() == Path("/home/u/Library/Caches/zeroset")
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setenv("LOCALAPPDATA", "/local")
    assert cache_folder() == Path("/local/zeroset/cache")


def test_the_folder_is_not_looked_through_at_every_write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    looks = []
    cache = Cache(tmp_path)
    monkeypatch.setattr(Cache, "_evict", lambda self: looks.append(1))
    for n in range(20):
        cache.put(f"key {n}", compiled())
    Cache(tmp_path).put("another process", compiled())
    assert len(looks) == 1
    os.utime(tmp_path / "swept", (time.time() - 7200,) * 2)
    cache.put("later", compiled())
    assert len(looks) == 2
