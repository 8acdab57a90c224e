"""Where figures were made, in words that mean something on another machine."""

from __future__ import annotations

import datetime
import os
import platform
from dataclasses import dataclass

import zeroset
from zeroset.runtime import Device


@dataclass(frozen=True, slots=True)
class Machine:
    """What decides figures besides the program.

    Attributes:
        cpu: LLVM's name of the processor's family, or the architecture.
        lanes: of 32 bits that run in lockstep; 0 where the device does not say.
        cores: that this process may use.
        threads: that a frame is spread over; 0 where the device does not say.
        gpu: name and driver of the GPU that was measured; empty where it was none.
        software: whether that is no GPU but a driver that calculates on the CPU.
        system: operating system.
        versions: of zeroset and Python.
        date: when, as YYYY-MM-DD.
    """

    cpu: str
    lanes: int
    cores: int
    threads: int
    system: str
    versions: str
    date: str
    gpu: str = ""
    software: bool = False

    def __str__(self) -> str:
        gpu = f"{self.gpu}{', NO GPU: software on the CPU' if self.software else ''}; " if self.gpu else ""
        lanes = f", {self.lanes} lanes" if self.lanes else ""
        threads = f", {self.threads} thread{'s' * (self.threads > 1)}" if self.threads else ""
        cores = f"{self.cores} core{'s' * (self.cores > 1)}"
        return f"{gpu}{self.cpu}{lanes}, {cores}{threads}; {self.system}; {self.versions}; {self.date}"


def this_machine(device: Device) -> Machine:
    """This machine, as a device sees it."""
    found = getattr(device, "found", None)
    # A GPU's target says nothing of the processor.
    target = getattr(device, "target", None) if found is None else None
    affinity = getattr(os, "sched_getaffinity", None)
    return Machine(
        cpu=f"{platform.machine()} {target.cpu} ({target.name})" if target is not None else platform.machine(),
        lanes=getattr(target, "width", 0),
        cores=len(affinity(0)) if affinity is not None else os.cpu_count() or 1,
        threads=getattr(device, "threads", 0),
        system=platform.system(),
        versions=f"zeroset {zeroset.__version__}, Python {platform.python_version()}",
        date=datetime.date.today().isoformat(),
        gpu=found.title if found is not None else "",
        software=found is not None and found.software,
    )
