"""The twin: it works beside, is never relied on, and leaves nothing behind. Each test is a process of its own."""

from __future__ import annotations

import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="processes are doubled on Linux only")

COMMON = """
import os, sys, threading, time
from pathlib import Path
from zeroset.runtime import twin
folder = Path(sys.argv[1])
"""
KERNEL = """
from zeroset.kernel import F32, KernelBuilder, load, store
from zeroset.runtime import Recipe
from zeroset.runtime.cache import Cache
from zeroset.runtime.cpu import CpuDevice

def build():
    (folder / str(os.getpid())).touch()
    with KernelBuilder("double") as k:
        x, i = k.buffer("x", F32, writable=True), k.index()
        store(x, i, load(x, i) * 2.0)
    return k.kernel

def run(program):
    data = device.allocate(F32, 3)
    data += 1.0
    program.run(3, {}, {"x": data})
    return data.tolist()
"""


def process(folder: Path, script: str, before: str = COMMON) -> str:
    done = subprocess.run(
        [sys.executable, "-c", before + textwrap.dedent(script), str(folder)],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    return done.stdout


def test_it_does_the_work_in_a_process_of_its_own(tmp_path: Path) -> None:
    out = process(
        tmp_path,
        """
        twin.allow()
        assert twin.possible()
        def note(name):
            print("never to be seen")
            (folder / name).write_text(str(os.getpid()))
        work = {name: (lambda name=name: note(name)) for name in "abc"}
        made = twin.Twin(work)
        for name in work:
            made.wait(name)
            assert int((folder / name).read_text()) != os.getpid()
        made.wait("not of the twin's")
        try:
            os.waitpid(-1, os.WNOHANG)
        except ChildProcessError:
            print("nobody is left")
        """,
    )
    assert out == "nobody is left\n"


def test_nobody_who_has_not_said_so_is_doubled(tmp_path: Path) -> None:
    process(
        tmp_path,
        """
        assert not twin.possible()
        twin.allow()
        assert twin.possible()
        gate = threading.Event()
        threading.Thread(target=gate.wait, daemon=True).start()
        assert not twin.possible()
        gate.set()
        """,
    )


@pytest.mark.parametrize("end", ["raise ValueError", "os.kill(os.getpid(), 9)", "os._exit(3)"])
def test_its_failure_only_ends_the_wait(tmp_path: Path, end: str) -> None:
    process(
        tmp_path,
        f"""
        def fail():
            {end}
        made = twin.Twin({{"a": fail, "b": fail}})
        made.wait("b")
        made.wait("a")
        """,
    )


def test_it_ends_with_its_process(tmp_path: Path) -> None:
    process(
        tmp_path,
        """
        def work():
            (folder / "begun").write_text(str(os.getpid()))
            time.sleep(3600)
        made = twin.Twin({"a": work})
        threading.Thread(target=made.wait, args=("a",), daemon=True).start()
        while not (folder / "begun").exists() or not (folder / "begun").read_text():
            time.sleep(0.01)
        """,
    )
    assert not Path("/proc", (tmp_path / "begun").read_text()).exists()


def test_what_may_be_asked_for_comes_last_and_holds_nobody_up(tmp_path: Path) -> None:
    process(
        tmp_path,
        """
        def note(name):
            assert name != "b" or (folder / "a").exists()
            (folder / name).write_text(str(os.getpid()))
        made = twin.Twin({"a": lambda: note("a")}, {"b": lambda: note("b"), "c": lambda: time.sleep(3600)})
        made.wait("b")
        assert (folder / "b").exists()
        """,
    )
    assert not Path("/proc", (tmp_path / "b").read_text()).exists()


def test_a_program_comes_from_the_twin(tmp_path: Path) -> None:
    process(
        tmp_path,
        """
        twin.allow()
        device = CpuDevice(threads=2, cache=Cache(folder / "cache"))
        device.begin_apart([Recipe("key", build), Recipe("other", build, True)])
        assert run(device.compile_cached("key", build)) == [2.0] * 3
        assert run(device.compile_cached("other", build, True)) == [2.0] * 3
        makers = {int(path.name) for path in folder.iterdir() if path.name.isdecimal()}
        assert len(makers) == 1 and os.getpid() not in makers
        again = CpuDevice(threads=2, cache=Cache(folder / "cache"))
        again.begin_apart([Recipe("key", build), Recipe("other", build, True)], [Recipe("third", build)])
        assert again._programs._twin is None, "what is on disk need not be made"
        """,
        COMMON + KERNEL,
    )


@pytest.mark.parametrize(
    "setting",
    [
        "threads=2, cache=Cache(None)",
        'threads=1, cache=Cache(folder / "cache")',
        'threads=2, cache=Cache(folder / "a/b")',
    ],
)
def test_without_a_twin_programs_are_made_here(tmp_path: Path, setting: str) -> None:
    (tmp_path / "a").touch()
    process(
        tmp_path,
        f"""
        twin.allow()
        device = CpuDevice({setting})
        device.begin_apart([Recipe("key", build)])
        assert run(device.compile_cached("key", build)) == [2.0] * 3
        assert (folder / str(os.getpid())).exists()
        """,
        COMMON + KERNEL,
    )


def test_a_system_that_allows_no_further_process(tmp_path: Path) -> None:
    process(
        tmp_path,
        """
        def full():
            raise BlockingIOError("no more processes")
        twin.allow()
        os.fork = full
        device = CpuDevice(threads=2, cache=Cache(folder / "cache"))
        device.begin_apart([Recipe("key", build)])
        assert run(device.compile_cached("key", build)) == [2.0] * 3
        """,
        COMMON + KERNEL,
    )


def test_what_the_twin_could_not_make_is_made_here(tmp_path: Path) -> None:
    process(
        tmp_path,
        """
        twin.allow()
        here = os.getpid()
        def only_here():
            assert os.getpid() == here
            return build()
        device = CpuDevice(threads=2, cache=Cache(folder / "cache"))
        device.begin_apart([Recipe("key", only_here)])
        assert run(device.compile_cached("key", only_here)) == [2.0] * 3
        """,
        COMMON + KERNEL,
    )


def test_a_picture_is_the_same_with_and_without(tmp_path: Path) -> None:
    """One thread is drawn without a twin; what two draw must be the same bytes."""
    for threads in ("1", "2"):
        environment = {"ZEROSET_THREADS": threads, "ZEROSET_CACHE_DIR": str(tmp_path / threads), "PATH": ""}
        subprocess.run(
            [sys.executable, "-m", "zeroset", "render", "x^4 + y^4 + z^4 = 1", "-s", "96", "-o", f"{threads}.png"],
            check=True,
            cwd=tmp_path,
            env=environment | {"PYTHONPATH": ":".join(path for path in sys.path if path)},
            capture_output=True,
            timeout=120,
        )
    assert (tmp_path / "1.png").read_bytes() == (tmp_path / "2.png").read_bytes()
