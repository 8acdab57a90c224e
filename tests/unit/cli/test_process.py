"""The command as a process of its own: what only shows there."""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import pytest

COMMAND = [sys.executable, "-m", "zeroset"]
HEARD = (signal.SIGINT, signal.SIG_DFL)
"""Tests that run in the background are deaf to Ctrl-C, and so would be what they start."""


def test_a_picture_from_a_fresh_process(tmp_path: Path) -> None:
    ran = subprocess.run(
        [*COMMAND, "render", "-x^2 - y^2 - z^2 + 1", "-b", "1.5", "-s", "32", "-o", "a.png"],
        cwd=tmp_path, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert ran.stderr == ""
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_a_plain_picture_loads_nothing_that_it_does_not_need(tmp_path: Path) -> None:
    """Each of these takes milliseconds, of the two or three hundred that a known formula takes."""
    program = (
        "import sys; from zeroset.cli import main; main(sys.argv[1:])\n"
        "print(*sorted({'PIL', 'logging', 'subprocess', 'zeroset.scene.coloring', 'zeroset.scene.environment',\n"
        "               'zeroset.rendering.bounce', 'zeroset.rendering.tint'} & set(sys.modules)))"
    )
    ran = subprocess.run(
        [sys.executable, "-c", program, "render", "x^2 + y^2 + z^2 = 1", "-s", "32", "-o", "a.png"],
        cwd=tmp_path, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert ran.stdout.splitlines()[1:] == [""]


def test_a_mistake_is_no_traceback(tmp_path: Path) -> None:
    ran = subprocess.run([*COMMAND, "render", "x^2 +* y"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode == 2
    assert ran.stdout == ""
    assert ran.stderr.startswith("error: ")
    assert "Traceback" not in ran.stderr
    assert list(tmp_path.iterdir()) == []


def test_ctrl_c_in_the_middle_of_a_long_render(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(b"what was there")
    # Minutes of work, most of it inside compiled code.
    command = [
        *COMMAND,
        "render",
        "sin(9x)*sin(8y)*sin(9z) = 0.2",
        "-b",
        "6",
        "-s",
        "8000",
        "-o",
        "a.png",
        "-t",
        "1e-7",
    ]
    command += ["-m", "marching-points:steps=50000"]
    pipe = subprocess.PIPE
    process = subprocess.Popen(
        command, cwd=tmp_path, stdout=pipe, stderr=pipe, text=True, preexec_fn=partial(signal.signal, *HEARD)
    )
    try:
        time.sleep(3)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=20)
    finally:
        process.kill()
    assert process.returncode == 130
    assert "interrupted" in err
    assert "Traceback" not in out + err
    assert (tmp_path / "a.png").read_bytes() == b"what was there"
    assert os.listdir(tmp_path) == ["a.png"]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no full disk at hand")
@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("where", ["> /dev/full", ">&-"])
@pytest.mark.parametrize("command", ["gallery", "--help", "render sphere -s 16 -o a.png", "explain x"])
def test_output_that_cannot_be_written_is_one_clear_line(
    command: str, where: str, unbuffered: str, tmp_path: Path
) -> None:
    ran = subprocess.run(
        f"{shlex.join(COMMAND)} {command} {where}", shell=True, env={**os.environ, "PYTHONUNBUFFERED": unbuffered},
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert ran.returncode == 1
    reason = "it is closed" if where == ">&-" else "No space left on device"
    assert ran.stderr == f"error: cannot write to the standard output: {reason}\n"


def test_a_mistake_is_told_though_output_is_closed(tmp_path: Path) -> None:
    command = f"{shlex.join(COMMAND)} render 'x +' >&-"
    ran = subprocess.run(command, shell=True, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode == 2
    assert "a value is missing" in ran.stderr
    assert "standard output" not in ran.stderr


def test_a_reader_that_leaves_early_is_no_error() -> None:
    process = subprocess.Popen([*COMMAND, "gallery"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None
    process.stdout.close()
    assert process.stderr is not None
    assert process.stderr.read() == ""
    process.stderr.close()
    process.wait(timeout=20)
