"""The pure operations of the kernel language as LLVM instructions, on scalars and on vectors alike.

Each must give what ``kernel.ops`` defines, bit for bit, with instructions alone: no call into the C library, and no
fused multiply-add where the CPU has none. What takes more than an instruction or two is in ``conversions``.
"""

from __future__ import annotations

from collections.abc import Callable

from zeroset.codegen.conversions import (
    ROUNDINGS,
    write_bitcast,
    write_convert,
    write_exponent,
    write_mantissa,
    write_pow2,
    write_rounding,
)
from zeroset.codegen.emit import Emit
from zeroset.codegen.writer import SCALARS, Writer
from zeroset.kernel.types import BOOL, I32, TYPES
from zeroset.kernel.value import Instruction

_COMPARE_FLOAT = {"lt": "olt", "le": "ole", "gt": "ogt", "ge": "oge", "eq": "oeq", "ne": "une"}
_COMPARE_SIGNED = {"lt": "slt", "le": "sle", "gt": "sgt", "ge": "sge", "eq": "eq", "ne": "ne"}
_COMPARE_UNSIGNED = {"lt": "ult", "le": "ule", "gt": "ugt", "ge": "uge", "eq": "eq", "ne": "ne"}
_COMPARE = {"f": _COMPARE_FLOAT, "i": _COMPARE_SIGNED, "u": _COMPARE_UNSIGNED}


def _arithmetic(emit: Emit, name: str) -> str:
    if emit.source.kind != "f":
        return emit.binary(name, *emit.operands)
    contract = " contract" if emit.writer.target.contract and name != "div" else ""
    return emit.binary(f"f{name}{contract}", *emit.operands)


def _negate(emit: Emit) -> str:
    (a,) = emit.operands
    if emit.source.kind == "f":
        return emit.writer.assign(f"fneg {emit.type} {a}")
    return emit.binary("sub", "zeroinitializer" if emit.vector else "0", a)


def _extreme(emit: Emit, name: str) -> str:
    a, b = emit.operands
    if emit.source.kind != "f":
        return emit.intrinsic(f"llvm.{emit.source.kind.replace('i', 's')}{name}", a, b)
    # Exactly minps and maxps: with a NaN, and between zeros, the second operand comes back.
    bits = emit.binary(f"fcmp {'olt' if name == 'min' else 'ogt'}", a, b)
    return emit.pick(bits, emit.type, a, b)


def _fma(emit: Emit) -> str:
    a, b, c = emit.operands
    if emit.writer.target.fused:
        return emit.intrinsic("llvm.fma", a, b, c)
    return emit.binary("fadd", emit.binary("fmul", a, b), c)


def _compare(emit: Emit, name: str) -> str:
    kind = emit.source.kind
    predicate = _COMPARE[kind][name]
    return emit.truth(emit.binary(f"{'fcmp' if kind == 'f' else 'icmp'} {predicate}", *emit.operands))


def _not(emit: Emit) -> str:
    ones = "true" if emit.source == BOOL else "-1"
    text = emit.writer.splat(emit.source, ones) if emit.vector else ones
    return emit.binary("xor", emit.operands[0], text)


def _shift(emit: Emit, name: str) -> str:
    a, b = emit.operands
    within = emit.binary("and", b, emit.splat("i32", 31))
    right = "ashr" if emit.source == I32 else "lshr"
    return emit.binary("shl" if name == "shl" else right, a, within)


def _bind(rule: Callable[[Emit, str], str], name: str) -> Callable[[Emit], str]:
    return lambda emit: rule(emit, name)


_RULES: dict[str, Callable[[Emit], str]] = {
    **{name: _bind(_arithmetic, name) for name in ("add", "sub", "mul", "div")},
    **{name: _bind(_extreme, name) for name in ("min", "max")},
    **{name: _bind(write_rounding, name) for name in ROUNDINGS},
    **{name: _bind(_compare, name) for name in _COMPARE_FLOAT},
    **{name: _bind(_shift, name) for name in ("shl", "shr")},
    **{name: _bind(lambda emit, op: emit.binary(op, *emit.operands), name) for name in ("and", "or", "xor")},
    "neg": _negate,
    "abs": lambda emit: emit.intrinsic("llvm.fabs", *emit.operands),
    "sqrt": lambda emit: emit.intrinsic("llvm.sqrt", *emit.operands),
    "fma": _fma,
    "pow2": write_pow2,
    "mantissa": write_mantissa,
    "exponent": write_exponent,
    "not": _not,
    "convert": write_convert,
    "bitcast": write_bitcast,
}


def write_pure(writer: Writer, instruction: Instruction) -> None:
    """Write a pure instruction, constants excepted: those are literals where they are used."""
    result, op = instruction.results[0], instruction.op
    if op == "select":
        writer.define(result, _select(writer, instruction))
    elif op in ("convert", "bitcast") and _is_alias(instruction):
        writer.rename(result, instruction.operands[0])
    else:
        writer.define(result, _RULES[op](Emit(writer, instruction)))


def _select(writer: Writer, instruction: Instruction) -> str:
    condition, a, b = instruction.operands
    vector = writer.is_varying(instruction.results[0])
    type_ = writer.type_of(a.type, vector)
    if writer.is_varying(condition):
        return writer.choose(writer.vector(condition), a.type, writer.vector(a), writer.vector(b))
    texts = writer.form(a, vector), writer.form(b, vector)
    return writer.assign(f"select i1 {writer.scalar(condition)}, {type_} {texts[0]}, {type_} {texts[1]}")


def _is_alias(instruction: Instruction) -> bool:
    """Whether a conversion does nothing: signed and unsigned integers are one LLVM type."""
    return SCALARS[TYPES[instruction.attributes[0]].name] == SCALARS[instruction.operands[0].type.name]
