"""Kernels and their control flow: what turns a Python function into a kernel.

A kernel is traced: inside ``with KernelBuilder("name") as k`` the Values made by ``k.uniform``, ``k.index`` and
``load`` flow through ordinary Python code. Loops and branches carry their state explicitly, as values that the body
takes and gives back; lanes that have left a loop or are not in a branch keep their old state and store nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from functools import cached_property
from types import TracebackType

from zeroset.errors import KernelError
from zeroset.kernel.types import BOOL, U32, Buffer, Type, Uniform
from zeroset.kernel.value import Block, Scalar, Value, constant, emit, lift, tracing


class Kernel:
    """A finished kernel: its name, what the caller binds, and its body."""

    def __init__(self, name: str, uniforms: tuple[Uniform, ...], buffers: tuple[Buffer, ...], body: Block) -> None:
        self.name = name
        self.uniforms = uniforms
        self.buffers = buffers
        self.body = body

    @cached_property
    def digest(self) -> str:
        """A hash of all of the kernel; equal kernels have equal digests in every process."""
        from zeroset.kernel.digest import digest_of

        return digest_of(self.name, self.uniforms, self.buffers, self.body)


class KernelBuilder:
    """Traces one kernel.

    Example:
        >>> from zeroset.kernel import F32, KernelBuilder
        >>> with KernelBuilder("scale") as k:
        ...     x = k.buffer("x", F32, writable=True)
        ...     i = k.index()
        ...     store(x, i, load(x, i) * k.uniform("factor", F32))
        >>> k.kernel.uniforms[0].name
        'factor'
    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._uniforms: list[Uniform] = []
        self._buffers: list[Buffer] = []
        self._body = Block()
        self._scope: AbstractContextManager[Block] | None = None
        self._kernel: Kernel | None = None

    def __enter__(self) -> KernelBuilder:
        self._scope = tracing(self._body)
        self._scope.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        assert self._scope is not None
        self._scope.__exit__(kind, error, trace)
        if error is None:
            self._kernel = Kernel(self._name, tuple(self._uniforms), tuple(self._buffers), self._body)

    @property
    def kernel(self) -> Kernel:
        """The finished kernel, after the ``with`` block."""
        if self._kernel is None:
            raise KernelError(f"kernel {self._name} is not finished: leave its with block first")
        return self._kernel

    def uniform(self, name: str, type_: Type) -> Value:
        """The uniform of that name, declared on first use."""
        for known in self._uniforms:
            if known.name == name:
                if known.type != type_:
                    raise KernelError(f"uniform {name} is {known.type} and cannot also be {type_}")
                break
        else:
            self._uniforms.append(Uniform(name, type_))
        return emit("uniform", (), (name,), (type_,))[0]

    def buffer(self, name: str, type_: Type, writable: bool = False, constant: bool = False) -> Buffer:
        """The buffer of that name, declared on first use."""
        made = Buffer(name, type_, writable, constant)
        for known in self._buffers:
            if known.name == name:
                if known != made:
                    raise KernelError(f"buffer {name} is already declared otherwise")
                return known
        self._buffers.append(made)
        return made

    def index(self) -> Value:
        """The lane's place in the dispatch, u32, from 0."""
        return emit("index", (), (), (U32,))[0]


def load(buffer: Buffer, index: Scalar) -> Value:
    """The element at an index (u32 or i32, in range)."""
    return emit("load", (lift(index, U32),), (buffer.name,), (buffer.type,))[0]


def store(buffer: Buffer, index: Scalar, value: Scalar) -> None:
    """Write an element; active lanes only. Two lanes must not write the same place."""
    if not buffer.writable:
        raise KernelError(f"buffer {buffer.name} is read only")
    emit("store", (lift(index, U32), lift(value, buffer.type)), (buffer.name,), ())


def atomic(operation: str, buffer: Buffer, index: Scalar, value: Scalar) -> Value:
    """``add``, ``min`` or ``max`` into an i32 or u32 element; gives back the value before."""
    if not buffer.writable or buffer.type.kind not in "iu":
        raise KernelError(f"atomics need a writable integer buffer, not {buffer.name}")
    operands = (lift(index, U32), lift(value, buffer.type))
    return emit(f"atomic_{operation}", operands, (buffer.name,), (buffer.type,))[0]


def any_(condition: Value) -> Value:
    """Whether some active lane of this packet has it; a target without votes gives the lane's own value."""
    return emit("any", (condition,), (), (BOOL,))[0]


def _region(types: tuple[Type, ...], body: Callable[..., object]) -> tuple[Block, tuple[object, ...]]:
    block = Block(types)
    with tracing(block):
        given = body(*block.parameters)
    if given is None:
        return block, ()
    return block, given if isinstance(given, tuple) else (given,)


def _yield(block: Block, values: Sequence[object], types: tuple[Type, ...], what: str) -> None:
    if len(values) != len(types):
        raise KernelError(f"{what} carries {len(types)} values but its body gives {len(values)}")
    with tracing(block):
        lifted = tuple(v if isinstance(v, Value) else constant(v, t) for v, t in zip(values, types, strict=True))  # type: ignore[arg-type]
    for value, type_ in zip(lifted, types, strict=True):
        if value.type != type_:
            raise KernelError(f"{what} carries a {type_} but its body gives a {value.type}")
    block.yields = lifted


def while_(condition: Callable[..., Value], body: Callable[..., object], *state: Value) -> tuple[Value, ...]:
    """Repeat ``body(*state) -> state`` on the lanes where ``condition(*state)`` holds."""
    types = tuple(v.type for v in state)
    head, test = _region(types, condition)
    _yield(head, test, (BOOL,), "the condition of while_")
    loop, given = _region(types, body)
    _yield(loop, given, types, "while_")
    return emit("while", state, (), types, (head, loop))


def for_(count: Scalar, body: Callable[..., object], *state: Value) -> tuple[Value, ...]:
    """Repeat ``body(i, *state) -> state`` for i = 0, 1, ..., count - 1 (u32)."""
    types = tuple(v.type for v in state)
    loop, given = _region((U32, *types), body)
    _yield(loop, given, types, "for_")
    return emit("for", (lift(count, U32), *state), (), types, (loop,))


def if_(
    condition: Value, then: Callable[[], object], otherwise: Callable[[], object] | None = None
) -> tuple[Value, ...]:
    """Run ``then()`` where the condition holds and ``otherwise()`` on the other lanes; both give the same types."""
    yes, given = _region((), then)
    no, other = _region((), otherwise or (lambda: ()))
    types = tuple(v.type for v in (*given, *other)[: len(given)] if isinstance(v, Value))
    if len(types) != len(given):
        raise KernelError("the first branch of if_ must give kernel values, not Python numbers")
    _yield(yes, given, types, "if_")
    _yield(no, other, types, "if_")
    return emit("if", (condition,), (), types, (yes, no))
