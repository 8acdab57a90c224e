"""A kernel's digest: the hash of all that its code depends on, under which compiled code is kept."""

from __future__ import annotations

from typing import TYPE_CHECKING

from zeroset.hashes import hexdigest

if TYPE_CHECKING:
    from zeroset.kernel.types import Buffer, Uniform
    from zeroset.kernel.value import Block


def digest_of(name: str, uniforms: tuple[Uniform, ...], buffers: tuple[Buffer, ...], body: Block) -> str:
    """The same for equal kernels in every process, and for no others; values count by where they first appear.

    Example:
        >>> from zeroset.kernel import KernelBuilder
        >>> with KernelBuilder("a") as a, KernelBuilder("b") as b:
        ...     pass
        >>> a.kernel.digest == b.kernel.digest
        False
    """
    parts: list[object] = [name, len(uniforms), len(buffers)]
    for uniform in uniforms:
        parts += (uniform.name, uniform.type.name)
    for buffer in buffers:
        parts += (buffer.name, buffer.type.name, buffer.writable, buffer.constant)
    _block(body, parts, _Numbers())
    # repr puts each text between quotes: with the counts before all that may be longer or shorter, no two kernels
    # give one text.
    return hexdigest(repr(parts))


class _Numbers(dict[int, int]):
    """A number for each value's id, counted up as they come."""

    def __missing__(self, key: int) -> int:
        number = self[key] = len(self)
        return number


def _block(block: Block, parts: list[object], numbers: _Numbers) -> None:
    """A block's parameters, instructions and yields; regions follow their instruction."""
    parts += (len(block.parameters), len(block.instructions), len(block.yields))
    for value in block.parameters:
        parts += (numbers[id(value)], value.type.name)
    for instruction in block.instructions:
        attributes, operands, regions = instruction.attributes, instruction.operands, instruction.regions
        parts += (instruction.op, len(attributes), len(operands), len(instruction.results), len(regions), *attributes)
        parts += [numbers[id(v)] for v in operands]
        for value in instruction.results:
            parts += (numbers[id(value)], value.type.name)
        for region in regions:
            _block(region, parts, numbers)
    parts += [numbers[id(v)] for v in block.yields]
