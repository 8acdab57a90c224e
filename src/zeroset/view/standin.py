"""The CPU draws until the GPU is ready: compilers of graphics drivers take seconds over a formula, ours a fraction.

A formula that the GPU has not drawn yet is drawn by the CPU, and compiled for the GPU aside. When that is done the GPU
takes over; where it cannot be done, the CPU goes on, and the user is told why.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from zeroset.errors import DeviceError
from zeroset.rendering.drawn import as_drawn
from zeroset.rendering.frame import settle
from zeroset.rendering.shading import Lighting, Smooth
from zeroset.runtime import get_device
from zeroset.view.painting import Shot, paint
from zeroset.view.worker import Failed, Newest, Superseded

SMALL = 32
"""Side of the picture that is drawn to compile everything."""
Structure = tuple[str, str, Lighting, str, str]


def structure(shot: Shot) -> Structure:
    """What the kernels of a picture depend on."""
    # A picture that moves has no smooth edges, but both are compiled together.
    light = Lighting.of(shot.scene, Smooth(shot.antialias))
    colored = shot.scene.colored
    by = "" if colored is None else f"{colored.coloring.by} {colored.shown}"
    return as_drawn(shot.scene.surface).shape.digest, shot.method.structure(), light, shot.device, by


class StandIn:
    """Says which device draws.

    Args:
        wake: called when it has become another one.
        warm: draws a picture, which compiles all that it needs.

    Attributes:
        trouble: why the GPU does not draw the present picture though it was asked for, or "".
    """

    def __init__(self, wake: Callable[[], object], warm: Callable[[Shot, Superseded], object] | None = None) -> None:
        self.trouble = ""
        self._ready: set[Structure] = set()
        self._failed: dict[Structure, str] = {}
        self._asked: Structure | None = None
        self._worker: Newest[Shot, Shot] = Newest("warmer", _warmer(warm or compiled), wake)

    def placed(self, shot: Shot, compile: bool = True) -> Shot:
        """The picture on the device that can draw it at once.

        Args:
            shot: a picture on the device that was asked for.
            compile: whether to begin to compile it for that device.
        """
        self._take()
        self.trouble = ""
        if not slow_to_compile(shot.device):
            return shot
        key = structure(shot)
        if key in self._ready:
            return shot
        self.trouble = self._failed.get(key, "")
        if compile and not self.trouble and key != self._asked:
            self._asked = key
            self._worker.ask(shot)
        return replace(shot, device="cpu")

    def close(self, timeout: float) -> bool:
        """End the thread; gives whether it has ended."""
        return self._worker.close(timeout)

    def _take(self) -> None:
        for answer in self._worker.answers():
            if isinstance(answer, Failed):
                self._failed[structure(answer.job)] = f"drawn by the CPU, as the GPU cannot: {answer.text}"
            else:
                self._ready.add(structure(answer))


def slow_to_compile(device: str) -> bool:
    """Whether a device's compiler keeps people waiting and the CPU can stand in for it."""
    try:
        return get_device(device).name == "gpu" and get_device("cpu").name == "cpu"
    except DeviceError:
        return False


def compiled(shot: Shot, superseded: Superseded) -> None:
    """Draw a small picture, and wait for the kernels that it did not need as well."""
    for moving in (True, False):
        paint(replace(shot, size=(SMALL, SMALL), moving=moving), lambda: False)
    settle()


def _warmer(warm: Callable[[Shot, Superseded], object]) -> Callable[[Shot, Superseded], Shot]:
    def work(shot: Shot, superseded: Superseded) -> Shot:
        warm(shot, superseded)
        return shot

    return work
