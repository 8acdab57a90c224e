"""A GPU behind the ``Device`` contract."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import Any

from zeroset.codegen.gpu_target import GpuTarget
from zeroset.codegen.wgsl import to_wgsl
from zeroset.kernel.build import Kernel
from zeroset.kernel.types import F64, U32, Type
from zeroset.runtime.cache import Cache, default_cache
from zeroset.runtime.compiled import Compiled
from zeroset.runtime.device import Array, Counted, Recipe, Signature
from zeroset.runtime.gpu.adapter import Found, choose, open_device
from zeroset.runtime.gpu.calls import HEAD, count_kernel, grid, head
from zeroset.runtime.gpu.faults import Faults
from zeroset.runtime.gpu.memory import GpuBuffer, Memory
from zeroset.runtime.gpu.probe import NEAR, Arithmetic, check, rounds_doubles, run_probe
from zeroset.runtime.gpu.program import GpuProgram, Pipeline
from zeroset.runtime.gpu.stream import SLOT, SLOTS, Stream
from zeroset.runtime.programs import Programs
from zeroset.runtime.stamps import source_stamp


class GpuDevice:
    """A GPU, or a driver that stands in for one.

    Args:
        found: the adapter; the best one by default, or the one that ``ZEROSET_GPU`` names.
        cache: where shaders are kept; the user's cache folder by default.

    Raises:
        DeviceError: there is no GPU, or it cannot be opened; the text says what is missing.
    """

    name = "gpu"

    def __init__(self, found: Found | None = None, cache: Cache | None = None) -> None:
        self.found = choose() if found is None else found
        self.handle = open_device(self.found)
        """wgpu's device, for those who draw with it on the screen."""
        self.cache = default_cache() if cache is None else cache
        self._faults = Faults(self.found.name)
        self.memory = Memory(self.handle, self._faults)
        self.stream = Stream(self.handle, self._faults, "timestamps" in self.found.features)
        self._calls = GpuBuffer(U32, SLOT * SLOTS // 4, self.stream.counted.handle)
        self._busy = threading.RLock()
        has = self.found.features
        self._use(
            GpuTarget("subgroups" in has, "doubles" in has, exact_division=True, exact_root=True, exact_rounding=True)
        )
        self.arithmetic = self._measure()

    def _use(self, target: GpuTarget) -> None:
        """Compile for a target from now on."""
        self.target = target
        self._programs = self._programs_for(target)
        # Constants that are too many for the memory of constants are read like anything else.
        self._longer = self._programs_for(replace(target, constants=0))
        self._counter: GpuProgram | None = None

    def _programs_for(self, target: GpuTarget) -> Programs[GpuProgram]:
        stamp = f"{target.identity}|{source_stamp()}"
        return Programs(self.cache, stamp, partial(self._write, target), self._translate, partial(self._place, target))

    def _measure(self) -> Arithmetic:
        """See how the GPU calculates, and correct what is too coarse."""
        if self.target.doubles and not rounds_doubles(self):
            self._use(replace(self.target, exact_rounding=False))
            if not rounds_doubles(self):
                self._use(replace(self.target, doubles=False))
        plain = run_probe(self)
        if plain.division and plain.root:
            check(self.found.name, plain, 0.5)
            return plain
        self._use(replace(self.target, exact_division=plain.division, exact_root=plain.root))
        check(self.found.name, run_probe(self), NEAR)
        return plain

    @property
    def lost(self) -> bool:
        """Whether the GPU is gone: it was reset, taken away, or failed; a new device must be opened."""
        return self._faults.lost

    @property
    def largest(self) -> int:
        """The most bytes that a buffer may have."""
        return self.memory.largest

    def supports(self, type_: Type) -> bool:
        """Whether kernels may calculate with a type."""
        return type_ is not F64 or self.target.doubles

    # ------------------------------------------------------------- programs

    def compile(self, kernel: Kernel) -> GpuProgram:
        """The program of a kernel; see ``Device.compile``."""
        return self._programs.of(kernel).or_longer(partial(self._longer.of, kernel))

    def compile_cached(self, key: str, build: Callable[[], Kernel], quick: bool = False) -> GpuProgram:
        """The program under a key; see ``Device.compile_cached``. Drivers know no hurry."""
        return self._programs.under(key, build).or_longer(partial(self._longer.under, key, build))

    def begin_apart(self, recipes: Iterable[Recipe], perhaps: Iterable[Recipe] = ()) -> None:
        """Nothing: pipelines belong to this process."""

    def _write(self, target: GpuTarget, kernel: Kernel) -> str:
        from zeroset.kernel.passes import optimise

        return to_wgsl(optimise(kernel), target)

    def _translate(self, kernel: Kernel, text: str, quick: bool) -> Compiled:
        return Compiled(Signature.of(kernel), 1, "wgsl", text.encode())

    def _place(self, target: GpuTarget, compiled: Compiled) -> GpuProgram:
        constant = target.constant(compiled.signature.buffers)
        return GpuProgram(Pipeline(self.handle, compiled, constant, self._faults), self._record)

    # --------------------------------------------------------------- memory

    def allocate(self, type_: Type, count: int, constant: bool = False) -> GpuBuffer:
        """A buffer of zeros."""
        return self.memory.allocate(type_, count, constant)

    def write(self, buffer: GpuBuffer, values: Array) -> None:
        """Set the first elements of a buffer."""
        with self._busy:
            # What was asked for before must still see the old elements.
            self.stream.submit()
            self.memory.write(buffer, values)

    def clear(self, buffer: GpuBuffer) -> None:
        """Set all elements of a buffer to zero."""
        with self._busy:
            self.stream.encoder().clear_buffer(buffer.handle)

    def copy(self, buffer: GpuBuffer) -> GpuBuffer:
        """Another buffer with the same elements."""
        made = self.allocate(buffer.type, buffer.count, buffer.constant)
        with self._busy:
            self.stream.encoder().copy_buffer_to_buffer(buffer.handle, 0, made.handle, 0, buffer.bytes)
        return made

    def read(self, buffer: GpuBuffer) -> Array:
        """The elements of a buffer, when all that was asked for before has been done."""
        with self._busy:
            self.stream.submit()
            return self.memory.read(buffer)

    # ----------------------------------------------------------------- work

    def submit(self) -> None:
        """Hand over what was asked for; nobody waits."""
        with self._busy:
            self.stream.submit()

    def lanes(self, count: int | Counted) -> int | None:
        """How many lanes a count is; None for what the GPU has counted, which it keeps to itself."""
        return count if isinstance(count, int) else None

    def _record(
        self, pipeline: Pipeline, count: int | Counted, uniforms: bytes, buffers: tuple[GpuBuffer, ...]
    ) -> None:
        with self._busy:
            self.stream.make_room(pipeline.layout.size)
            if isinstance(count, Counted):
                self._record_counted(pipeline, count, uniforms, buffers)
                return
            slot = self.stream.direct.add(head(count, self.target.workgroup) + uniforms)
            work = self._bind(pipeline, self.stream.direct, slot, buffers)
            work.dispatch_workgroups(*grid(count, self.target.workgroup))

    def _record_counted(
        self, pipeline: Pipeline, count: Counted, uniforms: bytes, buffers: tuple[GpuBuffer, ...]
    ) -> None:
        calls = self.stream.counted
        slot = calls.add(bytes(HEAD.size) + uniforms)
        counter = self._counting().pipeline
        numbers = {"index": count.place, "times": count.times, "slot": slot // 4}
        by_name = {"counters": count.buffer, "calls": self._calls}
        ordered = tuple(by_name[b.name] for b in counter.signature.buffers)
        place = self.stream.direct.add(head(1, self.target.workgroup) + counter.layout.pack(numbers))
        self._bind(counter, self.stream.direct, place, ordered).dispatch_workgroups(1)
        self._bind(pipeline, calls, slot, buffers).dispatch_workgroups_indirect(calls.handle, slot)

    def _bind(self, pipeline: Pipeline, slots: Any, slot: int, buffers: tuple[GpuBuffer, ...]) -> Any:
        work = self.stream.compute(pipeline.signature.name)
        work.set_pipeline(pipeline.handle)
        work.set_bind_group(0, pipeline.group(slots, buffers), [slot])
        return work

    def _counting(self) -> GpuProgram:
        if self._counter is None:
            workgroup = self.target.workgroup
            self._counter = self.compile_cached(f"count {workgroup}", lambda: count_kernel(workgroup))
        return self._counter
