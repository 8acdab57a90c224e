"""The contract between a frame and whatever runs its kernels.

A device compiles kernels to programs and holds buffers; a program runs on buffers and uniforms. The contract is made
so that a frame allocates and compiles nothing: buffers live as long as their owner keeps them, uniforms are numbers
packed anew for each run, and a program is asked for once. On the CPU a buffer is a NumPy array that the caller may
read at any time; on other devices it is a handle, and ``read`` and ``write`` move the data. All work on a device
happens in the order it was asked for, but not always at once: a GPU collects it until ``submit`` or ``read``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
import numpy.typing as npt

from zeroset.errors import DeviceError
from zeroset.kernel.build import Kernel
from zeroset.kernel.types import TYPES, Buffer, Type, Uniform

Array = npt.NDArray[Any]


class Signature(NamedTuple):
    """What a caller binds to run a program: all of a kernel that outlives its compilation.

    Attributes:
        name: the kernel's name, for errors.
        uniforms: the scalars it reads.
        buffers: the arrays it reads or writes.
    """

    name: str
    uniforms: tuple[Uniform, ...]
    buffers: tuple[Buffer, ...]

    @classmethod
    def of(cls, kernel: Kernel) -> Signature:
        """A kernel's signature."""
        return cls(kernel.name, kernel.uniforms, kernel.buffers)

    def to_json(self) -> dict[str, Any]:
        """The signature as plain data."""
        return {
            "name": self.name,
            "uniforms": [[u.name, u.type.name] for u in self.uniforms],
            "buffers": [[b.name, b.type.name, b.writable, b.constant] for b in self.buffers],
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Signature:
        """The signature that ``to_json`` wrote; ``KeyError``, ``TypeError`` or ``ValueError`` on anything else."""
        return cls(
            str(data["name"]),
            tuple(Uniform(name, TYPES[type_]) for name, type_ in data["uniforms"]),
            tuple(Buffer(name, TYPES[type_], bool(w), bool(c)) for name, type_, w, c in data["buffers"]),
        )


class Counted(NamedTuple):
    """A number of lanes that an earlier pass has written into a buffer; a GPU never brings it to the host.

    Attributes:
        buffer: a u32 buffer of the device.
        place: which element.
        times: lanes for each that was counted.
    """

    buffer: Any
    place: int = 0
    times: int = 1


class Recipe(NamedTuple):
    """How a program is made: what ``Device.compile_cached`` takes."""

    key: str
    build: Callable[[], Kernel]
    quick: bool = False


class Program(Protocol):
    """A kernel made ready for one device."""

    @property
    def signature(self) -> Signature:
        """What ``run`` must be given."""
        ...

    def run(self, count: int | Counted, uniforms: Mapping[str, float], buffers: Mapping[str, Any]) -> None:
        """Run ``count`` lanes, after all that was asked of the device before.

        Args:
            count: lanes, 0 to 2^31 - 1.
            uniforms: a number for each of the signature's uniforms; more are ignored.
            buffers: a buffer of this device for each of the signature's; more are ignored. A buffer that the kernel
                writes must not overlap another that it uses.

        Raises:
            DeviceError: something is missing or has the wrong type, or the device failed.
        """
        ...


@runtime_checkable
class Device(Protocol):
    """Something that runs kernels."""

    @property
    def name(self) -> str:
        """Its name as users write it: ``cpu``, ``gpu`` or ``interp``."""
        ...

    def compile(self, kernel: Kernel) -> Program:
        """The program of a kernel; the same kernel again costs nothing."""
        ...

    def compile_cached(self, key: str, build: Callable[[], Kernel], quick: bool = False) -> Program:
        """The program that an earlier call, perhaps of an earlier process, made under this key.

        Args:
            key: names everything that ``build`` depends on, versions of zeroset excepted.
            build: traces the kernel; called only where no program is known under the key.
            quick: that it is there soon counts more than that it runs fast; the results are the same.
        """
        ...

    def begin_apart(self, recipes: Iterable[Recipe], perhaps: Iterable[Recipe] = ()) -> None:
        """Begin to make programs outside this process, where that can be; ``compile_cached`` then waits for them.

        It may do nothing; it must be called before others of the programs are begun in threads.

        Args:
            recipes: of what will be asked for.
            perhaps: of what may be asked for.
        """
        ...

    def supports(self, type_: Type) -> bool:
        """Whether kernels may calculate with a type; all but f64 are everywhere."""
        ...

    @property
    def largest(self) -> int:
        """The most bytes that a buffer may have."""
        ...

    def allocate(self, type_: Type, count: int, constant: bool = False) -> Any:
        """A buffer of zeros; ``DeviceError`` where there is no memory for it.

        Args:
            type_: of its elements.
            count: how many.
            constant: whether kernels will call it so.
        """
        ...

    def write(self, buffer: Any, values: Array) -> None:
        """Set the first elements of a buffer."""
        ...

    def clear(self, buffer: Any) -> None:
        """Set all elements of a buffer to zero."""
        ...

    def copy(self, buffer: Any) -> Any:
        """Another buffer with the same elements."""
        ...

    def read(self, buffer: Any) -> Array:
        """The elements of a buffer, when all that was asked of the device before has been done."""
        ...

    def lanes(self, count: int | Counted) -> int | None:
        """How many lanes a count is, where that can be told without waiting; None where it cannot."""
        ...

    def submit(self) -> None:
        """Let the device begin what it was asked for; without waiting for it."""
        ...


class HostMemory:
    """Buffers of devices that share the host's memory: NumPy arrays; their programs run at once."""

    largest = 2**40

    def begin_apart(self, recipes: Iterable[Recipe], perhaps: Iterable[Recipe] = ()) -> None:
        """Nothing."""

    def supports(self, type_: Type) -> bool:
        """Every type."""
        return True

    def allocate(self, type_: Type, count: int, constant: bool = False) -> Array:
        """An array of zeros, aligned to cache lines."""
        size = type_.size
        raw = np.zeros(count * size + 64, np.uint8)
        start = -raw.ctypes.data % 64
        return raw[start : start + count * size].view(type_.dtype)

    def write(self, buffer: Array, values: Array) -> None:
        """Set the first elements of an array."""
        buffer[: len(values)] = values

    def clear(self, buffer: Array) -> None:
        """Set all elements of an array to zero."""
        buffer.fill(0)

    def copy(self, buffer: Array) -> Array:
        """A copy of an array."""
        return buffer.copy()

    def read(self, buffer: Array) -> Array:
        """The array itself."""
        return buffer

    def lanes(self, count: int | Counted) -> int:
        """How many lanes a count is."""
        return lanes_of(count)

    def submit(self) -> None:
        """Nothing: what was asked for is done."""


def lanes_of(count: int | Counted) -> int:
    """The number of lanes, where buffers are arrays."""
    return count if isinstance(count, int) else int(count.buffer[count.place]) * count.times


def check_count(signature: Signature, count: int) -> int:
    """The count, if it is one that every device can run; raises ``DeviceError``."""
    if not 0 <= count < 2**31:
        raise DeviceError(f"kernel {signature.name} cannot run {count} lanes", hint="0 to 2^31 - 1 can be run at once")
    return count


def check_array(signature: Signature, buffer: Buffer, array: object) -> Array:
    """The array bound to a buffer, if it can be; raises ``DeviceError``."""
    wanted = f"kernel {signature.name} needs the buffer {buffer.name} as a contiguous 1-D array of {buffer.type.dtype}"
    if not isinstance(array, np.ndarray):
        raise DeviceError(f"{wanted}, not {'nothing' if array is None else type(array).__name__}")
    if array.dtype != buffer.type.dtype or array.ndim != 1 or not array.flags.c_contiguous:
        raise DeviceError(f"{wanted}, not {array.dtype} of shape {array.shape}")
    if buffer.writable and not array.flags.writeable:
        raise DeviceError(f"{wanted} that may be written")
    return array
