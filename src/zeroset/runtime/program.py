"""A kernel as machine code, and how its lanes are spread over the cores.

Each thread takes chunks of lanes off a shared counter inside the compiled code, and comes back to Python every few
milliseconds only to see whether the user wants to stop. Arguments are packed into a block that the program keeps, and
the addresses of buffers are looked up only when other buffers come: a run allocates nothing. A dispatch that is over
sooner than threads wake up runs on the calling thread.
"""

from __future__ import annotations

import ctypes
import struct
import threading
import time
from collections.abc import Mapping
from typing import Any

from zeroset.codegen.slots import slot_layout
from zeroset.errors import DeviceError
from zeroset.runtime.device import Array, Counted, Signature, check_array, check_count, lanes_of
from zeroset.runtime.pool import Pool

_LOOK_UP = 0.005
"""Seconds of work between two looks at whether the user wants to stop."""
_WORTH_WAKING = 1e-4
"""Seconds of work below which one thread does it alone."""
_CHUNKS = 64
"""Chunks that each thread should get, so that the last ones to finish do not wait long for each other."""
_LARGEST_CHUNK = 128
"""Packets."""
_FIRST_STRIDE = 4096
"""Most packets before the first look of a dispatch: the last one may have been lighter by far."""

_Drain = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, *[ctypes.c_int32] * 3)


class CpuProgram:
    """A kernel as machine code; see the module's text.

    Args:
        signature: what ``run`` is given.
        width: lanes of a packet.
        address: where the compiled ``drain`` is.
        keep: what holds the code in memory.
        pool: the threads to run on.
    """

    def __init__(self, signature: Signature, width: int, address: int, keep: object, pool: Pool) -> None:
        self.signature = signature
        self._drain = _Drain(address)
        self._keep = keep
        self._width = width
        self._pool = pool
        self._layout = struct.Struct(slot_layout(signature.uniforms, len(signature.buffers)))
        self._slots = ctypes.create_string_buffer(self._layout.size + 8)
        self._next = ctypes.c_int64()
        self._busy = threading.Lock()
        self._bound: list[Array] | None = None
        self._addresses: list[int] = []
        self._seconds_per_packet = 0.0
        self._stride = 1

    def run(self, count: int | Counted, uniforms: Mapping[str, float], buffers: Mapping[str, Any]) -> None:
        """Run ``count`` lanes; see ``Program.run``."""
        lanes = check_count(self.signature, lanes_of(count))
        with self._busy:
            self._bind(buffers)
            try:
                values = [uniforms[u.name] for u in self.signature.uniforms]
                self._layout.pack_into(self._slots, 0, *self._addresses, *values)
            except (KeyError, struct.error, OverflowError, TypeError, ValueError) as error:
                raise self._bad_uniform(uniforms) from error
            if lanes:
                self._dispatch(lanes)

    def _bind(self, buffers: Mapping[str, Any]) -> None:
        wanted = self.signature.buffers
        given = [buffers.get(b.name) for b in wanted]
        if self._bound is not None and all(a is b for a, b in zip(given, self._bound, strict=True)):
            return
        arrays = [check_array(self.signature, b, a) for b, a in zip(wanted, given, strict=True)]
        self._addresses = [a.ctypes.data for a in arrays]
        self._bound = arrays

    def _bad_uniform(self, uniforms: Mapping[str, float]) -> DeviceError:
        for uniform in self.signature.uniforms:
            wanted = f"kernel {self.signature.name} needs the uniform {uniform.name} as {uniform.type}"
            if uniform.name not in uniforms:
                return DeviceError(f"{wanted}, not nothing")
            try:
                struct.pack(slot_layout((uniform,), 0), uniforms[uniform.name])
            except (struct.error, OverflowError, TypeError, ValueError):
                return DeviceError(f"{wanted}, not {uniforms[uniform.name]!r}")
        return DeviceError(f"kernel {self.signature.name} was given uniforms that it cannot take")

    def _dispatch(self, count: int) -> None:
        packets = -(-count // self._width)
        threads = min(self._pool.threads, packets)
        if self._seconds_per_packet * packets < _WORTH_WAKING and self._seconds_per_packet:
            threads = 1
        chunk = min(max(packets // (threads * _CHUNKS), 1), _LARGEST_CHUNK)
        self._next.value = 0
        self._stride = min(self._stride, _FIRST_STRIDE)
        drain, slots, following = self._drain, self._slots, ctypes.byref(self._next)

        def work() -> bool:
            budget = -(-self._stride // chunk)
            begin = time.perf_counter()
            left = drain(slots, following, count, chunk * self._width, budget)
            self._pace(time.perf_counter() - begin)
            return bool(left)

        begin = time.perf_counter()
        self._pool.run(work, threads)
        self._seconds_per_packet = (time.perf_counter() - begin) * threads / packets

    def _pace(self, seconds: float) -> None:
        """Adapt how many packets are run between two looks; threads may race here, and no harm comes of it."""
        if seconds < _LOOK_UP / 2:
            self._stride = min(self._stride * 2, 1 << 24)
        elif seconds > _LOOK_UP * 2:
            self._stride = max(self._stride // 2, 1)
