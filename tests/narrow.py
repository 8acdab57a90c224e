"""A CPU that does not calculate in f64, as many GPUs do not."""

from __future__ import annotations

from typing import Any

from zeroset.runtime import get_device


class Narrow:
    """The CPU, without f64."""

    def __getattr__(self, name: str) -> Any:
        return getattr(get_device("cpu"), name)

    def supports(self, type_: Any) -> bool:
        return bool(type_.name != "f64")


def narrow() -> Any:
    """Such a device."""
    return Narrow()
