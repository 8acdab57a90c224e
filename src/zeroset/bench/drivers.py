"""Graphics drivers keep shaders on disk themselves: time over such a cache says nothing of a formula seen first."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

SWITCHES = {
    "MESA_SHADER_CACHE_DISABLE": "true",
    "__GL_SHADER_DISK_CACHE": "0",
}
"""What switches the caches of Mesa's and NVIDIA's drivers off, from when they are loaded; others have no switch."""


@contextmanager
def no_driver_caches() -> Iterator[None]:
    """Have drivers that are loaded meanwhile keep no shaders on disk.

    Example:
        >>> with no_driver_caches():
        ...     os.environ["MESA_SHADER_CACHE_DISABLE"]
        'true'
    """
    before = {name: os.environ.get(name) for name in SWITCHES}
    os.environ.update(SWITCHES)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
