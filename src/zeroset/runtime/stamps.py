"""What compiled code depends on besides its kernel: this CPU, this LLVM, and zeroset's own sources.

Each is a text that changes when the thing does, found in a millisecond or less, and without loading LLVM: a warm
start must not pay for what it does not use.
"""

from __future__ import annotations

import os
from functools import lru_cache
from importlib.util import find_spec

from zeroset.hashes import hexdigest

_CPU_LINES = ("vendor_id", "cpu family", "model", "stepping", "flags", "Features", "CPU ")


@lru_cache(maxsize=1)
def source_stamp() -> str:
    """A hash that changes with every file of the package, by name, size and time of change.

    A checkout under development thus never runs code of an older state; it takes about a millisecond, which reading a
    version number through the packaging metadata would cost too.
    """
    import zeroset.errors

    root = os.path.dirname(zeroset.errors.__file__)
    found: list[str] = []
    folders = [root]
    while folders:
        with os.scandir(folders.pop()) as entries:
            for entry in entries:
                if entry.name.endswith(".py"):
                    stat = entry.stat()
                    found.append(f"{entry.path} {stat.st_size} {stat.st_mtime_ns}")
                elif entry.is_dir() and entry.name != "__pycache__":
                    folders.append(entry.path)
    return hexdigest("\n".join(sorted(found)))


def cpu_stamp() -> str:
    """What tells this CPU from others where the system says it in a file, else an empty string."""
    try:
        with open("/proc/cpuinfo") as file:
            lines = file.read(1 << 14).split("\n\n")[0].splitlines()
    except OSError:
        return ""
    return os.uname().machine + "\n".join(line for line in lines if line.startswith(_CPU_LINES))


@lru_cache(maxsize=1)
def llvm_stamp() -> str:
    """What tells this LLVM from others; empty where there is none."""
    found = find_spec("llvmlite")
    if found is None or found.origin is None:
        return ""
    stat = os.stat(found.origin)
    return f"{found.origin} {stat.st_size} {stat.st_mtime_ns}"
