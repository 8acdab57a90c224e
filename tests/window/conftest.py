"""A display, and a person at it who moves the mouse, types, looks at the screen and reads the log.

Tests of windows are skipped, aloud, where what they need is missing.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

PACKAGES = ("wgpu", "rendercanvas", "glfw", "imgui_bundle")
PROGRAMS = ("Xvfb", "xdotool")


@pytest.fixture(scope="session")
def adapter() -> None:
    """Skip where no adapter is found; asked in a process of its own, since drivers may print or worse."""
    missing = [name for name in PACKAGES if importlib.util.find_spec(name) is None]
    if missing:
        pytest.skip(f"not installed: {', '.join(missing)} (pip install 'zeroset[desktop]')")
    program = "import wgpu; wgpu.gpu.request_adapter_sync(power_preference='high-performance')"
    found = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    if found.returncode:
        pytest.skip("no graphics adapter (Debian: apt-get install mesa-vulkan-drivers)")


@pytest.fixture(scope="session")
def display(adapter: None) -> Iterator[dict[str, str]]:
    """An environment with an X server in it."""
    missing = [name for name in PROGRAMS if shutil.which(name) is None]
    if missing:
        pytest.skip(f"not installed: {', '.join(missing)} (Debian: apt-get install xvfb xdotool)")
    reader, writer = os.pipe()
    # The server picks a free number and writes it.
    command = ["Xvfb", "-displayfd", str(writer), "-screen", "0", "1300x820x24", "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=(writer,), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writer)
    with os.fdopen(reader) as file:
        number = file.readline().strip()
    if not number:
        server.kill()
        server.wait()
        pytest.skip("Xvfb does not start here")
    environment = {k: v for k, v in os.environ.items() if k != "WAYLAND_DISPLAY"}
    yield environment | {"DISPLAY": f":{number}"}
    server.terminate()
    server.wait(20)


@pytest.fixture
def at_window(display: dict[str, str], tmp_path: Path) -> Iterator[Callable[..., Person]]:
    """Starts ``zeroset view`` with some arguments, or a program, and puts a person at it."""
    started: list[subprocess.Popen[str]] = []

    def start(*args: str, program: str = "") -> Person:
        log = tmp_path / "log.jsonl"
        what = ["-c", program, str(log)] if program else ["-m", "zeroset", "view", *args, "--log", str(log)]
        command = [sys.executable, *what]
        pipe = subprocess.PIPE
        started.append(subprocess.Popen(command, env=display, cwd=tmp_path, stdout=pipe, stderr=pipe, text=True))
        return Person(started[-1], display, log)

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.communicate()


PATIENCE = 120.0
TICK = 0.06
"""Seconds between strokes: a person's fingers are no faster."""


class Person:
    """Drives the window of a process with xdotool."""

    def __init__(self, process: subprocess.Popen[str], environment: dict[str, str], log: Path) -> None:
        self.process = process
        self._environment = environment
        self._log = log
        self._read = 0

    def do(self, *words: object) -> str:
        """One xdotool command."""
        command = ["xdotool", *map(str, words)]
        done = subprocess.run(command, env=self._environment, capture_output=True, text=True, check=True)
        time.sleep(TICK)
        return done.stdout.strip()

    def window(self) -> int:
        """The window's number, once it is there; it gets the keyboard, as there is no window manager."""
        found = self.do("search", "--sync", "--onlyvisible", "--pid", self.process.pid).split()[-1]
        self.do("windowfocus", found)
        return int(found)

    def drag(self, start: tuple[int, int], stop: tuple[int, int], button: int = 1) -> None:
        """Press, move in steps, let go."""
        self.do("mousemove", *start)
        self.do("mousedown", button)
        for part in (0.25, 0.5, 0.75, 1.0):
            self.do("mousemove", *(round(a + part * (b - a)) for a, b in zip(start, stop, strict=True)))
        self.do("mouseup", button)

    def replace_text(self, place: tuple[int, int], text: str) -> None:
        """Click into a field, select all, type."""
        self.do("mousemove", *place)
        self.do("click", 1)
        time.sleep(0.3)
        self.do("keydown", "ctrl")
        self.do("key", "a")
        self.do("keyup", "ctrl")
        self.do("type", "--delay", 30, text)

    def events(self) -> list[dict[str, Any]]:
        """The whole log."""
        if not self._log.exists():
            return []
        return [json.loads(line) for line in self._log.read_text().splitlines(keepends=True) if line.endswith("\n")]

    def wait(self, event: str, wanted: Callable[[dict[str, Any]], object] = lambda facts: True) -> dict[str, Any]:
        """The next line of the log that is wanted, from where the last wait ended."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            known = self.events()
            for i in range(self._read, len(known)):
                if known[i]["event"] == event and wanted(known[i]):
                    self._read = i + 1
                    return known[i]
            assert self.process.poll() is None, f"it ended while {event!r} was waited for: {known[self._read :]}"
            time.sleep(0.05)
        raise AssertionError(f"no {event!r} came: {self.events()[self._read :]}")

    def begin_again(self, log: Path) -> None:
        """Read another log from its beginning."""
        self._log, self._read = log, 0

    def screen(self) -> npt.NDArray[np.uint8]:
        """What the screen shows, once it has stopped changing."""
        end, before = time.monotonic() + PATIENCE, self._grabbed()
        while time.monotonic() < end:
            time.sleep(0.2)
            now = self._grabbed()
            # A blinking cursor is no change; it is in the sidebar.
            if np.array_equal(before[:, now.shape[1] // 3 :], now[:, now.shape[1] // 3 :]):
                return now
            before = now
        raise AssertionError("the screen does not come to rest")

    def _grabbed(self) -> npt.NDArray[np.uint8]:
        from PIL import ImageGrab

        return np.asarray(ImageGrab.grab(xdisplay=self._environment["DISPLAY"]).convert("RGB"))

    def close(self, window: int) -> None:
        """Click on the window's cross: what a window manager sends then."""
        _ask_to_close(self._environment["DISPLAY"], window)


class _Message(ctypes.Structure):
    """Xlib's XClientMessageEvent."""

    _fields_ = (
        ("type", ctypes.c_int),
        ("serial", ctypes.c_ulong),
        ("send_event", ctypes.c_int),
        ("display", ctypes.c_void_p),
        ("window", ctypes.c_ulong),
        ("message_type", ctypes.c_ulong),
        ("format", ctypes.c_int),
        ("data", ctypes.c_long * 5),
        ("padding", ctypes.c_long * 24),
    )


def _ask_to_close(display: str, window: int) -> None:
    """Send WM_DELETE_WINDOW."""
    x11 = ctypes.CDLL(ctypes.util.find_library("X11") or "libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XInternAtom.restype = ctypes.c_ulong
    connection = ctypes.c_void_p(x11.XOpenDisplay(display.encode()))
    client_message = 33
    message = _Message(type=client_message, window=window, format=32)
    message.message_type = x11.XInternAtom(connection, b"WM_PROTOCOLS", 0)
    message.data[0] = x11.XInternAtom(connection, b"WM_DELETE_WINDOW", 0)
    x11.XSendEvent(connection, ctypes.c_ulong(window), 0, 0, ctypes.byref(message))
    x11.XFlush(connection)
    x11.XCloseDisplay(connection)
