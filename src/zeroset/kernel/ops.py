"""THE table of kernel operations: name, typing rule and meaning.

One row is one operation. ``evaluate`` is its definition on NumPy arrays: the interpreter runs it, constant folding
runs it, and every backend is held to it. Control flow, memory and ``any`` are in the table for their names and typing
only; their meaning is in ``interp.py``.

The minimum is ``a if a < b else b`` and the maximum ``a if a > b else b``: with a NaN the second operand comes back.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from zeroset.kernel.types import BOOL, Type

Array = Any
"""A NumPy array or scalar of a kernel type's dtype."""


class Op(NamedTuple):
    """One operation of the kernel language.

    Attributes:
        name: its name in kernels and in their printed text.
        kinds: the operand kinds it takes (``f``, ``i``, ``u``, ``b``), for the operands of the common type.
        result: ``same`` (the common type), ``bool`` or ``attr`` (the type is given with the instruction).
        arity: how many operands.
        evaluate: its meaning on NumPy arrays, or None where the interpreter itself says it.
        pure: whether equal operands give equal results and nothing else happens.
    """

    name: str
    kinds: str
    arity: int
    result: str = "same"
    evaluate: Callable[..., Array] | None = None
    pure: bool = True


def _fma(a: Array, b: Array, c: Array) -> Array:
    if a.dtype == np.float32:
        return (a.astype(np.float64) * b + c).astype(np.float32)
    return a * b + c


def _convert(a: Array, to: Type) -> Array:
    """Conversions saturate (floats to integers) as WGSL's do; a NaN becomes 0."""
    if to.kind in "iu" and a.dtype.kind == "f":
        info = np.iinfo(to.dtype)
        wide = np.nan_to_num(np.trunc(a.astype(np.float64)), nan=0.0, posinf=info.max, neginf=info.min)
        return np.clip(wide, info.min, info.max).astype(to.dtype)
    return a.astype(to.dtype)


def _pow2(a: Array) -> Array:
    """Defined for integral values of the normal exponent range only."""
    return np.ldexp(a.dtype.type(1), a.astype(np.int32))


def _shift_left(a: Array, b: Array) -> Array:
    return (a << (b & a.dtype.type(31))).astype(a.dtype)


def _shift_right(a: Array, b: Array) -> Array:
    return (a >> (b & a.dtype.type(31))).astype(a.dtype)


_ROWS = (
    Op("add", "fiu", 2, evaluate=np.add),
    Op("sub", "fiu", 2, evaluate=np.subtract),
    Op("mul", "fiu", 2, evaluate=np.multiply),
    Op("div", "f", 2, evaluate=np.divide),
    Op("neg", "fi", 1, evaluate=np.negative),
    Op("abs", "f", 1, evaluate=np.abs),
    Op("min", "fiu", 2, evaluate=lambda a, b: np.where(a < b, a, b)),
    Op("max", "fiu", 2, evaluate=lambda a, b: np.where(a > b, a, b)),
    Op("fma", "f", 3, evaluate=_fma),
    Op("sqrt", "f", 1, evaluate=np.sqrt),
    Op("floor", "f", 1, evaluate=np.floor),
    Op("ceil", "f", 1, evaluate=np.ceil),
    Op("trunc", "f", 1, evaluate=np.trunc),
    Op("rint", "f", 1, evaluate=np.rint),
    Op("pow2", "f", 1, evaluate=_pow2),
    Op("mantissa", "f", 1, evaluate=lambda a: np.frexp(a)[0] * a.dtype.type(2)),
    Op("exponent", "f", 1, evaluate=lambda a: (np.frexp(a)[1] - 1).astype(a.dtype)),
    Op("lt", "fiu", 2, "bool", np.less),
    Op("le", "fiu", 2, "bool", np.less_equal),
    Op("gt", "fiu", 2, "bool", np.greater),
    Op("ge", "fiu", 2, "bool", np.greater_equal),
    Op("eq", "fiu", 2, "bool", np.equal),
    Op("ne", "fiu", 2, "bool", np.not_equal),
    Op("and", "iub", 2, evaluate=np.bitwise_and),
    Op("or", "iub", 2, evaluate=np.bitwise_or),
    Op("xor", "iub", 2, evaluate=np.bitwise_xor),
    Op("not", "iub", 1, evaluate=np.invert),
    Op("shl", "iu", 2, evaluate=_shift_left),
    Op("shr", "iu", 2, evaluate=_shift_right),
    Op("convert", "fiub", 1, "attr", _convert),
    Op("bitcast", "fiu", 1, "attr", lambda a, to: np.ascontiguousarray(a).view(to.dtype)),
    Op("select", "fiub", 3, evaluate=np.where),
    Op("const", "", 0, "attr"),
    Op("uniform", "", 0, "attr"),
    Op("index", "", 0, "attr"),
    Op("any", "b", 1, "bool", pure=False),
    Op("load", "iu", 1, "attr", pure=False),
    Op("store", "", 2, "attr", pure=False),
    Op("atomic_add", "", 2, "attr", pure=False),
    Op("atomic_min", "", 2, "attr", pure=False),
    Op("atomic_max", "", 2, "attr", pure=False),
    Op("while", "", -1, "attr", pure=False),
    Op("for", "", -1, "attr", pure=False),
    Op("if", "", -1, "attr", pure=False),
)
OPS: dict[str, Op] = {row.name: row for row in _ROWS}
ATOMICS: dict[str, Any] = {"atomic_add": np.add, "atomic_min": np.minimum, "atomic_max": np.maximum}


def result_type(op: Op, operands: tuple[Type, ...]) -> Type:
    """The type that an operation gives for operand types; raises ``ValueError`` where they do not fit.

    Only for rows whose result is ``same`` or ``bool``; the others carry their type with the instruction.
    """
    if len(operands) != op.arity:
        raise ValueError(f"{op.name} takes {op.arity} operands, not {len(operands)}")
    common = operands
    if op.name == "select":
        if operands[0] != BOOL:
            raise ValueError(f"select chooses by a bool, not by {operands[0]}")
        common = operands[1:]
    if any(t != common[0] for t in common):
        raise ValueError(f"{op.name} of different types: {', '.join(map(str, operands))}")
    if common[0].kind not in op.kinds:
        raise ValueError(f"{op.name} is not defined on {common[0]}")
    return BOOL if op.result == "bool" else common[0]
