"""Values, instructions and blocks: the kernel language as a person writes it.

A ``Value`` is one SSA value. It obeys the scalar protocol that the number systems are generic over (operators,
``minimum``, ``select``, ...), so evaluating any formula on numbers made of Values appends its instructions to the
block being built. Equal pure instructions are emitted once for each scope; nothing else is optimised here.
"""

from __future__ import annotations

import math
import struct
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache, lru_cache
from typing import Any, Union

import numpy as np

from zeroset.errors import KernelError
from zeroset.kernel.ops import OPS, result_type
from zeroset.kernel.types import BOOL, F32, Type

Scalar = Union["Value", int, float, bool]


class Instruction:
    """One operation in a block: operands, attributes, nested regions and the values it defines."""

    __slots__ = ("attributes", "op", "operands", "regions", "results")

    def __init__(
        self,
        op: str,
        operands: tuple[Value, ...],
        attributes: tuple[Any, ...],
        types: tuple[Type, ...],
        regions: tuple[Block, ...] = (),
    ) -> None:
        self.op = op
        self.operands = operands
        self.attributes = attributes
        self.regions = regions
        # Nearly all instructions have one result.
        self.results = (Value(types[0], self),) if len(types) == 1 else tuple([Value(t, self) for t in types])


class Block:
    """A straight run of instructions with parameters at its head and yielded values at its end."""

    __slots__ = ("instructions", "parameters", "seen", "yields")

    def __init__(self, parameter_types: tuple[Type, ...] = ()) -> None:
        self.parameters = tuple(Value(t, None) for t in parameter_types)
        self.instructions: list[Instruction] = []
        self.yields: tuple[Value, ...] = ()
        self.seen: dict[Any, Instruction] = {}

    def walk(self) -> Iterator[Instruction]:
        """All instructions in here, nested ones after their own."""
        for instruction in self.instructions:
            yield instruction
            for region in instruction.regions:
                yield from region.walk()


class _Trace(threading.local):
    def __init__(self) -> None:
        self.blocks: list[Block] = []


_trace = _Trace()


@contextmanager
def tracing(block: Block) -> Iterator[Block]:
    """Make ``block`` the one that new instructions go to."""
    _trace.blocks.append(block)
    try:
        yield block
    finally:
        _trace.blocks.pop()


def emit(
    op: str,
    operands: tuple[Value, ...],
    attributes: tuple[Any, ...],
    types: tuple[Type, ...],
    regions: tuple[Block, ...] = (),
) -> tuple[Value, ...]:
    """Append an instruction to the block being traced, or find the equal one already in scope."""
    blocks = _trace.blocks
    if not blocks:
        raise KernelError("a kernel value was used outside the kernel that is being traced")
    block = blocks[-1]
    if not OPS[op].pure:
        instruction = Instruction(op, operands, attributes, types, regions)
        block.instructions.append(instruction)
        return instruction.results
    key = (op, attributes, types, *map(id, operands))
    for scope in reversed(blocks):
        found = scope.seen.get(key)
        if found is not None:
            return found.results
    instruction = Instruction(op, operands, attributes, types)
    block.instructions.append(instruction)
    block.seen[key] = instruction
    return instruction.results


def constant(value: float | int | bool, type_: Type) -> Value:
    """A constant of a kernel type; floats are rounded to nearest. NaN and infinity are not constants of kernels."""
    if type_.kind == "f":
        # Zeros are not remembered: 0.0 and -0.0 compare equal as dictionary keys.
        text = _remembered_text(value, type_) if value else _float_text(value, type_)
        return emit("const", (), (text,), (type_,))[0]
    if type_.kind in "iu":
        info = np.iinfo(type_.dtype)
        if int(value) != value or not info.min <= value <= info.max:
            raise KernelError(f"{value!r} is no {type_} constant")
        return emit("const", (), (str(int(value)),), (type_,))[0]
    return emit("const", (), (str(bool(value)),), (type_,))[0]


def _float_text(value: float, type_: Type) -> str:
    """A float as ``const`` instructions hold it, rounded to the type; 0.0 and -0.0 differ."""
    try:
        rounded = struct.unpack("<f", struct.pack("<f", value))[0] if type_ == F32 else float(value)
    except OverflowError:
        rounded = math.inf
    if not math.isfinite(rounded):
        raise KernelError(f"{value!r} is no finite {type_} constant; use a large finite sentinel instead")
    return repr(rounded)


_remembered_text = lru_cache(4096)(_float_text)


@cache
def _result(name: str, *operands: Type) -> tuple[Type]:
    return (result_type(OPS[name], operands),)


def constant_value(instruction: Instruction) -> Any:
    """The NumPy scalar that a ``const`` instruction stands for."""
    type_ = instruction.results[0].type
    text = instruction.attributes[0]
    if type_ == BOOL:
        return np.bool_(text == "True")
    return type_.dtype.type(float(text) if type_.kind == "f" else int(text))


def lift(value: Scalar, type_: Type) -> Value:
    """A Value as it is, a Python number as a constant of ``type_``."""
    if isinstance(value, Value):
        return value
    number: Any = value.item() if isinstance(value, (np.generic, np.ndarray)) else value
    return constant(number, type_)


def apply(name: str, *operands: Value) -> Value:
    """Emit a pure operation whose type follows from its operands."""
    try:
        types = _result(name, *[v.type for v in operands])
    except ValueError as error:
        raise KernelError(str(error)) from None
    return emit(name, operands, (), types)[0]


class Value:
    """One typed SSA value; see the module's text. Equality is identity: compare lanes with ``eq`` and ``ne``."""

    __slots__ = ("definition", "type")

    # NumPy scalars on the left side must leave the operator to the Value.
    __array_ufunc__ = None

    def __init__(self, type_: Type, definition: Instruction | None) -> None:
        self.type = type_
        self.definition = definition

    def __bool__(self) -> bool:
        raise KernelError("a kernel value has no truth while tracing; use select, if_ or while_ instead of a Python if")

    def _binary(self, name: str, other: Scalar) -> Value:
        return apply(name, self, other if isinstance(other, Value) else lift(other, self.type))

    def _reflected(self, name: str, other: Scalar) -> Value:
        return apply(name, lift(other, self.type), self)

    def __add__(self, other: Scalar) -> Value:
        return self._binary("add", other)

    def __radd__(self, other: Scalar) -> Value:
        return self._reflected("add", other)

    def __sub__(self, other: Scalar) -> Value:
        return self._binary("sub", other)

    def __rsub__(self, other: Scalar) -> Value:
        return self._reflected("sub", other)

    def __mul__(self, other: Scalar) -> Value:
        return self._binary("mul", other)

    def __rmul__(self, other: Scalar) -> Value:
        return self._reflected("mul", other)

    def __truediv__(self, other: Scalar) -> Value:
        return self._binary("div", other)

    def __rtruediv__(self, other: Scalar) -> Value:
        return self._reflected("div", other)

    def __neg__(self) -> Value:
        return apply("neg", self)

    def __abs__(self) -> Value:
        return apply("abs", self)

    def __lt__(self, other: Scalar) -> Value:
        return self._binary("lt", other)

    def __le__(self, other: Scalar) -> Value:
        return self._binary("le", other)

    def __gt__(self, other: Scalar) -> Value:
        return self._binary("gt", other)

    def __ge__(self, other: Scalar) -> Value:
        return self._binary("ge", other)

    def __and__(self, other: Scalar) -> Value:
        return self._binary("and", other)

    def __rand__(self, other: Scalar) -> Value:
        return self._reflected("and", other)

    def __or__(self, other: Scalar) -> Value:
        return self._binary("or", other)

    def __ror__(self, other: Scalar) -> Value:
        return self._reflected("or", other)

    def __xor__(self, other: Scalar) -> Value:
        return self._binary("xor", other)

    def __invert__(self) -> Value:
        return apply("not", self)

    def __lshift__(self, other: Scalar) -> Value:
        return self._binary("shl", other)

    def __rshift__(self, other: Scalar) -> Value:
        return self._binary("shr", other)

    def eq(self, other: Scalar) -> Value:
        """Lane by lane equality."""
        return self._binary("eq", other)

    def ne(self, other: Scalar) -> Value:
        """Lane by lane inequality."""
        return self._binary("ne", other)

    def minimum(self, other: Scalar) -> Value:
        """``self if self < other else other``."""
        return self._binary("min", other)

    def maximum(self, other: Scalar) -> Value:
        """``self if self > other else other``."""
        return self._binary("max", other)

    def fma(self, factor: Scalar, addend: Scalar) -> Value:
        """``self * factor + addend``, rounded once or twice as the target does it."""
        return apply("fma", self, lift(factor, self.type), lift(addend, self.type))

    def sqrt(self) -> Value:
        """Square root, correctly rounded; NaN for negative numbers."""
        return apply("sqrt", self)

    def floor(self) -> Value:
        """The largest integer not above."""
        return apply("floor", self)

    def ceil(self) -> Value:
        """The smallest integer not below."""
        return apply("ceil", self)

    def trunc(self) -> Value:
        """The integer part."""
        return apply("trunc", self)

    def rint(self) -> Value:
        """The nearest integer, halves to even."""
        return apply("rint", self)

    def select(self, chosen: Scalar, otherwise: Scalar) -> Value:
        """``chosen`` where this bool is true, else ``otherwise``."""
        like = chosen if isinstance(chosen, Value) else otherwise
        type_ = like.type if isinstance(like, Value) else BOOL if isinstance(like, bool) else F32
        return apply("select", self, lift(chosen, type_), lift(otherwise, type_))

    def convert(self, to: Type) -> Value:
        """The same number in another type; floats saturate to integers, NaN becomes 0."""
        return self if to == self.type else emit("convert", (self,), (to.name,), (to,))[0]

    def bitcast(self, to: Type) -> Value:
        """The same bits in another type of the same size."""
        if to.size != self.type.size:
            raise KernelError(f"bits of {self.type} do not fit {to}")
        return self if to == self.type else emit("bitcast", (self,), (to.name,), (to,))[0]

    def pow2(self) -> Value:
        """2 to an integral float inside the normal exponent range, exactly."""
        return apply("pow2", self)

    def frexp(self) -> tuple[Value, Value]:
        """Mantissa in [1, 2) and exponent, both floats, of a positive normal number."""
        return apply("mantissa", self), apply("exponent", self)
