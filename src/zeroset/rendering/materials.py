"""Materials inside kernels: uniforms where there is one part, a row of a table for each where there are several."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from zeroset.kernel import F32, KernelBuilder, Value, load
from zeroset.rendering.buffers import MATERIALS
from zeroset.runtime import Device
from zeroset.scene.light import Material

NUMBERS = ("ambient", "diffuse", "specular", "shininess", "opacity", "reflectance", "ior", "last_solid")
COLUMNS = (*(f"{side}_{c}" for side in ("front", "back") for c in "rgb"), *NUMBERS)
"""The numbers of a material by name, in the order in which the table has them."""


def material_numbers(material: Material) -> dict[str, float]:
    """The numbers of a material by name."""
    colors = {
        f"{side}_{c}": v for side in ("front", "back") for c, v in zip("rgb", getattr(material, side), strict=True)
    }
    return colors | {name: float(getattr(material, name)) for name in NUMBERS}


def material_table(materials: Sequence[Material]) -> npt.NDArray[np.float32]:
    """All materials' numbers, row after row."""
    rows = [[material_numbers(material)[name] for name in COLUMNS] for material in materials]
    return np.asarray(rows, np.float32).reshape(-1)


def opaque_parts(materials: Sequence[Material]) -> int:
    """The parts that nothing is seen through, as bits."""
    return sum(1 << part for part, material in enumerate(materials) if material.opacity >= 1.0)


class Table:
    """A buffer with numbers that seldom change, on one device."""

    def __init__(self, device: Device) -> None:
        self._device = device
        self._buffer: Any = None
        self._written: npt.NDArray[np.float32] | None = None

    def holding(self, values: npt.NDArray[np.float32]) -> Any:
        """The buffer, with these values in it."""
        if self._written is None or len(self._written) != len(values):
            self._buffer, self._written = self._device.allocate(F32, len(values)), None
        if self._written is None or not np.array_equal(self._written, values):
            self._device.write(self._buffer, values)
            self._written = values
        return self._buffer


def material_at(builder: KernelBuilder, part: Value | None) -> Callable[[str], Value]:
    """Gives a part's numbers by name; ``part``: None where there is only one."""
    if part is None:
        return lambda name: builder.uniform(name, F32)
    table, row = builder.buffer(MATERIALS, F32), part * len(COLUMNS)
    return lambda name: load(table, row + COLUMNS.index(name))
