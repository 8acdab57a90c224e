"""Whether there is a GPU, or Mesa's driver that stands in for one: tests that need it are skipped aloud without."""

from __future__ import annotations

from functools import lru_cache

import pytest

from zeroset.errors import DeviceError
from zeroset.runtime import get_device


@lru_cache(maxsize=1)
def no_gpu() -> str:
    """Why there is no GPU; empty where there is one."""
    try:
        get_device("gpu")
    except DeviceError as error:
        return f"no GPU: {error.message}"
    return ""


needs_gpu = pytest.mark.skipif(bool(no_gpu()), reason=no_gpu() or "there is one")
"""Marks a test that runs on a GPU."""
