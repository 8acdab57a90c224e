"""The pure operations of the kernel language as LLVM instructions, on scalars and on vectors alike.

Each must give what ``kernel.ops`` defines, bit for bit, with instructions alone: LLVM's vector code calls the C
library, lane by lane, wherever the CPU lacks an operation, so those are written out here (rounding without SSE4.1,
fused multiply-add without FMA). No value is ever poison: lanes that are not active may hold anything, and their
conversions are frozen.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from zeroset.codegen.writer import SCALARS, Writer
from zeroset.kernel.types import BOOL, I32, TYPES, Type
from zeroset.kernel.value import Instruction

_COMPARE_FLOAT = {"lt": "olt", "le": "ole", "gt": "ogt", "ge": "oge", "eq": "oeq", "ne": "une"}
_COMPARE_SIGNED = {"lt": "slt", "le": "sle", "gt": "sgt", "ge": "sge", "eq": "eq", "ne": "ne"}
_COMPARE_UNSIGNED = {"lt": "ult", "le": "ule", "gt": "ugt", "ge": "uge", "eq": "eq", "ne": "ne"}
_COMPARE = {"f": _COMPARE_FLOAT, "i": _COMPARE_SIGNED, "u": _COMPARE_UNSIGNED}
_ROUND = {"floor": "llvm.floor", "ceil": "llvm.ceil", "trunc": "llvm.trunc", "rint": "llvm.roundeven"}


@dataclass(frozen=True, slots=True)
class _Float:
    """Where the parts of an IEEE format lie."""

    bits: str
    mantissa: int
    bias: int

    @property
    def fraction(self) -> int:
        return (1 << self.mantissa) - 1


_FLOATS = {"f32": _Float("i32", 23, 127), "f64": _Float("i64", 52, 1023)}


class Emit:
    """One pure instruction being written, all its operands in one form."""

    def __init__(self, writer: Writer, instruction: Instruction) -> None:
        self.writer = writer
        self.instruction = instruction
        self.result = instruction.results[0].type
        self.vector = writer.is_varying(instruction.results[0])
        self.source = instruction.operands[-1].type
        self.operands = [writer.form(v, self.vector) for v in instruction.operands]
        self.type = writer.type_of(self.source, self.vector)

    def splat(self, type_: str, literal: int | str) -> str:
        """A literal of an LLVM type in the instruction's form."""
        return f"splat ({type_} {literal})" if self.vector else str(literal)

    def lanes(self, scalar: str) -> str:
        """An LLVM type in the instruction's form."""
        return f"<{self.writer.width} x {scalar}>" if self.vector else scalar

    def binary(self, name: str, a: str, b: str, type_: str | None = None) -> str:
        """A two-operand LLVM instruction."""
        return self.writer.assign(f"{name} {type_ or self.type} {a}, {b}")

    def cast(self, name: str, operand: str, source: str, target: str) -> str:
        """A one-operand LLVM conversion."""
        return self.writer.assign(f"{name} {source} {operand} to {target}")

    def intrinsic(self, name: str, *operands: str) -> str:
        """An LLVM intrinsic over the operands' type."""
        suffix = self.writer.suffix(self.source, self.vector)
        return self.writer.call(f"{name}.{suffix}", self.type, *((self.type, text) for text in operands))

    def truth(self, bits: str) -> str:
        """One bit a lane as the form truth values have."""
        return self.writer.from_bits(bits) if self.vector else bits

    def pick(self, bits: str, type_: str, a: str, b: str) -> str:
        """LLVM's ``select`` on bits."""
        return self.writer.assign(f"select {self.lanes('i1')} {bits}, {type_} {a}, {type_} {b}")


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


def _round(emit: Emit, name: str) -> str:
    (a,) = emit.operands
    if emit.writer.target.rounds:
        return emit.intrinsic(_ROUND[name], a)
    return _round_by_addition(emit, name, a)


def _round_by_addition(emit: Emit, name: str, a: str) -> str:
    """Adding and taking off 2^23 (2^52) rounds to an integer; one step back where that went the wrong way."""
    scalar, form = SCALARS[emit.source.name], _FLOATS[emit.source.name]
    magic = emit.splat(scalar, f"{2.0**form.mantissa:.1f}")
    one, zero = emit.splat(scalar, "1.0"), emit.splat(scalar, "0.0")
    size = emit.intrinsic("llvm.fabs", a)
    nearest = emit.binary("fsub", emit.binary("fadd", size, magic), magic)
    if name == "trunc":
        over = emit.binary("fcmp ogt", nearest, size)
        nearest = emit.binary("fsub", nearest, emit.pick(over, emit.type, one, zero))
    rounded = emit.intrinsic("llvm.copysign", nearest, a)
    if name in ("floor", "ceil"):
        wrong = emit.binary(f"fcmp {'ogt' if name == 'floor' else 'olt'}", rounded, a)
        step = emit.pick(wrong, emit.type, one, zero)
        rounded = emit.intrinsic("llvm.copysign", emit.binary("fsub" if name == "floor" else "fadd", rounded, step), a)
    small = emit.binary("fcmp olt", size, magic)
    return emit.pick(small, emit.type, rounded, a)


def _pow2(emit: Emit) -> str:
    form = _FLOATS[emit.source.name]
    # By way of 32 bits for f64 too: AVX2 and SSE have no conversion to 64-bit integers.
    narrow, wide = emit.lanes("i32"), emit.lanes(form.bits)
    whole = emit.writer.assign(f"freeze {narrow} {emit.cast('fptosi', emit.operands[0], emit.type, narrow)}")
    if form.bits == "i64":
        whole = emit.cast("sext", whole, narrow, wide)
    biased = emit.binary("add", whole, emit.splat(form.bits, form.bias), wide)
    return emit.cast("bitcast", emit.binary("shl", biased, emit.splat(form.bits, form.mantissa), wide), wide, emit.type)


def _mantissa(emit: Emit) -> str:
    form = _FLOATS[emit.source.name]
    wide = emit.lanes(form.bits)
    bits = emit.cast("bitcast", emit.operands[0], emit.type, wide)
    fraction = emit.binary("and", bits, emit.splat(form.bits, form.fraction), wide)
    one = emit.splat(form.bits, form.bias << form.mantissa)
    return emit.cast("bitcast", emit.binary("or", fraction, one, wide), wide, emit.type)


def _exponent(emit: Emit) -> str:
    form = _FLOATS[emit.source.name]
    narrow, wide = emit.lanes("i32"), emit.lanes(form.bits)
    bits = emit.cast("bitcast", emit.operands[0], emit.type, wide)
    biased = emit.binary("lshr", bits, emit.splat(form.bits, form.mantissa), wide)
    if form.bits == "i64":
        biased = emit.cast("trunc", biased, wide, narrow)
    return emit.cast("sitofp", emit.binary("sub", biased, emit.splat("i32", form.bias), narrow), narrow, emit.type)


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


def _convert(emit: Emit) -> str:
    (a,), source, to = emit.operands, emit.source, emit.result
    target = emit.writer.type_of(to, emit.vector)
    if source == BOOL:
        bits = emit.writer.bits(a) if emit.vector else a
        one, zero = ("1.0", "0.0") if to.kind == "f" else ("1", "0")
        return emit.pick(bits, target, emit.splat(SCALARS[to.name], one), emit.splat(SCALARS[to.name], zero))
    if to == BOOL:
        zero = emit.splat(SCALARS[source.name], "0.0" if source.kind == "f" else "0")
        return emit.truth(emit.binary("fcmp une" if source.kind == "f" else "icmp ne", a, zero))
    if source.kind == "f" and to.kind == "f":
        return emit.cast("fpext" if to.name == "f64" else "fptrunc", a, emit.type, target)
    if source.kind == "f":
        return _saturate(emit, a, to, target)
    return emit.cast("sitofp" if source == I32 else "uitofp", a, emit.type, target)


def _saturate(emit: Emit, a: str, to: Type, target: str) -> str:
    if emit.writer.target.saturates:
        suffix = f"{emit.writer.suffix(to, emit.vector)}.{emit.writer.suffix(emit.source, emit.vector)}"
        name = "llvm.fptosi.sat" if to == I32 else "llvm.fptoui.sat"
        return emit.writer.call(f"{name}.{suffix}", target, (emit.type, a))
    return _saturate_by_hand(emit, a, to, target)


def _saturate_by_hand(emit: Emit, a: str, to: Type, target: str) -> str:
    """Clamp and convert: LLVM's own saturating conversion goes lane by lane on x86."""
    scalar = SCALARS[emit.source.name]
    low, above, top = (-(2.0**31), 2.0**31, "2147483647") if to == I32 else (0.0, 2.0**32, "-1")
    floor, limit = emit.splat(scalar, f"{low:.1f}"), emit.splat(scalar, f"{above:.1f}")
    # A NaN becomes the lower bound, which is already right for unsigned integers.
    clamped = emit.pick(emit.binary("fcmp ogt", a, floor), emit.type, a, floor)
    whole = emit.cast("fptosi" if to == I32 else "fptoui", clamped, emit.type, target)
    whole = emit.writer.assign(f"freeze {target} {whole}")
    whole = emit.pick(emit.binary("fcmp oge", a, limit), target, emit.splat("i32", top), whole)
    if to == I32:
        whole = emit.pick(emit.binary("fcmp uno", a, a), target, emit.splat("i32", "0"), whole)
    return whole


def _bitcast(emit: Emit) -> str:
    return emit.cast("bitcast", emit.operands[0], emit.type, emit.writer.type_of(emit.result, emit.vector))


def _bind(rule: Callable[[Emit, str], str], name: str) -> Callable[[Emit], str]:
    return lambda emit: rule(emit, name)


_RULES: dict[str, Callable[[Emit], str]] = {
    **{name: _bind(_arithmetic, name) for name in ("add", "sub", "mul", "div")},
    **{name: _bind(_extreme, name) for name in ("min", "max")},
    **{name: _bind(_round, name) for name in _ROUND},
    **{name: _bind(_compare, name) for name in _COMPARE_FLOAT},
    **{name: _bind(_shift, name) for name in ("shl", "shr")},
    **{name: _bind(lambda emit, op: emit.binary(op, *emit.operands), name) for name in ("and", "or", "xor")},
    "neg": _negate,
    "abs": lambda emit: emit.intrinsic("llvm.fabs", *emit.operands),
    "sqrt": lambda emit: emit.intrinsic("llvm.sqrt", *emit.operands),
    "fma": _fma,
    "pow2": _pow2,
    "mantissa": _mantissa,
    "exponent": _exponent,
    "not": _not,
    "convert": _convert,
    "bitcast": _bitcast,
}


def write_pure(writer: Writer, instruction: Instruction) -> None:
    """Write a pure instruction, constants excepted: those are literals where they are used."""
    result = instruction.results[0]
    if instruction.op == "select":
        writer.define(result, _select(writer, instruction))
    elif _is_alias(instruction):
        writer.rename(result, instruction.operands[0])
    else:
        writer.define(result, _RULES[instruction.op](Emit(writer, instruction)))


def _select(writer: Writer, instruction: Instruction) -> str:
    condition, a, b = instruction.operands
    vector = writer.is_varying(instruction.results[0])
    type_ = writer.type_of(a.type, vector)
    if writer.is_varying(condition):
        return writer.choose(writer.vector(condition), a.type, writer.vector(a), writer.vector(b))
    texts = writer.form(a, vector), writer.form(b, vector)
    return writer.assign(f"select i1 {writer.scalar(condition)}, {type_} {texts[0]}, {type_} {texts[1]}")


def _is_alias(instruction: Instruction) -> bool:
    """Signed and unsigned integers are one LLVM type."""
    if instruction.op not in ("convert", "bitcast"):
        return False
    return SCALARS[TYPES[instruction.attributes[0]].name] == SCALARS[instruction.operands[0].type.name]
