"""Everything that draws a case and can be timed: peers, zeroset's command, zeroset's frame in steady state."""

from __future__ import annotations

import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pov
import surf
from scenes import Case

import zeroset as zs
from zeroset.bench.cold import START, environment
from zeroset.scene.file import save

FRAMES_FOR = 0.5
"""Seconds of frames in each round."""


@dataclass
class Program:
    """One way to draw one case.

    Attributes:
        name: what it is called in the table.
        run: draws once; gives the seconds that count, several for several frames.
        picture: where the last picture is; None where none is kept.
        note: what the reader should know.
        seconds: of all runs so far.
        inner: seconds of rendering alone, where the program says so.
        failure: why there is no picture, or an empty string.
        endless: whether it was stopped; ``seconds`` then holds what it was given.
    """

    name: str
    run: Callable[[Program], list[float]]
    picture: Path | None = None
    note: str = ""
    seconds: list[float] = field(default_factory=list)
    inner: list[float] = field(default_factory=list)
    failure: str = ""
    endless: bool = False

    def take_turn(self) -> None:
        """Run once and note the time, or the failure; what failed once is not tried again."""
        if self.failure:
            return
        try:
            self.seconds += self.run(self)
        except subprocess.TimeoutExpired as error:
            self.seconds, self.endless = [error.timeout], True
            self.failure = "stopped before it had a picture"
        except (OSError, subprocess.SubprocessError, ValueError) as error:
            self.failure = str(error).splitlines()[0][:200]

    @property
    def median(self) -> float:
        """Seconds; nan where it never came to an end."""
        return statistics.median(self.seconds or [math.nan])


def programs(case: Case, size: int, folder: Path, longest: float) -> list[Program]:
    """All programs that are installed and can draw a case; zeroset's own first.

    Args:
        case: what to draw.
        size: pixels along a side.
        folder: where scenes and pictures are left.
        longest: seconds after which a peer is stopped.
    """
    scene_file = folder / f"{case.name}.toml"
    save(case.scene, scene_file)
    own = [_frame(case, size), _command(scene_file, size, warm=True), _command(scene_file, size, warm=False)]
    return [*own, *_surf(case, size, folder, longest), *_povray(case, size, folder, longest)]


def missing() -> list[str]:
    """Peers that are not installed."""
    return [name for name in ("surf-alggeo", "povray") if shutil.which(name) is None]


def _frame(case: Case, size: int) -> Program:
    def run(program: Program) -> list[float]:
        zs.render(case.scene, size)
        taken: list[float] = []
        while len(taken) < 3 or sum(taken) < FRAMES_FOR:
            begin = time.perf_counter()
            zs.render(case.scene, size)
            taken.append(time.perf_counter() - begin)
        return taken

    return Program("zeroset, a frame", run)


def _command(scene: Path, size: int, warm: bool) -> Program:
    cache = tempfile.TemporaryDirectory(prefix="zeroset-peers-")
    picture = scene.with_name(f"{scene.stem}-zeroset.png")
    line = [sys.executable, "-c", START, "render", str(scene), "-o", str(picture), "-s", str(size)]

    def run(program: Program) -> list[float]:
        with tempfile.TemporaryDirectory(dir=cache.name) as fresh:
            chosen = os.path.join(cache.name, "warm") if warm else fresh
            if warm and not program.seconds:
                _process(line, ZEROSET_CACHE_DIR=chosen)
            return [_process(line, ZEROSET_CACHE_DIR=chosen)[0]]

    return Program(f"zeroset, whole process, {'warm' if warm else 'cold'} cache", run, picture)


def _surf(case: Case, size: int, folder: Path, longest: float) -> list[Program]:
    picture = folder / f"{case.name}-surf.ppm"
    text = surf.script(case, size, picture)
    if text is None or shutil.which("surf-alggeo") is None:
        return []
    file = folder / f"{case.name}.pic"
    file.write_text(text)
    drawing = _drawing(["surf-alggeo", "-q", str(file)], picture, longest)
    return [Program("surf, whole process", drawing, picture)]


def _povray(case: Case, size: int, folder: Path, longest: float) -> list[Program]:
    kinds = {"polynomial": pov.polynomial_scene(case), "isosurface": pov.isosurface_scene(case)}
    found = []
    for kind, text in kinds.items():
        if text is None or shutil.which("povray") is None:
            continue
        file = folder / f"{case.name}-{kind}.pov"
        file.write_text(text)
        picture = folder / f"{case.name}-pov-{kind}.png"
        line = ["povray", f"+I{file}", f"+O{picture}", f"+W{size}", f"+H{size}", "+FN", "-D", "-A", "+WT1"]
        note = f"max_gradient {case.max_gradient:g}" if kind == "isosurface" else ""
        found.append(Program(f"POV-Ray {kind}, whole process", _drawing(line, picture, longest), picture, note))
    return found


def _drawing(line: list[str], picture: Path, longest: float) -> Callable[[Program], list[float]]:
    def run(program: Program) -> list[float]:
        picture.unlink(missing_ok=True)
        seconds, said = _process(line, longest)
        if not picture.exists():
            raise ValueError(f"no picture: {said.strip()[-200:]}")
        if found := re.search(r"Trace Time:.*\(([\d.]+) seconds\)", said):
            program.inner.append(float(found[1]))
        return [seconds]

    return run


def trial(script: Path) -> Program:
    """The design's first trial, which prints how long its own frame of the Barth sextic takes; its view is its own."""

    def run(program: Program) -> list[float]:
        _, said = _process([sys.executable, str(script)])
        found = re.search(r"barth-sextic N=1024.*total ([\d.]+) ms", said)
        if found is None:
            raise ValueError("the trial did not print its time")
        return [float(found[1]) / 1e3]

    return Program("the design's trial, a frame", run, note="best of 10, its own view, 1024²")


def _process(line: list[str], longest: float | None = None, **more: str) -> tuple[float, str]:
    """Seconds of a process, and all that it printed."""
    begin = time.perf_counter()
    done = subprocess.run(
        line,
        env=environment() | more,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=longest,
        check=False,
    )
    seconds = time.perf_counter() - begin
    said = done.stdout.decode(errors="replace")
    if done.returncode:
        raise ValueError(f"{line[0]} failed: {said.strip()[-200:]}")
    return seconds, said


def silhouette(picture: Path) -> npt.NDArray[np.bool_]:
    """Which pixels of a picture are not its white background."""
    from PIL import Image

    with Image.open(picture) as image:
        drawn: npt.NDArray[np.bool_] = np.any(np.asarray(image.convert("RGB")) != 255, axis=-1)
    return drawn
