"""The interpreter: what a kernel means, on NumPy arrays, all lanes of a dispatch at once.

Slow and plain on purpose. Every backend is held to it, and it is the target of last resort where no machine code can
be made. All lanes form one packet, so ``any_`` votes over the whole dispatch.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from zeroset.errors import KernelError
from zeroset.kernel.build import Kernel
from zeroset.kernel.ops import ATOMICS, OPS
from zeroset.kernel.types import TYPES
from zeroset.kernel.value import Block, Instruction, Value, constant_value

Array = Any


def run(kernel: Kernel, count: int, uniforms: Mapping[str, float], buffers: Mapping[str, np.ndarray[Any, Any]]) -> None:
    """Run ``count`` lanes of a kernel; buffers are written in place.

    Raises:
        KernelError: a uniform or buffer is missing, or a buffer has another dtype.
    """
    for uniform in kernel.uniforms:
        if uniform.name not in uniforms:
            raise KernelError(f"kernel {kernel.name} needs the uniform {uniform.name}")
    for buffer in kernel.buffers:
        if buffer.name not in buffers or buffers[buffer.name].dtype != buffer.type.dtype:
            raise KernelError(f"kernel {kernel.name} needs the buffer {buffer.name} of {buffer.type.dtype}")
    machine = _Machine(kernel, count, uniforms, buffers)
    with np.errstate(all="ignore"):
        machine.block(kernel.body, np.ones(count, np.bool_))


class _Machine:
    def __init__(
        self, kernel: Kernel, count: int, uniforms: Mapping[str, float], buffers: Mapping[str, np.ndarray[Any, Any]]
    ) -> None:
        self.count = count
        self.uniforms = {u.name: u.type.dtype.type(uniforms[u.name]) for u in kernel.uniforms}
        self.buffers = buffers
        self.values: dict[int, Array] = {}

    def full(self, value: Array) -> Array:
        return np.broadcast_to(np.asarray(value), (self.count,))

    def get(self, values: tuple[Value, ...]) -> list[Array]:
        return [self.values[id(v)] for v in values]

    def bind(self, values: tuple[Value, ...], arrays: list[Array]) -> None:
        for value, array in zip(values, arrays, strict=True):
            self.values[id(value)] = array

    def block(self, block: Block, active: Array) -> list[Array]:
        for instruction in block.instructions:
            results = self.instruction(instruction, active)
            self.bind(instruction.results, results)
        return self.get(block.yields)

    def instruction(self, instruction: Instruction, active: Array) -> list[Array]:
        op = OPS[instruction.op]
        operands = self.get(instruction.operands)
        if op.evaluate is not None:
            extra = (TYPES[instruction.attributes[0]],) if op.result == "attr" else ()
            dtype = instruction.results[0].type.dtype
            return [np.asarray(op.evaluate(*operands, *extra)).astype(dtype, copy=False)]
        if op.name.startswith("atomic"):
            return self._atomic(instruction, operands, active)
        result: list[Array] = getattr(self, f"_{op.name}")(instruction, operands, active)
        return result

    def _const(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        return [self.full(constant_value(instruction))]

    def _uniform(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        return [self.full(self.uniforms[instruction.attributes[0]])]

    def _index(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        return [np.arange(self.count, dtype=np.uint32)]

    def _any(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        return [self.full(np.bool_(np.any(operands[0] & active)))]

    def _load(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        data = self.buffers[instruction.attributes[0]]
        # Lanes that are not active may hold any index: they read element 0, whose value nobody uses.
        where = np.where(active, operands[0], 0)
        if not len(data):
            return [np.zeros(self.count, data.dtype)]
        return [data[where]]

    def _store(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        self.buffers[instruction.attributes[0]][operands[0][active]] = self.full(operands[1])[active]
        return []

    def _atomic(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        data, combine = self.buffers[instruction.attributes[0]], ATOMICS[instruction.op]
        before = np.zeros(self.count, data.dtype)
        for lane in np.flatnonzero(active):
            place = operands[0][lane]
            before[lane] = data[place]
            data[place] = combine(data[place], operands[1][lane])
        return [before]

    def _while(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        head, loop = instruction.regions
        state = operands
        while True:
            self.bind(head.parameters, state)
            active = active & self.block(head, active)[0]
            if not active.any():
                return state
            self.bind(loop.parameters, state)
            after = self.block(loop, active)
            state = [np.where(active, new, old) for new, old in zip(after, state, strict=True)]

    def _for(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        (loop,) = instruction.regions
        count, state = operands[0], operands[1:]
        step = 0
        while True:
            inside = active & (step < count)
            if not inside.any():
                return state
            self.bind(loop.parameters, [self.full(np.uint32(step)), *state])
            after = self.block(loop, inside)
            state = [np.where(inside, new, old) for new, old in zip(after, state, strict=True)]
            step += 1

    def _if(self, instruction: Instruction, operands: list[Array], active: Array) -> list[Array]:
        yes, no = instruction.regions
        condition = operands[0]
        given = self.block(yes, active & condition)
        other = self.block(no, active & ~condition)
        return [np.where(condition, a, b) for a, b in zip(given, other, strict=True)]
