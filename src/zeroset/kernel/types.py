"""The five scalar types of the kernel language, and buffers of them.

Every value of a kernel has one of these types; a buffer is a flat array of one of them. Names are WGSL's, and the
NumPy dtype beside each name is what the interpreter, the runtimes and their callers use for it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np


@dataclass(frozen=True, slots=True, eq=False)
class Type:
    """A scalar type of the kernel language; there are the five below and no others, so identity is equality.

    Attributes:
        name: ``f32``, ``f64``, ``i32``, ``u32`` or ``bool``.
        kind: ``f`` (floating point), ``i`` (signed), ``u`` (unsigned) or ``b`` (truth value).
        size: bytes one element takes in a buffer; 0 for ``bool``, which no buffer holds.
    """

    name: str
    kind: str
    size: int

    @property
    def dtype(self) -> np.dtype[Any]:
        """The NumPy dtype of this type."""
        return np.dtype({"f32": "f4", "f64": "f8", "i32": "i4", "u32": "u4", "bool": "?"}[self.name])

    def __str__(self) -> str:
        return self.name


F32 = Type("f32", "f", 4)
F64 = Type("f64", "f", 8)
I32 = Type("i32", "i", 4)
U32 = Type("u32", "u", 4)
BOOL = Type("bool", "b", 0)
TYPES: dict[str, Type] = {t.name: t for t in (F32, F64, I32, U32, BOOL)}


class Uniform(NamedTuple):
    """A scalar that is the same for every lane of a dispatch."""

    name: str
    type: Type


class Buffer(NamedTuple):
    """A flat array that lanes load from and store to.

    Attributes:
        name: how the runtime binds it.
        type: element type, not ``bool``.
        writable: whether stores and atomics are allowed.
        constant: whether it is short as a rule and all lanes mostly read the same element: GPUs keep such data apart.
    """

    name: str
    type: Type
    writable: bool
    constant: bool = False
