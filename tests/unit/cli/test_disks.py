"""Disks that are full or closed, and commands that are killed: what is written is whole, or is not there."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from functools import lru_cache
from pathlib import Path

import pytest

ZEROSET = [sys.executable, "-m", "zeroset"]
ON_A_DISK = (
    'mkdir -p disk && mount -t tmpfs -o "$1" none disk && cd disk && shift && "$@"; s=$?; find . -type f; exit $s'
)
"""Mounts a small disk that nobody else sees, runs a command there, and lists what is on it then."""
BALL = ["x^2 + y^2 + z^2 = 1", "-b", "1.5"]
MOVING = ["animate", "x^2 + y^2 + z^2 = r", "-b", "2", "--vary", "r=1:2", "--frames", "3"]
WAVES = ["sin(9x)*sin(8y)*sin(9z) = 0.2", "-b", "3"]
"""A picture of it is no small file."""


@lru_cache(maxsize=1)
def no_disks() -> str:
    """Why no disk can be mounted here; empty where one can."""
    if shutil.which("unshare") is None:
        return "there is no unshare to mount a disk with"
    tried = subprocess.run(["unshare", "-rm", "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True, text=True)
    return f"no disk can be mounted: {tried.stderr.strip()}" if tried.returncode else ""


needs_disks = pytest.mark.skipif(bool(no_disks()), reason=no_disks() or "there are some")


def on_a_disk(options: str, folder: Path, *args: str) -> subprocess.CompletedProcess[str]:
    command = ["unshare", "-rm", "sh", "-c", ON_A_DISK, "sh", options, *ZEROSET, *args]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@needs_disks
@pytest.mark.parametrize(
    ("size", "args", "left"),
    [
        ("16k", ["render", *WAVES, "-s", "256", "-o", "a.png"], []),
        ("16k", ["render", *BALL, "-s", "64", "-o", "a.png", "--save-outputs", "a.npz"], ["a.png"]),
        ("64k", ["mesh", *BALL, "-r", "40", "-o", "a.stl"], []),
        ("64k", ["mesh", *BALL, "-r", "40", "-o", "a.glb"], []),
        ("4k", [*MOVING, "-s", "64", "-o", "a.gif"], []),
        ("24k", [*MOVING, "-s", "64", "-o", "a.gif"], ["frames"]),
        ("20k", [*MOVING, "-s", "64", "-o", "a.mp4"], ["frames"]),
        ("24k", [*MOVING, "-s", "64", "-o", "a-#.bmp"], ["frames"]),
    ],
    ids=lambda v: v if isinstance(v, str) else " ".join(v[-3:]),
)
def test_a_full_disk(size: str, args: list[str], left: list[str], tmp_path: Path) -> None:
    ran = on_a_disk(f"size={size}", tmp_path, *args)
    assert ran.returncode == 2, ran.stderr
    assert ran.stderr.startswith("error: cannot "), ran.stderr
    assert "No space left on device" in ran.stderr
    assert "Traceback" not in ran.stderr
    # Frames of an animation are kept, whole, to go on from; nothing else is left.
    files = [name.removeprefix("./") for name in ran.stdout.split()]
    frames = [name for name in files if ".frames/" in name]
    assert bool(frames) == ("frames" in left), files
    assert [name for name in files if name not in frames] == [name for name in left if name != "frames"]
    assert [name for name in frames if name.endswith(".part")] == []


@needs_disks
@pytest.mark.parametrize("args", [["render", *BALL], ["mesh", *BALL], MOVING], ids=lambda args: args[0])
def test_a_disk_that_may_only_be_read(args: list[str], tmp_path: Path) -> None:
    name = {"render": "a.png", "mesh": "a.stl", "animate": "a.gif"}[args[0]]
    ran = on_a_disk("ro", tmp_path, *args, "-o", name)
    assert ran.returncode == 2
    assert ran.stderr == f"error: cannot write {name!r}: permission denied\n  hint: choose another place\n"
    assert ran.stdout == ""


@needs_disks
def test_a_cache_on_a_full_disk_is_only_slow(tmp_path: Path) -> None:
    script = f'export ZEROSET_CACHE_DIR=$PWD; {sys.executable} -m zeroset render "{BALL[0]}" -s 32 -o {tmp_path}/a.png'
    command = ["unshare", "-rm", "sh", "-c", ON_A_DISK, "sh", "size=8k", "sh", "-c", script]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert "Traceback" not in ran.stderr
    assert (tmp_path / "a.png").stat().st_size > 200


KILLED = """
import os, signal, sys
from zeroset.cli import main
def replace(source, target, whole=os.replace):
    if os.path.basename(target) == sys.argv[1]:
        os.kill(os.getpid(), signal.SIGKILL)
    return whole(source, target)
os.replace = replace
main(sys.argv[2:])
"""
"""The command line, killed at the last moment before a file gets its name."""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no kill")
@pytest.mark.parametrize("old", [b"", b"what was there"], ids=["new", "old"])
@pytest.mark.parametrize(
    ("args", "name"),
    [
        (["render", *BALL, "-s", "32"], "a.png"),
        (["mesh", *BALL, "-r", "12"], "a.stl"),
        ([*MOVING, "-s", "32"], "a.gif"),
        ([*MOVING, "-s", "32"], "a.mp4"),
    ],
    ids=["render", "mesh", "gif", "mp4"],
)
def test_a_killed_command_leaves_no_half_of_a_file(args: list[str], name: str, old: bytes, tmp_path: Path) -> None:
    if old:
        (tmp_path / name).write_bytes(old)
    program = [sys.executable, "-c", KILLED, name, *args, "-o", name]
    assert subprocess.run(program, cwd=tmp_path, capture_output=True, check=False).returncode == -signal.SIGKILL
    assert (tmp_path / name).exists() == bool(old)
    assert not old or (tmp_path / name).read_bytes() == old
    # Once more, it is what it would have been at once.
    again, fresh = tmp_path / name, tmp_path / "fresh" / name
    fresh.parent.mkdir()
    for place in (again, fresh):
        ran = subprocess.run(
            [*ZEROSET, *args, "-o", name], cwd=place.parent, capture_output=True, text=True, check=False
        )
        assert ran.returncode == 0, ran.stderr
        assert ("3 of them drawn before" in ran.stdout) == (place is again and args[0] == "animate")
    assert again.read_bytes() == fresh.read_bytes()
    assert os.listdir(fresh.parent) == [name]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no kill")
@pytest.mark.parametrize("name", ["a.gif", "a.mp4", "a-#.png"])
def test_an_animation_that_was_killed_goes_on_to_the_same_film(name: str, tmp_path: Path) -> None:
    args = [*MOVING, "-s", "32", "--orbit", "90", "-o", name]
    program = [sys.executable, "-c", KILLED, "000002.png", *args]
    assert subprocess.run(program, cwd=tmp_path, capture_output=True, check=False).returncode == -signal.SIGKILL
    assert [path.name for path in tmp_path.iterdir() if path.is_file()] == []
    (tmp_path / "fresh").mkdir()
    for folder, said in ((tmp_path, "3 frames, 2 of them drawn before"), (tmp_path / "fresh", "3 frames, ")):
        ran = subprocess.run([*ZEROSET, *args], cwd=folder, capture_output=True, text=True, check=False)
        assert ran.returncode == 0, ran.stderr
        assert said in ran.stdout
    made = sorted(path for path in tmp_path.iterdir() if path.name != "fresh")
    assert [path.name for path in made] == sorted(os.listdir(tmp_path / "fresh"))
    assert [path.read_bytes() for path in made] == [(tmp_path / "fresh" / p.name).read_bytes() for p in made]
