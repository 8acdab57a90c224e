"""What each call of a shader is given: the head that says how many lanes run, and the uniforms.

A call lies in a slot of a buffer that the shader sees as its uniforms and, where an earlier pass decides how many lanes
run, the dispatch reads its size from. In that case a kernel of our own writes the head (``count_kernel``), as it is
written for any other device.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping

from zeroset.errors import DeviceError
from zeroset.kernel import U32, Kernel, KernelBuilder, constant, load, store
from zeroset.runtime.device import Signature

HEAD = struct.Struct("<4I")
"""Workgroups in x, y and z, and lanes: as ``wgsl`` declares them."""
ROW = 1 << 15
"""Workgroups in x before there is a second row of them; WebGPU allows 65,535."""
_CODES = {"f32": "f", "f64": "d", "i32": "i", "u32": "I", "bool": "I"}


def head(lanes: int, workgroup: int) -> bytes:
    """The head for a number of lanes."""
    groups = -(-lanes // workgroup)
    return HEAD.pack(min(groups, ROW), -(-groups // ROW), 1, lanes)


def grid(lanes: int, workgroup: int) -> tuple[int, int, int]:
    """Workgroups in x, y and z."""
    return HEAD.unpack(head(lanes, workgroup))[:3]


class Layout:
    """Where WGSL puts the uniforms of a signature behind the head."""

    def __init__(self, signature: Signature) -> None:
        self._signature = signature
        code, offset = "<", HEAD.size
        for uniform in signature.uniforms:
            size = uniform.type.size or 4
            padding = -offset % size
            code += f"{padding}x" if padding else ""
            code += _CODES[uniform.type.name]
            offset += padding + size
        self._struct = struct.Struct(code)
        self.size = -(-offset // 16) * 16

    def pack(self, uniforms: Mapping[str, float]) -> bytes:
        """The uniforms' bytes; raises ``DeviceError`` for one that is missing or has no such value."""
        wanted = self._signature.uniforms
        try:
            return self._struct.pack(*[uniforms[u.name] for u in wanted])
        except (KeyError, struct.error, OverflowError, TypeError, ValueError) as error:
            for u in wanted:
                if u.name not in uniforms:
                    text = f"kernel {self._signature.name} needs the uniform {u.name} as {u.type}, not nothing"
                    raise DeviceError(text) from error
            values = ", ".join(f"{u.name}: {u.type} = {uniforms[u.name]!r}" for u in wanted)
            raise DeviceError(f"kernel {self._signature.name} cannot take the uniforms {values}") from error


def count_kernel(workgroup: int) -> Kernel:
    """One lane that writes the head of a call, from a number that an earlier pass counted.

    Uniforms: ``index`` (of the number in ``counters``), ``times``, ``slot`` (the call's first word in ``calls``).
    """
    shift = workgroup.bit_length() - 1
    with KernelBuilder("count") as k:
        counted = load(k.buffer("counters", U32), k.uniform("index", U32))
        lanes = counted * k.uniform("times", U32)
        groups = (lanes + (workgroup - 1)) >> shift
        values = (groups.minimum(ROW), (groups + (ROW - 1)) >> (ROW.bit_length() - 1), constant(1, U32), lanes)
        for i, value in enumerate(values):
            store(k.buffer("calls", U32, writable=True), k.uniform("slot", U32) + i, value)
    return k.kernel
