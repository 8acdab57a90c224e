"""What the numbers of a surface are called in kernels: uniforms of scalar parameters, buffers of array parameters."""

from __future__ import annotations

from zeroset.kernel.types import Type

OFFSET = "offset of f"
"""Parameter that no formula can name: what the offset option takes off f."""


OPAQUE = "opaque parts"
"""Uniform of a shape with several bodies: the parts, as bits, that hide what lies in the same place."""


def isovalue_name(index: int) -> str:
    """Parameter that no formula can name: one of a surface's isovalues."""
    return f"isovalue {index}"


def parameter_names(name: str, type_: Type) -> tuple[str, str]:
    """The uniforms that hold a parameter, as a kernel of one scalar type reads it: value and storage error."""
    return f"p_{name}_{type_}", f"p_{name}_{type_}_error"


def array_names(name: str, type_: Type) -> tuple[str, str]:
    """The buffers that hold an array parameter: values and storage errors."""
    return f"a_{name}_{type_}", f"a_{name}_{type_}_error"


def length_name(name: str) -> str:
    """The uniform that holds how many elements an array parameter has."""
    return f"a_{name}_length"
