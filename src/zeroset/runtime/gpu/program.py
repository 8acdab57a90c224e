"""A shader made ready: its pipeline, and a run of it as commands."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Mapping
from typing import Any

from zeroset.errors import DeviceError
from zeroset.kernel.types import Buffer
from zeroset.runtime.compiled import Compiled
from zeroset.runtime.device import Counted, Signature, check_count
from zeroset.runtime.gpu.calls import Layout
from zeroset.runtime.gpu.faults import Faults
from zeroset.runtime.gpu.memory import GpuBuffer
from zeroset.runtime.gpu.stream import Slots
from zeroset.runtime.gpu.trusted import shader_module

_BOUND = 8
"""Sets of buffers whose bind groups are kept: a program mostly sees the same ones frame by frame."""


class Pipeline:
    """A compute pipeline and its bind groups.

    Args:
        device: wgpu's device.
        compiled: the shader.
        constant: the names of the buffers that it reads as constants.
        faults: of the GPU.
    """

    def __init__(self, device: Any, compiled: Compiled, constant: frozenset[str], faults: Faults) -> None:
        self.signature = compiled.signature
        self.constant = constant
        self.layout = Layout(compiled.signature)
        self._device = device
        with faults.at(f"take the shader of {self.signature.name}"):
            module = shader_module(device, compiled.code.decode(), self.signature.name)
            self._group_layout = device.create_bind_group_layout(entries=self._entries())
            pipeline_layout = device.create_pipeline_layout(bind_group_layouts=[self._group_layout])
            stage = {"module": module, "entry_point": "main"}
            self.handle = device.create_compute_pipeline(
                layout=pipeline_layout, compute=stage, label=self.signature.name
            )
        self._groups: OrderedDict[tuple[int, ...], tuple[Any, tuple[GpuBuffer, ...]]] = OrderedDict()

    def _entries(self) -> list[Any]:
        import wgpu

        compute = wgpu.ShaderStage.COMPUTE
        kinds = [{"type": "uniform", "has_dynamic_offset": True, "min_binding_size": self.layout.size}]
        kinds += [{"type": self._kind(b)} for b in self.signature.buffers]
        return [{"binding": i, "visibility": compute, "buffer": kind} for i, kind in enumerate(kinds)]

    def _kind(self, buffer: Buffer) -> str:
        if buffer.name in self.constant:
            return "uniform"
        return "storage" if buffer.writable else "read-only-storage"

    def group(self, slots: Slots, buffers: tuple[GpuBuffer, ...]) -> Any:
        """The bind group of a set of buffers."""
        key = (id(slots), *map(id, buffers))
        known = self._groups.get(key)
        if known is None:
            entries = [{"binding": 0, "resource": {"buffer": slots.handle, "offset": 0, "size": self.layout.size}}]
            entries += [
                {"binding": i + 1, "resource": {"buffer": b.handle, "offset": 0, "size": b.bytes}}
                for i, b in enumerate(buffers)
            ]
            # The buffers are kept beside their group, so that no other buffer can come to have their identities.
            known = self._device.create_bind_group(layout=self._group_layout, entries=entries), buffers
            self._groups[key] = known
            while len(self._groups) > _BOUND:
                self._groups.popitem(last=False)
        self._groups.move_to_end(key)
        return known[0]


class GpuProgram:
    """A kernel on a GPU.

    Args:
        pipeline: its shader.
        record: records a run; the device's own.
    """

    def __init__(self, pipeline: Pipeline, record: Callable[..., None]) -> None:
        self.pipeline = pipeline
        self.signature: Signature = pipeline.signature
        self._record = record
        self._longer: Callable[[], GpuProgram] | None = None

    def or_longer(self, longer: Callable[[], GpuProgram]) -> GpuProgram:
        """This program; ``longer`` gives the one for buffers that are too long to be constants."""
        if self.pipeline.constant:
            self._longer = longer
        return self

    def run(self, count: int | Counted, uniforms: Mapping[str, float], buffers: Mapping[str, Any]) -> None:
        """Run lanes; see ``Program.run``."""
        data = self.pipeline.layout.pack(uniforms)
        bound = tuple(self._checked(b, buffers.get(b.name)) for b in self.signature.buffers)
        if self._longer is not None and any(g.constant and g.long for g in bound):
            self._longer().run(count, uniforms, buffers)
            return
        if isinstance(count, int) and not check_count(self.signature, count):
            return
        self._record(self.pipeline, count, data, bound)

    def _checked(self, buffer: Buffer, given: object) -> GpuBuffer:
        if not isinstance(given, GpuBuffer) or given.type is not buffer.type:
            what = "nothing" if given is None else f"a {type(given).__name__}"
            raise DeviceError(
                f"kernel {self.signature.name} needs the buffer {buffer.name} of {buffer.type} on the GPU, not {what}"
            )
        if buffer.name in self.pipeline.constant and not given.constant:
            raise DeviceError(f"kernel {self.signature.name} needs the buffer {buffer.name} as one of constants")
        return given
