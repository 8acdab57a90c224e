"""The laws that ``fold`` applies: what each operation is when some operand is special.

Each law takes the rebuilding and the operands and gives the value that the operation equals, or None. All of them hold
for every float, NaN and signed zeros included (the payload and sign of a NaN are nobody's business).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from zeroset.kernel.types import BOOL
from zeroset.kernel.value import Value

if TYPE_CHECKING:
    from zeroset.kernel.passes.literals import Literals


def _is_float(value: Value) -> bool:
    return value.type.kind == "f"


def _add(f: Literals, a: Value, b: Value) -> Value | None:
    zero = -0.0 if _is_float(a) else 0
    if f.is_number(b, zero):
        return a
    if f.is_number(a, zero):
        return b
    if (minus := f.operand_of(b, "neg")) is not None:
        return f.emit("sub", (a, minus), a.type)
    if (minus := f.operand_of(a, "neg")) is not None:
        return f.emit("sub", (b, minus), a.type)
    return None


def _sub(f: Literals, a: Value, b: Value) -> Value | None:
    if f.is_number(b, 0.0):
        return a
    if _is_float(a) and f.is_number(a, -0.0):
        return f.emit("neg", (b,), a.type)
    if (minus := f.operand_of(b, "neg")) is not None:
        return f.emit("add", (a, minus), a.type)
    return f.constant(0, a.type) if a is b and not _is_float(a) else None


def _mul(f: Literals, a: Value, b: Value) -> Value | None:
    for one, other in ((a, b), (b, a)):
        if not f.is_constant(one):
            continue
        if f.is_number(one, 1):
            return other
        if a.type.kind in "fi" and f.is_number(one, -1):
            return f.emit("neg", (other,), a.type)
        if not _is_float(a) and f.is_number(one, 0):
            return one
    return None


def _div(f: Literals, a: Value, b: Value) -> Value | None:
    if f.is_number(b, 1.0):
        return a
    if f.is_number(b, -1.0):
        return f.emit("neg", (a,), a.type)
    if f.is_constant(b):
        number = f.number(b)
        mantissa, exponent = np.frexp(number)
        # A power of two that is normal, as is its reciprocal; NumPy's mantissas are in [1/2, 1).
        if abs(mantissa) == 0.5 and abs(int(exponent) - 1) <= -int(np.finfo(b.type.dtype).minexp):
            return f.emit("mul", (a, f.constant(1 / number, b.type)), a.type)
    return None


def _neg(f: Literals, a: Value) -> Value | None:
    return f.operand_of(a, "neg")


def _abs(f: Literals, a: Value) -> Value | None:
    inner = f.operand_of(a, "neg")
    if inner is not None:
        return f.emit("abs", (inner,), a.type)
    return a if f.operand_of(a, "abs") is not None else None


def _extreme(f: Literals, a: Value, b: Value) -> Value | None:
    return a if a is b else None


def _never(f: Literals, a: Value, b: Value) -> Value | None:
    return f.constant(False, BOOL) if a is b else None


def _always(f: Literals, a: Value, b: Value) -> Value | None:
    return f.constant(True, BOOL) if a is b and not _is_float(a) else None


def _unequal(f: Literals, a: Value, b: Value) -> Value | None:
    return f.constant(False, BOOL) if a is b and not _is_float(a) else None


def _all_ones(value: Value) -> int:
    return {"bool": 1, "i32": -1, "u32": 2**32 - 1}[value.type.name]


def _and(f: Literals, a: Value, b: Value) -> Value | None:
    for known, other in ((a, b), (b, a)):
        if f.is_number(known, 0):
            return known
        if f.is_number(known, _all_ones(known)):
            return other
    return a if a is b else None


def _or(f: Literals, a: Value, b: Value) -> Value | None:
    for known, other in ((a, b), (b, a)):
        if f.is_number(known, 0):
            return other
        if f.is_number(known, _all_ones(known)):
            return known
    return a if a is b else None


def _xor(f: Literals, a: Value, b: Value) -> Value | None:
    for known, other in ((a, b), (b, a)):
        if f.is_number(known, 0):
            return other
        if f.is_number(known, _all_ones(known)):
            return f.emit("not", (other,), a.type)
    return f.constant(0, a.type) if a is b else None


_OPPOSITE = {"eq": "ne", "ne": "eq"}
_OPPOSITE_OF_INTEGERS = {"lt": "ge", "ge": "lt", "gt": "le", "le": "gt", **_OPPOSITE}


def _not(f: Literals, a: Value) -> Value | None:
    definition = a.definition
    if definition is None:
        return None
    if definition.op == "not":
        return definition.operands[0]
    if definition.op in _OPPOSITE_OF_INTEGERS:
        # With a NaN, neither x < y nor x >= y.
        table = _OPPOSITE if _is_float(definition.operands[0]) else _OPPOSITE_OF_INTEGERS
        if definition.op in table:
            return f.emit(table[definition.op], definition.operands, BOOL)
    return None


def _shift(f: Literals, a: Value, b: Value) -> Value | None:
    return a if f.is_number(b, 0) or f.is_number(a, 0) else None


def _select(f: Literals, c: Value, a: Value, b: Value) -> Value | None:
    if f.is_constant(c):
        return a if f.number(c) else b
    if a is b:
        return a
    if a.type == BOOL and (made := _select_of_bools(f, c, a, b)) is not None:
        return made
    if (inner := f.operand_of(c, "not")) is not None:
        return f.emit("select", (inner, b, a), a.type)
    return None


def _select_of_bools(f: Literals, c: Value, a: Value, b: Value) -> Value | None:
    if f.is_number(a, 1):
        return c if f.is_number(b, 0) else f.emit("or", (c, b), BOOL)
    if f.is_number(b, 0):
        return f.emit("and", (c, a), BOOL)
    if f.is_number(a, 0) and f.is_number(b, 1):
        return f.emit("not", (c,), BOOL)
    return None


LAWS: dict[str, Callable[..., Value | None]] = {
    "add": _add,
    "sub": _sub,
    "mul": _mul,
    "div": _div,
    "neg": _neg,
    "abs": _abs,
    "min": _extreme,
    "max": _extreme,
    "lt": _never,
    "gt": _never,
    "le": _always,
    "ge": _always,
    "eq": _always,
    "ne": _unequal,
    "and": _and,
    "or": _or,
    "xor": _xor,
    "not": _not,
    "shl": _shift,
    "shr": _shift,
    "select": _select,
}
