"""The whole command, formula typed to picture written, as its user waits for it: a new process each time.

Cold means that no kernel is in the disk cache. Python's bytecode is there in every run, as pip leaves it where it
installs zeroset: a process that must compile the sources first takes a good deal longer.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from zeroset.errors import ZerosetError
from zeroset.surfaces import BallBounds, GalleryEntry, entry

START = "import sys; from zeroset.cli import main; sys.exit(main())"
"""What the installed command does."""


@dataclass(frozen=True, slots=True)
class CommandCost:
    """One formula through the whole command.

    Attributes:
        name: of the surface whose formula it is.
        size: pixels along a side.
        runs: processes of each kind.
        cold: seconds with an empty cache, the median.
        warm: seconds with a cache that knows the formula, the median.
        python: seconds of a Python process that does nothing, the median; part of both others.
    """

    name: str
    size: int
    runs: int
    cold: float
    warm: float
    python: float


def command_line(item: GalleryEntry, size: int, output: Path, options: Sequence[str] = ()) -> list[str]:
    """The command that draws an entry's formula as a user would type it."""
    line = [sys.executable, "-c", START, "render", "-o", str(output), "-s", str(size), *options]
    for name, value in item.params.items():
        line += ["-p", f"{name}={value!r}"]
    for name, values in item.arrays.items():
        line += ["-p", f"{name}={','.join(map(repr, values))}"]
    bounds = item.bounds
    if isinstance(bounds, BallBounds):
        # The command takes a ball around the origin; one elsewhere is fitted, as a formula without bounds is.
        line += ["-b", repr(bounds.radius)] if not any(bounds.center) else []
    else:
        line += ["-b", ",".join(map(repr, (*bounds.min, *bounds.max)))]
    return [*line, "--", item.formula]


def measure_command(
    name: str, size: int, runs: int, options: Sequence[str], threads: int | None, progress: Callable[[float], None]
) -> CommandCost:
    """Run the command again and again, cold and warm by turns.

    Args:
        name: a gallery surface.
        size: pixels along a side.
        runs: processes of each kind.
        options: more of the command's options.
        threads: ``ZEROSET_THREADS`` for the command; None leaves it.
        progress: told the share that is done.

    Raises:
        ZerosetError: the command failed.
    """
    item = entry(name)
    surroundings = environment()
    if threads is not None:
        surroundings["ZEROSET_THREADS"] = str(threads)
    python: list[float] = []
    cold: list[float] = []
    warm: list[float] = []
    with tempfile.TemporaryDirectory(prefix="zeroset-bench-") as folder:
        line = command_line(item, size, Path(folder) / "picture.png", options)
        # Bytecode in a place of its own, so that none is written beside sources whose owner wants none there.
        surroundings.pop("PYTHONDONTWRITEBYTECODE", None)
        surroundings |= {
            "PYTHONPYCACHEPREFIX": str(Path(folder) / "bytecode"),
            "ZEROSET_CACHE_DIR": str(Path(folder) / "first"),
        }
        _seconds(line, surroundings)
        for i in range(runs):
            surroundings["ZEROSET_CACHE_DIR"] = str(Path(folder) / f"cache{i}")
            for j, (kind, command) in enumerate(((python, [sys.executable, "-c", ""]), (cold, line), (warm, line))):
                progress((i + j / 3) / runs)
                kind.append(_seconds(command, surroundings))
    return CommandCost(name, size, runs, *map(statistics.median, (cold, warm, python)))


def environment() -> dict[str, str]:
    """This process's environment for one that is to run the same zeroset, with its cache switched on."""
    inherited = {name: value for name, value in os.environ.items() if name != "ZEROSET_CACHE"}
    # A package that runs from its sources, uninstalled, must be found by the new process too.
    return inherited | {"PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}


def _seconds(command: Sequence[str], surroundings: dict[str, str]) -> float:
    begin = time.perf_counter()
    done = subprocess.run(command, env=surroundings, capture_output=True, text=True, check=False)
    taken = time.perf_counter() - begin
    if done.returncode:
        raise ZerosetError(f"the command that is timed failed: {done.stderr.strip() or done.returncode}")
    return taken
